"""What the server does, apart from HTTP.

Agents, matches, strokes, turns, clocks and the physics on its own.
"""
