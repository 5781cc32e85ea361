"""Solvers, in the words of ``scipy.integrate.solve_ivp``."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import _native
from ._native import Solver, Toss
from .errors import InputError, MalformedError, OutOfRangeError
from .given import an, wrong
from .launches import column
from .results import Solution, Work


def solve(
    toss: Toss,
    solver: str | Solver = "exact",
    *,
    t_eval: npt.ArrayLike | None = None,
    scheme: str | None = None,
    rtol: float | None = None,
    step: float | None = None,
    formulation: str | None = None,
) -> Solution:
    """The flight of any body by any solver.

    Parameters
    ----------
    toss : Toss
        The body and its launch.
    solver : str or Solver
        The exact motion, or an integrator (``solvers()``).
    t_eval : array_like of shape (n,), optional
        Ascending times from 0 to the time of flight in s; launch and landing by default. An integrator stops at each.
    scheme, rtol, step, formulation
        Settings of a solver that is given by its name, as for ``Solver``. ``rtol`` is the absolute tolerance, too.

    Returns
    -------
    Solution
        With ``.t``, ``.y``, ``.nfev`` and ``.success``, as SciPy has them.

    Raises
    ------
    errors.InputError
        For a setting that the solver does not have, and for impossible times.
    errors.SolveError
        If the solver cannot go on, or does not solve such a body.
    """
    an(Toss, "toss", toss)
    settings = {"scheme": scheme, "rtol": rtol, "step": step, "formulation": formulation}
    if not isinstance(solver, Solver):
        if not isinstance(solver, str):
            raise wrong("solver", solver, "the name of a solver, or a Solver")
        try:
            solver = Solver(solver, scheme=scheme, rtol=rtol, step=step, formulation=formulation)
        except InputError as error:
            if error.field == "name":
                error.field = "solver"
            raise
    elif given := [name for name, value in settings.items() if value is not None]:
        raise MalformedError(f"{given[0]} is given with a Solver, which has settings", field=given[0], valid="None")
    times = _times(toss, t_eval)
    y, work, estimate = _native.solve(toss, times, solver)
    return Solution(times, y, work[0], Work(*work), estimate)


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
