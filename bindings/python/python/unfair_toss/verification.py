"""The checks of the verification suite, on a function of Python."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

from ._native import numbers
from .errors import MalformedError
from .given import truth, wrong
from .tables import Verification


def verify(
    f: Callable[..., Any],
    *,
    columns: bool = False,
    quick: bool = False,
    deep: bool = False,
    only: str | None = None,
    bodies: bool = False,
    claim: float | str | None = None,
    answer_seconds: float | None = None,
    total_seconds: float | None = None,
    time_factor: float | None = None,
    folder: str | os.PathLike[str] | None = None,
    program: str | os.PathLike[str] | None = None,
) -> Verification:
    """Runs the verification suite on a function that says where a toss lands.

    The function is called in this process, in a thread, by one call at a time. The suite itself is a program, which a second
    package installs: ``pip install ./bindings/verify``.

    Parameters
    ----------
    f : callable
        Called as ``f(toss)`` with a ``Toss`` of any coin; with ``rtol=`` as well, if it has an argument of this name: the
        local error to integrate with. It returns the attitude at landing: a unit quaternion (w, x, y, z) from the body to the
        laboratory, a ``Rotation`` of SciPy, a ``Landing`` or a ``Solution``. The last two also say their error estimate,
        rate and work. An ``errors.SolveError`` is a launch without an answer.
    columns : bool
        Whether ``f`` takes columns instead, as ``attitude`` does: ``f(rate_x, rate_y, rate_z, time=, attitude=, moments=)``,
        with moments of shape (n, 3) in kg m². It returns n attitudes.
    quick, deep : bool
        Whether to take fewer cases, or ten times as many. A quick run calls ``f`` some 17 000 times, others 300 000 times.
    only : str, optional
        The name of a check, to run it alone.
    bodies : bool
        Whether ``f`` takes bodies with three moments, too.
    claim : float or str, optional
        The error of cos θ by which ``f`` is judged: one number, or such as ``"1e-12/rad"`` for one that is multiplied by
        1 + φ, for a phase φ. By default its error estimate, if its answers have one, or else what ``rtol`` permits.
    answer_seconds, total_seconds : float, optional
        The longest time for an answer, and for all of them together, in s; 10 and 1800 by default.
    time_factor : float, optional
        The time limit of every check is multiplied by this.
    folder : path, optional
        A folder for the report (``report.html``) with its charts.
    program : path, optional
        The program, if it is not installed.

    Returns
    -------
    Verification
        The rows of all checks. Its method ``require`` raises an exception if one of them fails.

    Raises
    ------
    Exception
        What ``f`` raises, but for ``errors.SolveError``, with a note that names the launch.
    errors.MalformedError
        For an argument that the program refuses, and for what is no attitude.
    errors.ProgramError
        If the program is not there, or could not run.
    """
    # Most users need neither processes nor sockets, which take a while to import.
    from .suite import report_on

    if not callable(f):
        raise wrong("f", f, "a function")
    options = [f"--{name}" for name, is_set in (("quick", quick), ("deep", deep), ("bodies", bodies)) if truth(name, is_set)]
    if quick and deep:
        raise MalformedError("quick and deep contradict each other", field="deep", valid="either quick or deep")
    for name, value in (("only", only), ("claim", claim)):
        options += [] if value is None else [f"--{name}={_text(name, value)}"]
    for name, seconds in (("answer_seconds", answer_seconds), ("total_seconds", total_seconds), ("time_factor", time_factor)):
        options += [] if seconds is None else [f"--{name.replace('_', '-')}={_number(name, seconds)!r}"]
    report, diagnosis = report_on(f, truth("columns", columns), options, folder, program)
    return Verification._of_report(report, diagnosis)


def _text(field: str, value: object) -> str:
    """The text of an option, or that of a number."""
    if not isinstance(value, str):
        if field == "only":
            raise wrong(field, value, "the name of a check")
        return repr(_number(field, value))
    if not value.isprintable() or not value:
        raise MalformedError(f"{field} = {value!r}: expected a text that can be printed", field=field, valid="a text")
    return value


def _number(field: str, value: Any) -> float:
    given = numbers(field, value)
    if given.size != 1:
        raise MalformedError(f"{field} has {given.size} numbers: expected one", field=field, valid="a number")
    return float(given.reshape(-1)[0])
