"""Solvers, in the words of ``scipy.integrate.solve_ivp``."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from . import _native
from ._native import Solver, Toss, numbers
from .errors import InputError, MalformedError, OutOfRangeError
from .given import an, wrong
from .launches import column
from .results import DenseOutput, Solution, Work, fastest_turn
from .units import Quantity


def solve(
    toss: Toss,
    solver: str | Solver | None = None,
    *,
    t_eval: npt.ArrayLike | None = None,
    method: str | None = None,
    scheme: str | None = None,
    rtol: float | None = None,
    atol: float | None = None,
    step: Quantity | None = None,
    formulation: str | None = None,
    dense_output: bool = False,
) -> Solution:
    """The flight of any body by any solver.

    Parameters
    ----------
    toss : Toss
        The body and its launch.
    solver : str or Solver, optional
        The exact motion, or an integrator (``solvers()``). By default the exact motion; the quaternion if any setting is
        given.
    t_eval : array_like of shape (n,), optional
        Ascending times from 0 to the time of flight in s; launch and landing by default. An integrator stops at each.
    method : str, optional
        The scheme, in upper or lower case and with SciPy's names, too: ``"DOP853"``, or ``"RK45"`` for ``"dopri5"``.
    scheme, rtol, step, formulation
        Settings of a solver that is given by its name, as for ``Solver``.
    atol : float, optional
        The schemes control both errors by one tolerance, as the state is dimensionless: ``rtol`` or ``atol``, or both if
        they are equal.
    dense_output : bool
        Whether ``.sol`` gives the flight at any other time.

    Returns
    -------
    Solution
        With ``.t``, ``.y``, ``.nfev``, ``.success`` and ``.sol``, as SciPy has them.

    Raises
    ------
    errors.InputError
        For a setting that the solver does not have, and for impossible times.
    errors.SolveError
        If the solver cannot go on, or does not solve such a body.
    """
    an(Toss, "toss", toss)
    settings = {"method": method, "scheme": scheme, "rtol": rtol, "atol": atol, "step": step, "formulation": formulation}
    given = [name for name, value in settings.items() if value is not None]
    if solver is None:
        solver = "quaternion" if given else "exact"
    if not isinstance(solver, Solver):
        if not isinstance(solver, str):
            raise wrong("solver", solver, "the name of a solver, or a Solver")
        try:
            named = _scheme(method, scheme)
            solver = Solver(solver, scheme=named, rtol=_tolerance(rtol, atol), step=step, formulation=formulation)
        except InputError as error:
            field = _as_given(error.field, settings)
            error.args = (str(error).replace(error.field or "", field or "", 1),)
            error.field = field
            raise
    elif given:
        raise MalformedError(f"{given[0]} is given with a Solver, which has settings", field=given[0], valid="None")
    times = _times(toss, t_eval)
    y, work, estimate = _native.solve(toss, times, solver)
    if not isinstance(dense_output, bool):
        raise wrong("dense_output", dense_output, "True or False")
    sol = DenseOutput(toss, solver) if dense_output else None
    turn = fastest_turn(toss)
    return Solution(times, y, work["rhs_calls"], Work(**work), estimate, sol=sol, fastest_turn=turn)


_SCIPY = {"rk45": "dopri5"}
"""Schemes that SciPy calls otherwise."""


def _as_given(field: str | None, settings: Mapping[str, object]) -> str | None:
    """The argument of ``solve`` that a field of ``Solver`` came from."""
    if field == "name":
        return "solver"
    other = {"scheme": "method", "rtol": "atol"}.get(field or "")
    return other if other and settings[other] is not None and settings[field or ""] is None else field


def _scheme(method: str | None, scheme: str | None) -> str | None:
    """The scheme by its own name."""
    if method is None:
        return scheme
    if not isinstance(method, str):
        raise wrong("method", method, "the name of a scheme")
    if scheme is not None:
        raise MalformedError("method and scheme are the same setting", field="method", valid="either method or scheme")
    return _SCIPY.get(method.lower(), method.lower())


def _tolerance(rtol: float | None, atol: float | None) -> float | None:
    """The one tolerance of a scheme."""
    if atol is None:
        return rtol
    given = numbers("atol", atol)
    if given.size != 1 or (rtol is not None and atol != rtol):
        valid = "one number, equal to rtol: one tolerance controls both errors of all components"
        raise MalformedError(f"atol can't be used: expected {valid}", field="atol", valid=valid)
    return float(given[0])


def _times(toss: Toss, t_eval: npt.ArrayLike | None) -> npt.NDArray[np.float64]:
    """The times, ascending from launch to landing."""
    if t_eval is None:
        return np.array([0.0, toss.flight_time])
    times = np.array(column("t_eval [s]", t_eval), dtype=np.float64)
    valid = f"one dimension of ascending times from 0 to {toss.flight_time!r}"
    index = None
    if times.ndim == 1:
        is_wrong = ~((times >= 0.0) & (times <= toss.flight_time))
        is_wrong[1:] |= np.diff(times) < 0.0
        if not is_wrong.any():
            return times
        index = int(np.flatnonzero(is_wrong)[0])
    message = f"t_eval is outside its valid range: {valid}"
    raise OutOfRangeError(message, field="t_eval [s]", index=index, valid=valid)
