"""Single tosses: the same numbers as the command line, and results that travel."""

import copy
import pickle

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import unfair_toss as ut
from unfair_toss import errors

CHEATED = ut.Toss((1.0, 1.0, 2.5), speed=3.0)
BOOK = ut.Body.from_moments((1.0, 2.0, 2.8))
TILTED = ut.Body.from_tensor([[2.0, 0.1, 0.2], [0.1, 2.5, 0.3], [0.2, 0.3, 3.0]])


@pytest.mark.parametrize("solver", ["exact", "gamma", "euler", "quaternion"])
@pytest.mark.parametrize(
    ("arguments", "toss"),
    [
        (["--rate", "1,1,2.5", "--speed", "3"], CHEATED),
        (
            ["--rate", "12,-7,20", "--speed", "4", "--tilt", "1", "--drop", "0.5", "--gravity", "1.62", "--coin", "disc"],
            ut.Toss((12, -7, 20), speed=4, tilt=1, drop=0.5, gravity=1.62, body="disc"),
        ),
        (
            ["--rate", "9,4,3", "--time", "1.5", "--cylinder", "0.00567,0.01213,0.00175"],
            ut.Toss((9, 4, 3), time=1.5, body=ut.Body.cylinder(0.00567, 0.01213, 0.00175)),
        ),
    ],
)
def test_a_toss_has_the_bits_of_the_command_line(ask, arguments, toss, solver):
    expected = ask("toss", *arguments, "--solver", solver)
    found = ut.toss(toss, solver)
    assert (found.cos_tilt, found.outcome) == (expected["cos_tilt"], expected["outcome"])
    assert (found.certified, found.flight_time) == (expected["certified"], expected["flight_time"])
    assert (found.attitude.tolist(), found.rate.tolist()) == (expected["attitude"], expected["rate"])
    assert (found.norm_error, found.scheme) == (expected["norm_error"], expected["scheme"])
    assert vars(found.work) == expected["work"]
    margins = ut.margins(toss)
    assert {name: expected["margin"][name] for name in ("time", "speed", "gravity", "tilt")} == {
        name: getattr(margins, name) for name in ("time", "speed", "gravity", "tilt")
    }
    assert (list(margins.rate), list(margins.rate_range)) == (
        expected["margin"]["rate"],
        expected["margin"]["rate_range"],
    )


def test_a_trace_has_the_bits_of_the_command_line(ask):
    for solver in ("exact", "quaternion"):
        points = ask("trace", "--rate", "9,4,3", "--time", "1.5", "--points", "31", "--solver", solver)["points"]
        trace = ut.trace(ut.Toss((9, 4, 3), time=1.5), 31, solver=solver)
        assert trace.t.tolist() == [point["time"] for point in points]
        assert trace.attitude.tolist() == [point["attitude"] for point in points]
        assert trace.angles.tolist() == [[point["alpha"], point["beta"], point["gamma"]] for point in points]
        assert trace.normal.tolist() == [point["normal"] for point in points]
        assert trace.face.tolist() == [point["face"] for point in points]
        assert trace.cos_tilt.tolist() == [point["cos_tilt"] for point in points]
    assert ut.trace(CHEATED, dt=0.1).t[-1] == CHEATED.flight_time
    for arguments in ({"points": 3, "dt": 0.1}, {"points": 1}, {"dt": 0.0}):
        with pytest.raises(errors.InputError):
            ut.trace(CHEATED, **arguments)


def test_intervals_inverse_and_plan_have_the_bits_of_the_command_line(ask):
    expected = ask("intervals", "--rate", "20,5,3", "--speed", "3:9", "--drop", "1.3")
    found = ut.intervals(ut.Toss((20, 5, 3), speed=9, drop=1.3), 3)
    assert (found.heads.tolist(), found.probability) == (expected["heads"], expected["probability"])
    expected = ask("inverse", "--probability", "0.8", "--coin", "us-quarter")
    assert {name: expected[name] for name in vars(ut.inverse(0.8))} == vars(ut.inverse(0.8, "us-quarter"))
    expected = ask("plan", "--want", "attitude", "--accuracy", "1e-6", "--rate", "1,1,2.5", "--speed", "3", "--solver", "euler")
    found = ut.plan("attitude", CHEATED, 1e-6, solver="euler")
    for name in ("model", "solver", "scheme", "tolerance", "points", "expected_error", "expected_cost_ns"):
        assert getattr(found, name) == expected[name], name
    assert [{"model": model, "why": why} for model, why in found.passed_over] == expected["passed_over"]
    expected = ask("plan", "--want", "probability", "--accuracy", "1e-4", "--space", "paper-fig4")
    found = ut.plan("probability", ut.Space.named("paper-fig4"), 1e-4)
    assert (found.method, found.points) == (expected["method"], expected["points"])


def test_a_rate_of_precession_has_the_bits_of_the_command_line(ask):
    expected = ask("toss", "--coin", "us-quarter", "--turn", "238.75", "--psi", "1.4", "--speed", "2.4")
    rate = ut.rate_of_precession(238.75, 1.4, "us-quarter")
    landing = ut.toss(ut.Toss(rate, speed=2.4, body="us-quarter"))
    assert (landing.cos_tilt, landing.attitude.tolist()) == (expected["cos_tilt"], expected["attitude"])
    with pytest.raises(errors.OutOfRangeError) as refused:
        ut.rate_of_precession(238.75, 4.0)
    assert refused.value.field == "psi [rad]"


def test_the_same_side_bias_has_the_bits_of_the_command_line(ask, tmp_path):
    one, people = ut.same_side_bias(178078, 350757), tmp_path / "people.csv"
    assert [round(float(np.degrees(angle)), 2) for angle in (one.cone_angle, *one.cone_angle_interval)] == [81.16, 80.27, 82.16]
    same_side, tosses = np.array([56, 61, 20], dtype=np.uint16), [100, 100, 100]
    people.write_text("same,tosses\n" + "".join(f"{same},100\n" for same in same_side))
    several, half = ut.same_side_bias(same_side, tosses, "us-quarter"), ut.same_side_bias([45], (100,))
    for found, coin, counts in [(one, "paper", "178078/350757"), (several, "us-quarter", people), (half, "paper", "45/100")]:
        expected = ask("inverse", "--counts", str(counts), "--coin", coin)
        assert (found.same_side, found.tosses) == (expected["same"], expected["tosses"])
        for person, angle, ends in zip(expected["people"], found.each_cone_angle, found.each_cone_angle_interval):
            expected_angles = (person["cone_angle"], person["cone_angle_interval"])
            assert (angle, ends.tolist()) == expected_angles or (np.isnan([angle, *ends]).all() and expected_angles == (None, None))
        names = ("probability", "these_flips", "mean_over_people", "interval", "interval_kind", "next_person")
        for name in (*names, "inertia_ratio", "rate_ratio", "cone_angle", "cone_angle_interval"):
            value = getattr(found, name)
            assert (list(value) if isinstance(value, tuple) else value) == expected[name], name
        spread = None if found.spread is None else {**vars(found.spread), "interval": list(found.spread.interval)}
        assert spread == expected["spread"]
    assert several.interval_kind == "beta-binomial 95 % of 3 people" and np.isnan(several.each_cone_angle).tolist() == [False, False, True]
    assert one.each_cone_angle.tolist() == [one.cone_angle] and half.rate_ratio is None
    absent = ut.same_side_bias([56, 0, 61, 20], [100, 0, 100, 100])
    assert absent.interval == several.interval and np.isnan(absent.each_cone_angle).tolist() == [False, True, False, True]
    below = ut.same_side_bias(10, 100)
    assert (below.cone_angle, below.cone_angle_interval, below.rate_ratio) == (None, None, None)


@pytest.mark.parametrize(
    ("counts", "kind", "field", "index", "valid"),
    [
        ((3, 2), errors.OutOfRangeError, "same_side", None, "0 to the number of tosses"),
        (([1, 3], [2, 2]), errors.OutOfRangeError, "same_side", 1, "0 to the number of tosses"),
        (([0, 0], [0, 0]), errors.OutOfRangeError, "tosses", None, "at least 1"),
        (([1, 1], [2, 0]), errors.OutOfRangeError, "same_side", 1, "0 to the number of tosses"),
        (([], []), errors.MalformedError, "same_side", None, "the count of at least 1 person"),
        (([1, -1], [2, 2]), errors.MalformedError, "same_side", 1, "a whole number from 0 to 2^64 - 1"),
        ((1, [2.5]), errors.MalformedError, "tosses", 0, "a whole number from 0 to 2^64 - 1"),
        (([1, 2], [2]), errors.MalformedError, "tosses", None, "as many as of same_side"),
        (([1, 1], [10**12, 10**12]), errors.OutOfRangeError, "tosses", None, "at most 1e12 for several people together"),
        (([2**63, 2**63], [2**63, 2**63]), errors.MalformedError, "tosses", None, "fewer for all people together"),
    ],
)
def test_counts_that_cannot_be_are_refused(counts, kind, field, index, valid):
    with pytest.raises(kind) as caught:
        ut.same_side_bias(*counts)
    assert (caught.value.field, caught.value.index, caught.value.valid) == (field, index, valid)


def test_a_speed_is_in_an_interval_of_heads_if_it_lands_heads():
    fast = ut.Toss((20, 5, 3), speed=9, drop=1.3)
    heads = ut.intervals(fast, 3).heads
    for speed in np.linspace(3.0, 9.0, 200):
        inside = bool(((heads[:, 0] <= speed) & (speed <= heads[:, 1])).any())
        assert inside == (ut.toss(ut.Toss((20, 5, 3), speed=speed, drop=1.3)).outcome == "heads")
    with pytest.raises(errors.OutOfRangeError, match="slowest"):
        ut.intervals(fast, 9.0)
    with pytest.raises(errors.MalformedError, match="given by a time"):
        ut.intervals(ut.Toss((20, 5, 3), time=1))


def test_a_margin_is_where_the_outcome_flips():
    margins = ut.margins(CHEATED)
    for relative, outcome in [(1 - 1e-9, "heads"), (1 + 1e-9, "tails")]:
        assert ut.toss(ut.Toss((1, 1, 2.5), speed=3 + relative * margins.speed)).outcome == outcome
        assert ut.toss(ut.Toss((1 + relative * margins.rate[0], 1, 2.5), speed=3)).outcome == outcome


@pytest.mark.parametrize("body", [BOOK, TILTED])
def test_any_body_has_proven_outcomes(body):
    for time in np.linspace(0.1, 9.0, 30):
        landing = ut.toss(ut.Toss((0.3, 5.0, 0.1), time=time, body=body))
        assert landing.certified and landing.outcome == ("heads" if landing.cos_tilt > 0 else "tails")
        turned = Rotation.from_quat(landing.attitude, scalar_first=True).as_matrix()
        assert abs(turned[2, 2] - landing.cos_tilt) < 1e-14
    tensor = np.array(body.tensor)
    # The angular momentum is the same in the laboratory, and so is the energy.
    start, end = np.array([0.3, 5.0, 0.1]), landing.rate
    assert np.abs(turned @ tensor @ end - tensor @ start).max() < 1e-13
    assert abs(start @ tensor @ start - end @ tensor @ end) < 1e-12


def test_margins_and_intervals_of_any_body_are_where_it_flips():
    book = ut.Toss((0.3, 5.0, 0.1), speed=3, body=BOOK)
    margins, heads = ut.margins(book), ut.intervals(book, 1.0).heads
    names = {ut.toss(ut.Toss((0.3, 5, 0.1), speed=3 + part * margins.speed, body=BOOK)).outcome for part in (1 - 1e-9, 1 + 1e-9)}
    assert names == {"heads", "tails"}
    for speed in np.linspace(1.0, 3.0, 50):
        inside = bool(((heads[:, 0] <= speed) & (speed <= heads[:, 1])).any())
        assert inside == (ut.toss(ut.Toss((0.3, 5, 0.1), speed=speed, body=BOOK)).outcome == "heads")


def test_a_trace_and_a_plan_take_any_body():
    toss = ut.Toss((1, 2, 3), speed=3, body=BOOK)
    landing = ut.trace(toss, 5)
    assert ut.plan("tilt", toss, 1e-6) is not None
    found = ut.plan("attitude", toss, 1e-6, solver="quaternion")
    assert found.solver == "quaternion" and 0 < found.expected_error <= 1e-6
    assert landing.cos_tilt[-1] == pytest.approx(ut.toss(toss).cos_tilt, abs=1e-14)


def test_a_body_says_what_it_is():
    quarter = ut.Body.named("us-quarter")
    assert quarter.is_symmetric and 1.9 < quarter.inertia_ratio < 2.0
    assert (BOOK.moments, BOOK.inertia_ratio, BOOK.is_symmetric) == ([1.0, 2.0, 2.8], None, False)
    assert TILTED.moments is None and sorted(np.linalg.eigvalsh(TILTED.tensor)) == pytest.approx(TILTED.principal_moments)
    assert [ut.Body.named(name).is_symmetric for name, _ in ut.bodies()].count(False) == 4
    assert ut.Body.named("racket").moments == [1.21e-3, 1.638e-2, 1.748e-2]
    assert ut.toss(ut.Toss((0.12, 12, 0), time=1.0472, body="racket")).outcome == "tails"
    assert dict(ut.bodies())["us-quarter"] and "quaternion" in [row[0] for row in ut.solvers()]
    with pytest.raises(errors.NoBodyError) as caught:
        ut.Body.from_moments((1, 1.5, 3.5))
    assert caught.value.valid == "at most I1 + I2"
    with pytest.raises(errors.UnknownNameError) as caught:
        ut.Body.named("groat")
    assert "us-quarter" in caught.value.valid
    with pytest.raises(errors.MalformedError):
        ut.Body.from_tensor([[1, 0.1, 0], [0.2, 1, 0], [0, 0, 1]])


@pytest.mark.parametrize(
    "thing",
    [
        CHEATED,
        ut.Toss((1.0, 2.0, 3.0), time=0.5, attitude=(1.0, 2.0, 0.0, 0.5), body=TILTED),
        ut.Toss((1.0, 2.0, 3.0), speed=0.5, drop=1.0, tilt=0.1, gravity=9.0, body=ut.Body.cylinder(0.1, 0.2, 0.3)),
        BOOK,
        TILTED,
        ut.Body.named("us-quarter"),
        ut.Space(rate_x=(0.1, 0.7, 7), rate_y="x", rate_z=1 / 3, speed="normal:4:0.1", body="us-quarter", drop=0.1),
        ut.Plan.sobol(64, scrambles=4, seed=7),
        ut.Solver("exact"),
        ut.Solver("euler", scheme="dopri5", rtol=1e-7, formulation="vertical"),
        ut.Solver("quaternion", scheme="rk4", step=0.1),
        ut.tally(ut.Space.named("paper-fig4"), ut.Plan.exact_speed(64), (3, 40)),
    ],
    ids=lambda thing: type(thing).__name__,
)
def test_things_travel_to_other_processes(thing):
    again = pickle.loads(pickle.dumps(thing))
    assert again == thing and again is not thing and copy.deepcopy(thing) == thing and copy.copy(thing) == thing
    assert repr(again) == repr(thing)
    assert type(thing).__name__ in repr(thing)
    if not isinstance(thing, ut.Tally):
        assert hash(again) == hash(thing)


def answers():
    """An answer of each kind; those that hold arrays come first."""
    toss = ut.Toss((20, 5, 3), speed=9)
    plan = ut.Plan.random(1000)
    return [
        ut.toss(toss),
        ut.intervals(toss),
        ut.trace(toss, 5),
        ut.solve(toss),
        ut.same_side_bias([1, 60], [100, 100]),
        ut.margins(toss),
        ut.inverse(0.8),
        ut.plan("tilt", toss, 1e-6),
        ut.count(X, 1.0, 2.0, 3.0),
        ut.probability(ut.Space.named("paper-fig4"), plan),
        ut.toss(toss).work,
    ]


X = np.linspace(0.0, 50.0, 5)


@pytest.mark.parametrize("number", range(11))
def test_answers_are_compared_whole_and_equal_ones_have_equal_hashes(number):
    first, second, holds_arrays = answers()[number], answers()[number], number < 5
    assert first is not second and (first == second) is True and (first != second) is False
    assert (first == 1) is False and pickle.loads(pickle.dumps(first)) == first == copy.deepcopy(first)
    if holds_arrays:
        changed = copy.deepcopy(first)
        array = next(value for value in vars(changed).values() if isinstance(value, np.ndarray))
        array[-1] += 1.0
        assert (first == changed) is False
        with pytest.raises(TypeError, match="unhashable"):
            hash(first)
    else:
        assert hash(first) == hash(second)


def test_equal_things_have_equal_hashes():
    axes = {"rate_y": 1, "rate_z": 1, "speed": 1}
    for one, two in [
        (ut.Toss((0.0, 1.0, 2.0), speed=3), ut.Toss((-0.0, 1.0, 2.0), speed=3)),
        (ut.Toss((1.0, 1.0, 2.0), time=0.0), ut.Toss((1.0, 1.0, 2.0), time=-0.0)),
        (ut.Body.from_moments((1.0, 0.0)), ut.Body.from_moments((1.0, -0.0))),
        (ut.Body.cylinder(1.0, 1.0, 0.0), ut.Body.cylinder(1.0, 1.0, -0.0)),
        (ut.Space(rate_x=0.0, **axes), ut.Space(rate_x=-0.0, **axes)),
        (ut.Space(rate_x=(0.0, 2.0), **axes), ut.Space(rate_x=(-0.0, 2.0), **axes)),
        (ut.Space(rate_x=5, **axes), ut.Space(rate_x="5:5:9", **axes)),
    ]:
        assert one == two and hash(one) == hash(two), (one, two)


def test_exceptions_travel_to_other_processes():
    with pytest.raises(errors.OutOfRangeError) as caught:
        ut.cos_tilt([1, 2], 1, 1, [1, -1])
    again = pickle.loads(pickle.dumps(caught.value))
    assert (type(again), str(again)) == (errors.OutOfRangeError, str(caught.value))
    assert (again.field, again.index, again.valid) == ("speed [m/s]", 1, "finite and >= 0")


@pytest.mark.parametrize(
    ("arguments", "kind", "field"),
    [
        ({}, errors.MissingError, "speed"),
        ({"speed": 3, "time": 1}, errors.MalformedError, "time"),
        ({"time": 1, "gravity": 9}, errors.MalformedError, "time"),
        ({"time": 1, "drop": 9}, errors.MalformedError, "time"),
        ({"time": 1, "tilt": 1, "attitude": (1, 0, 0, 0)}, errors.MalformedError, "attitude"),
        ({"speed": -1}, errors.OutOfRangeError, "speed [m/s]"),
        ({"speed": 1, "drop": -9}, errors.OutOfRangeError, "drop [m]"),
        ({"speed": 1, "tilt": float("inf")}, errors.OutOfRangeError, "tilt [rad]"),
        ({"speed": 1, "body": "groat"}, errors.UnknownNameError, "body"),
    ],
)
def test_an_impossible_toss_is_refused(arguments, kind, field):
    with pytest.raises(kind) as caught:
        ut.Toss((1, 1, 2.5), **arguments)
    assert (caught.value.field, caught.value.index) == (field, None)


def test_a_rotation_is_an_attitude_without_reordering():
    turn = Rotation.from_rotvec([0.3, 0.2, -1.0])
    toss = ut.Toss((1, 2, 3), time=0.0, attitude=turn)
    landing = Rotation.from_quat(ut.toss(toss).attitude, scalar_first=True)
    assert (landing * turn.inv()).magnitude() < 1e-15
    with pytest.raises(errors.MalformedError, match="single rotation"):
        ut.Toss((1, 2, 3), time=0.0, attitude=Rotation.from_rotvec(np.zeros((2, 3))))


@pytest.mark.parametrize(
    ("call", "kind", "close"),
    [
        (lambda: ut.Toss((1, 1, 2.5), sped=3), TypeError, "speed"),
        (lambda: ut.Solver("euler", schema="rk4"), TypeError, "scheme"),
        (lambda: ut.Space(rate_x=1, rate_y=1, rate_z=1, speed=1, tild=1), TypeError, "tilt"),
        (lambda: ut.cos_tilt(1, 1, 1, 3, gravty=9), TypeError, "gravity"),
        (lambda: ut.solve(CHEATED, rtoll=1e-9), TypeError, "rtol"),
        (lambda: ut.Toss((1, 1, 2.5), speed=3, body="US-Quater"), errors.UnknownNameError, "us-quarter"),
        (lambda: ut.toss(CHEATED, "quaternions"), errors.UnknownNameError, "quaternion"),
        (lambda: ut.solve(CHEATED, method="DOPP853"), errors.UnknownNameError, "dop853"),
        (lambda: ut.Solver("euler", formulation="momentun"), errors.UnknownNameError, "momentum"),
        (lambda: ut.Space.named("paper-fig-4"), errors.UnknownNameError, "paper-fig4"),
        (lambda: ut.Body.named("zzz"), errors.UnknownNameError, None),
        (lambda: ut.Body.cylinder(mass=1, radius=1, thicknes=1), TypeError, "thickness"),
        (lambda: ut.Plan.random(10, sed=1), TypeError, "seed"),
        (lambda: ut.Plan.grid().points(spaces=1), TypeError, "space"),
        (lambda: ut.Space.named(nam="tails"), TypeError, "name"),
        (lambda: ut.Space.named("tails").with_body(bdy="paper"), TypeError, "body"),
        (lambda: ut.trace(CHEATED, 5).plot(axes=None), TypeError, "ax"),
        (lambda: ut.margins(CHEATED, zzz=1), TypeError, None),
    ],
)
def test_an_unknown_name_is_answered_with_a_similar_one(call, kind, close):
    with pytest.raises(kind) as caught:
        call()
    assert str(caught.value).endswith(f". Did you mean '{close}'?") if close else "Did you mean" not in str(caught.value)
    if kind is TypeError:
        assert "got an unexpected keyword argument" in str(caught.value)
