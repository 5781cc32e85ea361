# %% [markdown]
# # Choosing a solver by evidence
#
# An integrator's tolerance bounds the error of a step, not of a flight. What a flight's error is has to be measured, against
# something that is right. Here SciPy's integrators fly the problems of the verification suite of this project, beside its
# own, and are judged by the same rule: an error of cos θ of 100 × tolerance × (1 + φ) is allowed at the phase φ. (Rounding is
# allowed, too, but matters only in longer flights or at finer tolerances.)

# %%
import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import solve_ivp

import unfair_toss as ut

# The suite's flights, with what each of them stresses.
folder = Path(__file__).resolve().parents[3] / "crates" / "verify" / "data"
problems = tomllib.loads((folder / "problems.toml").read_text(encoding="utf-8"))["problem"]


def toss_of(data):
    """The toss in a file."""
    body = data["coin"] if "coin" in data else ut.Body.from_moments(data["body"]["moments"])
    return ut.Toss(body=body, **data["launch"])


tosses = {problem["name"]: toss_of(problem["toss"]) for problem in problems if "toss" in problem}
for problem in problems:
    print(f"{problem['name']:10} {problem['stresses']}")

# %% [markdown]
# ## The equations, for SciPy
#
# The attitude Q from the body to the laboratory obeys Q' = ½ Q ⊗ (0, ω), and ω Euler's equations of a coin.


# %%
def slope(_, state, k):
    w, x, y, z, a, b, c = state
    turn = [-(x * a + y * b + z * c), w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a]
    return [*(0.5 * part for part in turn), (1 - k) * b * c, (k - 1) * a * c, 0.0]


def by_scipy(toss, method, tolerance):
    """The attitude at landing, and the evaluations of the slope."""
    start = [*toss.attitude, *toss.rate]
    ends = solve_ivp(
        slope, (0.0, toss.flight_time), start, method, args=(toss.body.inertia_ratio,), rtol=tolerance, atol=tolerance
    )
    return ends.y[:4, -1] / np.linalg.norm(ends.y[:4, -1]), ends.nfev


def by_ours(toss, scheme, tolerance):
    landing = ut.toss(toss, ut.Solver("quaternion", scheme=scheme, rtol=tolerance))
    return landing.attitude, landing.work.rhs_calls


def angle(one, two):
    """The angle between two attitudes in rad; it does not lose the digits of a small one."""
    return 4.0 * np.arcsin(min(np.linalg.norm(one - two), np.linalg.norm(one + two)) / 2.0)


# %% [markdown]
# ## Work against error
#
# The exact motion is right to 4.5e-16 rad, so that it can judge all of them.

# %%
solvers = {
    "SciPy RK45": lambda toss, tolerance: by_scipy(toss, "RK45", tolerance),
    "SciPy DOP853": lambda toss, tolerance: by_scipy(toss, "DOP853", tolerance),
    "SciPy LSODA": lambda toss, tolerance: by_scipy(toss, "LSODA", tolerance),
    "ours, dop853": lambda toss, tolerance: by_ours(toss, "dop853", tolerance),
    "ours, taylor": lambda toss, tolerance: by_ours(toss, "taylor", tolerance),
}
tolerances = 10.0 ** -np.arange(3, 13, 3)
figure, panels = plt.subplots(2, 2, figsize=(9, 7), sharey=True, layout="constrained")
verdicts = {name: 0 for name in solvers}
for panel, name in zip(panels.flat, ("cheated", "keller", "tilted", "dropped"), strict=True):
    toss = tosses[name]
    exact = ut.toss(toss)
    k, (a, b, c) = toss.body.inertia_ratio, toss.rate
    phase = np.sqrt(a * a + b * b + (k * c) ** 2) * toss.flight_time
    for solver, solve in solvers.items():
        found = [solve(toss, tolerance) for tolerance in tolerances]
        errors = np.array([angle(attitude, exact.attitude) for attitude, _ in found])
        panel.loglog([calls for _, calls in found], np.maximum(errors, 1e-16), ".-", label=solver)
        w, x, y, z = np.array([attitude for attitude, _ in found]).T
        wrong = np.abs(w * w + z * z - x * x - y * y - exact.cos_tilt)
        verdicts[solver] += int((wrong > 100 * tolerances * (1 + phase)).sum())
    panel.xaxis.set_minor_formatter("")
    panel.set(title=f"{name}, φ = {phase:.0f} rad", xlabel="evaluations of the slope", ylabel="attitude error / rad")
panels[0, 0].legend(fontsize="small")

# %% [markdown]
# How often each of them was further off than the rule allows, of 16 flights:

# %%
for solver, above in verdicts.items():
    print(f"{solver:14} {above:2} of {4 * len(tolerances)}")
assert verdicts["ours, dop853"] == verdicts["ours, taylor"] == 0

# %% [markdown]
# ## A tolerance is no error
#
# The long problem turns 30 times. Each step keeps its tolerance, and the errors of the phase add up: what SciPy reports as
# success is off by some hundred times the tolerance. A solver of this project states an error estimate for the flight,
# which has to be above the truth.

# %%
toss = tosses["long"]
exact = ut.toss(toss)
rows = []
for tolerance in tolerances:
    attitude, _ = by_scipy(toss, "RK45", tolerance)
    ours = ut.toss(toss, ut.Solver("quaternion", rtol=tolerance))
    rows.append((angle(attitude, exact.attitude), abs(ours.cos_tilt - exact.cos_tilt), ours.error_estimate))
scipys, true, claimed = np.array(rows).T
figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
axes.loglog(tolerances, scipys, "o-", label="SciPy RK45: attitude error / rad")
axes.loglog(tolerances, np.maximum(true, 1e-16), "s-", label="ours, dop853: error of cos θ")
axes.loglog(tolerances, claimed, "s--", color="C1", alpha=0.5, label="ours: its estimate")
axes.loglog(tolerances, tolerances, color="grey", label="the tolerance")
axes.set(xlabel="tolerance", ylabel="error", title="30 turns in 100 s")
axes.legend()
assert (claimed >= true).all()

# %% [markdown]
# ## The choice
#
# `plan` knows measured errors and costs, and takes the cheapest model for an accuracy. For a free coin that is the exact
# motion; if it has to be an integrator, it says which scheme and tolerance.

# %%
for accuracy in (1e-3, 1e-6, 1e-9):
    free = ut.plan("attitude", tosses["tilted"], accuracy)
    integrated = ut.plan("attitude", tosses["tilted"], accuracy, solver="quaternion")
    print(
        f"{accuracy:.0e} rad: {free.solver} in {free.expected_cost_ns:.0f} ns, or {integrated.scheme} with a tolerance of "
        f"{integrated.tolerance:.1e} in {integrated.expected_cost_ns:.0f} ns"
    )

# %% [markdown]
# To put an integrator under the whole suite, some sixty checks, make it a program that reads launches and writes attitudes
# (`docs/your-solver.md`): `cargo xtask verify --command "python3 crates/contestants/python/dop853.py"` judges SciPy's.
