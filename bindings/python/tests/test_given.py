"""Values of the wrong kind, as every argument of everything public: an exception of the package that names the argument."""

import datetime
import decimal
import fractions
import inspect
import math
import random
import re
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pandas
import pytest

import unfair_toss as ut
from conftest import ROOT
from unfair_toss import errors

TOSS = ut.Toss((1.0, 1.0, 2.5), speed=3.0)
SPACE = ut.Space.named("paper-fig4")
GRID = ut.Space(rate_x=(1, 2, 3), rate_y=0, rate_z=(1, 2, 3), speed=(3, 4, 3))
PLAN = ut.Plan.random(100)
TALLY = ut.tally(SPACE, PLAN)
TOML = (ROOT / "crates" / "sampling" / "spaces" / "tails.toml").read_text(encoding="utf-8")
AXES = {"rate_x": 1, "rate_y": 1, "rate_z": 1, "speed": 1}
COLUMNS = {"rate_x": 1.0, "rate_y": 1.0, "rate_z": 2.5, "speed": 3.0}

RAGGED = [[1.0], [2.0, 3.0]]
HOSTILE = {
    "object": object(),
    "None": None,
    "nan": math.nan,
    "inf": math.inf,
    "10**400": 10**400,
    "10**5000": 10**5000,
    "-1": -1,
    "2**64": 2**64,
    "0.5": 0.5,
    "'3'": "3",
    "''": "",
    "a surrogate": "\udc80",
    "b'x'": b"x",
    "a bytearray": bytearray(b"abc"),
    "True": True,
    "numpy True": np.True_,
    "1+2j": 1 + 2j,
    "numpy complex": np.complex128(1 + 2j),
    "masked": np.ma.masked,
    "a masked array": np.ma.masked_greater([1.0, 2.0, 3.0], 2.5),
    "datetime64": np.datetime64("2020-01-01"),
    "timedelta64": np.timedelta64(3, "s"),
    "timedelta": datetime.timedelta(seconds=3),
    "dict": {0: 1.0, 1: 2.0, 2: 3.0},
    "set": {1.0, 2.0, 3.0},
    "ragged": RAGGED,
    "objects": np.array([1.0, "2", None], dtype=object),
    "truth values": np.array([True, False, True]),
    "complex numbers": np.array([1j, 2, 3]),
    "texts": np.array(["1", "2", "3"]),
    "spans of time": np.array([1, 2, 3], dtype="m8[s]"),
    "records": np.zeros(3, dtype=[("a", "f8"), ("b", "f8")]),
    "a generator": (number for number in (1.0, 2.0, 3.0)),
    "a cube": np.ones((3, 3, 3)),
    "an empty list": [],
    "nan in a list": [1.0, math.nan, 3.0],
    "True in a list": [1.0, True, 3.0],
    "a text in a list": [1.0, "2", 3.0],
    "masked in a list": [1.0, np.ma.masked, 3.0],
    "a span in a list": [1.0, np.timedelta64(2, "s"), 3.0],
    "10**400 in a list": [1.0, 10**400, 3.0],
    "sNaN": decimal.Decimal("sNaN"),
    "a class": ut.Toss,
    "a module": math,
}


def print_nothing(done, all_of_them):
    pass


def one_thread():
    return ThreadPoolExecutor(1)


def landed(toss, *rates, **launch):
    """The attitude of a toss, or of columns."""
    return ut.attitude(toss, *rates, **launch) if rates else ut.toss(toss)


# Everything public that takes arguments, with arguments that are right.
CALLS = {
    "Toss": (ut.Toss, {"rate": (1, 2, 3), "speed": 3.0}),
    "Toss by time": (ut.Toss, {"rate": (1, 2, 3), "time": 3.0}),
    "Toss with a tilt": (ut.Toss, {"rate": (1, 2, 3), "speed": 3.0, "gravity": 9.0, "drop": 0.1, "tilt": 0.1}),
    "Toss with an attitude": (ut.Toss, {"rate": (1, 2, 3), "speed": 3.0, "attitude": (1, 0, 0, 0), "body": "paper"}),
    "Toss of a precession": (ut.Toss, {"turn": 6.0, "psi": 1.0, "speed": 3.0}),
    "Body.named": (ut.Body.named, {"name": "paper"}),
    "Body.cylinder": (ut.Body.cylinder, {"mass": 1.0, "radius": 1.0, "thickness": 1.0}),
    "Body.from_moments": (ut.Body.from_moments, {"moments": (1.0, 2.0)}),
    "Body.from_tensor": (ut.Body.from_tensor, {"tensor": np.eye(3)}),
    "Solver": (ut.Solver, {"name": "euler", "scheme": "dopri5", "rtol": 1e-6, "formulation": "momentum"}),
    "Solver with a step": (ut.Solver, {"name": "euler", "scheme": "rk4", "step": 0.1}),
    "Space": (ut.Space, AXES | {"gravity": 9.0, "tilt": 0.0, "drop": 0.1, "body": "paper"}),
    "Space of turns": (ut.Space, {"turn": (6.0, 7.0), "psi": "60deg:80deg", "speed": 3.0}),
    "Space.named": (ut.Space.named, {"name": "tails"}),
    "Space.with_body": (SPACE.with_body, {"body": "paper"}),
    "Space.with_drop": (SPACE.with_drop, {"drop": 0.5}),
    "Space.with_spread": (ut.Space(**AXES).with_spread, {"spread": 0.05}),
    "Space.from_toml": (ut.Space.from_toml, {"text": TOML}),
    "Space.from_json": (ut.Space.from_json, {"text": SPACE.to_json()}),
    "Plan.random": (ut.Plan.random, {"points": 10, "seed": 1}),
    "Plan.sobol": (ut.Plan.sobol, {"points": 16, "scrambles": 4, "seed": 1}),
    "Plan.exact_speed": (ut.Plan.exact_speed, {"points": 16, "scrambles": 4, "seed": 1}),
    "Plan.enclosure": (ut.Plan.enclosure, {"accuracy": 1e-6}),
    "Plan.of": (PLAN.of, {"space": SPACE}),
    "Plan.points": (PLAN.points, {"space": SPACE}),
    "Plan.from_json": (ut.Plan.from_json, {"text": PLAN.to_json()}),
    "Tally.from_json": (ut.Tally.from_json, {"text": TALLY.to_json()}),
    "toss": (ut.toss, {"toss": TOSS, "solver": "quaternion", "prove": True}),
    "sensitivity": (ut.sensitivity, {"toss": TOSS}),
    "compare": (ut.compare, {"toss": TOSS, "rtol": 1e-6, "step": 0.1, "formulation": "all"}),
    "limit": (ut.limit, {"body": "paper", "points": 5, "seed": 1, "solver": "exact", "threads": 1}),
    "limit by a generator": (ut.limit, {"points": 5, "rng": 1}),
    "spread": (ut.spread, {"toss": TOSS, "heads": 0.9, "points": 16, "seed": 1, "threads": 1}),
    "spread by a generator": (ut.spread, {"toss": TOSS, "heads": 0.9, "points": 16, "rng": 1}),
    "map": (ut.map, {"space": GRID, "across": "rate_x", "up": "rate_z", "plan": PLAN, "solver": "exact", "threads": 1}),
    "convergence": (ut.convergence, {"space": GRID, "steps": 3, "seed": 1, "solver": "exact", "threads": 1}),
    "convergence by a generator": (ut.convergence, {"space": GRID, "rng": 1}),
    "sampling_errors": (
        ut.sampling_errors, {"space": SPACE, "replicates": 2, "up_to": 8, "reference": 0.6, "threads": 1}
    ),
    "sample": (ut.sample, {"space": GRID, "points": 5, "method": "sobol", "seed": 1, "solver": "exact", "threads": 1}),
    "sample by a generator": (ut.sample, {"space": GRID, "points": 5, "rng": 1}),
    "margins": (ut.margins, {"toss": TOSS}),
    "intervals": (ut.intervals, {"toss": TOSS, "slowest": 1.0}),
    "trace": (ut.trace, {"toss": TOSS, "points": 5, "solver": "quaternion", "prove": True}),
    "trace by steps": (ut.trace, {"toss": TOSS, "dt": 0.1}),
    "inverse": (ut.inverse, {"probability": 0.8, "body": "paper"}),
    "inverse of counts": (ut.inverse, {"counts": (60, 100)}),
    "rate_of_precession": (ut.rate_of_precession, {"turn": 240.0, "psi": 1.4, "body": "us-quarter"}),
    "power": (ut.power, {"share": 0.51, "sd": 0.02, "power": 0.9, "people": 25, "flips": 200}),
    "same_side_bias": (ut.same_side_bias, {"same_side": 60, "tosses": 100, "body": "paper"}),
    "same_side_bias of people": (ut.same_side_bias, {"same_side": [56, 61, 20], "tosses": np.array([100, 100, 100])}),
    "solve": (ut.solve, {"toss": TOSS, "solver": "euler", "t_eval": [0.0, 0.1], "scheme": "dopri5", "rtol": 1e-6}),
    "solve in a formulation": (ut.solve, {"toss": TOSS, "solver": "euler", "formulation": "momentum"}),
    "solve in SciPy's words": (ut.solve, {"toss": TOSS, "method": "DOP853", "atol": 1e-6, "dense_output": True}),
    "solve by steps": (ut.solve, {"toss": TOSS, "solver": "euler", "scheme": "rk4", "step": 0.1}),
    "plan": (ut.plan, {"want": "trace", "of": TOSS, "accuracy": 1e-6, "points": 5, "solver": "euler", "scheme": "dop853"}),
    "tally": (ut.tally, {"space": SPACE, "plan": PLAN, "range": (0, 10), "threads": 1, "progress": print_nothing}),
    "merge": (ut.merge, {"parts": [TALLY]}),
    "estimate": (ut.estimate, {"whole": TALLY}),
    "probability": (ut.probability, {"space": SPACE, "plan": PLAN, "threads": 1, "progress": print_nothing}),
    "probability in parts": (ut.probability, {"space": SPACE, "plan": PLAN, "shards": 2}),
    "probability by a solver": (ut.probability, {"space": SPACE, "plan": PLAN, "solver": "quaternion", "prove": True}),
    "probability to an accuracy": (ut.probability, {"space": SPACE, "accuracy": 1e-2}),
    "probability by an executor": (ut.probability, {"space": SPACE, "plan": PLAN, "executor": one_thread, "shards": 2, "retries": 3}),
    "verify": (
        ut.verify,
        {"f": landed, "columns": False, "only": "reference-cos-tilt", "quick": True, "deep": False, "bodies": False, "claim": 1e-9}
        | {"answer_seconds": 9.0, "total_seconds": 90, "time_factor": 2, "folder": "report", "program": None},
    ),
    "probability in a folder": (ut.probability, {"space": SPACE, "plan": PLAN, "folder": None, "shards": 2}),
    **{
        f"{function.__name__}{words}": (function, COLUMNS | {"threads": 1} | more)
        for function in (ut.cos_tilt, ut.outcome, ut.attitude, ut.count)
        for words, more in [
            ("", {"gravity": 9.0, "drop": 0.1, "tilt": 0.1, "body": "paper"}),
            (" by time", {"speed": None, "time": 1.0, "attitude": (1, 0, 0, 0)}),
            (" of attitudes", {"attitude": [(1, 0, 0, 0)]}),
            (" of turns", {"rate_x": None, "rate_y": None, "rate_z": None, "turn": 6.0, "psi": 1.0, "body": ["disc"]}),
            (" of moments", {"moments": [(1.0, 1.5)]}),
            (" by a solver", {"solver": "quaternion"}),
        ]
    },
}

PAIRS = [(name, argument) for name, (_, arguments) in CALLS.items() for argument in arguments]


@pytest.mark.parametrize(("name", "argument"), PAIRS, ids=lambda value: value)
@pytest.mark.filterwarnings("error")
def test_a_hostile_value_is_refused_by_the_name_of_its_argument(name, argument, tmp_path, monkeypatch, suite):
    # Some texts are names of folders.
    monkeypatch.chdir(tmp_path)
    call, right = CALLS[name]
    call(**right)
    refused = 0
    for words, value in HOSTILE.items():
        if argument in ("progress", "executor", "f") and callable(value):
            continue
        if argument == "only" and value is None:
            continue  # All checks, which test_verification.py runs.
        try:
            call(**(right | {argument: value}))
        except errors.SolveError:
            pass  # A number, and one with which no solver can go on.
        except errors.ProgramError:
            assert argument == "program"
        except errors.InputError as error:
            refused += 1
            # Without an argument, it may be another one that has no effect or is needed.
            assert error.field is not None and (value is None or error.field.split(" [")[0] == argument), (words, error)
        except OSError:
            assert argument == "folder"
        except BaseException as error:
            pytest.fail(f"{words}: {type(error).__name__}: {error}")
    assert refused >= (10 if argument in ("progress", "executor") else 20)


TEXTS = {"across", "up", "want", "solver", "method", "scheme", "formulation", "name", "body", "text", "folder", "program"}
TRUTHS = {"dense_output", "prove", "columns", "quick", "deep", "bodies"}
NO_NUMBERS = [
    "True", "numpy True", "b'x'", "1+2j", "masked", "datetime64", "timedelta64", "timedelta", "dict", "set", "truth values",
    "texts", "True in a list", "a text in a list", "masked in a list", "a span in a list", "a masked array", "objects",
    "complex numbers", "spans of time",
]  # fmt: skip


@pytest.mark.parametrize(("name", "argument"), [pair for pair in PAIRS if pair[1] not in TEXTS | TRUTHS], ids=lambda value: value)
def test_what_would_change_its_meaning_is_no_number(name, argument):
    call, right = CALLS[name]
    for words in NO_NUMBERS:
        with pytest.raises(errors.InputError) as caught:
            call(**(right | {argument: HOSTILE[words]}))
        assert isinstance(caught.value, errors.MalformedError | errors.PartError), words
    axes = ("rate_x", "rate_y", "rate_z", "turn", "psi", "speed", "gravity", "tilt", "drop")
    if argument not in axes or "Space" not in name:
        with pytest.raises(errors.InputError):
            call(**(right | {argument: "3"}))


EFFECTS = {
    "probability": (ut.probability, {"space": SPACE}),
    "probability of a plan": (ut.probability, {"space": SPACE, "plan": PLAN}),
    "probability of an enclosure": (ut.probability, {"space": SPACE, "plan": ut.Plan.enclosure(1e-3)}),
    "probability by a solver": (ut.probability, {"space": SPACE, "plan": PLAN, "solver": "gamma"}),
    "tally": (ut.tally, {"space": SPACE, "plan": PLAN}),
    "plan of a toss": (ut.plan, {"want": "tilt", "of": TOSS, "accuracy": 1e-6}),
    "plan of a space": (ut.plan, {"want": "probability", "of": SPACE, "accuracy": 1e-3}),
    "solve": (ut.solve, {"toss": TOSS, "t_eval": [0.1]}),
    "trace": (ut.trace, {"toss": TOSS, "points": 3}),
    "cos_tilt": (ut.cos_tilt, COLUMNS),
    "cos_tilt by time": (ut.cos_tilt, {"rate_x": 1.0, "rate_y": 1.0, "rate_z": 2.5, "time": 0.6}),
    "Toss": (ut.Toss, {"rate": (1, 1, 2.5), "speed": 3.0}),
    "attitude of turns": (ut.attitude, {"turn": 6.0, "psi": 1.2, "speed": 3.0}),
    "Toss by time": (ut.Toss, {"rate": (1, 1, 2.5), "time": 0.6}),
    "Solver": (ut.Solver, {"name": "euler"}),
    "exact": (ut.Solver, {"name": "exact"}),
    "Plan.exact_speed": (lambda **more: ut.Plan.exact_speed(**more).of(SPACE), {}),
    "rate_of_precession": (ut.rate_of_precession, {"turn": 20.0, "psi": 1.0}),
    "intervals": (ut.intervals, {"toss": ut.Toss((1, 1, 2.5), speed=3.0)}),
}
KEYWORDS = {
    "accuracy": 1e-2, "solver": "quaternion", "executor": one_thread, "shards": 3, "retries": 5, "scheme": "rk4", "rtol": 1e-3,
    "atol": 1e-3, "step": 0.1, "formulation": "vertical", "method": "RK45", "points": 4096, "dt": 0.25, "gravity": 5.0, "drop": 0.5,
    "tilt": 1.0, "attitude": (0.6, 0.8, 0, 0), "body": "us-quarter", "scrambles": 4, "seed": 3, "range": (0, 50), "slowest": 2.0,
    "turn": 7.0, "psi": 1.0, "moments": (1.0, 1.5), "rate_x": 1.0,
    "dense_output": True, "progress": None, "folder": None, "out": None, "threads": 1,
}  # fmt: skip
# They say how an answer is computed, or are where it comes from.
NO_ANSWERS = {"executor", "shards", "progress", "folder", "out", "threads"}


@pytest.mark.parametrize("name", EFFECTS)
def test_a_keyword_has_an_effect_or_is_refused(name):
    call, right = EFFECTS[name]
    keywords = KEYWORDS if "lambda" in getattr(call, "__name__", "") else set(inspect.signature(call).parameters) - set(right)
    for keyword in set(keywords) & set(KEYWORDS) - NO_ANSWERS:
        value = KEYWORDS[keyword]
        try:
            changed = call(**(right | {keyword: value}))
        except (TypeError, errors.TossError):
            continue
        assert np.any(changed != call(**right)), keyword


def test_every_public_callable_is_tried():
    kinds = (ut.Body, ut.Toss, ut.Solver, ut.Space, ut.Plan, ut.Tally)
    members = {(kind.__name__, name, callable(member)) for kind in kinds for name, member in inspect.getmembers(kind)}
    methods = {f"{kind}.{name}" for kind, name, is_method in members if is_method and not name.startswith("_")}
    answers = {"Choice", "Comparison", "Convergence", "Counts", "DenseOutput", "Estimate", "Intervals", "Inverse", "Landing", "Limit", "Map", "Margins", "MethodErrors", "PeopleSpread", "Sample", "Sensitivity", "Solution", "Spread", "SpreadAlone", "Power", "SameSideBias", "Trace", "Verification", "Work"}
    functions = {name for name in ut.__all__ if callable(getattr(ut, name))} - answers
    without_arguments = {"bodies", "models", "solvers", "spaces", "Plan", "Body", "Tally", "Plan.grid"}
    without_arguments |= {"Plan.to_json", "Space.to_json", "Tally.to_json"}
    tried = {words.split(" ")[0] for words in CALLS}
    assert (methods | functions) - without_arguments == tried
    for call, arguments in CALLS.values():
        # An argument that no call gives is one that another call of the same gives.
        names = set(inspect.signature(call).parameters) if call is not ut.Toss else set()
        given = {name for other, more in CALLS.values() if other == call for name in more}
        assert names - given <= {"out"}, (call, names - given)


class Labelled:
    """As a series of pandas, whose index is the order from behind: it gives values by label, and knows their positions."""

    def __init__(self, values):
        self.values = list(values)

    def __len__(self):
        return len(self.values)

    def __getitem__(self, label):
        return self.values[len(self.values) - 1 - label]

    def __iter__(self):
        return iter(self.values)

    def to_numpy(self):
        return np.array(self.values)


def series(values):
    return pandas.Series(values, index=range(len(values))[::-1])


def of_another_type(values):
    return [np.float32(value) for value in values]


def memory(values):
    return memoryview(np.array(values))


@pytest.mark.parametrize("make", [tuple, list, np.array, Labelled, series, memory, of_another_type])
def test_a_vector_is_read_by_position(make):
    expected = ut.Toss((3.0, 2.0, 1.0), speed=3)
    assert ut.Toss(make([3.0, 2.0, 1.0]), speed=3) == expected and expected.rate == [3.0, 2.0, 1.0]
    turned = ut.Toss((3.0, 2.0, 1.0), speed=3, attitude=make([4.0, 3.0, 2.0, 1.0]))
    assert turned == ut.Toss((3.0, 2.0, 1.0), speed=3, attitude=(4.0, 3.0, 2.0, 1.0))
    assert ut.Body.from_moments(make([3.0, 2.0, 1.5])) == ut.Body.from_moments((3.0, 2.0, 1.5))
    rows = [[2.0, 0.125, 0.25], [0.125, 2.5, 0.375], [0.25, 0.375, 3.0]]
    assert ut.Body.from_tensor([make(row) for row in rows]) == ut.Body.from_tensor(rows)
    assert ut.Space(**(AXES | {"rate_x": make([1.0, 2.0])})) == ut.Space(**(AXES | {"rate_x": (1, 2)}))
    assert (ut.cos_tilt(make([3.0, 2.0, 1.0]), 1, 1, 3) == ut.cos_tilt([3.0, 2.0, 1.0], 1, 1, 3)).all()
    assert (ut.solve(TOSS, t_eval=make([0.0, 0.25, 0.5])).t == [0.0, 0.25, 0.5]).all()


def test_a_frame_is_read_by_position():
    rows = [[2.0, 0.125, 0.25], [0.125, 2.5, 0.375], [0.25, 0.375, 3.0]]
    frame = pandas.DataFrame(rows, index=[2, 1, 0], columns=[2, 1, 0])
    assert ut.Body.from_tensor(frame) == ut.Body.from_tensor(rows)
    with pytest.raises(errors.MalformedError):
        ut.Toss(frame, speed=3)


COUNTS = [2, np.int8(2), np.uint64(2), np.array(2)]
NUMBERS = [2.0, np.float64(2), np.float32(2), np.longdouble(2), np.array(2.0), fractions.Fraction(2), decimal.Decimal(2)]


@pytest.mark.parametrize("number", COUNTS + NUMBERS, ids=repr)
def test_real_numbers_of_every_type_are_taken(number):
    assert ut.Toss((number, 1, 1), speed=number) == ut.Toss((2, 1, 1), speed=2)
    assert ut.Space(**(AXES | {"speed": number})) == ut.Space(**(AXES | {"speed": 2}))
    assert ut.cos_tilt(number, 1, 1, [number, 3.0])[0] == ut.cos_tilt(2, 1, 1, 2)


@pytest.mark.parametrize("number", COUNTS, ids=repr)
def test_whole_numbers_of_every_type_are_counts_and_no_others(number):
    assert ut.Plan.random(number, seed=number) == ut.Plan.random(2, seed=2)
    for other in NUMBERS:
        with pytest.raises(errors.MalformedError):
            ut.Plan.random(other)


@pytest.mark.parametrize(
    ("call", "field", "index"),
    [
        (lambda: ut.Toss([1.0, True, 2.0], speed=3), "rate", 1),
        (lambda: ut.Toss([1.0, 2.0, math.nan], speed=3), "rate", 2),
        (lambda: ut.Toss([1, 2, 3], speed=3, attitude=[1, 0, 0, "0"]), "attitude", 3),
        (lambda: ut.Body.from_moments(np.ma.masked_greater([1.0, 2.0, 1.5], 1.7)), "moments", 1),
        (lambda: ut.Body.from_tensor([[1, 0, 0], [0, 1, None], [0, 0, 1]]), "tensor", 5),
        (lambda: ut.Space(**(AXES | {"rate_x": (1, 2j)})), "rate_x", 1),
        (lambda: ut.cos_tilt([1.0, 2.0, True], 1, 1, 3), "rate_x", 2),
        (lambda: ut.cos_tilt(1, [[1.0, 2.0], [3.0, "4"]], 1, 3), "rate_y", 3),
        (lambda: ut.cos_tilt(1, 1, np.array([1.0, 2.0, "3"], dtype=object), 3), "rate_z", 2),
        (lambda: ut.cos_tilt(1, 1, 1, np.ma.masked_greater([1.0, 2.0, 1.5], 1.7)), "speed", 1),
        (lambda: ut.cos_tilt(1, 1, 1, time=[1.0, 10**400]), "time", 1),
        (lambda: ut.solve(TOSS, t_eval=[0.0, 0.2, 0.1]), "t_eval [s]", 2),
        (lambda: ut.solve(TOSS, t_eval=[0.0, 0.2, "0.3"]), "t_eval [s]", 2),
        (lambda: ut.merge([TALLY, 3]), "parts", 1),
    ],
)
def test_an_element_is_named_by_its_position(call, field, index):
    with pytest.raises(errors.InputError) as caught:
        call()
    assert (caught.value.field, caught.value.index) == (field, index)


def test_lists_of_numbers_of_mixed_types_are_columns():
    mixed = [1, 2.5, np.float32(3.0), fractions.Fraction(7, 2), np.int16(4)]
    assert (ut.cos_tilt(mixed, 1, 1, 3) == ut.cos_tilt([1.0, 2.5, 3.0, 3.5, 4.0], 1, 1, 3)).all()
    lists = [[random.random() for _ in range(7)] for _ in range(5)]
    assert (ut.cos_tilt(lists, 1, 1, 3) == ut.cos_tilt(np.array(lists), 1, 1, 3)).all()
    assert (ut.cos_tilt([np.array(row) for row in lists], 1, 1, 3) == ut.cos_tilt(np.array(lists), 1, 1, 3)).all()


@pytest.mark.parametrize("read", [ut.Space.from_json, ut.Plan.from_json, ut.Tally.from_json])
@pytest.mark.parametrize(("text", "line"), [("", 1), ("[[1]]", 1), ("null", 1), ("{", 1), ('{\n"coin": x}', 2)])
def test_a_fault_in_json_has_a_place_and_is_in_words(read, text, line):
    with pytest.raises(errors.TextError, match=rf"^line {line}, column \d+: ") as caught:
        read(text)
    assert not re.search("struct|Data|EOF| at line", str(caught.value)), caught.value


@pytest.mark.parametrize("name", ["\x1b[31m\n", "a\u202eb", "a\0\r", "\x85\u2028", "\ufeff", "\x1b]0;title\x07"])
def test_a_message_is_one_line_that_can_be_printed(name, tmp_path):
    def folder():
        part = tmp_path / name.replace("\0", "") / "part-1-of-1.json"
        part.parent.mkdir()
        part.write_text("x")
        ut.probability(SPACE, PLAN, folder=part.parent, shards=1)

    calls = [lambda: ut.Body.named(name), lambda: ut.Space(**(AXES | {"speed": name})), lambda: ut.Space.from_toml(f'"{name}"=1'), folder]
    for call in calls:
        with pytest.raises(errors.InputError) as caught:
            call()
        assert str(caught.value).isprintable(), caught.value
