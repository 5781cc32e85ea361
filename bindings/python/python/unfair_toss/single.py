"""What is asked of one toss."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import _native
from ._native import Body, Solver, Toss


@dataclass(frozen=True)
class Work:
    """The cost of a solution, as counts that are the same in every run.

    Attributes
    ----------
    rhs_calls : int
        Evaluations of the right-hand side; of a Taylor series, orders of all its steps.
    accepted_steps, rejected_steps : int
        Steps.
    """

    rhs_calls: int
    accepted_steps: int
    rejected_steps: int


@dataclass(frozen=True)
class Landing:
    """How a toss lands.

    Attributes
    ----------
    outcome : str
        ``"heads"``, ``"tails"`` or ``"undecided"``.
    certified : bool
        Whether the outcome is proven, for exactly the numbers given. Only the exact motion proves.
    proven_by : str or None
        The stage of the proof.
    cos_tilt : float
        cos θ, with θ the angle between the normal and the vertical.
    attitude : ndarray of shape (4,)
        Unit quaternion (w, x, y, z) from the body to the laboratory.
    rate : ndarray of shape (3,)
        Angular velocity at landing in rad/s, along the axes of the body.
    flight_time : float
        In s.
    norm_error : float
        Loss of norm of an integrated quaternion, before it was normalised.
    error_estimate : float or None
        The solver's estimate of the error of ``cos_tilt``.
    solver, scheme : str, str or None
        What computed it.
    work : Work
        Its cost.
    """

    outcome: str
    certified: bool
    proven_by: str | None
    cos_tilt: float
    attitude: npt.NDArray[np.float64]
    rate: npt.NDArray[np.float64]
    flight_time: float
    norm_error: float
    error_estimate: float | None
    solver: str
    scheme: str | None
    work: Work


@dataclass(frozen=True)
class Margins:
    """For each input alone, the change to the nearest value that lands the other way; None where no value does.

    Attributes
    ----------
    time : float or None
        Of the time of flight in s.
    speed, gravity : float or None
        In m/s and m/s²; None also where the time was given instead.
    tilt : float or None
        A further turn about the lab's x axis in rad.
    rate : tuple of 3 floats or None
        Of the rates about x, y and z in rad/s.
    rate_range : tuple of 3 floats
        The largest changes of rates that were searched in rad/s.
    time_range : tuple of 2 floats
        The largest changes of the time of flight that were searched, earlier and later, in s; infinite where all were.
    """

    time: float | None
    speed: float | None
    gravity: float | None
    tilt: float | None
    rate: tuple[float | None, float | None, float | None]
    rate_range: tuple[float, float, float]
    time_range: tuple[float, float]


@dataclass(frozen=True)
class Intervals:
    """The speeds that land heads.

    Attributes
    ----------
    heads : ndarray of shape (n, 2)
        Pairs of speeds in m/s between which the toss lands heads.
    probability : float
        Their share of the range.
    """

    heads: npt.NDArray[np.float64]
    probability: float


@dataclass(frozen=True)
class Trace:
    """A flight at n times.

    Attributes
    ----------
    t : ndarray of shape (n,)
        Times after launch in s.
    attitude : ndarray of shape (n, 4)
        Unit quaternions (w, x, y, z) from the body to the laboratory.
    angles : ndarray of shape (n, 3)
        Euler angles α, β, γ (z-x-z) in rad, continuous over the flight.
    normal : ndarray of shape (n, 3)
        The normal, a unit vector in the laboratory whose z axis is up.
    face : ndarray of shape (n, 3)
        The body's x axis, in the same axes.
    cos_tilt : ndarray of shape (n,)
        cos θ.
    """

    t: npt.NDArray[np.float64]
    attitude: npt.NDArray[np.float64]
    angles: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    face: npt.NDArray[np.float64]
    cos_tilt: npt.NDArray[np.float64]


@dataclass(frozen=True)
class Inverse:
    """A launch from horizontal whose long flights land heads with a wanted probability.

    Attributes
    ----------
    probability : float
        The wanted one.
    inertia_ratio : float
        k = I3/I1 of the coin.
    rate_ratio : float
        Rate of tumbling over the rate of spin, √(ωx² + ωy²)/ωz.
    cone_angle : float
        Angle ψ between the normal and the angular momentum in rad.
    """

    probability: float
    inertia_ratio: float
    rate_ratio: float
    cone_angle: float


def toss(toss: Toss, solver: str | Solver = "exact") -> Landing:
    """How a toss lands.

    Parameters
    ----------
    toss : Toss
        The body and its launch.
    solver : str or Solver
        The exact motion, or an integrator (``solvers()``).

    Returns
    -------
    Landing
        The same numbers as ``unfair-toss toss --format json``, to the bit.

    Raises
    ------
    errors.SolveError
        If the solver cannot go on, or does not solve such a body.
    """
    (cos_tilt, outcome, stage), (attitude, rate), errors, work, (name, scheme) = _native.land(toss, solver)
    return Landing(
        outcome=outcome,
        certified=stage is not None,
        proven_by=stage,
        cos_tilt=cos_tilt,
        attitude=np.array(attitude),
        rate=np.array(rate),
        flight_time=toss.flight_time,
        norm_error=errors[0],
        error_estimate=errors[1],
        solver=name,
        scheme=scheme,
        work=Work(*work),
    )


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
    (time, speed, gravity, tilt), (x, y, z), rates, (earlier, later) = _native.margins(toss)
    return Margins(time, speed, gravity, tilt, (x, y, z), (rates[0], rates[1], rates[2]), (earlier, later))


def intervals(toss: Toss, slowest: float = 0.0) -> Intervals:
    """The speeds from ``slowest`` to that of a toss with which it lands heads.

    Parameters
    ----------
    toss : Toss
        The toss of any body with the fastest speed.
    slowest : float
        The slowest speed in m/s.

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
    heads = np.array(_native.intervals(toss, slowest), dtype=np.float64).reshape(-1, 2)
    length = sum((fast - slow for slow, fast in heads.tolist()), 0.0)
    assert toss.speed is not None
    return Intervals(heads, min(length / (toss.speed - slowest), 1.0))


def trace(
    toss: Toss, points: int | None = None, *, dt: float | None = None, solver: str | Solver = "exact"
) -> Trace:
    """The flight of a coin or another body at equally spaced times, launch and landing included.

    Parameters
    ----------
    toss : Toss
        The toss.
    points : int, optional
        Number of times, from 2 to 1000000; this or ``dt`` is needed.
    dt : float, optional
        Step of time in s; the last time is the landing.
    solver : str or Solver
        The exact motion, or an integrator (``solvers()``).

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
    rows = _native.trace(toss, points, dt, solver)
    t, attitude, angles, normal, face, cos_tilt = (
        np.ascontiguousarray(part) for part in np.split(rows, [1, 5, 8, 11, 14], axis=1)
    )
    return Trace(t[:, 0], attitude, angles, normal, face, cos_tilt[:, 0])


def inverse(probability: float, body: str | Body = "paper") -> Inverse:
    """How to launch a coin from horizontal so that long flights land heads with a wanted probability.

    Parameters
    ----------
    probability : float
        Above ½ and at most 1.
    body : str or Body
        A symmetric body.

    Returns
    -------
    Inverse
        The ratio of rates, and the angle ψ.

    Raises
    ------
    errors.InputError
        For a probability outside its range, and for a body that is not symmetric.
    """
    return Inverse(probability, *_native.inverse(probability, body))
