"""What the framework does not do: strict JSON, the order of checks, exactly once, limits on bodies and connections."""
