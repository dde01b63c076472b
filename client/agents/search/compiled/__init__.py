"""Compiled geometry; see `kernels`."""
