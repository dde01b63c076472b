"""Tournaments at a server: organised, played on, shown."""
