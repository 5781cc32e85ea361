"""Lands coins by the closed form: two turns, about the angular momentum and about the normal."""

import csv
import math
import sys

Quaternion = tuple[float, float, float, float]


def turn(x: float, y: float, z: float) -> Quaternion:
    """The quaternion of a turn by the vector (x, y, z), whose length is the angle (rad)."""
    angle = math.hypot(x, y, z)
    factor = math.sin(angle / 2) / angle if angle else 0.0
    return math.cos(angle / 2), factor * x, factor * y, factor * z


def product(a: Quaternion, b: Quaternion) -> Quaternion:
    (w, x, y, z), (p, q, r, s) = a, b
    return (
        w * p - x * q - y * r - z * s,
        w * q + x * p + y * s - z * r,
        w * r - x * s + y * p + z * q,
        w * s + x * r - y * q + z * p,
    )


for row in csv.DictReader(sys.stdin):
    launch = {name: float(text) for name, text in row.items()}
    k, time = launch["i3"] / launch["i1"], launch["time"]
    x, y, z = (launch[f"rate_{axis}"] * time for axis in "xyz")
    attitude = launch["w"], launch["x"], launch["y"], launch["z"]
    landing = product(product(attitude, turn(x, y, k * z)), turn(0.0, 0.0, (1 - k) * z))
    error = min(2.0, 5e-16 * (4 + math.hypot(x, y, k * z) + abs((1 - k) * z)))
    print(row["id"], *landing, f"error={error}", sep=",", flush=True)
