"""Arguments that are no numbers, and what is said of those that are wrong."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from functools import wraps
from typing import ParamSpec, TypeVar

from .errors import MalformedError

_Kind = TypeVar("_Kind")
_Arguments = ParamSpec("_Arguments")


def close(name: str, known: Iterable[str]) -> str:
    """The end of a message about an unknown name: a known one that is similar, if there is one."""
    from difflib import get_close_matches

    found = get_close_matches(name.lower(), known, 1)
    return f". Did you mean '{found[0]}'?" if found else ""


def unexpected(call: Callable[..., object], name: str) -> TypeError:
    """The exception of a keyword that a function or a class does not have, in Python's own words."""
    message = f"{call.__name__}() got an unexpected keyword argument '{name}'"
    return TypeError(message + close(name, inspect.signature(call).parameters))


def suggesting(function: Callable[_Arguments, _Kind]) -> Callable[_Arguments, _Kind]:
    """The same function, whose exception for an unknown keyword suggests a similar one, as Python does from 3.13 on."""
    known = inspect.signature(function).parameters

    @wraps(function)
    def call(*args: _Arguments.args, **kwargs: _Arguments.kwargs) -> _Kind:
        for name in kwargs:
            if name not in known:
                raise unexpected(function, name)
        return function(*args, **kwargs)

    return call


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
