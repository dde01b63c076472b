"""The fixed sequences of ``angles``, compiled."""

from numba.extending import register_jitable

from physics.kernels import angles
from physics.kernels.compiling import kernel

for _piece in (angles.radians_of, angles.sine_of, angles.cosine_of):
    register_jitable(error_model="numpy", forceinline=True)(_piece)

sine_cosine = kernel(angles.sine_cosine)
"""``sine_cosine(degrees)``: (sin, cos) of a finite angle in degrees."""
