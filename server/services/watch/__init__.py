"""What spectators see: events of live games, and which agents are there."""
