"""The kernels that Python calls, all together: look, aim, rule, rack. Rows in, rows out.

`places` (n, 16, 2) m with NaN for absent balls and `games` (n, WIDTH) int64 hold all games; `rows` (m,) says which of
them an array of m rows is about. Every array is C-contiguous. `client.learn.engine` alone loads them: importing them
decides where their compiled code is kept.
"""

from client.learn.compiled.aiming import aim_straight, aim_with_jaws
from client.learn.compiled.observing import observe
from client.learn.compiled.racking import rack
from client.learn.compiled.ruling import rule

__all__ = ["aim_straight", "aim_with_jaws", "observe", "rack", "rule"]
