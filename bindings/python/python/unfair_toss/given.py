"""Arguments that are no numbers, and what is said of those that are wrong."""

from __future__ import annotations

from typing import TypeVar

from .errors import MalformedError

_Kind = TypeVar("_Kind")


def an(kind: type[_Kind], field: str, value: object) -> _Kind:
    """The value of an argument, if it is of this class."""
    if isinstance(value, kind):
        return value
    raise wrong(field, value, f"a {kind.__name__}")


def a_function(field: str, value: object) -> None:
    """Refuses what is neither None nor can be called."""
    if value is not None and not callable(value):
        raise wrong(field, value, "None, or what can be called")


def wrong(field: str, value: object, valid: str) -> MalformedError:
    """The exception of a value of another type than the argument has."""
    return MalformedError(f"{field} is of type {type(value).__name__}: expected {valid}", field=field, valid=valid)
