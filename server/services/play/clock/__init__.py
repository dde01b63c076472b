"""A game's clock: when a turn runs out, what it was charged, and the flag that ends the game."""
