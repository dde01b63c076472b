"""Ratings, intervals, tests: what the results say about strength, and how surely."""
