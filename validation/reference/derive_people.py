"""Derives crates/sampling/tests/people/answers.json, what counts of people say. Needs numpy 2 and scipy 1; no code of ours.

    cd crates/sampling/tests/people && python3 ../../../../validation/reference/derive_people.py *.csv > answers.json

The recipe is that of crates/sampling/src/people.rs. The likelihood is written by log-gamma functions, and scipy has the
quantiles, the maxima (Brent's method) and the roots.
"""
import csv
import json
import math
import sys

import numpy as np
from scipy import optimize, stats
from scipy.special import gammaln, xlog1py, xlogy

LEVEL, STUDENT = 0.95, 0.97
LOWEST, HIGHEST = -5.0, 16.0  # ln phi; None: all people are alike


def expit(e):
    return 1 / (1 + math.exp(-e))


def logit(s):
    return math.log(s / (1 - s)) if 0 < s < 1 else -36.0 if s <= 0 else 36.0


def clopper_pearson(k, n):
    a = (1 - LEVEL) / 2
    return [
        0.0 if k == 0 else float(stats.beta.ppf(a, k, n - k + 1)),
        1.0 if k == n else float(stats.beta.ppf(1 - a, k + 1, n - k)),
    ]


def log_likelihood(x, n, mu, ln_phi):
    if ln_phi is None:
        return float(np.sum(xlogy(x, mu) + xlog1py(n - x, -mu)))
    phi = math.exp(ln_phi)
    a, b = mu * phi, (1 - mu) * phi
    lg = gammaln
    return float(np.sum(lg(a + x) - lg(a) + lg(b + n - x) - lg(b) - lg(phi + n) + lg(phi)))


def hill(f, lo, hi):
    r = optimize.minimize_scalar(lambda q: -f(q), bounds=(lo, hi), method="bounded", options={"xatol": 1e-10})
    return -r.fun, r.x


def highest(f, lo, hi, cells):
    grid = np.linspace(lo, hi, cells + 1)
    values = [f(q) for q in grid]
    best, step = int(np.argmax(values)), (hi - lo) / cells
    at = grid[best]
    return max((values[best], at), hill(f, max(at - step, lo), min(at + step, hi)))


def over_phi(x, n, mu):
    apart = highest(lambda l: log_likelihood(x, n, mu, l), LOWEST, HIGHEST, 21)[0]
    return max(apart, log_likelihood(x, n, mu, None))


def cut(k):
    t = stats.t.ppf((1 + STUDENT) / 2, k - 1)
    return k * math.log1p(t * t / (k - 1))


def fit(x, n, c):
    same, tosses = float(x.sum()), float(n.sum())

    def f(e):
        return over_phi(x, n, expit(e))

    if same <= 0:
        top, mode = 0.0, -36.0
    elif same >= tosses:
        top, mode = 0.0, 36.0
    else:
        starts = sorted([logit(same / tosses), logit(float((x / n).mean()))])
        hills = [hill(f, q - 0.05, q + 0.05) for q in starts]
        top, mode = max([highest(f, starts[0] - 0.5, starts[1] + 0.5, 24), *hills])
    ends = []
    for side in (-1, 1):
        inner, step = mode, 0.01
        while True:
            outer = inner + side * step
            if abs(outer) > 36.5:
                ends.append(0.0 if side < 0 else 1.0)
                break
            if 2 * (top - f(outer)) > c:
                ends.append(expit(optimize.brentq(lambda q: 2 * (top - f(q)) - c, inner, outer, xtol=1e-13)))
                break
            inner, step = outer, 2 * step
    return 0.0 if same <= 0 else 1.0 if same >= tosses else expit(mode), *ends


def capped(x, n):
    m = np.minimum(n, 2 * np.median(n))
    return x * m / n, m


def mean_over_people(x, n):
    pooled, k = clopper_pearson(int(x.sum()), int(n.sum())), len(n)
    if k == 1:
        return float(x[0] / n[0]), pooled
    y, m = capped(x, n)
    effective = (k + max(2.0, float(m.sum() ** 2 / (m * m).sum()))) / 2
    mean, lo, hi = fit(x, n, cut(k))
    _, low, high = fit(y, m, cut(effective))
    return mean, [min(pooled[0], lo, low), max(pooled[1], hi, high)]


def homogeneity(x, n):
    same, tosses, k = float(x.sum()), float(n.sum()), len(n)
    p = same / tosses
    x2 = float(np.sum((x - n * p) ** 2 / (n * p * (1 - p))))
    if min(same, tosses - same) < 2:
        return x2, 1.0
    mean = (k - 1) * tosses / (tosses - 1)
    v, w = (tosses - 2) / (tosses - 1), (tosses * (1 / same + 1 / (tosses - same)) - 4) / (tosses - 2)
    v2 = (k - 1) * (tosses - k) / (tosses - 1)
    w2 = (tosses * float(np.sum(1 / n)) - k * k) / (tosses - 2)
    variance = 2 * tosses / (tosses - 3) * (v - w) * (v2 - w2) + tosses * tosses / (tosses - 1) * w * w2
    return x2, float(stats.chi2.sf(x2 * 2 * mean / variance, 2 * mean * mean / variance)) if variance > 0 else 1.0


def over_mu(x, n, ln_phi):
    same, tosses = x.sum(), n.sum()
    if ln_phi is None:
        return log_likelihood(x, n, same / tosses, None), same / tosses
    share = float((x / n).mean())
    a = math.log((same + 0.25) / (tosses - same + 0.25))
    b = math.log((share + 1e-3) / (1 - share + 1e-3))
    value, e = hill(lambda e: log_likelihood(x, n, expit(e), ln_phi), min(a, b) - 1.5, max(a, b) + 1.5)
    return value, expit(e)


def deviation_at(x, n, l):
    mu = over_mu(x, n, l)[1]
    return math.sqrt(mu * (1 - mu) / (1 + math.exp(l)))


def deviation(x, n):
    k = len(n)
    below, above = (k * (z - 1 - math.log(z)) for z in (stats.chi2.ppf(q, k - 1) / k for q in (0.975, 0.025)))
    best, at = highest(lambda l: over_mu(x, n, l)[0], LOWEST, HIGHEST, 42)
    alike = over_mu(x, n, None)[0]
    top = max(alike, best)
    at = None if alike >= best else at

    def drop(l):
        return 2 * (top - over_mu(x, n, l)[0])

    def end(start, stop, c):
        step = 0.25 if stop > start else -0.25
        inner = start
        while inner != stop:
            outer = min(inner + step, stop) if step > 0 else max(inner + step, stop)
            if drop(outer) > c:
                return optimize.brentq(lambda q: drop(q) - c, inner, outer, xtol=1e-10)
            inner = outer
        return None

    low = 0.0
    if 2 * (top - alike) > below:
        l = end(at, HIGHEST, below)
        low = deviation_at(x, n, HIGHEST if l is None else l)
    l = end(HIGHEST if at is None else at, LOWEST, above)
    up = 0.5 if l is None else deviation_at(x, n, l)
    sd = 0.0 if at is None else deviation_at(x, n, at) * math.sqrt(k / (k - 1))
    return min(max(sd, low), up), low, up


def spread(x, n):
    if x.sum() in (0, n.sum()):
        return None
    sd, low, up = deviation(x, n)
    _, other_low, other_up = deviation(*capped(x, n))
    chi2, p_value = homogeneity(x, n)
    return {"sd": sd, "interval": [min(low, other_low), max(up, other_up)], "chi2": chi2, "p_value": p_value}


def next_person(x, n):
    if len(n) < 3:
        return None
    all_same, none_same = bool((x == n).any()), bool((x == 0).any())
    if x.sum() == n.sum():
        x = x - 0.5 / len(n)
    if x.sum() == 0:
        x = x + 0.5 / len(n)
    grid = np.arange(-3.0, HIGHEST + 0.01, 0.5)
    values, mu = np.array([over_mu(x, n, l) for l in grid]).T
    between = mu * (1 - mu) / (1 + np.exp(grid))
    within = np.maximum(mu * (1 - mu) - between, 1e-12)
    error = 1 / np.array([np.sum(1 / (b + w / n)) for b, w in zip(between, within)])
    rho, i = 1 / np.sqrt(1 + np.exp(grid)), np.arange(len(grid))
    prior = rho[np.maximum(i - 1, 0)] - rho[np.minimum(i + 1, len(grid) - 1)]
    weight = np.exp(values - values.max()) * np.sqrt(error) * prior
    weight /= weight.sum()
    variance = np.minimum(between + error, 0.98 * mu * (1 - mu))
    phi = mu * (1 - mu) / variance - 1

    def cdf(q):
        return float(np.sum(weight * stats.beta.cdf(q, mu * phi, (1 - mu) * phi)))

    lo, hi = (optimize.brentq(lambda q: cdf(q) - p, 0, 1, xtol=1e-12) for p in (0.025, 0.975))
    return [0.0 if none_same and lo < 0.01 else lo, 1.0 if all_same and hi > 0.99 else hi]


def psi(p):
    return math.degrees(math.atan2(1.0, math.sqrt(math.sin(math.pi * (max(p, 0.5) - 0.5)))))


def people_of(path):
    people = {}
    for number, row in enumerate(csv.DictReader(open(path, newline=""))):
        name = row.get("person") or number
        same, tosses = people.get(name, (0, 0))
        people[name] = (same + int(row["same"]), tosses + int(row["tosses"]))
    present = [counts for counts in people.values() if counts[1] > 0]
    return np.array(present, float).T


def answers(x, n):
    mean, interval = mean_over_people(x, n)
    several = len(n) > 1
    lo, hi = interval
    return {
        "same": int(x.sum()),
        "tosses": int(n.sum()),
        "people": len(n),
        "these_flips": clopper_pearson(int(x.sum()), int(n.sum())),
        "mean_over_people": mean,
        "interval": interval,
        "spread": spread(x, n) if several else None,
        "next_person": next_person(x, n) if several else None,
        "psi": None if hi < 0.5 else psi(mean),
        "psi_interval": None if hi < 0.5 else [0.0 if hi >= 1 else psi(hi), psi(lo)],
    }


print(json.dumps({path: answers(*people_of(path)) for path in sys.argv[1:]}, indent=1))
