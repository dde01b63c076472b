"""Agents of other kinds: commands in any language, and the game as an environment for learning."""
