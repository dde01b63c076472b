"""A game being played: turns, strokes, clocks, budgets, ends."""
