"""Arguments that are no numbers, and what is said of those that are wrong."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Iterable
from functools import wraps
from typing import Any, TypeVar

from ._native import count
from .errors import MalformedError

_Kind = TypeVar("_Kind")


def close(name: str, known: Iterable[str]) -> str:
    """The end of a message about an unknown name: a known one that is similar, if there is one."""
    from difflib import get_close_matches

    found = get_close_matches(name.lower(), known, 1)
    return f". Did you mean '{found[0]}'?" if found else ""


def unexpected(call: Callable[..., object], name: str) -> TypeError:
    """The exception of a keyword that a function or a class does not have, in Python's own words."""
    message = f"{call.__qualname__}() got an unexpected keyword argument '{name}'"
    return TypeError(message + close(name, inspect.signature(call).parameters))


def suggest(public: dict[str, Any]) -> None:
    """Lets the exceptions of all functions and methods for an unknown keyword suggest a similar one, as those of Python's own
    do from 3.13 on."""
    for name, thing in list(public.items()):
        if inspect.isfunction(thing):
            # By its name in its module as well, by which it is pickled.
            public[name] = vars(sys.modules[thing.__module__])[name] = _suggesting(thing)
        elif inspect.isclass(thing):
            for name, method in inspect.getmembers(thing, inspect.isroutine):
                if not name.startswith("_"):
                    call = _suggesting(method)
                    call.__module__, call.__qualname__ = thing.__module__, f"{thing.__qualname__}.{name}"
                    is_static = isinstance(inspect.getattr_static(thing, name), staticmethod)
                    setattr(thing, name, staticmethod(call) if is_static else call)


def _suggesting(call: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(call)
    def suggesting(*args: Any, **kwargs: Any) -> Any:
        try:
            return call(*args, **kwargs)
        except TypeError:
            known = inspect.signature(call).parameters
            for name in kwargs:
                if name not in known:
                    raise unexpected(suggesting, name) from None
            raise

    return suggesting


def an(kind: type[_Kind], field: str, value: object) -> _Kind:
    """The value of an argument, if it is of this class."""
    if isinstance(value, kind):
        return value
    raise wrong(field, value, f"a {kind.__name__}")


def drawn(value: Any) -> Any:
    """The whole number that a generator of NumPy draws as a seed, or that a sequence of seeds has first; else the value."""
    random = sys.modules.get("numpy.random")
    if random is not None and isinstance(value, random.Generator):
        return int(value.integers(2**63))
    if random is not None and isinstance(value, random.SeedSequence):
        return int(value.generate_state(1, "uint64")[0])
    return value


def as_seed(seed: Any, rng: Any) -> int | None:
    """The seed, by either of its names."""
    if seed is not None and rng is not None:
        raise MalformedError("seed and rng are the same setting", field="rng", valid="either seed or rng")
    name, value = ("seed", seed) if rng is None else ("rng", rng)
    return None if value is None else count(name, drawn(value))


def truth(field: str, value: object) -> bool:
    """The argument, if it is True or False."""
    if isinstance(value, bool):
        return value
    raise wrong(field, value, "True or False")


def a_function(field: str, value: object) -> None:
    """Refuses what is neither None nor can be called."""
    if value is not None and not callable(value):
        raise wrong(field, value, "None, or what can be called")


def wrong(field: str, value: object, valid: str) -> MalformedError:
    """The exception of a value of another type than the argument has."""
    return MalformedError(f"{field} is of type {type(value).__name__}: expected {valid}", field=field, valid=valid)

