"""The planner: which model answers a question at the least cost."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from . import _native
from ._native import Plan, Space, Toss
from .errors import MalformedError
from .given import wrong


@dataclass(frozen=True)
class Choice:
    """The cheapest model that answers a question.

    Attributes
    ----------
    model : str
        Its name.
    solver : str
        The solver that it uses.
    scheme : str or None
        The scheme of an integrator.
    method : str or None
        How the launches of a sample are chosen.
    tolerance : float or None
        The local error per step of an integrator.
    points : int or None
        The launches of a sample.
    expected_error : float
        Of what is wanted.
    expected_cost_ns : float
        In ns, on one core.
    plan : Plan or None
        The launches of a sample, for ``probability``. Functions that take a Plan take the choice itself, too.
    passed_over : tuple of (str, str)
        The models that were passed over, each with the reason.
    """

    model: str
    solver: str
    scheme: str | None
    method: str | None
    tolerance: float | None
    points: int | None
    expected_error: float
    expected_cost_ns: float
    plan: Plan | None
    passed_over: tuple[tuple[str, str], ...]


def plan_of(given: Any) -> Plan:
    """The plan that an argument is, or that a choice has."""
    if isinstance(given, Plan):
        return given
    valid = "a Plan, or a Choice of launches"
    if not isinstance(given, Choice):
        raise wrong("plan", given, valid)
    if given.plan is None:
        message = f"plan is a Choice of the model {given.model}, which tries no launches: expected {valid}"
        raise MalformedError(message, field="plan", valid=valid)
    return given.plan


def plan(
    want: Literal["outcome", "tilt", "attitude", "trace", "probability"],
    of: Toss | Space,
    accuracy: float,
    *,
    points: int | None = None,
    solver: str | None = None,
    scheme: str | None = None,
) -> Choice:
    """The cheapest model that answers a question accurately enough, without running it.

    Parameters
    ----------
    want : {"outcome", "tilt", "attitude", "trace", "probability"}
        What is wanted.
    of : Toss or Space
        Of which toss; for a probability, over which space.
    accuracy : float
        The largest acceptable error: of cos θ, of an attitude in rad, or of a probability.
    points : int, optional
        Number of times of a trace; 100 by default.
    solver, scheme : str, optional
        An integrator that is used as a cross-check, and its scheme.

    Returns
    -------
    Choice
        The model with its settings, its expected error and cost, and why others were passed over.

    Raises
    ------
    errors.InputError
        If the question is invalid or no model is accurate enough.
    """
    found = _native.plan(want, of, accuracy, points, solver, scheme)
    return Choice(**found | {"passed_over": tuple(found["passed_over"])})
