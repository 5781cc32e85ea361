"""What questions about one toss are answered with."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, fields
from html import escape
from typing import TYPE_CHECKING, Any, ClassVar, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _native
from ._native import Solver, Toss
from .errors import OutOfRangeError
from .launches import column

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes
    from scipy.spatial.transform import Rotation

Outcome: TypeAlias = Literal["heads", "tails", "undecided"]


class ShownAsTable:
    """An answer that a notebook shows as a table of its values."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    def _repr_html_(self) -> str:
        rows = ((field.name, getattr(self, field.name)) for field in fields(self))
        cells = (f"<tr><th>{name}</th><td>{escape(_short(value))}</td></tr>" for name, value in rows)
        return f"<table><caption>{type(self).__name__}</caption>{''.join(cells)}</table>"


def _short(value: object) -> str:
    """A value in a line: of a long array, its shape."""
    if isinstance(value, np.ndarray):
        # All digits, so that the end of an interval is not rounded inwards.
        return np.array2string(value, floatmode="unique") if value.size <= 8 else f"array of shape {value.shape}"
    return str(value)


class _Flight:
    """What a flight over the times ``t`` becomes with pandas, xarray and matplotlib."""

    t: npt.NDArray[np.float64]
    fastest_turn: float

    def _parts(self) -> dict[str, npt.NDArray[np.float64]]:
        """``cos_tilt`` and other numbers of shape (n,), vectors (n, 3) and quaternions (n, 4), by their names."""
        raise NotImplementedError

    def to_pandas(self) -> pd.DataFrame:
        """A ``pandas.DataFrame`` over the times ``t``, with a column for each component, such as ``rate_x``."""
        import pandas as pd

        columns = {}
        for name, values in self._parts().items():
            letters = "" if values.ndim == 1 else {3: "xyz", 4: "wxyz"}[values.shape[1]]
            if not letters:
                columns[name] = values
            for index, letter in enumerate(letters):
                columns[f"{name}_{letter}"] = values[:, index]
        return pd.DataFrame(columns, index=pd.Index(self.t, name="t"))

    def to_xarray(self) -> xr.Dataset:
        """An ``xarray.Dataset`` with the dimensions ``t``, ``axis`` (x, y, z) and ``component`` (w, x, y, z)."""
        import xarray as xr

        dimensions = {3: ("t", "axis"), 4: ("t", "component")}
        values = {
            name: (("t",) if part.ndim == 1 else dimensions[part.shape[1]], part)
            for name, part in self._parts().items()
        }
        coordinates = {"t": ("t", self.t, {"units": "s"}), "axis": list("xyz"), "component": list("wxyz")}
        return xr.Dataset(values, coordinates)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws cos θ over time with matplotlib, on ``ax`` or the current axes, and returns the axes.

        It draws points without a line between them if the body may turn by more than a quarter from one time to the next,
        and for fewer than twenty times."""
        if ax is None:
            import matplotlib.pyplot as plt

            ax = plt.gca()
        turn = self.fastest_turn * float(np.max(np.diff(self.t), initial=0.0))
        ax.plot(self.t, self._parts()["cos_tilt"], "o" if self.t.size < 20 else "." if turn > np.pi / 2 else "-")
        ax.axhline(0.0, color="0.6", linewidth=0.8)
        ax.set(xlabel="time after launch (s)", ylabel="cos θ (heads above 0)", ylim=(-1.05, 1.05))
        return ax


def fastest_turn(toss: Toss) -> float:
    """How fast a toss turns at most, in rad/s: the rate S/I1 of the normal of a coin about its angular momentum S; of any
    other body the larger one of its rate and of S over its middle moment."""
    tensor, rate = np.array(toss.body.tensor), np.array(toss.rate)
    momentum = tensor @ rate
    energy, square = float(rate @ momentum), float(momentum @ momentum)
    if toss.body.is_symmetric:
        return float(np.sqrt(square) / tensor[0, 0]) if square else 0.0
    moments = toss.body.principal_moments
    fastest = max(float(rate @ rate), square / moments[1] ** 2)
    # Of all rates with this energy and momentum, the fastest ones have no part along one of the principal axes.
    for one, two in itertools.combinations(moments, 2):
        if 0.0 < one < two:
            parts = (two * energy - square) / (one * (two - one)), (square - one * energy) / (two * (two - one))
            fastest = max(fastest, sum(parts) if min(parts) >= 0.0 else 0.0)
    return float(np.sqrt(fastest))


class _HoldsArrays:
    """An answer that holds arrays. Two of the same class are equal if all their values are, of arrays each element. It has
    no hash, because arrays can be changed."""

    __dataclass_fields__: ClassVar[dict[str, Any]]
    __hash__: ClassVar[None] = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        with np.printoptions(floatmode="unique", threshold=8):
            shown = ", ".join(f"{field.name}={getattr(self, field.name)!r}" for field in fields(self))
        return f"{type(self).__name__}({shown})"

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        pairs = ((getattr(self, field.name), getattr(other, field.name)) for field in fields(self))
        return all(bool(np.array_equal(one, two, equal_nan=True)) if isinstance(one, np.ndarray) else one == two for one, two in pairs)


@dataclass(frozen=True)
class Work(ShownAsTable):
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


@dataclass(frozen=True, eq=False, repr=False)
class Landing(ShownAsTable, _HoldsArrays):
    """How a toss lands.

    Attributes
    ----------
    outcome : str
        ``"heads"``, ``"tails"`` or ``"undecided"``.
    certified : bool
        Whether the outcome is proven, for exactly the numbers given. Only the exact motion proves.
    proven_by : str or None
        The stage of the proof, or ``"integrated"``.
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
    error_bound, attitude_error_bound : float or None
        With ``prove``, proven bounds of the errors of ``cos_tilt`` and of the attitude's quaternion.
    """

    outcome: Outcome
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
    error_bound: float | None = None
    attitude_error_bound: float | None = None


@dataclass(frozen=True)
class Margins(ShownAsTable):
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


@dataclass(frozen=True, eq=False, repr=False)
class Intervals(ShownAsTable, _HoldsArrays):
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


@dataclass(frozen=True, eq=False, repr=False)
class Trace(ShownAsTable, _Flight, _HoldsArrays):
    """A flight at n times.

    Attributes
    ----------
    t : ndarray of shape (n,)
        Times after launch in s.
    attitude : ndarray of shape (n, 4)
        Unit quaternions (w, x, y, z) from the body to the laboratory.
    angles : ndarray of shape (n, 3)
        Euler angles α, β, γ (intrinsic z-x'-z'', SciPy's ``"ZXZ"``) in rad, continuous over the flight.
    normal : ndarray of shape (n, 3)
        The normal, a unit vector in the laboratory whose z axis is up.
    face : ndarray of shape (n, 3)
        The body's x axis, in the same axes.
    cos_tilt : ndarray of shape (n,)
        cos θ.
    fastest_turn : float
        How fast it turns at most, in rad/s: the rate S/I1 of the normal of a coin about its angular momentum S; of any
        other body the larger one of its rate and of S over its middle moment.
    error_bound, attitude_error_bound : ndarray of shape (n,), or None
        With ``prove``, the proven bounds of the errors of cos θ and of the quaternion.
    """

    t: npt.NDArray[np.float64]
    attitude: npt.NDArray[np.float64]
    angles: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    face: npt.NDArray[np.float64]
    cos_tilt: npt.NDArray[np.float64]
    fastest_turn: float = 0.0
    error_bound: npt.NDArray[np.float64] | None = None
    attitude_error_bound: npt.NDArray[np.float64] | None = None

    def _parts(self) -> dict[str, npt.NDArray[np.float64]]:
        names = ["cos_tilt", "attitude", "normal", "face"]
        names += [] if self.error_bound is None else ["error_bound", "attitude_error_bound"]
        angles = zip(("alpha", "beta", "gamma"), self.angles.T, strict=True)
        return {name: getattr(self, name) for name in names} | {name: angle for name, angle in angles}


@dataclass(frozen=True)
class Inverse(ShownAsTable):
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


@dataclass(frozen=True)
class PeopleSpread(ShownAsTable):
    """How much people differ.

    Attributes
    ----------
    sd : float
        Standard deviation of the probability between people.
    interval : tuple of 2 floats
        Its interval at a level of 95 %.
    chi2 : float
        Pearson's X² of the hypothesis that all people are alike.
    p_value : float
        How probable so large an X² is if they are.
    """

    sd: float
    interval: tuple[float, float]
    chi2: float
    p_value: float


@dataclass(frozen=True, eq=False, repr=False)
class SameSideBias(ShownAsTable, _HoldsArrays):
    """How often coins land on the side that had been up, and the angle ψ that explains it. Intervals are at a level of 95 %.

    Attributes
    ----------
    same_side, tosses : int
        The counts of all people together.
    probability : float
        The share of tosses that landed on the side that had been up.
    these_flips : tuple of 2 floats
        The interval of the mean probability of these people, weighted by their tosses.
    mean_over_people : float
        The mean probability over people like these, each counted once; of one person ``probability``.
    interval : tuple of 2 floats
        The interval of the mean over people; of one person ``these_flips``.
    interval_kind : str
        What the interval is.
    spread : PeopleSpread or None
        How much people differ; None for one person, and if all landings are the same.
    next_person : tuple of 2 floats or None
        Where the probability of a further person lies; None for fewer than three people.
    inertia_ratio : float
        k = I3/I1 of the coin.
    rate_ratio : float or None
        √(ωx² + ωy²)/ωz; None for a mean of ½ or less, at which the coin does not spin.
    cone_angle : float or None
        Angle ψ between the normal and the angular momentum in rad; π/2 for a mean of ½ or less, and None if the whole
        interval is below ½, which no ψ explains.
    cone_angle_interval : tuple of 2 floats or None
        The smallest and the largest ψ that have a mean in the interval, in rad.
    each_cone_angle : ndarray of shape (n,)
        ψ of each person alone in rad; NaN without a toss, and where no ψ explains the counts.
    each_cone_angle_interval : ndarray of shape (n, 2)
        Its interval.
    """

    same_side: int
    tosses: int
    probability: float
    these_flips: tuple[float, float]
    mean_over_people: float
    interval: tuple[float, float]
    interval_kind: str
    spread: PeopleSpread | None
    next_person: tuple[float, float] | None
    inertia_ratio: float
    rate_ratio: float | None
    cone_angle: float | None
    cone_angle_interval: tuple[float, float] | None
    each_cone_angle: npt.NDArray[np.float64]
    each_cone_angle_interval: npt.NDArray[np.float64]


@dataclass(frozen=True)
class Power(ShownAsTable):
    """What it takes to see a same-side share.

    Attributes
    ----------
    flips_of_one : float
        Flips that one hand needs.
    people_needed : float or None
        People that are needed with these flips of each; None if the flips were not given.
    flips_needed : float or None
        Flips of each that these people need; None if no number suffices, or the people were not given.
    chance : float or None
        How probable it is that the interval of these people with these flips leaves out ½; None unless both were given.
    least_share : float or None
        The least share that they find with the wanted power; likewise, and None if they find none.
    """

    flips_of_one: float
    people_needed: float | None
    flips_needed: float | None
    chance: float | None
    least_share: float | None


@dataclass(frozen=True)
class DenseOutput:
    """A flight at any time, by the solver itself: it flies to the times that are asked for.

    Attributes
    ----------
    toss : Toss
        The body and its launch.
    solver : Solver
        With its settings.
    """

    toss: Toss
    solver: Solver

    def __call__(self, t: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The state as in ``Solution.y`` at a time, of shape (7,), or at n times in any order, of shape (7, n)."""
        times = np.asarray(column("t [s]", t), dtype=np.float64)
        valid = f"one time or one dimension of times, from 0 to {self.toss.flight_time!r}"
        flat = np.atleast_1d(times)
        outside = ~((flat >= 0.0) & (flat <= self.toss.flight_time))
        if times.ndim > 1 or outside.any():
            index = int(np.flatnonzero(outside)[0]) if times.ndim == 1 else None
            raise OutOfRangeError(f"t is outside its valid range: {valid}", field="t [s]", index=index, valid=valid)
        order = np.argsort(flat, kind="stable")
        ascending, _, _ = _native.solve(self.toss, flat[order], self.solver)
        states = np.empty_like(ascending)
        states[:, order] = ascending
        return states[:, 0] if times.ndim == 0 else states


@dataclass(frozen=True, eq=False, repr=False)
class Solution(ShownAsTable, _Flight, _HoldsArrays):
    """A flight as a solver found it.

    Attributes
    ----------
    t : ndarray of shape (n,)
        Times after launch in s.
    y : ndarray of shape (7, n)
        The state at each time: the unit quaternion (w, x, y, z) from the body to the laboratory, and the angular
        velocity in rad/s along the axes of the body.
    nfev : int
        Evaluations of the right-hand side; 0 for a closed form.
    work : Work
        Evaluations, and steps.
    error_estimate : float or None
        The solver's estimate of the error of cos θ at the landing, of a flight without stops.
    success : bool
        Always true: a solver that cannot go on raises ``errors.SolveError`` instead.
    status : int
        0, as SciPy has it for the end of the interval.
    message : str
        In words.
    sol : DenseOutput or None
        The flight at any other time; with ``dense_output=True``.
    fastest_turn : float
        As of a ``Trace``.
    """

    t: npt.NDArray[np.float64]
    y: npt.NDArray[np.float64]
    nfev: int
    work: Work
    error_estimate: float | None
    success: bool = True
    status: int = 0
    message: str = "The solver reached the landing or the last time."
    sol: DenseOutput | None = None
    fastest_turn: float = 0.0

    @property
    def attitude(self) -> npt.NDArray[np.float64]:
        """Unit quaternions (w, x, y, z), of shape (n, 4)."""
        return np.ascontiguousarray(self.y[:4].T)

    @property
    def rate(self) -> npt.NDArray[np.float64]:
        """Angular velocities in rad/s along the axes of the body, of shape (n, 3)."""
        return np.ascontiguousarray(self.y[4:].T)

    @property
    def cos_tilt(self) -> npt.NDArray[np.float64]:
        """cos θ of the attitudes, of shape (n,)."""
        w, x, y, z = self.y[:4]
        heights: npt.NDArray[np.float64] = (w * w + z * z) - (x * x + y * y)
        return heights

    @property
    def rotation(self) -> Rotation:
        """The attitudes as one ``scipy.spatial.transform.Rotation``."""
        from scipy.spatial.transform import Rotation

        return Rotation.from_quat(self.attitude, scalar_first=True)

    def _parts(self) -> dict[str, npt.NDArray[np.float64]]:
        return {"cos_tilt": self.cos_tilt, "attitude": self.attitude, "rate": self.rate}
