"""Columns of launches: right in every layout, and an exception for every input that is none."""

import threading
from fractions import Fraction

import numpy as np
import pandas
import pytest
import xarray
from scipy.spatial.transform import Rotation

import unfair_toss as ut
from unfair_toss import errors
from unfair_toss._native import Batch

X = np.array([1.0, 20.0, 0.0, -3.0])
Y = np.array([1.0, 3.0, 30.0, 4.0])
Z = np.array([2.5, 1.0, 0.0, 5.0])
V = np.array([3.0, 2.0, 4.0, 5.0])


def single(**settings):
    return [ut.toss(ut.Toss((x, y, z), speed=v, **settings)) for x, y, z, v in zip(X, Y, Z, V, strict=True)]


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"tilt": 0.7},
        {"attitude": (0.5, 0.1, -0.3, 2.0)},
        {"attitude": Rotation.from_rotvec([0.3, 0.2, -1.0])},
        {"body": "us-quarter", "gravity": 1.62},
        {"body": ut.Body.from_moments((1.0, 1.5, 2.0))},
        {"body": ut.Body.from_tensor([[2.0, 0.1, 0.2], [0.1, 2.5, 0.3], [0.2, 0.3, 3.0]]), "tilt": -0.4},
    ],
)
def test_columns_are_the_landings_of_single_tosses(settings):
    expected = single(**settings)
    names = {1: "heads", -1: "tails", 0: "undecided"}
    cos_tilt, faces = ut.cos_tilt(X, Y, Z, V, **settings), ut.outcome(X, Y, Z, V, **settings)
    attitudes = ut.attitude(X, Y, Z, V, **settings)
    assert np.abs(cos_tilt - [landing.cos_tilt for landing in expected]).max() < 1e-15
    assert [names[face] for face in faces] == [landing.outcome for landing in expected]
    turns = Rotation.from_quat(attitudes, scalar_first=True) * Rotation.from_quat(
        [landing.attitude for landing in expected], scalar_first=True
    ).inv()
    assert turns.magnitude().max() < 3e-15
    counts = ut.count(X, Y, Z, V, **settings)
    assert (counts.heads, counts.tails, counts.certified) == ((faces == 1).sum(), (faces == -1).sum(), True)
    assert sum(counts.proven_by.values()) == counts.points == 4


def test_cos_tilt_is_the_closed_form_of_the_paper(launches):
    x, y, z, speed = launches
    along, across = 0.5 * z, x * x + y * y
    square = across + along * along
    part = along * along / square
    expected = part + (1.0 - part) * np.cos(np.sqrt(square) * (2.0 * speed / 9.81))
    assert np.abs(ut.cos_tilt(*launches) - expected).max() < 1e-12


def test_the_exact_solver_gives_the_bits_of_single_tosses():
    assert (ut.cos_tilt(X, Y, Z, V, solver="exact") == [landing.cos_tilt for landing in single()]).all()
    by_name = ut.cos_tilt(X, Y, Z, V, solver="quaternion")
    assert (by_name == ut.cos_tilt(X, Y, Z, V, solver=ut.Solver("quaternion"))).all()
    assert 0 < np.abs(by_name - ut.cos_tilt(X, Y, Z, V)).max() < 1e-8
    counts = ut.count(X, Y, Z, V, solver="quaternion")
    assert (counts.certified, counts.proven_by, counts.points) == (False, None, 4)


def test_a_time_is_a_speed_without_gravity():
    time = 2.0 * V / 9.81
    assert np.abs(ut.cos_tilt(X, Y, Z, time=time) - ut.cos_tilt(X, Y, Z, V)).max() < 1e-14
    single = [ut.toss(ut.Toss((x, y, z), time=t)).cos_tilt for x, y, z, t in zip(X, Y, Z, time, strict=True)]
    assert np.abs(ut.cos_tilt(X, Y, Z, time=time) - single).max() < 1e-15


def layouts(column):
    """The same column in other layouts and types."""
    spread = np.full(3 * column.size, np.nan)
    spread[::3] = column
    unaligned = np.zeros(8 * column.size + 1, np.uint8)
    unaligned[1:] = np.frombuffer(column.tobytes(), np.uint8)
    frozen = column.copy()
    frozen.flags.writeable = False
    return {
        "list": column.tolist(),
        "strided": spread[::3],
        "reversed": column[::-1].copy()[::-1],
        "unaligned": unaligned[1:].view(np.float64),
        "big-endian": column.astype(">f8"),
        "longdouble": column.astype(np.longdouble),
        "object": np.array([Fraction(value) for value in column.tolist()], dtype=object),
        "read-only": frozen,
        "matrix": np.array([column, column])[0],
        "record": np.array([(value, 0) for value in column.tolist()], dtype=[("a", "f8"), ("b", "i1")])["a"],
    }


@pytest.mark.parametrize("name", list(layouts(X)))
@pytest.mark.parametrize("function", [ut.cos_tilt, ut.outcome, ut.attitude])
def test_no_layout_changes_a_bit(function, name):
    expected = function(X, Y, Z, V)
    assert (function(*(layouts(column)[name] for column in (X, Y, Z, V))) == expected).all()
    assert (function(X, layouts(Y)[name], Z, V) == expected).all()


def test_columns_broadcast():
    expected = ut.cos_tilt(*(column.reshape(-1).copy() for column in np.broadcast_arrays(X[:, None], Y, 2.5, 3)))
    found = ut.cos_tilt(X[:, None], Y, 2.5, 3)
    assert found.shape == (4, 4) and (found.reshape(-1) == expected).all()
    assert (ut.cos_tilt(np.asfortranarray(np.tile(X[:, None], 4)), Y, 2.5, 3) == found).all()
    assert ut.attitude(X[:, None, None], Y[:, None], Z, 3).shape == (4, 4, 4, 4)
    assert ut.cos_tilt(1.0, 1.0, 2.5, 3.0).shape == () and ut.cos_tilt(X[:0], 1.0, 2.5, 3.0).shape == (0,)
    assert ut.count(X[:0], 1, 2, 3).points == 0 and not ut.count(X[:0], 1, 2, 3).certified
    with pytest.raises(errors.MalformedError, match="don't broadcast"):
        ut.cos_tilt(X, Y[:3], Z, V)


def test_many_launches_are_the_same_in_any_blocks_and_on_any_threads(launches):
    x, y, z, speed = (column[:200_003] for column in launches)
    whole = ut.cos_tilt(x, y, z, speed)
    wide = np.stack([x, y, z, speed], axis=1)
    for threads in (1, 2, 3, None):
        assert (ut.cos_tilt(x, y, z, speed, threads=threads) == whole).all()
        assert (ut.cos_tilt(*wide.T, threads=threads) == whole).all()
        assert (ut.outcome(x, y, z, speed, threads=threads) == np.sign(whole)).all()
        counts = ut.count(*wide.T, threads=threads)
        assert (counts.heads, counts.tails) == ((whole > 0).sum(), (whole < 0).sum())
    part = [column[:3000] for column in (x, y, z, speed)]
    for solver in ("exact", "quaternion"):
        one, two = (ut.attitude(*part, solver=solver, threads=threads) for threads in (1, 2))
        assert (one == two).all()


def test_results_go_where_they_are_wanted():
    expected = ut.cos_tilt(X, Y, Z, V)
    out = np.full(4, np.nan)
    assert ut.cos_tilt(X, Y, Z, V, out=out) is out and (out == expected).all()
    spread = np.full((4, 3), 7.0)
    ut.cos_tilt(X, Y, Z, V, out=spread[:, 1])
    assert (spread[:, 1] == expected).all() and (spread[:, ::2] == 7.0).all()
    quaternions = np.empty((4, 4), order="F")
    assert (ut.attitude(X, Y, Z, V, out=quaternions) == ut.attitude(X, Y, Z, V)).all()
    faces = np.empty(4, np.int8)
    assert (ut.outcome(X, Y, Z, V, out=faces) == [1, -1, 1, -1]).all() or (faces == np.sign(expected)).all()


def test_a_result_may_overlap_the_input():
    expected = ut.cos_tilt(X, Y, Z, V)
    column = X.copy()
    assert (ut.cos_tilt(column, Y, Z, V, out=column) == expected).all()
    memory = np.concatenate([X, np.zeros(4)])
    assert (ut.cos_tilt(memory[:4], Y, Z, V, out=memory[2:6]) == expected).all()
    square = np.stack([X, Y, Z, V])
    expected = ut.attitude(*square.copy())
    assert (ut.attitude(*square, out=square) == expected).all()
    assert (ut.cos_tilt(X, X, X, V) == ut.cos_tilt(X, X.copy(), X.copy(), V)).all()


@pytest.mark.parametrize(
    ("out", "words"),
    [
        (np.empty(3), "expected is float64"),
        (np.empty(4, np.float32), "expected is float64"),
        (np.empty((4, 1)), "expected is float64"),
        ([0.0] * 4, "no array"),
        (np.ma.zeros(4), "no array"),
        (np.broadcast_to(np.float64(0.0), 4), "read-only"),
        (np.zeros(4, ">f8"), "expected is float64"),
    ],
)
def test_a_place_for_results_that_does_not_fit_is_refused(out, words):
    with pytest.raises(errors.MalformedError, match=words) as caught:
        ut.cos_tilt(X, Y, Z, V, out=out)
    assert caught.value.field == "out"


@pytest.mark.parametrize(
    "column",
    [
        np.array(["1", "2", "3", "4"]),
        np.array([1j, 2, 3, 4]),
        np.array([True, False, True, False]),
        np.array(["2020-01-01"] * 4, dtype="M8[D]"),
        np.ma.masked_greater(X, 10.0),
        [[1.0], [2.0, 3.0]],
        [10**400, 1, 2, 3],
        object(),
        "speed",
    ],
    ids=repr,
)
def test_columns_that_are_no_real_numbers_are_refused(column):
    for place in range(4):
        columns = [X, Y, Z, V]
        columns[place] = column
        with pytest.raises(errors.MalformedError) as caught:
            ut.cos_tilt(*columns)
        assert caught.value.field == ("rate_x", "rate_y", "rate_z", "speed")[place]


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("function", [ut.cos_tilt, ut.outcome, ut.attitude, ut.count])
def test_the_first_impossible_launch_is_named(function, threads, bad, launches):
    columns = [column[:150_000].copy() for column in launches]
    columns[2][100_001] = bad
    columns[0][140_000] = bad
    for settings in ({}, {"tilt": 0.3}):
        with pytest.raises(errors.OutOfRangeError, match="launch 100001: rate z") as caught:
            function(*columns, threads=threads, **settings)
        assert (caught.value.field, caught.value.index, caught.value.valid) == ("rate_z [rad/s]", 100_001, "finite")
    few = [column[100_000:100_002] for column in columns]
    with pytest.raises(errors.OutOfRangeError) as caught:
        function(*few, threads=threads, body=ut.Body.from_moments((1.0, 1.5, 2.0)))
    assert (caught.value.index, isinstance(caught.value, ValueError)) == (1, True)


def test_a_negative_speed_or_time_is_named_as_it_was_given():
    for name, field in [("speed", "speed [m/s]"), ("time", "time [s]")]:
        with pytest.raises(errors.OutOfRangeError) as caught:
            ut.outcome(X, Y, Z, **{name: np.array([1.0, 2.0, -1.0, -2.0])})
        assert (caught.value.field, caught.value.index) == (field, 2)
    with pytest.raises(errors.PhaseTooLargeError) as caught:
        ut.cos_tilt(X * 1e17, Y, Z, V)
    assert caught.value.index == 0 and isinstance(caught.value, RuntimeError)


@pytest.mark.parametrize(
    ("settings", "field"),
    [
        ({"gravity": 0.0}, "gravity [m/s²]"),
        ({"tilt": np.nan}, "tilt [rad]"),
        ({"tilt": 0.1, "attitude": (1, 0, 0, 0)}, "attitude"),
        ({"attitude": (0, 0, 0, 0)}, "attitude (largest component)"),
        ({"attitude": [[1, 0, 0, 0]] * 4, "tilt": V}, "attitude"),
        ({"attitude": [[1, 0, 0, 0]] * 4, "tilt": 0.1}, "attitude"),
        ({"attitude": [1, 0, 0]}, "attitude"),
        ({"attitude": np.ones((4, 3))}, "attitude"),
        ({"attitude": np.ones((3, 4))}, "columns"),
        ({"attitude": Rotation.identity(3)}, "columns"),
        ({"attitude": pandas.DataFrame(np.ones((4, 4)), columns=list("xyzw"))}, "attitude"),
        ({"attitude": xarray.DataArray(np.ones((4, 4)), dims=("throw", "part"))}, "attitude"),
        ({"attitude": xarray.DataArray(np.ones(4), {"component": list("xyzw")})}, "attitude"),
        ({"attitude": xarray.DataArray([["1"] * 4] * 4, dims=("throw", "component"))}, "attitude"),
        ({"drop": np.nan}, "drop [m]"),
        ({"drop": [1.0, 2.0]}, "columns"),
        ({"threads": 0}, "threads"),
        ({"threads": 5000}, "threads"),
        ({"body": "groat"}, "body"),
        ({"solver": "magic"}, "solver"),
        ({"time": V}, "speed"),
    ],
)
def test_impossible_settings_are_refused(settings, field):
    with pytest.raises(errors.InputError) as caught:
        ut.cos_tilt(X, Y, Z, V, **settings)
    assert caught.value.field == field


def test_an_argument_without_effect_is_refused():
    for name in ("gravity", "drop"):
        with pytest.raises(errors.MalformedError, match=f"{name} has no effect"):
            ut.cos_tilt(X, Y, Z, time=V, **{name: 9.81})
    with pytest.raises(errors.MalformedError, match="expected speed or time, and not both"):
        ut.cos_tilt(X, Y, Z)


def test_a_billion_launches_that_are_all_the_same_need_no_memory():
    many = np.broadcast_to(1.0, 10**9)
    counts = ut.count(many, many, 2.5, 3.0)
    assert (counts.heads, counts.tails, counts.undecided) == (10**9, 0, 0)
    with pytest.raises(errors.OutOfRangeError) as caught:
        ut.count(np.broadcast_to(np.nan, 10**9), many, 2.5, 3.0)
    assert caught.value.index == 0


def test_the_lock_of_python_is_released(launches):
    batch = Batch(
        [("paper", None)], gravity=9.81, drop=None, tilt=None, attitude=None, varying=(0,) * 5, precesses=False, timed=False,
        solver="exact", threads=1,
    )  # fmt: skip
    out, done, turns, within = np.empty(1_000_000), threading.Event(), 0, []

    def compute():
        # Calls of one block each: with the lock held, no other thread has a turn before such a call ends.
        for _ in range(50):
            before = turns
            batch.cos_tilts(launches, out, 0)
            within.append(turns - before)
            if sum(number >= 10 for number in within) == 3:
                break
        done.set()

    worker = threading.Thread(target=compute)
    worker.start()
    while not done.wait(0.001):
        turns += 1
    worker.join()
    assert sum(number >= 10 for number in within) == 3, within


def test_two_threads_may_read_the_same_columns_but_not_write_the_same_result(launches):
    out, failures = np.empty(1_000_000), []

    def compute():
        try:
            for _ in range(5):
                ut.cos_tilt(*launches, out=out)
        except errors.MalformedError as error:
            failures.append(error.field)

    workers = [threading.Thread(target=compute) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    # Refused, or one after the other; never a crash.
    assert set(failures) <= {"out"}
    assert (out[:1000] == ut.cos_tilt(*(column[:1000] for column in launches))).all()


def same(function, found, expected, arguments) -> bool:
    """To the bit, but for cos θ and attitudes of the kernels in which all varies, which are right to 1e-15 and 2e-15 rad."""
    if function in (ut.cos_tilt, ut.attitude) and not set(arguments) & {"body", "solver"}:
        found, expected = np.asarray(found), np.asarray(expected)
        if function is ut.attitude:
            expected = expected * np.sign((found * expected).sum(-1, keepdims=True))
        return np.abs(found - expected).max() < 1.2e-15
    return np.all(found == expected)


GRAVITY = [9.81, 9.81, 1.62, 9.81, 3.7]
TILT = [0.0, 0.5, 0.5, -1.0]


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("arguments", [{}, {"body": "racket"}, {"solver": "exact"}, {"solver": "quaternion"}], ids=str)
def test_gravity_and_tilt_are_columns_with_the_bits_of_one_at_a_time(arguments, threads):
    rate, arguments = np.linspace(3.0, 40.0, 70), arguments | {"threads": threads}
    gravity, tilt = np.array(GRAVITY)[:, None, None], np.array(TILT)[:, None]
    for function in (ut.cos_tilt, ut.outcome, ut.attitude):
        one = lambda g, t: function(rate, 2.0, rate[::-1], 2.5, gravity=g, tilt=t, **arguments)
        expected = np.array([[one(g, t) for t in TILT] for g in GRAVITY])
        found = function(rate, 2.0, rate[::-1], 2.5, gravity=gravity, tilt=tilt, **arguments)
        assert same(function, found, expected, arguments)
        found = function(rate[:5], 2, rate[4::-1], 2.5, gravity=GRAVITY, **arguments)[2]
        assert same(function, found, function(rate[2], 2, rate[2], 2.5, gravity=1.62, **arguments), arguments)
    found = ut.count(rate, 2.0, rate[::-1], 2.5, gravity=gravity, tilt=tilt, **arguments)
    faces = ut.outcome(rate, 2.0, rate[::-1], 2.5, gravity=gravity, tilt=tilt, **arguments)
    assert (found.heads, found.tails, found.points) == ((faces == 1).sum(), (faces == -1).sum(), faces.size)
    assert found.certified == (arguments.get("solver") != "quaternion")
    timed = ut.cos_tilt(rate, 1, 1, time=1.0, tilt=rate, **arguments)
    assert same(ut.cos_tilt, timed[7], ut.cos_tilt(rate[7], 1, 1, time=1.0, tilt=rate[7], **arguments), arguments)


ATTITUDE = np.array([(1, 0, 0, 0), (0.5, 0.1, -0.3, 2.0), (0.5, 0.1, -0.3, 2.0), (0.5, 0.1, -0.3, -2.0), (0.8, 0.6, 0, 0)])


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("arguments", [{}, {"body": "racket"}, {"solver": "exact"}, {"solver": "quaternion"}], ids=str)
def test_attitudes_are_columns_with_the_bits_of_one_at_a_time(arguments, threads):
    rate, arguments = np.linspace(3.0, 40.0, 70), arguments | {"threads": threads}
    for function in (ut.cos_tilt, ut.outcome, ut.attitude):
        expected = np.array([function(rate, 2.0, rate[::-1], 2.5, attitude=one, **arguments) for one in ATTITUDE])
        for given in (ATTITUDE[:, None], ATTITUDE[:, None].tolist(), np.repeat(ATTITUDE[:, None], 70, axis=1)):
            assert same(function, function(rate, 2.0, rate[::-1], 2.5, attitude=given, **arguments), expected, arguments)
        alike = np.tile(ATTITUDE[1], (70, 1))
        assert same(function, function(rate, 2.0, rate[::-1], 2.5, attitude=alike, **arguments), expected[1], arguments)
        turns = Rotation.from_quat(ATTITUDE, scalar_first=True)
        quaternions = turns.as_quat(scalar_first=True)
        one = np.array([function(3, 2, 1, 2.5, attitude=one, **arguments) for one in quaternions])
        assert same(function, function(3, 2, 1, 2.5, attitude=turns, **arguments), one, arguments)
    faces = ut.outcome(rate, 2.0, rate[::-1], 2.5, attitude=ATTITUDE[:, None], gravity=rate, **arguments)
    found = ut.count(rate, 2.0, rate[::-1], 2.5, attitude=ATTITUDE[:, None], gravity=rate, **arguments)
    assert (found.heads, found.tails, found.points) == ((faces == 1).sum(), (faces == -1).sum(), faces.size)
    assert found.certified == (arguments.get("solver") != "quaternion")


DROP = [0.0, 1.0, 1.0, -0.2]


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("arguments", [{}, {"body": "racket"}, {"solver": "exact"}, {"solver": "quaternion"}], ids=str)
def test_drops_and_attitudes_are_columns_with_the_bits_of_single_tosses(arguments, threads):
    body, solver = arguments.get("body", "paper"), arguments.get("solver", "exact")
    rate, drop = np.linspace(3.0, 40.0, 5)[:, None], np.array(DROP)
    toss = lambda x, h, q: ut.toss(ut.Toss((x, 2, 9), speed=2.5, drop=h, attitude=q, body=body), solver)
    single = [[toss(x, h, q) for h in DROP] for x, q in zip(rate[:, 0], ATTITUDE, strict=True)]
    settings = {"drop": drop, "attitude": ATTITUDE[:, None], "threads": threads} | arguments
    expected = [[one.cos_tilt for one in row] for row in single]
    assert same(ut.cos_tilt, ut.cos_tilt(rate, 2, 9, 2.5, **settings), expected, arguments)
    turned = [[one.attitude for one in row] for row in single]
    assert same(ut.attitude, ut.attitude(rate, 2, 9, 2.5, **settings), turned, arguments)
    faces = ut.outcome(rate, 2, 9, 2.5, **settings)
    assert [[{1: "heads", -1: "tails", 0: "undecided"}[face] for face in row] for row in faces.tolist()] == [
        [one.outcome for one in row] for row in single
    ]
    found = ut.count(rate, 2, 9, 2.5, **settings)
    assert (found.heads, found.points) == ((faces == 1).sum(), 20) and found.certified == (solver == "exact")
    for one in DROP:
        assert (ut.cos_tilt(rate, 2, 9, 2.5, **settings | {"drop": one}) == ut.cos_tilt(rate, 2, 9, 2.5, **settings)[:, DROP.index(one), None]).all()


@pytest.mark.parametrize("solver", [None, "exact", "quaternion"])
@pytest.mark.parametrize(
    ("name", "right", "wrong", "field", "valid"),
    [
        ("gravity", 2.0, 0.0, "gravity [m/s²]", "finite and > 0"),
        ("gravity", 2.0, np.nan, "gravity [m/s²]", "finite and > 0"),
        ("tilt", 2.0, np.inf, "tilt [rad]", "finite"),
        ("drop", 2.0, np.nan, "drop [m]", "finite"),
        ("drop", 2.0, -9.0, "drop [m]", ">= -v0²/(2 g), the height that the toss reaches"),
        ("attitude", (1, 0, 0, 0), (0, 0, 0, 0), "attitude (largest component)", "finite and > 0"),
        ("attitude", (1, 0, 0, 0), (1, 0, np.nan, 0), "attitude (largest component)", "finite and > 0"),
    ],
)
def test_a_wrong_condition_is_named_by_its_launch(solver, name, right, wrong, field, valid):
    column = np.array([right] * 700 + [wrong] * 300)
    for function in (ut.cos_tilt, ut.outcome, ut.attitude, ut.count):
        with pytest.raises(errors.OutOfRangeError) as caught:
            function(1.0, 2.0, 3.0, 1.0, solver=solver, **{name: column})
        assert (caught.value.field, caught.value.index, caught.value.valid) == (field, 700, valid)


def test_columns_of_xarray_are_combined_by_their_labels():
    x = xarray.DataArray([3.0, 2.0, 1.0], {"throw": ["a", "b", "c"]})
    v = xarray.DataArray([2.0, 4.0], {"hand": [1, 2]}, name="speed", attrs={"units": "m/s"})
    z = (x * v.T).drop_attrs()  # Of which xarray keeps the unit of the speed.
    found = ut.cos_tilt(x, 1.0, z, v)
    assert found.dims == ("throw", "hand") and found.sel(throw="b", hand=2) == ut.cos_tilt(2.0, 1.0, 8.0, 4.0)
    assert found.identical(ut.cos_tilt(x, 1.0, z.transpose("hand", "throw"), v))
    turned = ut.attitude(x, 1.0, 1.0, v)
    assert turned.dims == ("throw", "hand", "component") and turned.sel(component="w").shape == (3, 2)
    gravity = v.assign_attrs(units="m/s2")
    assert ut.outcome(x, 1, 1, v, gravity=gravity).sel(hand=1, throw="a") == ut.outcome(3, 1, 1, 2, gravity=2)
    assert ut.count(x, 1, 1, v) == ut.count(x.values[:, None], 1, 1, v.values)
    assert (ut.cos_tilt(x, [1.0, 2.0, 3.0], 1, 2) == ut.cos_tilt(x.values, [1.0, 2.0, 3.0], 1, 2)).all()


def test_attitudes_are_combined_by_their_labels():
    x = xarray.DataArray([3.0, 2.0, 1.0], {"throw": ["a", "b", "c"]})
    turned = ut.attitude(x, 1.0, 1.0, xarray.DataArray([2.0, 4.0], {"hand": [1, 2]}))
    found = ut.cos_tilt(x, 1.0, 1.0, 2.0, attitude=turned.transpose("component", "hand", "throw"))
    one = turned.sel(throw="b", hand=2).values
    assert found.dims == ("throw", "hand") and found.sel(throw="b", hand=2) == ut.cos_tilt(2.0, 1.0, 1.0, 2.0, attitude=one)
    assert ut.cos_tilt(1, 1, 1, 2, attitude=turned).sel(throw="b", hand=2) == ut.cos_tilt(1, 1, 1, 2, attitude=one)
    frame = pandas.DataFrame({"x": [3.0, 2.0], "v": [2.0, 4.0]}, index=["b", "a"])
    turned = ut.attitude(frame.x, 1, 1, frame.v)
    found = ut.cos_tilt(frame.x, 1, 1, frame.v, attitude=turned)
    assert found["a"] == ut.cos_tilt(2.0, 1, 1, 4.0, attitude=turned.loc["a"])
    for wrong in (turned[::-1], turned[:1]):
        with pytest.raises(errors.MalformedError, match="has other labels") as caught:
            ut.cos_tilt(frame.x, 1, 1, frame.v, attitude=wrong)
        assert caught.value.field == "attitude"


def test_columns_of_pandas_keep_their_labels():
    frame = pandas.DataFrame({"x": [3.0, 2.0], "v": [2.0, 4.0]}, index=["b", "a"])
    found = ut.cos_tilt(frame.x, 1.0, 1.0, frame.v)
    assert isinstance(found, pandas.Series) and found["a"] == ut.cos_tilt(2.0, 1.0, 1.0, 4.0)
    assert ut.attitude(frame.x, 1, 1, frame.v).loc["b"].tolist() == ut.attitude(3.0, 1, 1, 2.0).tolist()
    assert ut.outcome(frame, frame, 1, 2).loc["a", "v"] == ut.outcome(4.0, 4.0, 1, 2)
    assert ut.same_side_bias(frame.x.astype(int), frame.v.astype(int) + 9) == ut.same_side_bias([3, 2], [11, 13])
    out = np.empty(2)
    assert (ut.cos_tilt(frame.x, 1.0, 1.0, frame.v, out=out) == out).all()


def test_attitudes_that_labels_have_no_place_for_are_refused():
    frame = pandas.DataFrame({"a": [1.0, 2.0]})
    array = xarray.DataArray([3.0, 2.0], {"component": ["b", "a"]})
    for column in (frame, array):
        assert ut.cos_tilt(column, 1.0, 1.0, 3.0).shape == column.shape
        with pytest.raises(errors.MalformedError, match="component") as caught:
            ut.attitude(1.0, column, 1.0, 3.0)
        assert caught.value.field == "rate_y"


SERIES = pandas.Series([3.0, 2.0], index=["b", "a"])
ARRAY = xarray.DataArray([3.0, 2.0], {"throw": ["b", "a"]})


@pytest.mark.parametrize(
    ("one", "two"),
    [
        (SERIES, SERIES.sort_index()),
        (SERIES, SERIES[:1]),
        (SERIES, SERIES.to_frame()),
        (SERIES, ARRAY),
        (SERIES, [[1.0, 2.0], [3.0, 4.0]]),
        (SERIES, [1.0]),
        (ARRAY, ARRAY[::-1]),
        (ARRAY, ARRAY[:1]),
        (ARRAY, xarray.DataArray([3.0, 2.0, 1.0], dims="throw")),
        (ARRAY, np.ones((3, 2))),
    ],
)
def test_columns_whose_labels_differ_are_refused(one, two):
    for function in (ut.cos_tilt, ut.outcome, ut.attitude, ut.count):
        with pytest.raises(errors.MalformedError) as caught:
            function(one, 1.0, 1.0, two)
        assert caught.value.field in ("rate_x", "speed") and caught.value.valid == "the labels of the other columns, or one number"
    with pytest.raises(errors.MalformedError):
        ut.same_side_bias(one.astype(int), two if isinstance(two, list) else two.astype(int) + 5)
