"""Columns of launches: checked, broadcast, and handed to the kernels in blocks."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar, Union

import numpy as np
import numpy.typing as npt

from ._native import Batch, Body, Solver, number, numbers
from .errors import MalformedError, MissingError
from .given import wrong
from .labels import combined, components
from .units import PLAIN, plain

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation

Attitudes: TypeAlias = Union[npt.ArrayLike, "Rotation"]
"""One attitude, or a column of them."""

Bodies: TypeAlias = str | Body | Sequence[str | Body] | npt.NDArray[np.object_ | np.str_]
"""One body, or a column of them."""

Columns = tuple[npt.NDArray[np.float64], ...]
"""Rates about x, y, z in rad/s, or turns in rad/s, ψ in rad and 0; speeds in m/s or times in s; where they vary gravity in m/s²,
drops in m, tilts in rad, the components of attitudes, and the numbers or the moments of bodies."""

_Result = TypeVar("_Result", np.float64, np.int8)

_OPERAND: Any = ["readonly", "contig", "aligned", "nbo"]
"""How each block of a column has to be; NumPy's stubs do not know "contig"."""

_BLOCK = 1 << 18
"""Launches of a call of the kernels: so many that the call itself does not count."""

_COPIED_BLOCK = 1 << 16
"""The same if columns are copied: so few that the copies stay in the cache."""

_LONG_BLOCK = 1 << 21
"""The same for several threads, whose start takes as long as thousands of launches."""

_SLOW_BLOCK = 1 << 14
"""The same for each of at most 64 threads, for launches that are not solved by the kernels: so few that copies are small."""


class Launches:
    """Columns that have been checked, and how their launches are solved."""

    def __init__(
        self,
        rates: tuple[npt.ArrayLike | None, npt.ArrayLike | None, npt.ArrayLike | None],
        speed: npt.ArrayLike | None,
        time: npt.ArrayLike | None,
        gravity: npt.ArrayLike | None,
        drop: npt.ArrayLike | None,
        tilt: npt.ArrayLike | None,
        attitude: Attitudes | None,
        turn: npt.ArrayLike | None,
        psi: npt.ArrayLike | None,
        body: Bodies | None,
        moments: npt.ArrayLike | None,
        solver: str | Solver | None,
        threads: int | None,
    ) -> None:
        if (speed is None) == (time is None):
            raise MalformedError("expected speed or time, and not both", field="speed", valid="either speed or time")
        given = _turning(rates, turn, psi)
        given |= {"speed": speed} if time is None else {"time": time}
        for name, value in (("gravity", gravity), ("drop", drop), ("tilt", tilt)):
            if value is not None and time is not None and name != "tilt":
                raise MalformedError(f"{name} has no effect with time", field=name, valid="None, or a speed")
            given |= {} if value is None else {name: value}
        one_attitude, attitudes = (None, {}) if attitude is None else _attitudes(attitude)
        # Before columns are combined by their labels, which forgets their units.
        given = {name: _without_unit(name, value) for name, value in given.items()}
        bodies, inertia = _bodies(body, moments)
        given, self.labels = combined(given | attitudes | inertia)
        read = {name: column(name.split(" ")[0], value) for name, value in given.items()}
        if len(inertia) == 3 and (read["moments 1"] == read["moments 2"]).all():
            del read["moments 2"]  # Of coins, which the kernels take.
        # What is the same for all launches is no column.
        one = {name: given[name] for name in ("gravity", "drop", "tilt") if name in read and read[name].ndim == 0}
        self.columns = tuple(numbers for name, numbers in read.items() if name not in one)
        names = [name.split(" ")[0] for name in read if name not in one]
        varying = [names.count(name) for name in ("gravity", "drop", "tilt", "attitude")]
        varying.append(names.count("body") + names.count("moments"))
        try:
            self.shape = np.broadcast_shapes(*(column.shape for column in self.columns))
        except ValueError:
            shapes = ", ".join(str(column.shape) for column in self.columns)
            raise MalformedError(f"columns of the shapes {shapes} don't broadcast", field="columns") from None
        self.size = math.prod(self.shape)
        self.batch = Batch(
            bodies,
            gravity=one.get("gravity"),
            drop=one.get("drop"),
            tilt=one.get("tilt", 0.0 if varying[2] else None),
            attitude=(1.0, 0.0, 0.0, 0.0) if attitudes else one_attitude,
            varying=varying,
            precesses=turn is not None,
            timed=time is not None,
            solver=solver,
            threads=threads,
        )
        if not self.batch.is_vectorised:
            self.block = self.copied_block = _SLOW_BLOCK * min(threads or 64, 64)
        elif threads == 1:
            self.block, self.copied_block = _BLOCK, _COPIED_BLOCK
        else:
            self.block = self.copied_block = _LONG_BLOCK

    def blocks(self) -> Iterator[tuple[int, Columns]]:
        """Blocks of contiguous columns, each with the index of its first launch; only what is strided is copied."""
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
            buffersize=self.copied_block,
        )
        first = 0
        for columns in iterator:
            yield first, columns
            first += columns[0].size

    def solved(
        self,
        solve: Callable[[Columns, npt.NDArray[_Result], int], None],
        dtype: type[_Result],
        out: npt.NDArray[_Result] | None,
        width: tuple[int, ...] = (),
    ) -> npt.NDArray[_Result]:
        """The results of a kernel, in ``out`` if it is given; ``width`` is the shape of one of them."""
        if width and self.labels is not None and self.labels.no_attitude is not None:
            raise self.labels.no_attitude
        result, target = self._places(out, dtype, width)
        flat, numbers = target.reshape(-1), math.prod(width)
        for first, columns in self.blocks():
            solve(columns, flat[numbers * first : numbers * (first + columns[0].size)], first)
        if result is not target:
            np.copyto(result, target)
        if out is None and result.ndim == 0:
            number: npt.NDArray[_Result] = result[()]  # A number of NumPy.
            return number
        labelled: npt.NDArray[_Result] = result if self.labels is None else self.labels.put_on(result)
        return labelled

    def _places(
        self, out: npt.NDArray[_Result] | None, dtype: type[_Result], width: tuple[int, ...]
    ) -> tuple[npt.NDArray[_Result], npt.NDArray[_Result]]:
        """Where results are returned, and a contiguous array, the same if possible, that they are written to."""
        shape = self.shape + width
        if out is None:
            out = np.empty(shape, dtype)
            return out, out
        has_unit = getattr(out, "unit", getattr(out, "units", None)) is not None
        if not isinstance(out, np.ndarray) or isinstance(out, np.ma.MaskedArray) or has_unit:
            raise MalformedError("out is no array of NumPy without a mask and a unit", field="out", valid="a numpy.ndarray")
        if out.shape != shape or out.dtype != dtype:
            found, expected = f"{out.dtype} {out.shape}", f"{np.dtype(dtype)} {shape}"
            raise MalformedError(f"out is {found}, expected is {expected}", field="out", valid=expected)
        if not out.flags.writeable:
            raise MalformedError("out is read-only", field="out", valid="an array that can be written")
        shared = any(np.may_share_memory(out, column) for column in self.columns)
        if out.flags.c_contiguous and out.flags.aligned and not shared:
            return out, out
        return out, np.empty(shape, dtype)


def _turning(rates: tuple[Any, ...], turn: Any, psi: Any) -> dict[str, Any]:
    """The columns of rates, or of turn and ψ, which have as many."""
    named = dict(zip(("rate_x", "rate_y", "rate_z"), rates, strict=True))
    if turn is None and psi is None:
        for name, value in named.items():
            if value is None:
                raise MissingError(f"{name} is missing: expected rates, or turn with psi", field=name, valid="a column of rates")
        return named
    for name, value in named.items():
        if value is not None:
            raise MalformedError(f"{name} has no effect with turn and psi", field=name, valid="either rates, or turn with psi")
    for name, value, other in (("turn", turn, "psi"), ("psi", psi, "turn")):
        if value is None:
            raise MissingError(f"{name} is missing: {other} needs it", field=name, valid=f"a column, with {other}")
    return {"turn": turn, "psi": psi, "nothing": 0.0}


def _bodies(body: Any, moments: Any) -> tuple[list[tuple[str | Body, int | None]], dict[str, Any]]:
    """The bodies, each with its place if there are several; and the column of their numbers, or those of moments."""
    if moments is not None:
        if body is not None:
            raise MalformedError("body and moments are the same", field="moments", valid="either body or moments")
        return _moments(moments)
    if body is None or isinstance(body, str | Body):
        return [("paper" if body is None else body, None)], {}
    valid = "the name of a body, a Body, or a sequence of these"
    array = np.asarray(body.to_numpy() if hasattr(body, "to_numpy") else body, dtype=object)
    flat = array.reshape(-1).tolist()
    # By what they are, as long tables hold the same objects many times.
    objects = dict(zip(map(id, flat), flat, strict=True))
    try:
        places = {one: place for place, one in enumerate(dict.fromkeys(objects.values()))}
    except TypeError:
        raise wrong("body", body, valid) from None
    for one in places:
        if not isinstance(one, str | Body):
            first = flat.index(one)
            message = f"body[{first}] is of type {type(one).__name__}: expected {valid}"
            raise MalformedError(message, field="body", index=first, valid=valid)
    found: list[tuple[str | Body, int | None]] = [(one, flat.index(one)) for one in places]
    place_of = {name: places[one] for name, one in objects.items()}
    numbers = np.fromiter(map(place_of.__getitem__, map(id, flat)), np.float64, len(flat))
    if array.ndim == 0:
        return [(flat[0], None)], {}
    numbers = numbers.reshape(array.shape)
    if hasattr(body, "dims"):
        return found, {"body": body.copy(data=numbers)}
    return found, {"body": type(body)(numbers, *body.axes) if hasattr(body, "axes") else numbers}


def _moments(moments: Any) -> tuple[list[tuple[str | Body, int | None]], dict[str, Any]]:
    """The body with these moments; or the columns of those of several."""
    valid = "I1, I3 of coins or I1, I2, I3, or a column of shape (..., 2) or (..., 3)"
    if isinstance(moments, list | tuple) and all(isinstance(one, str) or not hasattr(one, "__len__") for one in moments):
        return [(Body.from_moments(moments), None)], {}
    given = _without_unit("moments", moments)
    read = column("moments", given)
    if read.ndim == 0 or read.shape[-1] not in (2, 3):
        message = f"moments has the shape {read.shape}: expected {valid}"
        raise MalformedError(message, field="moments", valid=valid)
    if read.ndim == 1:
        return [(Body.from_moments(read.tolist()), None)], {}
    parts = list(np.moveaxis(read, -1, 0))
    if hasattr(given, "dims"):
        parts = [given.isel({given.dims[-1]: part}, drop=True) for part in range(len(parts))]
    elif hasattr(given, "columns"):
        parts = [given.iloc[:, part] for part in range(len(parts))]
    return [], {f"moments {part + 1}": column for part, column in enumerate(parts)}


def _attitudes(given: Any) -> tuple[npt.NDArray[np.generic] | None, dict[str, Any]]:
    """The attitude of all launches, or the columns of w, x, y and z if there are several."""
    valid = "4 real numbers (w, x, y, z), or a column of shape (..., 4), or rotations of SciPy"
    if hasattr(given, "as_quat"):
        try:
            given = given.as_quat(scalar_first=True)
        except TypeError:
            raise wrong("attitude", given, valid) from None
    parts = components(_without_unit("attitude", given))
    if parts is None:
        read = column("attitude", given)
        if read.shape[-1:] != (4,):
            message = f"attitude has the shape {read.shape}: expected {valid}"
            raise MalformedError(message, field="attitude", valid=valid)
        if read.ndim == 1:
            return read, {}
        parts = list(np.moveaxis(read, -1, 0))
    return None, {f"attitude {name}": part for name, part in zip("wxyz", parts, strict=True)}


def _plain(column: npt.NDArray[np.generic], shape: tuple[int, ...]) -> npt.NDArray[np.float64] | None:
    """The column in one dimension if nothing has to be copied: one number, or all of them in a row; else None."""
    if all(stride == 0 or length == 1 for stride, length in zip(column.strides, column.shape, strict=True)):
        return np.array(column[(0,) * column.ndim], np.float64).reshape(1)
    if column.shape == shape and column.dtype == np.float64 and column.flags.c_contiguous and column.flags.aligned:
        return column.reshape(-1).view(np.float64)
    return None


def column(name: str, value: npt.ArrayLike | None) -> npt.NDArray[np.generic]:
    """An argument as an array of numbers in SI units, in whatever type and layout it comes, by position."""
    expected = "real numbers"
    value = _without_unit(name, value)
    to_numpy = None if isinstance(value, type) else getattr(value, "to_numpy", None)
    if to_numpy is not None:
        value = to_numpy()
    # Of NumPy and of astropy, which have classes of their own.
    mask = getattr(value, "mask", False) if isinstance(value, np.ndarray) else False
    if np.any(mask):
        index = int(np.flatnonzero(mask)[0]) if np.ndim(mask) else None
        raise MalformedError(f"{name} has masked elements", field=name, index=index, valid=expected)
    try:
        is_plain = _is_plain(value)
        array = np.asarray(value) if is_plain else np.asarray(value, dtype=object)
    except (TypeError, ValueError, OverflowError, RecursionError) as error:
        raise MalformedError(f"{name}: {error}", field=name, valid=expected) from None
    if array.dtype.kind == "O":
        # One by one, because NumPy reads texts and truth values among objects as numbers.
        return numbers(name, list(array.flat) if array.ndim else array.item()).reshape(array.shape)
    if array.dtype.kind not in "iuf":
        index = 0 if array.ndim else None
        message = f"{name} has the type {array.dtype}, not real numbers"
        raise MalformedError(message, field=name, index=index, valid=expected)
    return array


def _without_unit(name: str, value: Any) -> Any:
    """An argument in SI units: a number of a text that has a unit, or what a value with a unit holds."""
    if isinstance(value, str):
        return number(name, value)
    try:
        return plain(name, value)
    except RecursionError as error:
        raise MalformedError(f"{name}: {error}", field=name, valid="real numbers") from None


def _is_plain(value: object) -> bool:
    """Whether NumPy reads a column as it is: an array, a number, or lists of these. Masks are refused inside of lists."""
    if isinstance(value, list | tuple):
        return set(map(type, value)) <= PLAIN or all([_is_element(element) for element in value])
    return isinstance(value, np.ndarray | np.generic) or type(value) in PLAIN


def _is_element(value: object) -> bool:
    """The same of an element of a list, beside which it may get another type."""
    if isinstance(value, np.ma.MaskedArray) and value.ndim and np.ma.is_masked(value):
        raise ValueError("a list holds masked elements")
    if isinstance(value, np.ndarray):
        return value.dtype.kind in "iuf" and not isinstance(value, np.ma.MaskedArray)
    return _is_plain(value) and not isinstance(value, np.bool_ | np.timedelta64)
