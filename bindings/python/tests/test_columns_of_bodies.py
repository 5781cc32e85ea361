"""Columns in which the body, or the turn and ψ of a coin, vary: each launch lands as it does by itself."""

import numpy as np
import pandas
import pytest
import xarray

import unfair_toss as ut
from unfair_toss import errors

NAMES = ["us-quarter", "paper", "euro-2c", "us-quarter", "disc"]
RACKET = ut.Body.named("racket")
MIXED = ["us-quarter", "racket", RACKET, ut.Body.from_moments((1.0, 1.5, 2.0)), "paper", "racket"]
MOMENTS = np.array([(1.0, 1.5), (2e-7, 4e-7), (5e-7, 2.5e-7), (3.0, 1e-3)])
BODIES = np.array([(1.0, 1.5, 2.0), (1.0, 1.0, 0.5), (3.0, 2.0, 1.5), (1.0, 1.5, 2.0)])
FACES = {"heads": 1, "tails": -1, "undecided": 0}


def landings(bodies, **settings):
    """Of each body the landings of some launches by themselves, and the same launches as columns."""
    x, v = np.linspace(-30.0, 30.0, 7), np.linspace(1.0, 4.0, 7)
    single = [[ut.toss(ut.Toss((a, 2, 9), speed=b, body=body, **settings)) for a, b in zip(x, v, strict=True)] for body in bodies]
    return single, (x, 2, 9, v)


def assert_lands(single, columns, settings):
    """Proven outcomes agree exactly, on any threads; the rest to the error of the kernels."""
    for threads in (1, 3):
        faces = ut.outcome(*columns, threads=threads, **settings)
        assert faces.tolist() == [[FACES[one.outcome] for one in row] for row in single]
        found = ut.cos_tilt(*columns, threads=threads, **settings)
        assert np.abs(found - [[one.cos_tilt for one in row] for row in single]).max() < 1.2e-15
        turned, expected = ut.attitude(*columns, threads=threads, **settings), np.array([[one.attitude for one in row] for row in single])
        assert np.abs(turned * np.sign((turned * expected).sum(-1, keepdims=True)) - expected).max() < 1.5e-15
        counts = ut.count(*columns, threads=threads, **settings)
        assert counts.certified and (counts.heads, counts.tails) == ((faces == 1).sum(), (faces == -1).sum())
        assert sum(counts.proven_by.values()) == faces.size


@pytest.mark.parametrize("settings", [{}, {"gravity": 1.62, "drop": 0.7, "tilt": 0.5}, {"attitude": (1, 2, 3, 4.0)}], ids=str)
@pytest.mark.parametrize("bodies", [NAMES, MIXED])
def test_a_column_of_bodies_lands_as_each_by_itself(bodies, settings):
    single, columns = landings(bodies, **settings)
    assert_lands(single, columns, settings | {"body": np.array(bodies, dtype=object)[:, None]})


@pytest.mark.parametrize("moments", [MOMENTS, BODIES, np.array([(1.0, 1.0, 0.5), (2.0, 2.0, 3.9)])], ids=["coins", "bodies", "coins by three"])
def test_columns_of_moments_land_as_each_by_itself(moments):
    single, columns = landings([ut.Body.from_moments(row) for row in moments])
    assert_lands(single, columns, {"moments": moments[:, None]})


def test_many_bodies_are_the_same_in_any_order_and_on_any_threads(launches):
    random = np.random.default_rng(2)
    for bodies, number in ((NAMES, 40_000), (MIXED, 3000)):
        columns = [column[:number] for column in launches]
        codes = random.integers(len(bodies), size=number)
        body = np.array(bodies, dtype=object)[codes]
        for function in (ut.outcome, ut.cos_tilt, ut.attitude) if bodies is NAMES else (ut.outcome,):
            found = function(*columns, body=body, threads=1)
            assert (function(*columns, body=body, threads=3) == found).all()
            assert (function(*(column[::-1] for column in columns), body=body[::-1]) == found[::-1]).all()
        faces = ut.outcome(*columns, body=body)
        for number, one in enumerate(bodies):
            of = codes == number
            assert (faces[of] == ut.outcome(*(column[of] for column in columns), body=one)).all()


def test_moments_and_solvers_of_columns():
    single, columns = landings(["us-quarter", "paper"])
    for solver in ("exact", "quaternion"):
        found = ut.cos_tilt(*columns, body=np.array([["us-quarter"], ["paper"]]), solver=solver)
        one = [ut.cos_tilt(*columns, body=name, solver=solver) for name in ("us-quarter", "paper")]
        assert (found == one).all()
    assert ut.outcome(*columns, moments=(2, 3)).tolist() == ut.outcome(*columns, body=ut.Body.from_moments((2, 3))).tolist()
    assert ut.outcome(1, 2, 3, 4, moments=("200g*cm2", "300g*cm2")) == ut.outcome(1, 2, 3, 4, moments=(2, 3))


TURN, PSI = np.array([0.0, 20.0, 238.7, 150.0]), np.array([0.3, 1.0, 1.417, np.pi])


@pytest.mark.parametrize("body", ["us-quarter", ["us-quarter", "paper", "disc", "euro-2c"]])
def test_turn_and_psi_are_columns_with_the_rates_of_single_tosses(body):
    bodies = [body] * 4 if isinstance(body, str) else body
    rates = [ut.rate_of_precession(*one) for one in zip(TURN, PSI, bodies, strict=True)]
    single = [[ut.toss(ut.Toss(rate, speed=2.4, drop=0.2, body=one))] for rate, one in zip(rates, bodies, strict=True)]
    for one, turn, psi, (landing,) in zip(bodies, TURN, PSI, single, strict=True):
        toss = ut.Toss(turn=turn, psi=psi, speed=2.4, drop=0.2, body=one)
        assert ut.toss(toss).cos_tilt == landing.cos_tilt and eval(repr(toss), vars(ut)) == toss
    settings = {"turn": TURN[:, None], "psi": PSI[:, None], "drop": 0.2, "speed": 2.4}
    assert_lands(single, (), settings | {"body": body if isinstance(body, str) else np.array(body)[:, None]})
    found = ut.cos_tilt(turn="38rev/s", psi="81.2deg", speed="2.4m/s", body="us-quarter")
    rate = ut.rate_of_precession("38rev/s", "81.2deg", "us-quarter")
    assert found == ut.cos_tilt(*rate, 2.4, body="us-quarter")
    column = np.linspace(0.0, 3.0, 2001)
    single = np.array([ut.rate_of_precession(60.0, psi, "us-quarter") for psi in column])
    moments = np.stack([np.linspace(1.0, 3.0, 2001), np.linspace(0.1, 2.0, 2001) ** 2], axis=-1) * 1e-7
    moments[:3] = (1.0, 2.0000000000000004), (1e-9, 2e-9), (3e-300, 1e-305)
    rates = [ut.rate_of_precession(60.0, psi, ut.Body.from_moments(own)) for psi, own in zip(column, moments, strict=True)]
    found = ut.cos_tilt(turn=60.0, psi=column, time=0.5, moments=moments)
    assert (found == ut.cos_tilt(*np.transpose(rates), time=0.5, moments=moments)).all()
    for solver in (None, "exact"):
        found = ut.outcome(turn=60.0, psi=column, speed=3.0, body="us-quarter", solver=solver)
        assert (found == ut.outcome(*single.T, 3.0, body="us-quarter", solver=solver)).all()


def test_labels_are_kept_and_combined():
    frame = pandas.DataFrame({"body": ["paper", "us-quarter"], "turn": [40.0, 90.0], "psi": [1.0, 1.2]}, index=["b", "a"])
    found = ut.outcome(turn=frame.turn, psi=frame.psi, speed=3.0, body=frame.body)
    assert found["a"] == ut.outcome(turn=90.0, psi=1.2, speed=3.0, body="us-quarter")
    frame = frame.assign(i1=[1.0, 2.0], i3=[1.5, 1.0])
    found = ut.cos_tilt(1.0, 2.0, 3.0, 4.0, moments=frame[["i1", "i3"]])
    assert found["a"] == ut.cos_tilt(1.0, 2.0, 3.0, 4.0, moments=[[2.0, 1.0]])[0]
    with pytest.raises(errors.MalformedError, match="has other labels") as caught:
        ut.outcome(frame.turn, 1, 1, 1, body=frame.body[::-1])
    assert caught.value.field == "body"
    names = xarray.DataArray(["paper", "disc"], {"coin": ["p", "d"]})
    speed = xarray.DataArray([1.0, 2.0, 3.0], dims="throw")
    found = ut.cos_tilt(9.0, 2.0, 3.0, speed, body=names)
    assert found.dims == ("throw", "coin") and found.sel(coin="d")[1] == ut.cos_tilt(9.0, 2.0, 3.0, 2.0, body=np.array(["disc"]))[0]
    moments = xarray.DataArray([[1.0, 1.5], [1.0, 2.0]], dims=("coin", "axis"))
    assert ut.cos_tilt(9.0, 2.0, 3.0, speed, moments=moments).dims == ("throw", "coin")


@pytest.mark.parametrize("function", [ut.outcome, ut.cos_tilt, ut.attitude, ut.count])
def test_what_is_wrong_is_named_with_its_place(function):
    def refused(kind, field, index, **settings):
        with pytest.raises(kind) as caught:
            function(**{"speed": 2.0} | settings)
        assert (caught.value.field, caught.value.index) == (field, index)

    rates = {name: np.ones(1000) for name in ("rate_x", "rate_y", "rate_z")}
    psi, moments = np.full(1000, 0.5), np.full((1000, 2), 1.0)
    psi[700] = 4.0
    refused(errors.OutOfRangeError, "psi [rad]", 700, turn=1.0, psi=psi)
    refused(errors.OutOfRangeError, "turn [rad/s]", 600, turn=np.where(np.arange(1000) < 600, 1.0, -1.0), psi=psi)
    refused(errors.OutOfRangeError, "speed [m/s]", 300, turn=1.0, psi=psi, speed=np.where(np.arange(1000) < 300, 1.0, -1.0))
    refused(errors.OutsideModelError, "turn", 1, turn=1.0, psi=0.5, body=["paper", "racket"])
    refused(errors.MissingError, "psi", None, turn=1.0)
    refused(errors.MissingError, "rate_z", None, rate_x=1.0, rate_y=1.0)
    refused(errors.MalformedError, "rate_y", None, rate_y=1.0, turn=1.0, psi=1.0)
    moments[800, 1] = 2.1
    refused(errors.OutOfRangeError, "moments", 800, moments=moments, **rates)
    moments[500, 0] = np.nan
    refused(errors.OutOfRangeError, "moments", 500, moments=moments, **rates)
    three = np.tile([1.0, 1.2, 1.3], (100, 1))
    three[[40, 60]] = [[1.0, 2.0, 4.0], [0.5, 2.0, 4.0]]
    few = {name: column[:100] for name, column in rates.items()}
    refused(errors.NoBodyError, "moments", 40, moments=three, **few)
    refused(errors.UnknownNameError, "body", 2, body=["paper", "paper", "groat"], rate_x=1.0, rate_y=1.0, rate_z=1.0)
    refused(errors.MalformedError, "body", 1, body=["paper", 3.0], rate_x=1.0, rate_y=1.0, rate_z=1.0)
    refused(errors.MalformedError, "moments", None, moments=[1.0], rate_x=1.0, rate_y=1.0, rate_z=1.0)
    refused(errors.MalformedError, "moments", None, moments=(1.0, 1.0), body="paper", rate_x=1.0, rate_y=1.0, rate_z=1.0)
    # Those of one body are solved after those of another; the first launch in the columns is named.
    bad = np.ones(2000)
    bad[[900, 1500]] = np.nan
    body = np.array(["racket", "disc"], dtype=object)[(np.arange(2000) < 1000).astype(int)]
    refused(errors.OutOfRangeError, "rate_x [rad/s]", 900, rate_x=bad, rate_y=1.0, rate_z=1.0, speed=1e-3, body=body)
    refused(errors.OutOfRangeError, "rate_x [rad/s]", 499, rate_x=bad[::-1], rate_y=1.0, rate_z=1.0, speed=1e-3, body=body)
