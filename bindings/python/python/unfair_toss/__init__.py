"""The free flight of a tossed coin: proven outcomes, trajectories, solvers and probabilities.

All quantities are in SI units and angles in radians. The axes x, y, z of a body are fixed in it, z is the normal of
the side of heads; the laboratory's z axis points up, and heads is up where cos θ > 0, with θ the angle between both.
An attitude is the unit quaternion (w, x, y, z) from the body to the laboratory.
"""

from . import errors, given
from ._native import Body, Plan, Solver, Space, Tally, Toss, __version__, bodies, models, solvers, spaces
from .columns import Counts, attitude, cos_tilt, count, outcome
from .planner import Choice, plan
from .results import DenseOutput, Intervals, Inverse, Landing, Margins, PeopleSpread, Power, SameSideBias, Solution, Trace, Work
from .sampling import Estimate, estimate, merge, probability
from .single import intervals, inverse, margins, power, rate_of_precession, same_side_bias, toss, trace
from .solving import solve
from .studies import compare, convergence, limit, map, sample, sampling_errors, sensitivity, spread
from .tables import Comparison, Convergence, Limit, Map, MethodErrors, Sample, Sensitivity, Spread, SpreadAlone, Verification
from .tallies import tally
from .verification import verify

__all__ = [
    "Body",
    "Choice",
    "Comparison",
    "Convergence",
    "Counts",
    "DenseOutput",
    "Estimate",
    "Intervals",
    "Inverse",
    "Landing",
    "Limit",
    "Map",
    "Margins",
    "MethodErrors",
    "PeopleSpread",
    "Plan",
    "Power",
    "SameSideBias",
    "Sample",
    "Sensitivity",
    "Solution",
    "Solver",
    "Space",
    "Spread",
    "SpreadAlone",
    "Tally",
    "Toss",
    "Trace",
    "Verification",
    "Work",
    "__version__",
    "attitude",
    "bodies",
    "compare",
    "convergence",
    "cos_tilt",
    "count",
    "errors",
    "estimate",
    "intervals",
    "inverse",
    "limit",
    "map",
    "margins",
    "merge",
    "models",
    "outcome",
    "plan",
    "power",
    "probability",
    "rate_of_precession",
    "same_side_bias",
    "sample",
    "sampling_errors",
    "sensitivity",
    "solve",
    "solvers",
    "spaces",
    "spread",
    "tally",
    "toss",
    "trace",
    "verify",
]

given.suggest(globals())
