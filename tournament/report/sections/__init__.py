"""The sections of a report: a function each, from its data to a piece of the page; empty if nothing is to be said."""
