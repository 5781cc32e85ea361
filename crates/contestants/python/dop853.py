"""SciPy's DOP853 as a program: launches on standard input, attitudes at landing on standard output."""

import csv
import sys

import numpy as np
from scipy.integrate import solve_ivp


def slope(_, y, ratio):
    w, x, y, z, a, b, c = y
    return [
        -(x * a + y * b + z * c) / 2,
        (w * a + y * c - z * b) / 2,
        (w * b + z * a - x * c) / 2,
        (w * c + x * b - y * a) / 2,
        -(ratio - 1) * c * b,
        (ratio - 1) * c * a,
        0.0,
    ]


for row in csv.DictReader(sys.stdin):
    name, toss = row.pop("id"), {column: float(text) for column, text in row.items()}
    start = np.array([toss[column] for column in ("w", "x", "y", "z", "rate_x", "rate_y", "rate_z")])
    # SciPy takes no smaller relative tolerance.
    relative = max(toss["tolerance"], 100 * np.finfo(float).eps)
    ends = solve_ivp(
        slope, (0.0, toss["time"]), start, "DOP853", args=(toss["i3"] / toss["i1"],), rtol=relative, atol=toss["tolerance"]
    )
    if ends.success:
        w, x, y, z = ends.y[:4, -1]
        print(f"{name},{float(w)!r},{float(x)!r},{float(y)!r},{float(z)!r},calls={ends.nfev}", flush=True)
    else:
        print(f"{name},failed,{ends.message}", flush=True)
