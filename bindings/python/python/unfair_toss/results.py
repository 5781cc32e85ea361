"""What questions about one toss are answered with."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation


class _HoldsArrays:
    """An answer that holds arrays. Two of the same class are equal if all their values are, of arrays each element. It has
    no hash, because arrays can be changed."""

    __dataclass_fields__: ClassVar[dict[str, Any]]
    __hash__: ClassVar[None] = None  # type: ignore[assignment]

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        pairs = ((getattr(self, field.name), getattr(other, field.name)) for field in fields(self))
        return all(bool(np.array_equal(one, two)) if isinstance(one, np.ndarray) else one == two for one, two in pairs)


@dataclass(frozen=True)
class Work:
    """The cost of a solution, as counts that are the same in every run.

    Attributes
    ----------
    rhs_calls : int
        Evaluations of the right-hand side; of a Taylor series, orders of all its steps.
    accepted_steps, rejected_steps : int
        Steps.
    """

    rhs_calls: int
    accepted_steps: int
    rejected_steps: int


@dataclass(frozen=True, eq=False)
class Landing(_HoldsArrays):
    """How a toss lands.

    Attributes
    ----------
    outcome : str
        ``"heads"``, ``"tails"`` or ``"undecided"``.
    certified : bool
        Whether the outcome is proven, for exactly the numbers given. Only the exact motion proves.
    proven_by : str or None
        The stage of the proof.
    cos_tilt : float
        cos θ, with θ the angle between the normal and the vertical.
    attitude : ndarray of shape (4,)
        Unit quaternion (w, x, y, z) from the body to the laboratory.
    rate : ndarray of shape (3,)
        Angular velocity at landing in rad/s, along the axes of the body.
    flight_time : float
        In s.
    norm_error : float
        Loss of norm of an integrated quaternion, before it was normalised.
    error_estimate : float or None
        The solver's estimate of the error of ``cos_tilt``.
    solver, scheme : str, str or None
        What computed it.
    work : Work
        Its cost.
    """

    outcome: str
    certified: bool
    proven_by: str | None
    cos_tilt: float
    attitude: npt.NDArray[np.float64]
    rate: npt.NDArray[np.float64]
    flight_time: float
    norm_error: float
    error_estimate: float | None
    solver: str
    scheme: str | None
    work: Work


@dataclass(frozen=True)
class Margins:
    """For each input alone, the change to the nearest value that lands the other way; None where no value does.

    Attributes
    ----------
    time : float or None
        Of the time of flight in s.
    speed, gravity : float or None
        In m/s and m/s²; None also where the time was given instead.
    tilt : float or None
        A further turn about the lab's x axis in rad.
    rate : tuple of 3 floats or None
        Of the rates about x, y and z in rad/s.
    rate_range : tuple of 3 floats
        The largest changes of rates that were searched in rad/s.
    time_range : tuple of 2 floats
        The largest changes of the time of flight that were searched, earlier and later, in s; infinite where all were.
    """

    time: float | None
    speed: float | None
    gravity: float | None
    tilt: float | None
    rate: tuple[float | None, float | None, float | None]
    rate_range: tuple[float, float, float]
    time_range: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Intervals(_HoldsArrays):
    """The speeds that land heads.

    Attributes
    ----------
    heads : ndarray of shape (n, 2)
        Pairs of speeds in m/s between which the toss lands heads.
    probability : float
        Their share of the range.
    """

    heads: npt.NDArray[np.float64]
    probability: float


@dataclass(frozen=True, eq=False)
class Trace(_HoldsArrays):
    """A flight at n times.

    Attributes
    ----------
    t : ndarray of shape (n,)
        Times after launch in s.
    attitude : ndarray of shape (n, 4)
        Unit quaternions (w, x, y, z) from the body to the laboratory.
    angles : ndarray of shape (n, 3)
        Euler angles α, β, γ (z-x-z) in rad, continuous over the flight.
    normal : ndarray of shape (n, 3)
        The normal, a unit vector in the laboratory whose z axis is up.
    face : ndarray of shape (n, 3)
        The body's x axis, in the same axes.
    cos_tilt : ndarray of shape (n,)
        cos θ.
    """

    t: npt.NDArray[np.float64]
    attitude: npt.NDArray[np.float64]
    angles: npt.NDArray[np.float64]
    normal: npt.NDArray[np.float64]
    face: npt.NDArray[np.float64]
    cos_tilt: npt.NDArray[np.float64]


@dataclass(frozen=True)
class Inverse:
    """A launch from horizontal whose long flights land heads with a wanted probability.

    Attributes
    ----------
    probability : float
        The wanted one.
    inertia_ratio : float
        k = I3/I1 of the coin.
    rate_ratio : float
        Rate of tumbling over the rate of spin, √(ωx² + ωy²)/ωz.
    cone_angle : float
        Angle ψ between the normal and the angular momentum in rad.
    """

    probability: float
    inertia_ratio: float
    rate_ratio: float
    cone_angle: float


@dataclass(frozen=True, eq=False)
class Solution(_HoldsArrays):
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
