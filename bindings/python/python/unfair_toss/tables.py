"""Answers of several rows: columns of NumPy, which pandas, polars and Arrow read."""

from __future__ import annotations

from dataclasses import dataclass, fields
from html import escape
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from .errors import NotVerifiedError
from .results import ShownAsTable, _HoldsArrays

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes

_Floats = npt.NDArray[np.float64]


class Table(ShownAsTable, _HoldsArrays):
    """Columns of the same length. ``polars.DataFrame(table)`` and ``pyarrow.table(table)`` read it, too."""

    _SHOWN: ClassVar[int] = 20
    """How many rows a notebook shows."""

    @classmethod
    def _of(cls, rows: list[dict[str, Any]], **others: Any) -> Self:
        """The columns of rows of JSON, beside other fields. A number that is not known is NaN."""
        columns = (field for field in fields(cls) if field.name not in others)
        return cls(**{field.name: _column(str(field.type), [row.get(field.name) for row in rows]) for field in columns}, **others)

    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """The columns by their names."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        return {name: value for name, value in values.items() if isinstance(value, np.ndarray)}

    def to_pandas(self) -> pd.DataFrame:
        """A ``pandas.DataFrame`` with a row for each row."""
        import pandas as pd

        return pd.DataFrame(self.to_dict())

    def __len__(self) -> int:
        return len(getattr(self, fields(self)[0].name))

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The rows as Arrow, which needs pyarrow."""
        import pyarrow

        return pyarrow.table(self.to_dict()).__arrow_c_stream__(requested_schema)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({len(self)} rows: {', '.join(self.to_dict())})"

    def _repr_html_(self) -> str:
        shown = self._SHOWN
        rows = zip(*(column[:shown] for column in self.to_dict().values()), strict=True)
        body = "".join(f"<tr>{''.join(f'<td>{escape(str(cell))}</td>' for cell in row)}</tr>" for row in rows)
        head = "".join(f"<th>{name}</th>" for name in self.to_dict())
        more = f", the first {shown} of {len(self)} rows" if len(self) > shown else ""
        return f"<table><caption>{type(self).__name__}{more}</caption><tr>{head}</tr>{body}</table>"


def _column(kind: str, values: list[Any]) -> npt.NDArray[Any]:
    if kind == "_Floats":
        return np.array([np.nan if value is None else value for value in values], np.float64)
    if kind.endswith("int64]"):
        return np.array([value or 0 for value in values], np.int64)
    return np.array(["" if value is None else value for value in values], np.str_)


@dataclass(frozen=True, eq=False, repr=False)
class Limit(Table):
    """The limit of long flights, and the share of heads among some.

    Attributes
    ----------
    cone_angle : ndarray of float64
        ψ in rad.
    limit : ndarray of float64
        p(ψ), the probability of heads in the limit.
    launches : ndarray of int64
        Number of flights.
    share, share_lo, share_hi : ndarray of float64
        The share of heads among the decided ones, and its interval at a level of 95 %.
    undecided : ndarray of int64
        Number of undecided flights.
    """

    cone_angle: _Floats
    limit: _Floats
    launches: npt.NDArray[np.int64]
    share: _Floats
    share_lo: _Floats
    share_hi: _Floats
    undecided: npt.NDArray[np.int64]


@dataclass(frozen=True, eq=False, repr=False)
class Convergence(Table):
    """Shares of heads after a growing number of launches.

    Attributes
    ----------
    launches : ndarray of int64
        Number of launches so far.
    grid, random : ndarray of float64
        The share of heads among the decided launches of the grid, and of those at random.
    random_lo, random_hi : ndarray of float64
        The interval of the latter at a level of 95 %.
    grid_undecided, random_undecided : ndarray of int64
        Numbers of undecided launches.
    """

    launches: npt.NDArray[np.int64]
    grid: _Floats
    random: _Floats
    random_lo: _Floats
    random_hi: _Floats
    grid_undecided: npt.NDArray[np.int64]
    random_undecided: npt.NDArray[np.int64]


@dataclass(frozen=True, eq=False, repr=False)
class MethodErrors(Table):
    """The errors of the methods of sampling.

    Attributes
    ----------
    method : ndarray of str
        Name of the method.
    launches, replicates : ndarray of int64
        Number of launches, and of seeds.
    rms_error : ndarray of float64
        Root mean square of the error of the probability.
    reference, reference_error : ndarray of float64
        The probability that was taken as true, and a bound of its own error.
    """

    method: npt.NDArray[np.str_]
    launches: npt.NDArray[np.int64]
    rms_error: _Floats
    replicates: npt.NDArray[np.int64]
    reference: _Floats
    reference_error: _Floats


@dataclass(frozen=True, eq=False, repr=False)
class Comparison(Table):
    """One toss by every solver. What a solver does not have is NaN, 0 or an empty text.

    Attributes
    ----------
    solver, scheme, formulation : ndarray of str
        The solver with its settings.
    cos_tilt, cos_tilt_error : ndarray of float64
        cos θ at landing, and its difference from the exact motion.
    attitude_error : ndarray of float64
        The angle from the attitude of the exact motion in rad.
    outcome : ndarray of str
        ``"heads"``, ``"tails"`` or ``"undecided"``.
    rhs_calls, accepted_steps, rejected_steps : ndarray of int64
        The cost, as of ``Work``.
    failure : ndarray of str
        Why there is no answer.
    """

    solver: npt.NDArray[np.str_]
    scheme: npt.NDArray[np.str_]
    formulation: npt.NDArray[np.str_]
    cos_tilt: _Floats
    cos_tilt_error: _Floats
    attitude_error: _Floats
    outcome: npt.NDArray[np.str_]
    rhs_calls: npt.NDArray[np.int64]
    accepted_steps: npt.NDArray[np.int64]
    rejected_steps: npt.NDArray[np.int64]
    failure: npt.NDArray[np.str_]


@dataclass(frozen=True, eq=False, repr=False)
class Sample(Table):
    """Launches, and how each lands. The first seven are columns for ``cos_tilt`` and its siblings, by the same names.

    Attributes
    ----------
    rate_x, rate_y, rate_z : ndarray of float64
        Angular velocity at launch in rad/s, along the axes of the body.
    speed : ndarray of float64
        In m/s.
    gravity : ndarray of float64
        In m/s².
    drop : ndarray of float64
        How far below its launch the coin lands, in m.
    tilt : ndarray of float64
        Turn about the lab's x axis before the launch in rad.
    flight_time : ndarray of float64
        In s.
    cos_tilt : ndarray of float64
        cos θ at landing.
    outcome : ndarray of int8
        1 for heads, -1 for tails, 0 for undecided.
    certified : ndarray of bool
        Whether the outcome is proven.
    """

    rate_x: _Floats
    rate_y: _Floats
    rate_z: _Floats
    speed: _Floats
    gravity: _Floats
    drop: _Floats
    tilt: _Floats
    flight_time: _Floats
    cos_tilt: _Floats
    outcome: npt.NDArray[np.int8]
    certified: npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False, repr=False)
class Verification(Table):
    """What the checks of the verification suite found, the worst row first.

    Attributes
    ----------
    check : ndarray of str
        Name of the check.
    status : ndarray of str
        ``"pass-by-claim"`` or another that begins with ``"pass"``; ``"not-judged"``; any other one is a failure.
    measured, limit : ndarray of float64
        The deviation that was measured, and the largest one that is allowed; NaN where there is none.
    unit : ndarray of str
        Unit of both.
    reserve : ndarray of float64
        ``limit / measured``.
    cases, without_answer : ndarray of int64
        Numbers of launches, and of those without an answer.
    worst_input, failure : ndarray of str
        The worst launch, and why it has no answer.
    claim : ndarray of str
        What the check claims.
    passed : bool
        Whether no row fails.
    diagnosis : str
        What the function most likely does wrong; empty if it is right.
    """

    _SHOWN = 50

    check: npt.NDArray[np.str_]
    status: npt.NDArray[np.str_]
    measured: _Floats
    limit: _Floats
    unit: npt.NDArray[np.str_]
    reserve: _Floats
    cases: npt.NDArray[np.int64]
    without_answer: npt.NDArray[np.int64]
    worst_input: npt.NDArray[np.str_]
    failure: npt.NDArray[np.str_]
    claim: npt.NDArray[np.str_]
    passed: bool
    diagnosis: str

    @classmethod
    def _of_report(cls, report: dict[str, Any], diagnosis: str) -> Self:
        """The rows of a report of the suite."""

        def rank(row: dict[str, Any]) -> tuple[bool, float]:
            return _passes(row["status"]), np.inf if row["reserve"] is None else row["reserve"]

        return cls._of(sorted(report["rows"], key=rank), passed=report["passed"], diagnosis=diagnosis)

    def require(self) -> Self:
        """These rows, if none fails.

        Raises
        ------
        errors.NotVerifiedError
            With the diagnosis and the failing checks.
        """
        if not self.passed:
            raise NotVerifiedError(self._words())
        return self

    def _words(self) -> str:
        failing = self.check[[not _passes(status) for status in self.status]]
        if not failing.size:
            return f"passes all {len(self)} checks"
        return f"fails {len(failing)} of {len(self)} checks ({', '.join(failing)}). {self.diagnosis}".strip()

    def __repr__(self) -> str:
        return f"Verification({self._words()})"

    def _repr_html_(self) -> str:
        return f"<p>{escape(self._words())}</p>{super()._repr_html_()}"


def _passes(status: str) -> bool:
    return status.startswith("pass") or status == "not-judged"


@dataclass(frozen=True, eq=False, repr=False)
class Map(ShownAsTable, _HoldsArrays):
    """The probability of heads over two coordinates.

    Attributes
    ----------
    across, up : str
        Names of the coordinates.
    across_values, up_values : ndarray of float64
        Their values in SI units, m of ``up`` and n of ``across``.
    probability : ndarray of shape (m, n)
        NaN where no launch is decided.
    undecided : ndarray of int64 of shape (m, n)
        Numbers of undecided launches.
    """

    across: str
    up: str
    across_values: _Floats
    up_values: _Floats
    probability: _Floats
    undecided: npt.NDArray[np.int64]

    @classmethod
    def _of(cls, found: dict[str, Any]) -> Map:
        probability = np.array(found["probability"], np.float64)
        undecided = np.array(found.get("undecided") or np.zeros(probability.shape), np.int64)
        columns, rows = (np.array(found[name], np.float64) for name in ("across_values", "up_values"))
        return cls(found["across"], found["up"], columns, rows, probability, undecided)

    def to_xarray(self) -> xr.DataArray:
        """The probability as an ``xarray.DataArray`` with the two coordinates."""
        import xarray as xr

        coordinates = {self.up: self.up_values, self.across: self.across_values}
        return xr.DataArray(self.probability, coordinates, (self.up, self.across), "probability")

    def to_pandas(self) -> pd.DataFrame:
        """The probability as a ``pandas.DataFrame``: a row for each value of ``up``."""
        import pandas as pd

        rows, columns = pd.Index(self.up_values, name=self.up), pd.Index(self.across_values, name=self.across)
        return pd.DataFrame(self.probability, rows, columns)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the probability with matplotlib, on ``ax`` or the current axes, and returns the axes."""
        if ax is None:
            import matplotlib.pyplot as plt

            ax = plt.gca()
        drawn = ax.pcolormesh(self.across_values, self.up_values, self.probability, vmin=0.0, vmax=1.0, shading="nearest")
        assert ax.figure is not None
        ax.figure.colorbar(drawn, ax=ax, label="P(heads)")
        ax.set(xlabel=self.across, ylabel=self.up)
        return ax


@dataclass(frozen=True)
class SpreadAlone(ShownAsTable):
    """The largest spread of a single input.

    Attributes
    ----------
    input : str
        Its name.
    answer, spread, probability, looks, at_least
        As of ``Spread``.
    """

    input: str
    answer: str
    spread: float | None
    probability: float | None
    looks: int | None
    at_least: float | None


@dataclass(frozen=True)
class Spread(ShownAsTable):
    """How precise a hand must be.

    Attributes
    ----------
    answer : str
        ``"up_to"`` the spread; ``"at_least"``, where the search ended; ``"any"`` that was tried; ``"toss_is_not_heads"`` or
        ``"below_smallest"``, where none suffices.
    spread : float or None
        The largest relative standard deviation of each rate and of the speed.
    probability : float or None
        That of heads at this spread.
    interval : tuple of 2 floats or None
        Its interval at a level of 95 %.
    interval_kind : str or None
        What it is.
    looks : int or None
        At how many spreads the probability was estimated.
    at_least : float or None
        The probability at every smaller spread is at least this.
    alone : tuple of SpreadAlone
        The spread of each input alone.
    """

    answer: str
    spread: float | None
    probability: float | None
    interval: tuple[float, float] | None
    interval_kind: str | None
    looks: int | None
    at_least: float | None
    alone: tuple[SpreadAlone, ...]


@dataclass(frozen=True)
class Sensitivity(ShownAsTable):
    """Derivatives of cos θ at landing.

    Attributes
    ----------
    rate : tuple of 3 floats
        By the rates about x, y and z, per rad/s.
    time : float
        By the time of flight, per s.
    """

    rate: tuple[float, ...]
    time: float
