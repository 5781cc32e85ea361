"""joblib and multiprocessing: the answers of one process, in whichever way the others start."""

from multiprocessing import get_context

import numpy as np
import pytest

import unfair_toss as ut

joblib = pytest.importorskip("joblib")

pytestmark = pytest.mark.filterwarnings("ignore")

TOSSES = [ut.Toss((20.0, 0.0, z), speed="2.4m/s", body=body) for z in (5.0, 30.0) for body in ("us-quarter", ut.Body.named("racket"))]
TOSSES.append(ut.Toss(turn="38rev/s", psi=1.4, time=0.5, body="us-quarter"))
SPACE, PLAN = ut.Space.named("paper-fig4"), ut.Plan.random(100_000, seed=3)


def columns(launches):
    """Parts of columns, whole columns, and what is found of these here, by threads that a child that forks does not have."""
    parts = [tuple(column[start : start + 50_000] for column in launches) for start in (0, 50_000)]
    return parts, ut.outcome(*(column[:100_000] for column in launches), threads=2)


@pytest.mark.parametrize("method", ["spawn", "fork", "forkserver"])
def test_processes_of_multiprocessing_answer_as_this_one(method, launches):
    parts, whole = columns(launches)
    with get_context(method).Pool(2) as pool:
        assert (np.concatenate(pool.starmap(ut.outcome, parts)) == whole).all()
        found = pool.map(ut.toss, TOSSES)
        assert [one.cos_tilt for one in found] == [ut.toss(toss).cos_tilt for toss in TOSSES]
        (estimate,) = pool.starmap(ut.probability, [(SPACE, PLAN)])
    assert estimate == ut.probability(SPACE, PLAN)


@pytest.mark.parametrize("backend", ["loky", "multiprocessing", "threading"])
def test_workers_of_joblib_answer_as_this_process(backend, launches):
    parts, whole = columns(launches)
    run = joblib.Parallel(n_jobs=2, backend=backend)
    assert (np.concatenate(run(joblib.delayed(ut.outcome)(*part) for part in parts)) == whole).all()
    found = run(joblib.delayed(ut.toss)(toss, "quaternion") for toss in TOSSES)
    assert [one.cos_tilt for one in found] == [ut.toss(toss, "quaternion").cos_tilt for toss in TOSSES]
    with pytest.raises(ut.errors.OutOfRangeError) as caught:
        run(joblib.delayed(ut.outcome)(1.0, 1.0, 1.0, speed) for speed in (1.0, -1.0))
    assert caught.value.field == "speed [m/s]"
