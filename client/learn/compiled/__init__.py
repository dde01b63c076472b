"""The step of many games at once, compiled: what `codec`, the noise and the referee say, on arrays."""
