"""Solvers, in the words of ``scipy.integrate.solve_ivp``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from . import _native
from ._native import Solver, Toss
from .errors import MalformedError, OutOfRangeError
from .single import Work

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation


@dataclass(frozen=True)
class Solution:
    """A flight as a solver found it.

    Attributes
    ----------
    t : ndarray of shape (n,)
        Times after launch in s.
    y : ndarray of shape (7, n)
        The state at each time: the unit quaternion (w, x, y, z) from the body to the laboratory, and the angular
        velocity in rad/s along the axes of the body.
    nfev : int
        Evaluations of the right-hand side; 0 for a closed form.
    work : Work
        Evaluations, and steps.
    error_estimate : float or None
        The solver's estimate of the error of cos θ at the landing, of a flight without stops.
    success : bool
        Always true: a solver that cannot go on raises ``errors.SolveError`` instead.
    status : int
        0, as SciPy has it for the end of the interval.
    message : str
        In words.
    """

    t: npt.NDArray[np.float64]
    y: npt.NDArray[np.float64]
    nfev: int
    work: Work
    error_estimate: float | None
    success: bool = True
    status: int = 0
    message: str = "The solver reached the landing or the last time."

    @property
    def attitude(self) -> npt.NDArray[np.float64]:
        """Unit quaternions (w, x, y, z), of shape (n, 4)."""
        return np.ascontiguousarray(self.y[:4].T)

    @property
    def rate(self) -> npt.NDArray[np.float64]:
        """Angular velocities in rad/s along the axes of the body, of shape (n, 3)."""
        return np.ascontiguousarray(self.y[4:].T)

    @property
    def cos_tilt(self) -> npt.NDArray[np.float64]:
        """cos θ of the attitudes, of shape (n,)."""
        w, x, y, z = self.y[:4]
        heights: npt.NDArray[np.float64] = (w * w + z * z) - (x * x + y * y)
        return heights

    @property
    def rotation(self) -> Rotation:
        """The attitudes as one ``scipy.spatial.transform.Rotation``."""
        from scipy.spatial.transform import Rotation

        return Rotation.from_quat(self.attitude, scalar_first=True)


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
    settings = {"scheme": scheme, "rtol": rtol, "step": step, "formulation": formulation}
    if isinstance(solver, str):
        solver = Solver(solver, scheme=scheme, rtol=rtol, step=step, formulation=formulation)
    elif given := [name for name, value in settings.items() if value is not None]:
        raise MalformedError(f"{given[0]} is given with a Solver, which has settings", field=given[0], valid="None")
    times = _times(toss, t_eval)
    y, work, estimate = _native.solve(toss, times, solver)
    return Solution(times, y, work[0], Work(*work), estimate)


def _times(toss: Toss, t_eval: npt.ArrayLike | None) -> npt.NDArray[np.float64]:
    """The times, ascending from launch to landing."""
    if t_eval is None:
        return np.array([0.0, toss.flight_time])
    try:
        times = np.array(t_eval, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise MalformedError(f"t_eval: {error}", field="t_eval [s]", valid="ascending times") from None
    valid = f"one dimension of ascending times from 0 to {toss.flight_time!r}"
    within = times.ndim == 1 and bool(np.all((times >= 0.0) & (times <= toss.flight_time)))
    if not within or bool(np.any(np.diff(times) < 0.0)):
        raise OutOfRangeError(f"t_eval is outside its valid range: {valid}", field="t_eval [s]", valid=valid)
    return times
