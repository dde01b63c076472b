"""Benchmarks of Pooliad: scripts that measure and append what they found to ``benchmarks/results`` as data lines.

``pooliad bench`` lists them, ``pooliad bench NAME [--full]`` or ``python -m benchmarks.NAME [--full]`` runs one.
``docs/benchmarks.md`` says what each measures. Not part of the installed distribution.
"""
