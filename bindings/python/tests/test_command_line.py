"""Each command and option of the command line has a function and a keyword, or a reason, and the same answer without options."""

import inspect
import re
import subprocess

import numpy as np
import pytest

import unfair_toss as ut

OF_A_BODY = {
    "coin": "Toss.body",
    "cylinder": "Body.cylinder.mass",
    "moments": "Body.from_moments.moments",
    "inertia": "Body.from_tensor.tensor",
}
OF_A_TOSS = OF_A_BODY | {
    "rate": "Toss.rate",
    "turn": "rate_of_precession.turn",
    "psi": "rate_of_precession.psi",
    "speed": "Toss.speed",
    "time": "Toss.time",
    "gravity": "Toss.gravity",
    "drop": "Toss.drop",
    "tilt": "Toss.tilt",
    "attitude": "Toss.attitude",
    "drag": "none: it is there to be refused",
    "bounce": "none: it is there to be refused",
}
OF_A_SPACE = OF_A_BODY | {
    name.replace("_", "-"): f"Space.{name}"
    for name in ("rate_x", "rate_y", "rate_z", "turn", "psi", "speed", "gravity", "tilt", "drop")
} | {"space": "Space.named.name", "spread": "Space.with_spread.spread"}
OF_A_SOLVER = {
    "solver": "Solver.name",
    "scheme": "Solver.scheme",
    "tolerance": "Solver.rtol",
    "step": "Solver.step",
    "formulation": "Solver.formulation",
}
OF_A_PLAN = {"method": "none: each method is a function of Plan", "points": "Plan.random.points", "seed": "Plan.random.seed"}
ALL = {
    "help": "none: help(ut) has it",
    "format": "none: an answer is an object",
    "svg": "none: .plot() and .to_pandas() of an answer",
    "seconds": "none: Ctrl-C ends a call, and parts keep what is known",
    "threads": "{}.threads",
}
PROVE = "none: by Plan.enclosure, or each toss with toss.prove"

COMMANDS = {
    "toss": ("toss", OF_A_TOSS | OF_A_SOLVER | {"prove": "toss.prove", "margin": "margins.toss"}),
    "trace": ("trace", OF_A_TOSS | OF_A_SOLVER | {"points": "trace.points", "dt": "trace.dt", "prove": PROVE}),
    "probability": (
        "probability",
        OF_A_SPACE | OF_A_SOLVER | OF_A_PLAN
        | {"accuracy": "probability.accuracy", "shard": "tally.range", "out": "probability.folder", "prove": PROVE},
    ),
    "sample": ("sample", OF_A_SPACE | OF_A_SOLVER | {name: f"sample.{name}" for name in ("points", "method", "seed")}),
    "compare": (
        "compare",
        OF_A_TOSS
        | {"tolerance": "compare.rtol", "step": "compare.step", "formulation": "compare.formulation"}
        | {"repeats": "none: timeit measures times"},
    ),
    "spread": ("spread", OF_A_TOSS | {name: f"spread.{name}" for name in ("heads", "points", "seed")}),
    "convergence": (
        "convergence", OF_A_SPACE | OF_A_SOLVER | {name: f"convergence.{name}" for name in ("steps", "seed")},
    ),
    "errors": (
        "sampling_errors",  # `errors` is the module of exceptions.
        OF_A_SPACE | {name.replace("_", "-"): f"sampling_errors.{name}" for name in ("replicates", "up_to", "reference")},
    ),
    "map": ("map", OF_A_SPACE | OF_A_SOLVER | OF_A_PLAN | {"across": "map.across", "up": "map.up"}),
    "merge": ("merge", {"allow-gaps": "none"}),
    "intervals": ("intervals", OF_A_TOSS),
    "inverse": ("inverse", OF_A_BODY | {"probability": "inverse.probability", "counts": "inverse.counts"}),
    "power": ("power", {name: f"power.{name}" for name in ("share", "sd", "power", "people", "flips")}),
    "limit": ("limit", OF_A_BODY | OF_A_SOLVER | {"points": "limit.points", "seed": "limit.seed"}),
    "plan": (
        "plan",
        OF_A_TOSS | OF_A_SPACE
        | {name: f"plan.{name}" for name in ("want", "accuracy", "points", "solver", "scheme")}
        | {"scene": "none: a Toss or a Space is the scene", "prove": "none: toss.prove proves what was planned"}
        | {name: OF_A_TOSS[name] for name in ("speed", "gravity", "drop", "tilt", "turn", "psi")},
    ),
    "coins": ("bodies", {}),
    "solvers": ("solvers", {}),
    "models": ("models", {}),
    "spaces": ("spaces", {}),
    "completions": (None, {}),
    "man": (None, {}),
}

OF_THE_SUITE = {
    name: f"verify.{name.replace('-', '_')}"
    for name in ("quick", "deep", "only", "bodies", "claim", "answer-seconds", "total-seconds", "time-factor")
} | {
    "out": "verify.folder",
    "command": "none: it is the function",
    "memory-mb": "none: the function is in this process",
    "bless": "none: a baseline is of a program, by --command",
    "validation": "none: the same",
    "worse-above": "none: the same",
    "verbose": "none: a Verification has all rows",
    "list": "none: verification.md",
    "replay": "none: f(toss)",
    "row": "none: the same",
    "resume": "none: not with --command, either",
}


def help_of(program: str, *command: str) -> str:
    return subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True).stdout


def test_every_command_has_a_function(program):
    listed = re.search(r"Commands:\n(.*?)\n\n", help_of(program), re.DOTALL)[1]
    assert {name for name in re.findall(r"^  (\w+)", listed, re.MULTILINE)} - {"help"} == set(COMMANDS)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_option_has_a_keyword_or_a_reason(command, program):
    function, spelled = COMMANDS[command]
    if function is None:
        return
    assert callable(getattr(ut, function))
    each_has_a_counterpart(help_of(program, command), function, spelled)


def test_every_option_of_the_suite_has_a_keyword_or_a_reason(suite):
    each_has_a_counterpart(help_of(suite), "verify", OF_THE_SUITE)


def each_has_a_counterpart(text: str, function: str, spelled: dict[str, str]) -> None:
    options = set(re.findall(r"^ +(?:-\w, )?--([a-z-]+)", text, re.MULTILINE))
    known = ALL | spelled
    assert not options - set(known), "options without a counterpart"
    for option in options:
        if known[option].startswith("none"):
            continue
        *path, keyword = known[option].format(function).split(".")
        thing = ut
        for name in path:
            thing = getattr(thing, name)
        assert keyword in inspect.signature(thing).parameters, f"--{option}: {known[option]}"


RATE = ("--rate", "20,3,30", "--speed", "2.4")
TOSS = ut.Toss((20.0, 3.0, 30.0), speed=2.4)
AXES = ("--rate-x", "20:60:9", "--rate-y", "0", "--rate-z", "5:15:5", "--speed", "3:5:7")
FIG4 = ut.Space.named("paper-fig4")
SPACE = ut.Space(rate_x=(20, 60, 9), rate_y=0, rate_z=(5, 15, 5), speed=(3, 5, 7))


def rows_of(table) -> list[dict]:
    return [dict(zip(table.to_dict(), row, strict=True)) for row in zip(*table.to_dict().values(), strict=True)]


def are_same(found: list[dict], expected: list[dict]) -> None:
    assert len(found) == len(expected) > 0
    for one, other in zip(found, expected, strict=True):
        for name in set(one) & set(other) - {"failure"}:
            empty = other[name] is None and (one[name] in ("", 0) or np.isnan(one[name]))
            assert one[name] == other[name] or empty, name


def test_series_without_options_have_the_same_numbers(ask):
    limit, steps = ut.limit(threads=1), ut.convergence(SPACE)
    are_same(rows_of(limit), ask("limit")["series"])
    are_same(rows_of(steps), ask("convergence", *AXES)["series"])
    space = ut.Space(rate_x=(20, 60), rate_y=0, rate_z=(5, 15), speed=(3, 5))
    axes = [text.rsplit(":", 1)[0] if text.count(":") == 2 else text for text in AXES]
    are_same(rows_of(ut.sampling_errors(space, up_to=9)), ask("errors", *axes, "--up-to", "9")["series"])
    are_same(rows_of(ut.compare(TOSS)), ask("compare", *RATE, "--repeats", "0")["rows"])


def test_a_sample_has_the_rows_of_the_command_line(program):
    import csv

    for options, sample in [
        (("--points", "40"), ut.sample(SPACE, 40)),
        (("--points", "16", "--method", "sobol", "--seed", "3"), ut.sample(SPACE, 16, method="sobol", rng=3)),
        (("--points", "9", "--solver", "quaternion"), ut.sample(SPACE, 9, solver="quaternion")),
    ]:
        axes = [text.rsplit(":", 1)[0] if text.count(":") == 2 else text for text in AXES]
        text = subprocess.check_output([program, "sample", *axes, *options], text=True)
        rows = list(csv.DictReader(text.splitlines()))
        assert len(rows) == len(sample)
        for name, own in {"wx": "rate_x", "wz": "rate_z", "speed": "speed", "cos_tilt": "cos_tilt"}.items():
            assert ([float(row[name]) for row in rows] == getattr(sample, own)).all()
        outcomes = [{1: "heads", -1: "tails", 0: "undecided"}[outcome] for outcome in sample.outcome]
        assert [row["outcome"] for row in rows] == outcomes
        assert [row["certified"] == "true" for row in rows] == sample.certified.tolist()
    columns = [getattr(sample, name) for name in ("rate_x", "rate_y", "rate_z", "speed")]
    assert (ut.outcome(*columns, gravity=sample.gravity, tilt=sample.tilt) == sample.outcome).all()


def test_other_answers_without_options_are_the_same(ask):
    found, expected = ut.map(SPACE), ask("map", *AXES[:-1], "3:5")
    assert (found.probability == np.array(expected["probability"])).all() and found.across == expected["across"]
    assert (found.to_xarray().sel(rate_z=5.0) == found.to_pandas().loc[5.0].to_numpy()).all()
    toss = ("--coin", "us-quarter", "--rate", "20,0,30", "--speed", "2.4")
    for heads, options in [(0.9, {}), (0.99, {"points": 64, "seed": 2})]:
        typed = [text for name, value in options.items() for text in (f"--{name}", str(value))]
        spread = ut.spread(ut.Toss((20.0, 0.0, 30.0), speed=2.4, body="us-quarter"), heads, **options)
        expected = ask("spread", *toss, "--heads", str(heads), *typed)
        assert (spread.answer, spread.spread, spread.looks) == tuple(expected[name] for name in ("answer", "spread", "looks"))
        assert [one.spread for one in spread.alone] == [one["spread"] for one in expected["alone"]]
    proven, expected = ut.toss(TOSS, "quaternion", prove=True), ask("toss", *RATE, "--solver", "quaternion", "--prove")
    for name in ("certified", "cos_tilt", "error_bound", "attitude_error_bound", "outcome", "scheme"):
        assert getattr(proven, name) == expected[name]
    assert proven.certified and proven.proven_by == "integrated"
    book = ut.Toss((20.0, 3.0, 30.0), speed=2.4, body="racket")
    assert list(ut.sensitivity(book).rate) == ask("toss", *RATE, "--coin", "racket")["sensitivity"]["rate"]
    assert [name for name, *_ in ut.models()] == [model["name"] for model in ask("models")["models"]]
    hand = ut.probability(ut.Space(rate_x=20, rate_y=3, rate_z=30, speed=2.4).with_spread(0.05), ut.Plan.random())
    typed = ("--rate-x", "20", "--rate-y", "3", "--rate-z", "30", "--speed", "2.4", "--spread", "0.05")
    assert hand.heads == ask("probability", *typed, "--method", "random")["heads"]


def test_counts_of_people_come_from_a_frame_too():
    pandas = pytest.importorskip("pandas")
    people = {"person": ["a", "b", "a"], "same": [60, 52, 50], "tosses": [100, 100, 100]}
    added = ut.same_side_bias([110, 52], [200, 100])
    assert ut.inverse(counts=pandas.DataFrame(people)) == added
    polars = pytest.importorskip("polars")
    assert ut.inverse(counts=polars.DataFrame(people)) == added
    assert ut.inverse(counts=(110, 200)) == ut.same_side_bias(110, 200)
    for wrong in (3, {"same": [1]}, (1, 2, 3)):
        with pytest.raises(ut.errors.MalformedError, match="counts"):
            ut.inverse(counts=wrong)
    with pytest.raises(ut.errors.InputError):
        ut.inverse()


def test_a_table_is_read_by_pandas_polars_and_arrow():
    space = ut.Space(rate_x=(20, 60), rate_y=0, rate_z=(5, 15), speed=(3, 5))
    sample = ut.sample(space, 30, seed=np.random.SeedSequence(4))
    assert sample == ut.sample(space, 30, rng=np.random.SeedSequence(4)) != ut.sample(space, 30, seed=5)
    assert sample._repr_html_().count("<tr>") == 21 and "first 20 of 30 rows" in sample._repr_html_()
    assert repr(sample).startswith("Sample(30 rows: rate_x,") and len(sample) == 30
    pandas = pytest.importorskip("pandas")
    frame = sample.to_pandas()
    again = ut.cos_tilt(frame.rate_x, frame.rate_y, frame.rate_z, frame.speed, gravity=frame.gravity, tilt=frame.tilt)
    assert isinstance(again, pandas.Series) and np.abs(again - frame.cos_tilt).max() < 1e-15
    dropped = ut.sample(space.with_drop((0, 1)), 30, seed=4)
    assert 0 < np.ptp(dropped.drop) < 1 and not sample.drop.any()
    columns = {name: getattr(dropped, name) for name in ("rate_x", "rate_y", "rate_z", "speed", "gravity", "drop", "tilt")}
    assert np.abs(ut.cos_tilt(**columns) - dropped.cos_tilt).max() < 2e-15
    polars, pyarrow = pytest.importorskip("polars"), pytest.importorskip("pyarrow")
    assert polars.DataFrame(sample)["cos_tilt"].to_list() == sample.cos_tilt.tolist()
    assert pyarrow.table(sample).column_names == list(frame.columns)
    own = polars.DataFrame(sample)
    faces = ut.outcome(own["rate_x"], own["rate_y"], own["rate_z"], own["speed"])
    assert own.with_columns(faces=faces)["faces"].to_list() == sample.outcome.tolist()
    with pytest.raises(ut.errors.MalformedError, match="rng"):
        ut.sample(space, 30, seed=1, rng=2)


def test_ends_of_intervals_are_shown_with_all_digits():
    found = ut.intervals(ut.Toss((90.0, 0.0, 20.0), speed=2.4, body="us-quarter"), 2.0)
    assert repr(found.heads.tolist()[-1][0]) in repr(found).replace("\n", "")
    shown = ut.results._short(np.array([1 / 3, 2 / 3]))
    assert [float(text) for text in shown.strip("[]").split()] == [1 / 3, 2 / 3]


def test_proofs_by_integration_are_those_of_the_command_line(ask):
    toss = ut.Toss((20.0, 0.0, 30.0), speed=2.4, body="us-quarter")
    options = ("--solver", "quaternion", "--prove")
    points = ask("trace", "--coin", "us-quarter", "--rate", "20,0,30", "--speed", "2.4", "--points", "5", *options)["points"]
    found = ut.trace(toss, 5, solver="quaternion", prove=True)
    for name in ("error_bound", "attitude_error_bound", "cos_tilt"):
        assert getattr(found, name).tolist() == [point[name] for point in points]
    assert (np.abs(found.cos_tilt - ut.trace(toss, 5).cos_tilt) <= found.error_bound).all()
    assert ut.trace(toss, 5).error_bound is None and "error_bound" in found.to_pandas()
    answer = ask("probability", "--space", "paper-fig4", "--method", "random", "--points", "300", *options)
    proven = ut.probability(FIG4, ut.Plan.random(300), solver="quaternion", prove=True)
    assert (proven.heads, proven.certified, proven.integrated_by) == (answer["heads"], answer["certified"], answer["integrated_by"])
    assert proven.certified and sum(proven.integrated_by.values()) == 300 and proven.proven_by is None
    assert not ut.probability(FIG4, ut.Plan.random(300), solver="quaternion").certified
    for settings, field in [({"solver": "gamma"}, "solver"), ({"solver": None}, "prove")]:
        with pytest.raises(ut.errors.MalformedError) as caught:
            ut.probability(FIG4, ut.Plan.random(300), prove=True, **settings)
        assert caught.value.field == field
