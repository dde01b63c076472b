"""Compiled functions over floats and flat memory. They import only one another.

detect (when is the next event) · advance (along the closed form) · resolve (what the event does) · loop.
"""
