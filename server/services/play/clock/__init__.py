"""A game's clock at the server: its columns, views and ledger, the flag that ends the game, and what a stop costs.

The arithmetic is `referee.play.clock`.
"""
