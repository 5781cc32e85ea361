"""Columns with labels, of xarray or pandas: never combined by their positions where the labels are others."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from .errors import MalformedError


COMPONENTS = list("wxyz")
"""The labels of the components of an attitude."""


class Labels(NamedTuple):
    """The labels that columns have in common."""

    shape: tuple[int, ...]
    put_on: Callable[[Any], Any]
    """Puts the labels on a result, which may have the four components of an attitude as a further dimension."""
    no_attitude: MalformedError | None = None
    """Why an attitude cannot have the labels."""


def combined(given: dict[str, Any]) -> tuple[dict[str, Any], Labels | None]:
    """The columns, those with labels in the same order and broadcast by these; and the labels, if there are some."""
    xarray, pandas = sys.modules.get("xarray"), sys.modules.get("pandas")
    arrays = {name: value for name, value in given.items() if xarray and isinstance(value, xarray.DataArray)}
    frames = {
        name: value for name, value in given.items() if pandas and isinstance(value, pandas.Series | pandas.DataFrame)
    }
    if not arrays and not frames:
        return given, None
    if arrays and frames:
        raise _differ(next(iter(frames)), "labels of pandas next to ones of xarray")
    more, labels = _of_xarray(xarray, arrays) if arrays else _of_pandas(pandas, frames)
    for name, value in given.items():
        if name not in more and getattr(value, "ndim", isinstance(value, list | tuple)) and np.shape(value) != labels.shape:
            raise _differ(name, f"no labels, and another shape than {labels.shape}")
    return given | more, labels


def components(attitudes: Any) -> list[Any] | None:
    """The columns of w, x, y and z of attitudes with labels; None of others, and of a single one."""
    xarray, pandas = sys.modules.get("xarray"), sys.modules.get("pandas")
    if pandas and isinstance(attitudes, pandas.DataFrame):
        if list(attitudes.columns) == COMPONENTS:
            return [attitudes[name] for name in COMPONENTS]
        raise _differ("attitude", "other columns", "the columns w, x, y and z")
    if xarray and isinstance(attitudes, xarray.DataArray) and (attitudes.ndim > 1 or "component" in attitudes.dims):
        names = attitudes.coords["component"].values.tolist() if "component" in attitudes.coords else COMPONENTS
        if attitudes.sizes.get("component") != 4 or names != COMPONENTS:
            raise _differ("attitude", "other components", 'a dimension "component" of w, x, y and z')
        if attitudes.ndim > 1:
            return [attitudes.isel(component=place, drop=True) for place in range(4)]
    return None


def _differ(name: str, what: str, valid: str = "the labels of the other columns, or one number") -> MalformedError:
    return MalformedError(f"{name} has {what}: expected {valid}", field=name.split(" ")[0], valid=valid)


def _of_xarray(xarray: Any, arrays: dict[str, Any]) -> tuple[dict[str, Any], Labels]:
    for number, name in enumerate(arrays):
        try:
            aligned = xarray.align(*list(arrays.values())[: number + 1], join="exact", copy=False)
        except ValueError as error:
            raise _differ(name, f"other labels ({error})") from None
    same = xarray.broadcast(*aligned)

    def put_on(result: Any) -> Any:
        labelled = xarray.DataArray(result, dims=(*same[0].dims, "component")[: result.ndim])
        if result.ndim > same[0].ndim:
            labelled = labelled.assign_coords(component=COMPONENTS)
        return labelled.assign_coords(same[0].coords)

    has_components = 'the dimension "component", which is that of the attitudes'
    no_attitude = _differ(next(iter(arrays)), has_components, "dimensions with other names")
    is_taken = "component" in same[0].dims
    return dict(zip(arrays, same, strict=True)), Labels(same[0].shape, put_on, no_attitude if is_taken else None)


def _of_pandas(pandas: Any, frames: dict[str, Any]) -> tuple[dict[str, Any], Labels]:
    first = next(iter(frames.values()))
    for name, frame in frames.items():
        if frame.ndim != first.ndim or not all(map(pandas.Index.equals, frame.axes, first.axes)):
            raise _differ(name, "other labels")

    def put_on(result: Any) -> Any:
        if result.ndim == 1:
            return pandas.Series(result, first.index)
        return pandas.DataFrame(result, first.index, first.columns if first.ndim == 2 else COMPONENTS)

    rows_and_columns = "rows and columns, and no place for the four components of attitudes"
    no_attitude = _differ(next(iter(frames)), rows_and_columns, "columns of one dimension, or an array")
    return frames, Labels(first.shape, put_on, no_attitude if first.ndim == 2 else None)
