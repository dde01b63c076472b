"""The shipped agents; `client.agents.registry` knows them by name."""
