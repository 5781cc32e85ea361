"""Exceptions, one class for each kind of error.

Bad input is an ``InputError``, which is a ``ValueError``; a solver that cannot go on is a ``SolveError``, which is a
``RuntimeError``. Each exception has the attributes ``field``, ``index`` and ``valid``.
"""

from __future__ import annotations

from collections.abc import Callable


class TossError(Exception):
    """An error of this package.

    Attributes
    ----------
    field : str or None
        The argument that is at fault, with its unit.
    index : int or None
        The index from 0 of what is at fault, in C order: of a launch of the broadcast columns, or of an element of an
        argument that takes several.
    valid : str or None
        The valid range, or what was expected.
    """

    def __init__(
        self, message: str, *, field: str | None = None, index: int | None = None, valid: str | None = None
    ) -> None:
        # What others wrote may hold control characters. A message is one line.
        super().__init__("".join(letter if letter.isprintable() else _escaped(letter) for letter in message))
        self.field = field
        self.index = index
        self.valid = valid

    def __reduce__(self) -> tuple[Callable[..., TossError], tuple[object, ...]]:
        return _again, (type(self), str(self), self.field, self.index, self.valid)


def _escaped(letter: str) -> str:
    """A letter as in the source of a text."""
    return letter.encode("unicode_escape").decode()


def _again(
    kind: type[TossError], message: str, field: str | None, index: int | None, valid: str | None
) -> TossError:
    """Makes an exception anew, in another process."""
    return kind(message, field=field, index=index, valid=valid)


class InputError(TossError, ValueError):
    """Input that describes no toss. It was refused before anything was computed."""


class OutOfRangeError(InputError):
    """A number outside its valid range, or not a number."""


class MalformedError(InputError):
    """What cannot be read as a value of the field, or arguments that contradict each other."""


class MissingError(InputError):
    """A value that is needed and was not given."""


class OutsideModelError(InputError):
    """A physical effect or a body that is left out, and refused because ignoring it would give a wrong answer."""


class NoBodyError(InputError):
    """A moment of inertia that is larger than the sum of the other two."""


class UnknownNameError(InputError):
    """A name that is not in the list of known names."""


class TextError(InputError):
    """A text that cannot be read."""


class NotReachedError(InputError):
    """The largest allowed number of launches did not reach the wanted accuracy."""


class PartError(InputError):
    """A part of an estimate that is of another plan, there twice, missing, or changed since it was written."""


class SolveError(TossError, RuntimeError):
    """A solver that cannot go on."""


class PhaseTooLargeError(SolveError):
    """The body turns so far, by more than 2^53 rad, that neighbouring inputs land a radian apart."""


class SingularError(SolveError):
    """The formulation reached a point where its equations have no derivative."""


class NotOfferedError(SolveError):
    """The solver does not have this scheme."""


class NotSymmetricError(SolveError):
    """The solver is for bodies with I1 = I2 only."""


class StepLimitError(SolveError):
    """The flight needs more steps than the limit."""


class StepSizeUnderflowError(SolveError):
    """The step size fell below the resolution of the time."""


class NotFiniteError(SolveError):
    """The integrated state holds a NaN or an infinity."""


class MisbehavedError(SolveError):
    """The solver answered an impossible number."""


class FailedError(SolveError):
    """The solver failed for a reason of its own."""


class NotVerifiedError(TossError, RuntimeError):
    """A function that fails a check of the verification suite."""


class ProgramError(TossError, RuntimeError):
    """The program of the verification suite is not there, or could not run."""
