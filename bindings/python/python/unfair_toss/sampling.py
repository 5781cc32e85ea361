"""Probabilities of heads over a space of launches, at once or in parts."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from os import PathLike
from typing import TYPE_CHECKING, Any

from . import _native
from ._native import Plan, Solver, Space, Tally, count
from .errors import MalformedError, PartError
from .given import a_function, an, truth, wrong
from .planner import Choice, plan_of
from .results import ShownAsTable
from .tallies import tally

if TYPE_CHECKING:
    from concurrent.futures import Executor


@dataclass(frozen=True)
class Estimate(ShownAsTable):
    """An estimated probability of heads.

    Attributes
    ----------
    probability : float or None
        From 0 to 1; of counts, the share of heads among the decided launches, and None if none is decided.
    interval : tuple of 2 floats or None
        The interval in which it lies: proven with enclosure, at a level of 95 % with others; a grid has none.
    interval_kind : str
        What the interval is; "proven" if it is.
    points : int
        Number of launches; with exact-speed, each of them stands for all speeds. With enclosure, the number of cells.
    heads, tails, undecided : int or None
        Numbers of launches by their outcome; None with exact-speed, which counts none.
    certified : bool
        Whether the answer is proven: every outcome of the counts, or the interval with enclosure. Counts that came through a
        file or another process no longer are.
    proven_by : dict of str to int, or None
        The number of outcomes that each stage of the proof decided.
    plan : Plan
        Which launches were tried.
    integrated_by : dict of str to int, or None
        The same of proofs by integration.
    """

    probability: float | None
    interval: tuple[float, float] | None
    interval_kind: str
    points: int
    heads: int | None
    tails: int | None
    undecided: int | None
    certified: bool
    proven_by: dict[str, int] | None = field(hash=False)
    plan: Plan
    integrated_by: dict[str, int] | None = field(default=None, hash=False)

    @property
    def half_width(self) -> float | None:
        """Distance from the probability to the farther end of the interval; None without one of both."""
        if self.interval is None or self.probability is None:
            return None
        lo, hi = self.interval
        return max(self.probability - lo, hi - self.probability)


def merge(parts: Iterable[Tally]) -> Estimate:
    """The estimate from all parts of a plan, in any order.

    Parameters
    ----------
    parts : iterable of Tally
        Each launch of the plan has to be in one of them.

    Returns
    -------
    Estimate
        The same as that of the whole plan at once, to the last bit.

    Raises
    ------
    errors.PartError
        If a part is of another plan or space, if launches are missing, or if some are in two parts.
    """
    try:
        each = iter(parts)
    except TypeError:
        raise wrong("parts", parts, "an iterable of Tally") from None
    given = list(each)
    for index, part in enumerate(given):
        if not isinstance(part, Tally):
            message = f"parts[{index}] is of type {type(part).__name__}: expected a Tally"
            raise PartError(message, field="parts", index=index, valid="a Tally")
    ordered = sorted(given, key=lambda part: part.range)
    if not ordered:
        raise PartError("no part was given", field="parts", valid="all parts of a plan")
    whole = ordered[0]
    for part in ordered[1:]:
        try:
            whole = whole + part
        except MalformedError as error:
            raise PartError(str(error), field="parts", valid=error.valid) from None
    return estimate(whole)


def estimate(whole: Tally) -> Estimate:
    """The estimate from a tally of all launches of its plan.

    Parameters
    ----------
    whole : Tally
        Of all launches.

    Returns
    -------
    Estimate
        The probability with its interval.

    Raises
    ------
    errors.PartError
        If launches are missing.
    """
    an(Tally, "whole", whole)
    try:
        return Estimate(**whole._estimate())
    except MalformedError as error:
        raise PartError(str(error), field="parts", valid=error.valid) from None


def probability(
    space: Space,
    plan: Plan | Choice | None = None,
    *,
    accuracy: float | None = None,
    solver: str | Solver | None = None,
    prove: bool = False,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
    executor: Executor | Callable[[], Any] | None = None,
    shards: int | None = None,
    folder: str | PathLike[str] | None = None,
    retries: int | None = None,
) -> Estimate:
    """The probability of heads over a space of launches.

    Parameters
    ----------
    space : Space
        The distribution of the launches.
    plan : Plan or Choice, optional
        Which of them are tried; by default, the cheapest that serves for ``accuracy``.
    accuracy : float, optional
        Largest acceptable error if no plan is given; 1e-4 by default, 1e-3 for a body that is not symmetric.
    solver : str or Solver, optional
        What decides the outcomes; by default the exact motion, which proves them. It needs a plan, and has no parts.
    prove : bool
        Whether each outcome is proven by integration, by the solver ``"quaternion"``.
    threads : int, optional
        Number of threads, with an executor of each worker. By default one per core; with an executor, one.
    progress : callable, optional
        Called with the number of launches that are done, and of all.
    executor : concurrent.futures.Executor, or a callable that makes one, optional
        What computes the parts, such as ``ProcessPoolExecutor(2)`` or Dask's ``client.get_executor()``. A callable, such
        as ``lambda: ProcessPoolExecutor(2)``, is called again after the death of a worker that breaks the executor.
    shards : int, optional
        Number of parts; by default of at most 10⁹ launches each, and eight or more. It does not change the result.
    folder : path, optional
        Where each part is kept as a file, as ``unfair-toss probability --shard`` writes it. A part that is there is not
        computed again; a file that holds another part is refused.
    retries : int, optional
        How often a part is computed again if its worker fails; 3 by default. It needs an executor.

    Returns
    -------
    Estimate
        The probability with its interval, and the counts.

    Raises
    ------
    errors.InputError
        For a plan that does not fit the space, and for arguments that have no effect.
    errors.PartError
        For a part that is wrong.
    """
    an(Space, "space", space)
    a_function("progress", progress)
    retries = None if retries is None else count("retries", retries)
    if executor is not None and not hasattr(executor, "submit") and not callable(executor):
        raise wrong("executor", executor, "an executor, or what makes one")
    if retries is not None and executor is None:
        raise MalformedError("retries has no effect without an executor", field="retries", valid="None, or an executor")
    if truth("prove", prove) and solver is None:
        raise MalformedError("prove needs the solver 'quaternion'", field="prove", valid="False, or a solver")
    parted = executor is not None or shards is not None or folder is not None
    if plan is None:
        if parted or solver is not None:
            raise MalformedError("a plan is needed for parts and for a solver", field="plan", valid="a Plan")
        return _planned(space, accuracy, threads, progress)
    plan = plan_of(plan)
    if accuracy is not None:
        raise MalformedError("accuracy has no effect with a plan", field="accuracy", valid="None, or no plan")
    if solver is not None:
        if parted or progress is not None:
            raise MalformedError("a solver has no parts and no progress", field="solver", valid="None, for parts")
        return Estimate(**_native.estimate_by_solver(space, plan, solver, threads, prove))
    if plan.method == "enclosure" and not parted and progress is None:
        return Estimate(**_native.estimate_by_solver(space, plan, "exact", threads, False))
    if not parted:
        return estimate(tally(space, plan, threads=threads, progress=progress))
    # Only here, because what it imports takes as long as all the rest.
    from .parts import Parts

    parts = Parts(space, plan, shards, folder, threads, executor, retries, progress)
    return merge(parts.computed())


def _planned(
    space: Space, accuracy: float | None, threads: int | None, progress: Callable[[int, int], object] | None
) -> Estimate:
    if progress is not None:
        raise MalformedError("progress needs a plan", field="progress", valid="None, or a Plan")
    return Estimate(**_native.estimate_by_accuracy(space, accuracy, threads))
