"""Values that carry a unit, of any package: converted to SI units, or refused by the name of their unit.

No such package is imported. A quantity is known by what it can do: ``m_as`` of pint, ``to_value`` of astropy and unyt. An
array with ``attrs["units"]``, of xarray or pandas, names its unit.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, SupportsFloat, TypeAlias

import numpy as np

from ._native import in_si, unit_of
from .errors import MalformedError

Quantity: TypeAlias = SupportsFloat | str
"""A number in SI units, a value with a unit, or a text with one."""

PLAIN = {float, int, np.float64, np.float32, np.int64, np.int32}
"""Types of numbers that have no unit, and that NumPy reads as they are."""

_WORDS = {
    "radian": "rad", "radians": "rad", "degree": "deg", "degrees": "deg", "turn": "rev", "turns": "rev",
    "revolution": "rev", "revolutions": "rev", "second": "s", "seconds": "s", "meter": "m", "meters": "m",
    "metre": "m", "metres": "m",
}  # fmt: skip
"""Names of units that are written out."""


def plain(field: str, value: Any, index: int | None = None) -> Any:
    """The value in the SI unit of the argument ``field``, without its unit; a value that has none, as it is."""
    kind = type(value)
    if kind in PLAIN or kind is np.ndarray or isinstance(value, type):
        return value
    if isinstance(value, list | tuple):
        if set(map(type, value)) <= PLAIN:
            return value
        return [plain(field, element, place) for place, element in enumerate(value)]
    if isinstance(value, np.ma.MaskedArray):
        if np.ma.is_masked(value):
            return value  # It is refused for that.
        value = value if hasattr(value, "unit") else value.data
    # A series gives an element of itself by any name that is one of its labels.
    if isinstance(getattr(value, "attrs", None), Mapping) and hasattr(value, "shape"):
        return _labelled(field, value)
    return _quantity(field, value, index)


def _quantity(field: str, value: Any, index: int | None) -> Any:
    """A quantity in SI units; any other value as it is."""
    # Of a column of astropy's tables, which is no quantity.
    value = value.quantity if getattr(value, "unit", None) is not None and hasattr(value, "quantity") else value
    unit = getattr(value, "unit", getattr(value, "units", None))
    convert = getattr(value, "m_as", getattr(value, "to_value", None))
    if convert is None:
        if unit is None or callable(unit):
            return value
        raise _wrong(field, f"{unit}, from which {type(value).__name__} cannot be converted", index)
    si, _ = unit_of(field)
    # To pint an angle is a number, so that 1 Hz would be 1 rad/s.
    if si == "rad/s" and hasattr(value, "m_as") and "radian" not in dict(value.to_root_units().unit_items()):
        raise _wrong(field, unit, index)
    try:
        return convert(si)
    except Exception:  # Each package has its own.
        raise _wrong(field, f"of {type(value).__name__}" if unit is None else unit, index) from None


def _labelled(field: str, value: Any) -> Any:
    """An array with labels, with numbers in SI units and the same labels."""
    is_frame = not hasattr(value, "dims")
    held = _held(value) if is_frame else value.data
    numbers = plain(field, held)
    if numbers is held:
        unit = value.attrs.get("units")
        if unit is None:
            return value
        if _known(str(unit)) != unit_of(field)[0]:
            flat = np.asarray(held).reshape(-1)
            is_real = flat.dtype.kind in "iuf"
            found = in_si(field, _known(str(unit)), np.ascontiguousarray(flat, np.float64)) if is_real else None
            if found is None:
                raise _wrong(field, unit, None)
            numbers = found.reshape(value.shape)
    if not is_frame:
        result = value.copy(data=numbers)
        result.attrs = {}
        return result
    if not hasattr(value, "axes"):
        return numbers
    return type(value)(numbers, *value.axes)


def _held(value: Any) -> Any:
    """The values of a series or a frame of pandas, with the unit of their type."""
    quantity = getattr(getattr(value, "array", None), "quantity", None)
    return getattr(value, "values", value) if quantity is None else quantity


def _known(unit: str) -> str:
    """A unit as it is written here: ``m/s2`` of ``m s-2``, the form of CF and of netCDF."""
    text = re.sub(r"[a-z]+", lambda word: _WORDS.get(word[0], word[0]), unit.strip())
    text = re.sub(r"[ .*·]+([a-z]+)(?:\*\*|\^)?-(\d)", r"/\1\2", text)
    return "" if text in ("1", "dimensionless") else text.removesuffix("1")


def _wrong(field: str, unit: object, index: int | None) -> MalformedError:
    _, expected = unit_of(field)
    expected += " without a unit" if expected == "a number" else ""
    at = "" if index is None else f"[{index}]"
    message = f"{field}{at} has the unit {str(unit) or 'dimensionless'}: expected {expected}"
    return MalformedError(message, field=field, index=index, valid=expected)
