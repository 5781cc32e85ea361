"""Many launches of one body, as columns that broadcast."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
import numpy.typing as npt

from ._native import Batch, Body, Solver
from .errors import MalformedError

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation

Columns = tuple[npt.NDArray[np.float64], ...]
"""Rates about x, y, z in rad/s, and speeds in m/s or times in s."""

_Result = TypeVar("_Result", np.float64, np.int8)

_OPERAND: Any = ["readonly", "contig", "aligned", "nbo"]
"""How each block of a column has to be; NumPy's stubs do not know "contig"."""

_NAMES = ("rate_x", "rate_y", "rate_z", "speed")

_BLOCK = 1 << 16
"""Launches for which columns are copied at a time, if they are not contiguous."""

_LONG_BLOCK = 1 << 21
"""The same for several threads, whose start takes as long as thousands of launches."""

_SLOW_BLOCK = 1 << 10
"""The same for launches that are solved one by one, so that Ctrl-C is heard."""


@dataclass(frozen=True)
class Counts:
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
    proven_by: dict[str, int] | None

    @property
    def points(self) -> int:
        """The number of launches."""
        return self.heads + self.tails + self.undecided

    @property
    def probability(self) -> float:
        """The fraction of heads; NaN of no launches."""
        return self.heads / self.points if self.points else float("nan")


STAGES = ("keller", "certain", "f64", "double_double", "multiprecision")
"""The stages of the proof, from the cheapest on, by their names in JSON."""


def stages(numbers: Sequence[int] | None) -> dict[str, int] | None:
    """The numbers of proven outcomes by the names of the stages."""
    return None if numbers is None else dict(zip(STAGES, numbers, strict=True))


class _Launches:
    """Columns that have been checked, and how their launches are solved."""

    def __init__(
        self,
        columns: tuple[npt.ArrayLike | None, ...],
        *,
        time: npt.ArrayLike | None,
        gravity: float | None,
        tilt: float | None,
        attitude: Sequence[float] | Rotation | None,
        body: str | Body,
        solver: str | Solver | None,
        threads: int | None,
    ) -> None:
        *rates, speed = columns
        if (speed is None) == (time is None):
            raise MalformedError("one of speed and time is needed", field="speed", valid="either speed or time")
        if time is not None and gravity is not None:
            raise MalformedError("gravity has no effect with time", field="gravity", valid="None, or a speed")
        last = _column("time", time) if time is not None else _column("speed", speed)
        self.columns = tuple(_column(name, rate) for name, rate in zip(_NAMES, rates, strict=False)) + (last,)
        try:
            self.shape = np.broadcast_shapes(*(column.shape for column in self.columns))
        except ValueError:
            shapes = ", ".join(str(column.shape) for column in self.columns)
            raise MalformedError(f"columns of the shapes {shapes} don't broadcast", field="columns") from None
        self.size = math.prod(self.shape)
        self.batch = Batch(
            body,
            tilt=tilt,
            attitude=attitude,
            gravity=9.81 if gravity is None else gravity,
            timed=time is not None,
            solver=solver,
            threads=threads,
        )
        if not self.batch.is_vectorised:
            self.block = _SLOW_BLOCK * (threads or 64)
        else:
            self.block = _BLOCK if threads == 1 else _LONG_BLOCK

    def blocks(self) -> Iterator[tuple[int, Columns]]:
        """Blocks of contiguous columns, each with the index of its first launch. Only what is not contiguous is copied."""
        if self.size == 0:
            return
        plain = [_plain(column, self.shape) for column in self.columns]
        if any(column is None for column in plain):
            yield from self._copied()
            return
        block = min(self.block, self.size)
        # A constant is written once, and read again for each block.
        columns = [np.full(block, part) if part.size == 1 else part for part in plain if part is not None]
        for first in range(0, self.size, block):
            more = min(block, self.size - first)
            starts = (0 if column.size == block else first for column in columns)
            yield first, tuple(column[start : start + more] for column, start in zip(columns, starts, strict=True))

    def _copied(self) -> Iterator[tuple[int, Columns]]:
        """The blocks of columns that are not contiguous."""
        iterator = np.nditer(
            self.columns,
            flags=["external_loop", "buffered"],
            op_flags=[_OPERAND] * len(self.columns),
            op_dtypes=[np.dtype(np.float64)] * len(self.columns),
            casting="same_kind",
            order="C",
            buffersize=self.block,
        )
        first = 0
        for columns in iterator:
            yield first, columns
            first += columns[0].size

    def results(
        self, out: npt.NDArray[_Result] | None, dtype: type[_Result], width: tuple[int, ...] = ()
    ) -> tuple[npt.NDArray[_Result], npt.NDArray[_Result]]:
        """Where results are returned, and a contiguous array, the same if possible, that they are written to."""
        shape = self.shape + width
        if out is None:
            out = np.empty(shape, dtype)
            return out, out
        if not isinstance(out, np.ndarray) or isinstance(out, np.ma.MaskedArray):
            raise MalformedError("out is no array of NumPy", field="out", valid="a numpy.ndarray")
        if out.shape != shape or out.dtype != dtype:
            found, expected = f"{out.dtype} {out.shape}", f"{np.dtype(dtype)} {shape}"
            raise MalformedError(f"out is {found}, expected is {expected}", field="out", valid=expected)
        if not out.flags.writeable:
            raise MalformedError("out is read-only", field="out", valid="an array that can be written")
        shared = any(np.may_share_memory(out, column) for column in self.columns)
        if out.flags.c_contiguous and out.flags.aligned and not shared:
            return out, out
        return out, np.empty(shape, dtype)


def _plain(column: npt.NDArray[np.generic], shape: tuple[int, ...]) -> npt.NDArray[np.float64] | None:
    """The column in one dimension if nothing has to be copied: one number, or all of them in a row; else None."""
    if all(stride == 0 or length == 1 for stride, length in zip(column.strides, column.shape, strict=True)):
        return np.array(column[(0,) * column.ndim], np.float64).reshape(1)
    if column.shape == shape and column.dtype == np.float64 and column.flags.c_contiguous and column.flags.aligned:
        return column.reshape(-1).view(np.float64)
    return None


def _column(name: str, value: npt.ArrayLike | None) -> npt.NDArray[np.generic]:
    """The column as an array of numbers, in whatever type and layout it comes."""
    expected = "real numbers"
    if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
        raise MalformedError(f"{name} has masked elements", field=name, valid=expected)
    try:
        array = np.asarray(value)
        if array.dtype.kind == "O":
            array = array.astype(np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise MalformedError(f"{name}: {error}", field=name, valid=expected) from None
    if array.dtype.kind not in "iuf":
        raise MalformedError(f"{name} has the type {array.dtype}, not real numbers", field=name, valid=expected)
    return array


def cos_tilt(
    rate_x: npt.ArrayLike,
    rate_y: npt.ArrayLike,
    rate_z: npt.ArrayLike,
    speed: npt.ArrayLike | None = None,
    *,
    time: npt.ArrayLike | None = None,
    gravity: float | None = None,
    tilt: float | None = None,
    attitude: Sequence[float] | Rotation | None = None,
    body: str | Body = "paper",
    solver: str | Solver | None = None,
    threads: int | None = 1,
    out: npt.NDArray[np.float64] | None = None,
) -> npt.NDArray[np.float64]:
    """cos θ at landing, with θ the angle between the normal and the vertical; heads is up where it is above 0.

    Parameters
    ----------
    rate_x, rate_y, rate_z : array_like
        Angular velocity at launch in rad/s, along the axes of the body. These columns and the next broadcast against
        each other; contiguous ones of float64 are read in place.
    speed : array_like, optional
        Upward speed at launch in m/s. The body lands at the height of its launch.
    time : array_like, optional
        Time of flight in s, instead of a speed.
    gravity : float, optional
        In m/s²; 9.81 by default.
    tilt : float, optional
        Turn about the lab's x axis before the launch in rad.
    attitude : sequence of 4 floats or scipy Rotation, optional
        Attitude at launch instead of a tilt, as the quaternion (w, x, y, z) from the body to the laboratory.
    body : str or Body
        A name of the catalogue (``bodies()``), or a body.
    solver : str or Solver, optional
        By default, many coins at once are solved in the processor's vector registers, with an error of at most 6e-16.
        ``"exact"`` is the exact motion to an ulp, toss by toss; other names are those of integrators.
    threads : int, optional
        Number of threads; None for one per core. It does not change a bit of the result.
    out : ndarray of float64, optional
        Array for the result, of the broadcast shape. After an exception its content is unspecified.

    Returns
    -------
    ndarray of float64
        cos θ in the broadcast shape, which is () if all columns are scalars.

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
    launches = _Launches(
        (rate_x, rate_y, rate_z, speed), time=time, gravity=gravity, tilt=tilt, attitude=attitude, body=body,
        solver=solver, threads=threads,
    )  # fmt: skip
    result, target = launches.results(out, np.float64)
    flat = target.reshape(-1)
    for first, columns in launches.blocks():
        launches.batch.cos_tilts(columns, flat[first : first + columns[0].size], first)
    if result is not target:
        np.copyto(result, target)
    return result


def outcome(
    rate_x: npt.ArrayLike,
    rate_y: npt.ArrayLike,
    rate_z: npt.ArrayLike,
    speed: npt.ArrayLike | None = None,
    *,
    time: npt.ArrayLike | None = None,
    gravity: float | None = None,
    tilt: float | None = None,
    attitude: Sequence[float] | Rotation | None = None,
    body: str | Body = "paper",
    solver: str | Solver | None = None,
    threads: int | None = 1,
    out: npt.NDArray[np.int8] | None = None,
) -> npt.NDArray[np.int8]:
    """Heads or tails of many launches.

    By default and with ``solver="exact"`` each outcome is proven for exactly the numbers given, and undecided only for
    an exact tie. By an integrator it is undecided where \\|cos θ\\| is within its error estimate.

    Parameters
    ----------
    rate_x, rate_y, rate_z, speed, time, gravity, tilt, attitude, body, solver, threads
        As for ``cos_tilt``.
    out : ndarray of int8, optional
        Array for the result, of the broadcast shape. After an exception its content is unspecified.

    Returns
    -------
    ndarray of int8
        1 for heads, -1 for tails, 0 for undecided, in the broadcast shape, which is () if all columns are scalars.

    Raises
    ------
    errors.InputError, errors.SolveError
        As for ``cos_tilt``.
    """
    launches = _Launches(
        (rate_x, rate_y, rate_z, speed), time=time, gravity=gravity, tilt=tilt, attitude=attitude, body=body,
        solver=solver, threads=threads,
    )  # fmt: skip
    result, target = launches.results(out, np.int8)
    flat = target.reshape(-1)
    for first, columns in launches.blocks():
        launches.batch.outcomes(columns, flat[first : first + columns[0].size], first)
    if result is not target:
        np.copyto(result, target)
    return result


def attitude(
    rate_x: npt.ArrayLike,
    rate_y: npt.ArrayLike,
    rate_z: npt.ArrayLike,
    speed: npt.ArrayLike | None = None,
    *,
    time: npt.ArrayLike | None = None,
    gravity: float | None = None,
    tilt: float | None = None,
    attitude: Sequence[float] | Rotation | None = None,
    body: str | Body = "paper",
    solver: str | Solver | None = None,
    threads: int | None = 1,
    out: npt.NDArray[np.float64] | None = None,
) -> npt.NDArray[np.float64]:
    """Attitude at landing of many launches.

    Parameters
    ----------
    rate_x, rate_y, rate_z, speed, time, gravity, tilt, attitude, body, solver, threads
        As for ``cos_tilt``; the default solver has an error of at most 1e-15 rad.
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
    launches = _Launches(
        (rate_x, rate_y, rate_z, speed), time=time, gravity=gravity, tilt=tilt, attitude=attitude, body=body,
        solver=solver, threads=threads,
    )  # fmt: skip
    result, target = launches.results(out, np.float64, (4,))
    flat = target.reshape(-1)
    for first, columns in launches.blocks():
        launches.batch.attitudes(columns, flat[4 * first : 4 * (first + columns[0].size)], first)
    if result is not target:
        np.copyto(result, target)
    return result


def count(
    rate_x: npt.ArrayLike,
    rate_y: npt.ArrayLike,
    rate_z: npt.ArrayLike,
    speed: npt.ArrayLike | None = None,
    *,
    time: npt.ArrayLike | None = None,
    gravity: float | None = None,
    tilt: float | None = None,
    attitude: Sequence[float] | Rotation | None = None,
    body: str | Body = "paper",
    solver: str | Solver | None = None,
    threads: int | None = 1,
) -> Counts:
    """Counts of heads and tails of many launches, without an array of results.

    Parameters
    ----------
    rate_x, rate_y, rate_z, speed, time, gravity, tilt, attitude, body, solver, threads
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
    launches = _Launches(
        (rate_x, rate_y, rate_z, speed), time=time, gravity=gravity, tilt=tilt, attitude=attitude, body=body,
        solver=solver, threads=threads,
    )  # fmt: skip
    heads = tails = undecided = 0
    proven: list[int] | None = [0] * len(STAGES)
    for first, columns in launches.blocks():
        more = launches.batch.count(columns, first)
        heads, tails, undecided = heads + more[0], tails + more[1], undecided + more[2]
        proven = None if proven is None or more[3] is None else [a + b for a, b in zip(proven, more[3], strict=True)]
    certified = proven is not None and heads + tails + undecided > 0
    return Counts(heads, tails, undecided, certified, stages(proven))
