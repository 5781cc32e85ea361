"""What is asked of one toss."""

from __future__ import annotations

import json
from dataclasses import fields
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from . import _native
from ._native import Body, Solver, Toss
from .errors import InputError, MissingError
from .given import truth, wrong
from .labels import combined
from .results import Intervals, Inverse, Landing, Margins, PeopleSpread, Power, SameSideBias, Trace, Work, fastest_turn
from .units import Quantity


def toss(toss: Toss, solver: str | Solver = "exact", *, prove: bool = False) -> Landing:
    """How a toss lands.

    Parameters
    ----------
    toss : Toss
        The body and its launch.
    solver : str or Solver
        The exact motion, or an integrator (``solvers()``).
    prove : bool
        Whether the outcome is proven by integration, by the solver ``"quaternion"``, with bounds of the errors. Its scheme
        is then ``"taylor"`` unless it has another.

    Returns
    -------
    Landing
        The same numbers as ``unfair-toss toss --format json``, to the bit.

    Raises
    ------
    errors.SolveError
        If the solver cannot go on, or does not solve such a body.
    """
    if truth("prove", prove):
        proven = json.loads(_native.prove(toss, solver))
        known = {field.name for field in fields(Landing)}
        found = {name: value for name, value in proven.items() if name in known}
        found |= {"proven_by": proven["proof"], "error_estimate": None}
    else:
        found = _native.land(toss, solver)
    arrays = {name: np.array(found[name]) for name in ("attitude", "rate")}
    return Landing(**found | arrays | {"work": Work(**found["work"])})


def margins(toss: Toss) -> Margins:
    """How far a toss is from landing the other way.

    Parameters
    ----------
    toss : Toss
        The toss of any body.

    Returns
    -------
    Margins
        Changes of one input alone. Those of a body that is not symmetric take some tenths of a second.

    Raises
    ------
    errors.SolveError
        For a phase above 2^53 rad.
    """
    return Margins(**_native.margins(toss))


def intervals(toss: Toss, slowest: Quantity = 0.0) -> Intervals:
    """The speeds from ``slowest`` to that of a toss with which it lands heads.

    Parameters
    ----------
    toss : Toss
        The toss of any body with the fastest speed.
    slowest : float or str
        The slowest speed in m/s, or as in ``"2m/s"``.

    Returns
    -------
    Intervals
        The ranges of speeds, and their share.

    Raises
    ------
    errors.InputError
        For a toss that is given by a time, a slowest speed that is not below that of the toss, and flights of more than
        10000 turns.
    errors.SolveError
        If the motion of a body that is not symmetric stays too near to its edge to be searched.
    """
    lowest = _native.number("slowest", slowest)
    heads = np.array(_native.intervals(toss, lowest), dtype=np.float64).reshape(-1, 2)
    length = sum((fast - slow for slow, fast in heads.tolist()), 0.0)
    assert toss.speed is not None
    return Intervals(heads, min(length / (toss.speed - lowest), 1.0))


def trace(
    toss: Toss,
    points: int | None = None,
    *,
    dt: Quantity | None = None,
    solver: str | Solver = "exact",
    prove: bool = False,
) -> Trace:
    """The flight of a coin or another body at equally spaced times, launch and landing included.

    Parameters
    ----------
    toss : Toss
        The toss.
    points : int, optional
        Number of times, from 2 to 1000000; 101 by default, without ``dt``.
    dt : float or str, optional
        Step of time in s or as in ``"50ms"``; the last time is the landing.
    solver : str or Solver
        The exact motion, or an integrator (``solvers()``).
    prove : bool
        Whether the errors at each time are bounded by integration, by the solver ``"quaternion"``.

    Returns
    -------
    Trace
        The same numbers as ``unfair-toss trace --format json``, to the bit.

    Raises
    ------
    errors.InputError
        For an impossible number of times.
    errors.SolveError
        If the solver cannot go on.
    """
    rows = _native.trace(toss, points, dt, solver, truth("prove", prove))
    t, attitude, angles, normal, face, cos_tilt, *bounds = (
        np.ascontiguousarray(part) for part in np.split(rows, [1, 5, 8, 11, 14, *([15, 16] if prove else [])], axis=1)
    )
    flight = (t[:, 0], attitude, angles, normal, face, cos_tilt[:, 0], fastest_turn(toss))
    return Trace(*flight, *(bound[:, 0] for bound in bounds))


@overload
def inverse(probability: float, body: str | Body = "paper") -> Inverse: ...
@overload
def inverse(*, counts: Any, body: str | Body = "paper") -> SameSideBias: ...
def inverse(
    probability: float | None = None, body: str | Body = "paper", *, counts: Any = None
) -> Inverse | SameSideBias:
    """How to launch a coin from horizontal so that long flights land heads with a wanted probability, or how coins were thrown.

    Parameters
    ----------
    probability : float
        Above ½ and at most 1.
    body : str or Body
        A symmetric body.
    counts : tuple of 2 ints, or a frame
        In place of a probability: the coins that landed on the side that had been up, and all tossed; or a frame of pandas or
        polars with the columns ``same`` and ``tosses``. Rows with the same ``person``, if it has this column, are added up.

    Returns
    -------
    Inverse or SameSideBias
        The ratio of rates, and the angle ψ; of counts as of ``same_side_bias``.

    Raises
    ------
    errors.InputError
        For a probability outside its range, for counts that cannot be, and for a body that is not symmetric.
    """
    if counts is not None:
        if probability is not None:
            raise wrong("counts", counts, "None, or no probability")
        try:
            return same_side_bias(*_people(counts), body)
        except InputError as error:
            error.field = "counts" if error.field in ("same_side", "tosses") else error.field
            raise
    if probability is None:
        raise MissingError("probability is missing: expected it or counts", field="probability", valid="above ½, up to 1")
    wanted = _native.number("probability", probability)
    return Inverse(wanted, *_native.inverse(wanted, body))


def _people(counts: Any) -> tuple[Any, Any]:
    """The counts of each person: on the same side, and all."""
    if isinstance(counts, tuple | list) and len(counts) == 2:
        return counts[0], counts[1]
    columns = list(getattr(counts, "columns", ()))
    if not {"same", "tosses"} <= set(columns):
        raise wrong("counts", counts, "2 whole numbers, or a frame with the columns same and tosses")
    same, tosses = (counts[name].to_numpy() for name in ("same", "tosses"))
    if "person" not in columns:
        return same, tosses
    rows: dict[Any, list[int]] = {}
    for person, *row in zip(counts["person"].to_numpy(), same, tosses, strict=True):
        rows[person] = [int(new) + old for new, old in zip(row, rows.get(person, [0, 0]), strict=True)]
    return tuple(map(list, zip(*rows.values(), strict=True))) if rows else (same, tosses)  # type: ignore[return-value]


def power(
    share: float = 0.508, sd: float = 0.016, power: float = 0.8, *, people: int | None = None, flips: int | None = None
) -> Power:
    """How many flips and people it takes to see that coins land more often on the side that had been up.

    Parameters
    ----------
    share : float
        The share that shall be told from ½.
    sd : float
        Standard deviation of the probability between people; that of 48 people was 0.016.
    power : float
        How surely the interval of ``same_side_bias`` shall leave out ½, from 0.5 to 0.9999.
    people : int, optional
        Number of people, at least 2.
    flips : int, optional
        Flips of each of them.

    Returns
    -------
    Power
        The same numbers as ``unfair-toss power --format json``, by Student's interval of the people's shares. That of
        ``same_side_bias`` is as wide or wider, and finds a little less.

    Raises
    ------
    errors.InputError
        For a number outside its range.

    Examples
    --------
    >>> ut.power(flips=200).people_needed
    216.0
    """
    return Power(**_native.power(share, sd, power, people, flips))


def rate_of_precession(turn: Quantity, psi: Quantity, body: str | Body = "paper") -> tuple[float, float, float]:
    """The angular velocity of a coin by what can be seen: how fast its normal n turns, and the angle ψ.

    Parameters
    ----------
    turn : float or str
        How fast the normal goes round the angular momentum, in rad/s or as in ``"38rev/s"``.
    psi : float or str
        The angle ψ between the two, from 0 to π, in rad or as in ``"81deg"``.
    body : str or Body
        A symmetric body.

    Returns
    -------
    tuple of 3 floats
        The rate in rad/s along the axes of the body, as of ``--turn`` and ``--psi`` of ``unfair-toss``, to the bit. The
        part across the normal is put along x.

    Raises
    ------
    errors.InputError
        For an angle outside its range, and for a body that is not symmetric.

    Examples
    --------
    >>> rate = ut.rate_of_precession(38 * 2 * np.pi, np.radians(81.2), "us-quarter")
    >>> ut.toss(ut.Toss(rate, speed=2.4, body="us-quarter")).outcome
    'tails'
    """
    return _native.rate_of_precession(turn, psi, body)


def same_side_bias(same_side: npt.ArrayLike, tosses: npt.ArrayLike, body: str | Body = "paper") -> SameSideBias:
    """The angle ψ that explains how often coins landed on the side that had been up.

    It assumes independent flips and long flights from horizontal, all with the same angle ψ; 180° - ψ explains the
    counts as well. People differ, so ψ is that of the mean over people, who are the sample of its interval. One person
    has Clopper and Pearson's. People without a toss are passed over.

    Parameters
    ----------
    same_side : int or array_like of int, one per person
        Numbers of tosses that landed on the side that had been up.
    tosses : int or array_like of int, one per person
        Numbers of all tosses. One row per person: add up the rows of one before.
    body : str or Body
        A symmetric body, for the ratio of rates.

    Returns
    -------
    SameSideBias
        The same numbers as ``unfair-toss inverse --counts --format json``, to the bit.

    Raises
    ------
    errors.InputError
        For counts that cannot be, with the person's number as ``.index``; and if nobody tossed a coin.

    Examples
    --------
    The flips of F. Bartoš et al., arXiv 2310.04153:

    >>> round(np.degrees(ut.same_side_bias(178078, 350757).cone_angle), 2)
    81.16
    """
    counts, _ = combined({"same_side": same_side, "tosses": tosses})
    found = _native.same_side_bias(**counts, body=body)
    spread = found["spread"] and PeopleSpread(**found["spread"])
    arrays = {name: np.array(found[name]) for name in ("each_cone_angle", "each_cone_angle_interval")}
    return SameSideBias(**found | arrays | {"spread": spread})
