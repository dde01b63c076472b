"""Matches: challenged, accepted, seeded, shown, kept secret as long as need be."""
