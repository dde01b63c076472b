"""Compiled geometry; see `entries`."""
