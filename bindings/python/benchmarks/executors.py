"""What an executor costs: the time of two processes of one thread, over that of one process of two threads.

`python bindings/python/benchmarks/executors.py` runs both in turns, compares their counts, and prints the shortest
times.
"""

import argparse
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from time import perf_counter

import unfair_toss as ut


def processes() -> ProcessPoolExecutor:
    """Two processes that share nothing with this one."""
    return ProcessPoolExecutor(2, mp_context=get_context("spawn"))


def main(arguments: list[str]) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--launches", type=int, default=10**10)
    parser.add_argument("--rounds", type=int, default=2)
    options = parser.parse_args(arguments)
    space, plan = ut.Space.named("paper-fig4"), ut.Plan.random(options.launches)
    one, two = [], []
    for _ in range(options.rounds):
        start = perf_counter()
        whole = ut.probability(space, plan, threads=2)
        between = perf_counter()
        found = ut.probability(space, plan, executor=processes)
        one.append(between - start)
        two.append(perf_counter() - between)
        assert (found.heads, found.tails, found.interval) == (whole.heads, whole.tails, whole.interval)
    print(f"{whole.heads} heads of {options.launches} by both")
    print(f"one process {min(one):.2f} s, two {min(two):.2f} s, {min(two) / min(one):.3f} times as long")


if __name__ == "__main__":
    main(sys.argv[1:])
