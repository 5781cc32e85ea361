"""What a toss costs in columns on one thread: by NumPy's closed form, by this package, and by Rust's own batch.

`python bindings/python/benchmarks/columns.py` in a clone measures all of them in one run, in turns and with the same
launches, and prints the shortest times. With `--no-rust` it needs no Cargo.
"""

import argparse
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import perf_counter_ns

import numpy as np

import unfair_toss as ut

ROOT = Path(__file__).resolve().parents[3]


def launches(number: int) -> np.ndarray:
    """Rates about x, y, z in rad/s, and speeds in m/s."""
    random = np.random.default_rng(1)
    return np.concatenate([random.uniform(-40.0, 40.0, (3, number)), random.uniform(0.0, 5.0, (1, number))])


def closed_form(x: np.ndarray, y: np.ndarray, z: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """cos θ of the paper's coin from horizontal, by NumPy."""
    along, across = 0.5 * z, x * x + y * y
    square = across + along * along
    part = along * along / square
    return part + (1.0 - part) * np.cos(np.sqrt(square) * (2.0 * speed / 9.81))


def shortest(work: Callable[[], object], repeats: int) -> float:
    """The shortest time in ns."""
    times = []
    for _ in range(repeats):
        start = perf_counter_ns()
        work()
        times.append(perf_counter_ns() - start)
    return min(times)


def by_rust(path: Path) -> dict[str, float]:
    """The times of Rust's own batch in ns a toss by name, of the launches in a file."""
    command = ["cargo", "bench", "--quiet", "--package", "toss", "--bench", "columns", "--", str(path)]
    lines = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    return {name: float(time) for name, time in (line.split() for line in lines if line)}


def by_python(columns: np.ndarray) -> dict[str, float]:
    """The times of NumPy and of this package in ns a toss by name."""
    number = columns.shape[1]
    out, faces = np.empty(number), np.empty(number, np.int8)
    works: dict[str, Callable[[], object]] = {
        "numpy": lambda: closed_form(*columns),
        "cos_tilt": lambda: ut.cos_tilt(*columns, out=out, threads=1),
        "outcome": lambda: ut.outcome(*columns, out=faces, threads=1),
        "count": lambda: ut.count(*columns, threads=1),
    }
    return {name: shortest(work, 15) / number for name, work in works.items()}


def main(arguments: list[str]) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tosses", type=int, default=1_000_000)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--no-rust", action="store_true")
    options = parser.parse_args(arguments)
    columns = launches(options.tosses)
    ours, rust = [], []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "launches")
        columns.tofile(path)
        for _ in range(options.rounds):
            ours.append(by_python(columns))
            if not options.no_rust:
                rust.append(by_rust(path))
    numpy = min(times["numpy"] for times in ours)
    print(f"NumPy's closed form: {numpy:.2f} ns a toss")
    for name in ("cos_tilt", "outcome", "count"):
        time = min(times[name] for times in ours)
        line = f"{name}: {time:.2f} ns a toss, {numpy / time:.1f} times faster than NumPy"
        if rust:
            beside = min(times[name] for times in rust)
            line += f", {time / beside:.2f} times the {beside:.2f} ns of Rust's batch"
        print(line)


if __name__ == "__main__":
    main(sys.argv[1:])
