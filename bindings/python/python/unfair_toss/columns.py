"""Many launches, as columns that broadcast."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Generic, Protocol, TypeAlias, TypedDict, TypeVar, Unpack, cast, overload

import numpy as np
import numpy.typing as npt

from ._native import Body, Solver
from .launches import Attitudes, Bodies, Launches
from .results import ShownAsTable


@dataclass(frozen=True)
class Counts(ShownAsTable):
    """Numbers of launches by their outcome.

    Attributes
    ----------
    heads, tails, undecided : int
        With the exact motion, only an exact tie is undecided.
    certified : bool
        Whether every outcome is proven.
    proven_by : dict of str to int, or None
        The number of outcomes that each stage of the proof decided.
    """

    heads: int
    tails: int
    undecided: int
    certified: bool
    proven_by: dict[str, int] | None = field(hash=False)

    @property
    def points(self) -> int:
        """The number of launches."""
        return self.heads + self.tails + self.undecided

    @property
    def probability(self) -> float:
        """The fraction of heads among the decided launches; NaN if none is decided."""
        decided = self.heads + self.tails
        return self.heads / decided if decided else float("nan")


_One: TypeAlias = float | np.floating[Any] | np.integer[Any] | str
_Number = TypeVar("_Number", np.float64, np.int8)


class Labelled(Protocol):
    """A series of pandas or an array of xarray."""

    @property
    def attrs(self) -> Any: ...
    @property
    def size(self) -> int: ...


_Labels = TypeVar("_Labels", bound=Labelled)


class _Dimensioned(Labelled, Protocol):
    """An array of xarray."""

    @property
    def dims(self) -> Any: ...


_Array = TypeVar("_Array", bound=_Dimensioned)
_Frame = TypeVar("_Frame", covariant=True)


class _Framed(Protocol[_Frame]):
    """A series of pandas, and its frame."""

    def to_frame(self) -> _Frame: ...


_Of = TypeVar("_Of")


class Others(TypedDict, Generic[_Of], total=False):
    """The keywords that are the same for numbers, for columns and for what has labels."""

    time: _Of | None
    gravity: _Of | None
    drop: _Of | None
    tilt: _Of | None
    attitude: Attitudes | None
    turn: _Of | None
    psi: _Of | None
    solver: str | Solver | None
    threads: int | None


class OfColumns(Protocol[_Number]):
    """A function of columns: of numbers it gives a number, of what has labels the same, of arrays an array."""

    @overload
    def __call__(
        self,
        rate_x: _One | None = None,
        rate_y: _One | None = None,
        rate_z: _One | None = None,
        speed: _One | None = None,
        *,
        body: str | Body | None = None,
        out: None = None,
        **others: Unpack[Others[_One]],
    ) -> _Number: ...

    @overload
    def __call__(
        self,
        rate_x: _Labels | _One | None = None,
        rate_y: _Labels | _One | None = None,
        rate_z: _Labels | _One | None = None,
        speed: _Labels | _One | None = None,
        *,
        body: _Labels | str | Body | None = None,
        moments: _Labels | None = None,
        out: None = None,
        **others: Unpack[Others[_Labels | _One]],
    ) -> _Labels: ...

    @overload
    def __call__(
        self,
        rate_x: npt.ArrayLike | None = None,
        rate_y: npt.ArrayLike | None = None,
        rate_z: npt.ArrayLike | None = None,
        speed: npt.ArrayLike | None = None,
        *,
        body: Bodies | None = None,
        moments: npt.ArrayLike | None = None,
        out: npt.NDArray[_Number] | None = None,
        **others: Unpack[Others[npt.ArrayLike]],
    ) -> npt.NDArray[_Number]: ...


class OfAttitudes(Protocol):
    """The same of attitudes: of a series of pandas it gives a frame."""

    @overload
    def __call__(
        self,
        rate_x: _One | None = None,
        rate_y: _One | None = None,
        rate_z: _One | None = None,
        speed: _One | None = None,
        *,
        body: str | Body | None = None,
        out: npt.NDArray[np.float64] | None = None,
        **others: Unpack[Others[_One]],
    ) -> npt.NDArray[np.float64]: ...

    @overload
    def __call__(
        self,
        rate_x: _Array | _One | None = None,
        rate_y: _Array | _One | None = None,
        rate_z: _Array | _One | None = None,
        speed: _Array | _One | None = None,
        *,
        body: _Array | str | Body | None = None,
        moments: _Array | None = None,
        out: None = None,
        **others: Unpack[Others[_Array | _One]],
    ) -> _Array: ...

    @overload
    def __call__(
        self,
        rate_x: _Framed[_Frame] | _One | None = None,
        rate_y: _Framed[_Frame] | _One | None = None,
        rate_z: _Framed[_Frame] | _One | None = None,
        speed: _Framed[_Frame] | _One | None = None,
        *,
        body: _Framed[_Frame] | str | Body | None = None,
        moments: _Framed[_Frame] | None = None,
        out: None = None,
        **others: Unpack[Others[_Framed[_Frame] | _One]],
    ) -> _Frame: ...

    @overload
    def __call__(
        self,
        rate_x: npt.ArrayLike | None = None,
        rate_y: npt.ArrayLike | None = None,
        rate_z: npt.ArrayLike | None = None,
        speed: npt.ArrayLike | None = None,
        *,
        body: Bodies | None = None,
        moments: npt.ArrayLike | None = None,
        out: npt.NDArray[np.float64] | None = None,
        **others: Unpack[Others[npt.ArrayLike]],
    ) -> npt.NDArray[np.float64]: ...


def _typed(function: Callable[..., npt.NDArray[_Number]]) -> OfColumns[_Number]:
    """The function itself, to the checkers of types one that tells numbers, arrays and what has labels."""
    return cast("OfColumns[_Number]", function)


def _typed_of_attitudes(function: Callable[..., npt.NDArray[np.float64]]) -> OfAttitudes:
    return cast("OfAttitudes", function)


STAGES = ("f64", "double_double", "multiprecision")
"""The stages of the proof, from the cheapest on, by their names in JSON."""


@_typed
def cos_tilt(
    rate_x: npt.ArrayLike | None = None,
    rate_y: npt.ArrayLike | None = None,
    rate_z: npt.ArrayLike | None = None,
    speed: npt.ArrayLike | None = None,
    *,
    time: npt.ArrayLike | None = None,
    gravity: npt.ArrayLike | None = None,
    drop: npt.ArrayLike | None = None,
    tilt: npt.ArrayLike | None = None,
    attitude: Attitudes | None = None,
    turn: npt.ArrayLike | None = None,
    psi: npt.ArrayLike | None = None,
    body: Bodies | None = None,
    moments: npt.ArrayLike | None = None,
    solver: str | Solver | None = None,
    threads: int | None = None,
    out: npt.NDArray[np.float64] | None = None,
) -> npt.NDArray[np.float64]:
    """cos θ at landing, with θ the angle between the normal and the vertical; heads is up where it is above 0.

    Parameters
    ----------
    rate_x, rate_y, rate_z : array_like
        Angular velocity at launch in rad/s, along the axes of the body; these or ``turn`` and ``psi``. All columns broadcast
        against each other; contiguous ones of float64 are read in place. Columns of pint, astropy or unyt are converted to SI
        units, and so are those of xarray and pandas with ``attrs["units"]``; a single quantity may be a text with a unit,
        such as ``"38rev/s"``.
    speed : array_like, optional
        Upward speed at launch in m/s.
    time : array_like, optional
        Time of flight in s, instead of a speed.
    gravity : array_like, optional
        In m/s²; 9.81 by default. Where it, the drop, the tilt, the attitude or the body vary, cos θ of coins is right to 1e-15.
    drop : array_like, optional
        How far below its launch the body lands, in m; at the same height by default. Bodies that are not symmetric are solved
        one by one with a drop.
    tilt : array_like, optional
        Turn about the lab's x axis before the launch in rad.
    attitude : array_like of shape (..., 4) or scipy Rotation, optional
        Attitude at launch instead of a tilt: one quaternion (w, x, y, z) from the body to the laboratory, or a column of
        them. Columns of xarray have the dimension "component", those of pandas the columns w, x, y and z.
    turn, psi : array_like, optional
        Of coins, instead of rates: the rate in rad/s at which the normal turns about the angular momentum, and the angle in rad
        between both.
    body : str or Body, or array_like of these, optional
        A name of the catalogue (``bodies()``), or a body; the paper's coin by default. Or a column, in which several may be.
    moments : array_like of shape (..., 2) or (..., 3), optional
        Moments I1, I3 of coins or I1, I2, I3 in kg m², instead of a body.
    solver : str or Solver, optional
        By default, many coins at once are solved in the processor's vector registers, with an error of at most 6e-16.
        ``"exact"`` is the exact motion to an ulp, toss by toss; other names are those of integrators.
    threads : int, optional
        Number of threads; by default one per core, and a single one for columns that it solves at once. It does not
        change a bit of the result.
    out : ndarray of float64, optional
        Array for the result, of the broadcast shape. After an exception its content is unspecified.

    Returns
    -------
    ndarray of float64
        cos θ in the broadcast shape; a number if all columns are. Columns of xarray are combined by their
        labels, and give a ``DataArray``; those of pandas have to have equal labels, and give a ``Series`` or a
        ``DataFrame``.

    Raises
    ------
    errors.InputError
        If a launch is impossible; ``.index`` is that of the first such one.
    errors.SolveError
        If a launch has no answer.

    Notes
    -----
    Python's lock is released meanwhile. Arrays must not be written by another thread at the same time.
    """
    launches = Launches((rate_x, rate_y, rate_z), speed, time, gravity, drop, tilt, attitude, turn, psi, body, moments, solver, threads)
    return launches.solved(launches.batch.cos_tilts, np.float64, out)


@_typed
def outcome(
    rate_x: npt.ArrayLike | None = None,
    rate_y: npt.ArrayLike | None = None,
    rate_z: npt.ArrayLike | None = None,
    speed: npt.ArrayLike | None = None,
    *,
    time: npt.ArrayLike | None = None,
    gravity: npt.ArrayLike | None = None,
    drop: npt.ArrayLike | None = None,
    tilt: npt.ArrayLike | None = None,
    attitude: Attitudes | None = None,
    turn: npt.ArrayLike | None = None,
    psi: npt.ArrayLike | None = None,
    body: Bodies | None = None,
    moments: npt.ArrayLike | None = None,
    solver: str | Solver | None = None,
    threads: int | None = None,
    out: npt.NDArray[np.int8] | None = None,
) -> npt.NDArray[np.int8]:
    """Heads or tails of many launches.

    By default and with ``solver="exact"`` each outcome is proven for exactly the numbers given, and undecided only for
    an exact tie. By an integrator it is undecided where \\|cos θ\\| is within its error estimate.

    Parameters
    ----------
    rate_x, rate_y, rate_z, speed, time, gravity, drop, tilt, attitude, turn, psi, body, moments, solver, threads
        As for ``cos_tilt``.
    out : ndarray of int8, optional
        Array for the result, of the broadcast shape. After an exception its content is unspecified.

    Returns
    -------
    ndarray of int8
        1 for heads, -1 for tails, 0 for undecided, in the broadcast shape; a number if all columns are.

    Raises
    ------
    errors.InputError, errors.SolveError
        As for ``cos_tilt``.
    """
    launches = Launches((rate_x, rate_y, rate_z), speed, time, gravity, drop, tilt, attitude, turn, psi, body, moments, solver, threads)
    return launches.solved(launches.batch.outcomes, np.int8, out)


@_typed_of_attitudes
def attitude(
    rate_x: npt.ArrayLike | None = None,
    rate_y: npt.ArrayLike | None = None,
    rate_z: npt.ArrayLike | None = None,
    speed: npt.ArrayLike | None = None,
    *,
    time: npt.ArrayLike | None = None,
    gravity: npt.ArrayLike | None = None,
    drop: npt.ArrayLike | None = None,
    tilt: npt.ArrayLike | None = None,
    attitude: Attitudes | None = None,
    turn: npt.ArrayLike | None = None,
    psi: npt.ArrayLike | None = None,
    body: Bodies | None = None,
    moments: npt.ArrayLike | None = None,
    solver: str | Solver | None = None,
    threads: int | None = None,
    out: npt.NDArray[np.float64] | None = None,
) -> npt.NDArray[np.float64]:
    """Attitude at landing of many launches.

    Parameters
    ----------
    rate_x, rate_y, rate_z, speed, time, gravity, drop, tilt, attitude, turn, psi, body, moments, solver, threads
        As for ``cos_tilt``; the default solver has an error of at most 1e-15 rad, or 2e-15 rad of coins
        that differ in more than rates and speeds.
    out : ndarray of float64, optional
        Array for the result, of the broadcast shape and 4. After an exception its content is unspecified.

    Returns
    -------
    ndarray of float64, of the broadcast shape and 4
        Unit quaternions (w, x, y, z) from the body to the laboratory, of either sign, as
        ``Rotation.from_quat(..., scalar_first=True)`` takes them.

    Raises
    ------
    errors.InputError, errors.SolveError
        As for ``cos_tilt``.
    """
    launches = Launches((rate_x, rate_y, rate_z), speed, time, gravity, drop, tilt, attitude, turn, psi, body, moments, solver, threads)
    return launches.solved(launches.batch.attitudes, np.float64, out, (4,))


def count(
    rate_x: npt.ArrayLike | None = None,
    rate_y: npt.ArrayLike | None = None,
    rate_z: npt.ArrayLike | None = None,
    speed: npt.ArrayLike | None = None,
    *,
    time: npt.ArrayLike | None = None,
    gravity: npt.ArrayLike | None = None,
    drop: npt.ArrayLike | None = None,
    tilt: npt.ArrayLike | None = None,
    attitude: Attitudes | None = None,
    turn: npt.ArrayLike | None = None,
    psi: npt.ArrayLike | None = None,
    body: Bodies | None = None,
    moments: npt.ArrayLike | None = None,
    solver: str | Solver | None = None,
    threads: int | None = None,
) -> Counts:
    """Counts of heads and tails of many launches, without an array of results.

    Parameters
    ----------
    rate_x, rate_y, rate_z, speed, time, gravity, drop, tilt, attitude, turn, psi, body, moments, solver, threads
        As for ``cos_tilt``.

    Returns
    -------
    Counts
        The numbers of heads, tails and undecided launches.

    Raises
    ------
    errors.InputError, errors.SolveError
        As for ``cos_tilt``.
    """
    launches = Launches((rate_x, rate_y, rate_z), speed, time, gravity, drop, tilt, attitude, turn, psi, body, moments, solver, threads)
    counts = [0] * (4 + len(STAGES))
    for first, columns in launches.blocks():
        counts = [sum(both) for both in zip(counts, launches.batch.count(columns, first), strict=True)]
    heads, tails, undecided, without_proof, *by_stage = counts
    proven_by = None if without_proof else dict(zip(STAGES, by_stage, strict=True))
    return Counts(heads, tails, undecided, without_proof == 0 and heads + tails + undecided > 0, proven_by)

