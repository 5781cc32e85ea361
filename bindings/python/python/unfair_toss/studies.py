"""Series, maps and comparisons of many launches, as the commands of the same names of ``unfair-toss`` give them."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from . import _native
from ._native import Body, Plan, Solver, Space, Toss
from .errors import MalformedError, UnknownNameError
from .given import as_seed, wrong
from .planner import Choice, plan_of
from .tables import Comparison, Convergence, Limit, Map, MethodErrors, Sample, Sensitivity, Spread, SpreadAlone
from .units import Quantity

if TYPE_CHECKING:
    _Seed: TypeAlias = int | np.random.Generator | np.random.SeedSequence | None


def limit(
    body: str | Body = "paper",
    *,
    points: int | None = None,
    seed: _Seed = None,
    rng: _Seed = None,
    solver: str | Solver = "exact",
    threads: int | None = None,
) -> Limit:
    """The limit p(ψ) of the probability of heads for long flights, beside the share of heads among some.

    Parameters
    ----------
    body : str or Body
        A symmetric body.
    points : int, optional
        Number of flights at each ψ; 1000 by default.
    seed : int, numpy.random.Generator or numpy.random.SeedSequence, optional
        Seed of the random speeds; 1 by default.
    rng : as seed
        Another name of ``seed``.
    solver : str or Solver
        The exact motion, or an integrator (``solvers()``).
    threads : int, optional
        Number of threads; None for one per core. It does not change the result.

    Returns
    -------
    Limit
        A row for each ψ from 30° to 90°.

    Raises
    ------
    errors.InputError
        For a body that is not symmetric, and for impossible numbers.
    """
    return Limit._of(json.loads(_native.limit(body, points, as_seed(seed, rng), solver, threads)))


def spread(
    toss: Toss,
    heads: float,
    *,
    points: int | None = None,
    seed: _Seed = None,
    rng: _Seed = None,
    threads: int | None = None,
) -> Spread:
    """How precise a hand must be for a wanted probability of heads.

    Parameters
    ----------
    toss : Toss
        The toss that the hand means to throw.
    heads : float
        The wanted probability, above 0 and below 1.
    points : int, optional
        Number of launches of each estimate, a multiple of 8; 16384 by default, 2048 for a body that is not symmetric.
    seed, rng : int, numpy.random.Generator or numpy.random.SeedSequence, optional
        Seed of the scrambles; 1 by default.
    threads : int, optional
        Number of threads; None for one per core. It does not change the result.

    Returns
    -------
    Spread
        The largest relative standard deviation of each rate and of the speed, and that of each of them alone.

    Raises
    ------
    errors.InputError
        For impossible numbers, and for a toss that is given by a time.
    """
    found = json.loads(_native.spread(toss, heads, points, as_seed(seed, rng), threads))
    interval = found.pop("interval")
    alone = tuple(SpreadAlone(**one) for one in found.pop("alone"))
    return Spread(**found, interval=interval and tuple(interval), alone=alone)


def map(
    space: Space,
    across: str = "rate_x",
    up: str = "rate_z",
    plan: Plan | Choice | None = None,
    *,
    solver: str | Solver = "exact",
    threads: int | None = None,
) -> Map:
    """The probability of heads at the nodes of a grid over two coordinates of a space.

    Parameters
    ----------
    space : Space
        The distribution of the launches; the two coordinates have a number of points, as in ``(0, 40, 21)``.
    across, up : str
        The coordinates: ``"rate_x"``, ``"rate_y"``, ``"rate_z"``, ``"turn"``, ``"psi"``, ``"speed"``, ``"gravity"`` or
        ``"tilt"``.
    plan : Plan or Choice, optional
        Which launches are tried at each node; by default all speeds at once, the others by 1024 points of Sobol's sequence.
    solver : str or Solver
        The exact motion, or an integrator (``solvers()``), which needs a plan.
    threads : int, optional
        Number of threads; None for one per core. It does not change the result.

    Returns
    -------
    Map
        With the probability of shape (values of ``up``, values of ``across``).

    Raises
    ------
    errors.InputError
        For a coordinate without points, and for a plan that does not fit the space.
    """
    chosen = None if plan is None else plan_of(plan)
    return Map._of(json.loads(_native.map(space, across, up, chosen, solver, threads)))


def convergence(
    space: Space,
    *,
    steps: int | None = None,
    seed: _Seed = None,
    rng: _Seed = None,
    solver: str | Solver = "exact",
    threads: int | None = None,
) -> Convergence:
    """The share of heads after each step of a growing number of launches, of a grid and at random.

    Parameters
    ----------
    space : Space
        The distribution of the launches; each coordinate that varies has a number of points.
    steps : int, optional
        Number of equal steps; 500 by default, or the number of launches if there are fewer.
    seed, rng : int, numpy.random.Generator or numpy.random.SeedSequence, optional
        Seed of the random launches; 1 by default.
    solver : str or Solver
        The exact motion, or an integrator (``solvers()``).
    threads : int, optional
        Number of threads; None for one per core. It does not change the result.

    Returns
    -------
    Convergence
        A row for each step.

    Raises
    ------
    errors.InputError
        For a coordinate without points, and for impossible numbers.
    """
    return Convergence._of(json.loads(_native.convergence(space, steps, as_seed(seed, rng), solver, threads)))


def sampling_errors(
    space: Space,
    *,
    replicates: int | None = None,
    up_to: int | None = None,
    reference: float | None = None,
    threads: int | None = None,
) -> MethodErrors:
    """How the error of each method of sampling falls with the number of launches: ``unfair-toss errors``.

    Parameters
    ----------
    space : Space
        The distribution of the launches of a coin.
    replicates : int, optional
        Number of seeds over which the root mean square is taken; 16 by default.
    up_to : int, optional
        The largest number of launches is 2 to this power, from 8 to 24; 18 by default.
    reference : float, optional
        The probability that is taken as true; by default that of ``Plan.exact_speed`` with 64 times as many launches.
    threads : int, optional
        Number of threads; None for one per core. It does not change the result.

    Returns
    -------
    MethodErrors
        A row for each method and number of launches.

    Raises
    ------
    errors.InputError
        For a body that is not symmetric, and for impossible numbers.
    """
    return MethodErrors._of(json.loads(_native.sampling_errors(space, replicates, up_to, reference, threads)))


def compare(
    toss: Toss, *, rtol: float | None = None, step: Quantity | None = None, formulation: str = "momentum"
) -> Comparison:
    """One toss by every solver and scheme: how far each is off the exact motion, and what it costs.

    Parameters
    ----------
    toss : Toss
        The body and its launch.
    rtol : float, optional
        Local error per step of the schemes that control their step; 1e-10 by default.
    step : float or str, optional
        Step of the schemes with a fixed step in s; 1e-3 by default.
    formulation : str
        That of the integrators; ``"all"`` for every one that a solver has.

    Returns
    -------
    Comparison
        A row for each solver with its settings.

    Raises
    ------
    errors.InputError
        For a setting outside its range. A solver that fails is a row that says why.
    """
    rows = json.loads(_native.compare(toss, rtol, step, formulation))
    for row in rows:
        row["failure"] = row["failure"] and row["failure"]["message"]
        row.pop("time_ns")
    return Comparison._of(rows)


def sensitivity(toss: Toss) -> Sensitivity:
    """How cos θ at landing changes with the launch, to first order.

    Parameters
    ----------
    toss : Toss
        The toss of any body.

    Returns
    -------
    Sensitivity
        The derivatives of cos θ.

    Raises
    ------
    errors.SolveError
        If they leave the range of numbers.
    """
    found = json.loads(_native.sensitivity(toss))
    return Sensitivity(tuple(found["rate"]), found["time"])


def sample(
    space: Space,
    points: int | Plan | Choice | None = None,
    *,
    method: Literal["grid", "random", "sobol"] = "random",
    seed: _Seed = None,
    rng: _Seed = None,
    solver: str | Solver = "exact",
    threads: int | None = None,
) -> Sample:
    """Single launches of a space, and how each lands.

    Parameters
    ----------
    space : Space
        The distribution of the launches.
    points : int, Plan or Choice
        Number of launches, or which of them.
    method : {"grid", "random", "sobol"}
        How so many launches are chosen, sobol with one scramble. A grid has no ``points``.
    seed, rng : int, numpy.random.Generator or numpy.random.SeedSequence, optional
        Seed of the launches; 1 by default.
    solver : str or Solver
        The exact motion, which proves the outcomes, or an integrator (``solvers()``).
    threads : int, optional
        Number of threads; None for one per core. It does not change the result.

    Returns
    -------
    Sample
        The same numbers as ``unfair-toss sample``, to the bit; ``.to_pandas()`` makes a frame of them.

    Raises
    ------
    errors.InputError
        For a plan that does not fit the space, and for impossible numbers.
    errors.SolveError
        If a launch has no answer.
    """
    numbers, outcome, certified = _native.sample(space, _plan(points, method, as_seed(seed, rng)), solver, threads)
    x, y, z, speed, gravity, drop, tilt, time, cos_tilt = (np.ascontiguousarray(column) for column in numbers.T)
    return Sample(x, y, z, speed, gravity, drop, tilt, time, cos_tilt, outcome, certified)


METHODS = "grid, random, sobol"
"""The methods that draw single launches."""


def _plan(points: Any, method: str, seed: Any) -> Plan:
    """The plan of a sample."""
    if not isinstance(method, str):
        raise wrong("method", method, '"grid", "random" or "sobol"')
    if seed is not None and (isinstance(points, Plan | Choice) or method == "grid"):
        raise MalformedError("seed has no effect with a plan or a grid", field="seed", valid="None")
    if isinstance(points, Plan | Choice):
        return plan_of(points)
    given: dict[str, Any] = {} if seed is None else {"seed": seed}
    if method == "grid":
        if points is not None:
            raise wrong("points", points, "None: a grid takes its points from the axes")
        return Plan.grid()
    if points is None:
        raise wrong("points", points, "the number of launches, or a Plan")
    if method == "random":
        return Plan.random(points, **given)
    if method == "sobol":
        return Plan.sobol(points, scrambles=1, **given)
    raise UnknownNameError(f"method = '{method}' is unknown; known: {METHODS}", field="method", valid=METHODS)
