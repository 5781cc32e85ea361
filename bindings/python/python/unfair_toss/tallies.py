"""The sums of some launches of a plan, which add up in any order."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from . import _native
from ._native import Plan, Space, Tally, count
from .errors import MalformedError
from .given import a_function, wrong
from .planner import Choice, plan_of

_SLICE = 1 << 28
"""Launches between two reports of progress: some tenths of a second."""


def tally(
    space: Space,
    plan: Plan | Choice,
    range: tuple[int, int] | range | None = None,
    *,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Tally:
    """The result of some launches of a plan, as integers that add up.

    Parameters
    ----------
    space : Space
        The distribution of the launches.
    plan : Plan or Choice
        Which of them are tried.
    range : tuple of 2 ints or range, optional
        The numbers of the launches: the first one, and the one after the last; all of them by default.
    threads : int, optional
        Number of threads; None for one per core. It does not change the result.
    progress : callable, optional
        Called with the number of launches that are done, and of all.

    Returns
    -------
    Tally
        To be added to others with ``+``, until all launches of the plan are in it.

    Raises
    ------
    errors.InputError
        For a range beyond the launches of the plan, and for a plan that does not fit the space.
    """
    a_function("progress", progress)
    plan = plan_of(plan)
    start, end = _ends(range, plan.points(space))
    whole: Tally | None = None
    for first in _starts(start, end):
        part = _native.tally(space, plan, first, min(first + _SLICE, end), threads)
        whole = part if whole is None else whole + part
        if progress is not None:
            progress(whole.range[1] - start, end - start)
    assert whole is not None
    return whole


def _ends(given: tuple[int, int] | range | None, points: int) -> tuple[int, int]:
    """The first launch and the one after the last."""
    if given is None:
        return 0, points
    if isinstance(given, range):
        if given.step != 1:
            raise MalformedError(f"range = {given} has gaps", field="range", valid="a step of 1")
        given = (given.start, given.stop)
    if not isinstance(given, tuple | list) or len(given) != 2:
        raise wrong("range", given, "a tuple of 2 ints, or a range")
    start, end = (count("range", number) for number in given)
    if not start <= end <= points:
        valid = f"an ascending range of the {points} launches of the plan"
        raise MalformedError(f"range = {start}..{end} can't be used: expected {valid}", field="range", valid=valid)
    return start, end


def _starts(start: int, end: int) -> Iterable[int]:
    """The first launches of the slices; one even if there is no launch."""
    return (start + _SLICE * index for index in range(max(1, math.ceil((end - start) / _SLICE))))
