"""Probabilities and their parts: the counts of the command line, whatever computes them and whoever dies."""

import json
import math
import os
import subprocess
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

import unfair_toss as ut
from unfair_toss import errors, parts

FIG4 = ut.Space.named("paper-fig4")
RANDOM = ut.Plan.random(1_000_003, seed=5)
PLANS = {
    "grid": ut.Plan.grid(),
    "random": RANDOM,
    "sobol": ut.Plan.sobol(1 << 14, seed=5),
    "exact-speed": ut.Plan.exact_speed(1 << 10, seed=5),
}


def processes():
    """Two processes that share nothing with this one."""
    return ProcessPoolExecutor(2, mp_context=get_context("spawn"))


@pytest.mark.parametrize("method", PLANS)
def test_an_estimate_has_the_numbers_of_the_command_line(ask, method):
    points = {"grid": [], "random": ["1000003"], "sobol": ["16384"], "exact-speed": ["1024"]}[method]
    options = ["--points", *points, "--seed", "5"] if points else []
    expected = ask("probability", "--space", "paper-fig4", "--method", method, *options)
    found = ut.probability(FIG4, PLANS[method])
    assert (found.probability, found.points) == (expected["probability"], expected["points"])
    assert found.interval == (expected["interval"] and tuple(expected["interval"]))
    assert (found.interval_kind, found.certified) == (expected["interval_kind"], expected["certified"])
    assert [found.heads, found.tails] == [expected.get("heads"), expected.get("tails")]
    assert found.proven_by == expected.get("proven_by") and found.plan == PLANS[method]
    if method == "exact-speed":
        assert found.half_width == expected["error_bound"]


def test_a_space_may_be_of_any_body():
    book = ut.Space(rate_x=(0, 9), rate_y=5, rate_z=0.1, speed=(3, 5), body=ut.Body.from_moments((1, 2, 2.8)))
    whole = ut.probability(book, ut.Plan.random(2000))
    assert whole.certified and whole.points == 2000
    halves = [ut.tally(book, ut.Plan.random(2000), half) for half in ((0, 1000), (1000, 2000))]
    assert ut.merge(halves) == whole


def test_an_accuracy_chooses_the_plan_of_the_command_line(ask):
    expected = ask("probability", "--space", "paper-fig4", "--accuracy", "1e-5")
    found = ut.probability(FIG4, accuracy=1e-5)
    assert (found.probability, found.plan.method) == (expected["probability"], expected["method"])
    assert found.half_width < 1e-5


def test_an_enclosure_is_proven_and_has_no_parts(ask):
    expected = ask("probability", "--space", "paper-fig4", "--method", "enclosure", "--accuracy", "1e-9")
    found = ut.probability(FIG4, ut.Plan.enclosure(1e-9))
    assert (found.probability, found.interval_kind) == (expected["probability"], "proven")
    assert found.interval == tuple(expected["interval"]) and expected["proven"]
    assert found.certified and expected["certified"] and found.proven_by is None
    for refused in ({"shards": 2}, {"progress": print}):
        with pytest.raises(errors.OutsideModelError):
            ut.probability(FIG4, ut.Plan.enclosure(), **refused)
    with pytest.raises(errors.OutOfRangeError):
        ut.Plan.enclosure(0.0)


def test_a_space_takes_numbers_tuples_and_texts():
    by_number = ut.Space(rate_x=(0, 50, 500), rate_y="x", rate_z=30, speed=(3, 5, 500))
    by_text = ut.Space(rate_x="0:50:500", rate_y="x", rate_z="30", speed="3:5:500")
    assert by_number == by_text == FIG4 and by_number != FIG4.with_body("us-quarter")
    assert ut.Space(rate_x="1rev/s", rate_y=0, rate_z=0, speed=1) != ut.Space(rate_x=1, rate_y=0, rate_z=0, speed=1)
    for changes, field in [
        ({"rate_x": (5, 1)}, "rate_x [rad/s]"),
        ({"speed": -1}, "speed [m/s]"),
        ({"rate_z": [1, 2, 3, 4]}, "rate_z"),
        ({"rate_z": None}, "rate_z [rad/s]"),
        ({"turn": 1}, "rate_x [rad/s]"),
        ({"rate_y": "sideways"}, "rate_y [rad/s]"),
        ({"drop": -10.0}, "drop [m]"),
    ]:
        with pytest.raises(errors.InputError) as caught:
            ut.Space(**({"rate_x": 1, "rate_y": 1, "rate_z": 1, "speed": 1} | changes))
        assert caught.value.field == field


def test_a_space_of_turns_and_angles_is_that_of_the_command_line(ask):
    axes = {"turn": "normal:38rev/s:0.5rev/s", "psi": "normal:70deg:2deg", "speed": "2.3:2.5"}
    space = ut.Space(**axes, body="us-quarter")
    assert ut.Space.from_json(space.to_json()) == space
    options = [part for name, text in axes.items() for part in (f"--{name}", text)]
    expected = ask("probability", "--coin", "us-quarter", *options, "--method", "enclosure", "--accuracy", "1e-5")
    found = ut.probability(space, ut.Plan.enclosure(1e-5))
    assert list(found.interval) == expected["interval"] and found.probability == expected["probability"]
    with pytest.raises(errors.InputError, match="n of a body with I1 ≠ I2"):
        space.with_body(ut.Body.from_moments((1, 2, 2.5)))


@pytest.mark.parametrize("method", PLANS)
def test_any_partition_gives_the_estimate_of_the_whole(method):
    plan = PLANS[method]
    points, whole = plan.points(FIG4), ut.probability(FIG4, plan)
    edges = [0, 1, points // 3, points // 3, points // 2 + 1, points]
    tallies = [ut.tally(FIG4, plan, edge) for edge in zip(edges, edges[1:], strict=False)]
    for order in (tallies, tallies[::-1], sorted(tallies, key=lambda part: str(part.range)[::-1])):
        assert ut.merge(order) == whole
    assert ut.estimate(tallies[0] + tallies[1] + (tallies[4] + tallies[3] + tallies[2])) == whole
    read = [ut.Tally.from_json(part.to_json()) for part in tallies]
    merged = ut.merge(read)
    assert (merged.probability, merged.interval, merged.heads) == (whole.probability, whole.interval, whole.heads)
    assert not merged.certified  # A file proves nothing.


def test_parts_that_do_not_fit_are_refused():
    first, second, other = (
        ut.tally(FIG4, RANDOM, (0, 500_000)),
        ut.tally(FIG4, RANDOM, range(500_000, 1_000_003)),
        ut.tally(FIG4, ut.Plan.random(1_000_003, seed=6), (500_000, 1_000_003)),
    )
    assert ut.merge([second, first]).points == 1_000_003
    for wrong in ([], [first], [second], [first, first, second], [first, other], [first, ut.tally(FIG4, RANDOM, (9, 99)), second]):
        with pytest.raises(errors.PartError):
            ut.merge(wrong)
    with pytest.raises(errors.MalformedError, match="share no launch"):
        first + first
    for wrong in [(5, 1), (0, 1_000_004), (-1, 5), range(0, 10, 2)]:
        with pytest.raises(errors.MalformedError) as caught:
            ut.tally(FIG4, RANDOM, wrong)
        assert caught.value.field == "range"
    for nothing in (1, 0.5, False):
        with pytest.raises(TypeError):
            nothing + first
    with pytest.raises(TypeError):
        first + 1


def test_parts_add_up_by_sum():
    tallies = [ut.tally(FIG4, RANDOM, edge) for edge in ((0, 9), (9, 500_000), (500_000, 1_000_003))]
    assert ut.estimate(sum(tallies)) == ut.probability(FIG4, RANDOM)


@pytest.mark.parametrize("make", [lambda: ThreadPoolExecutor(3), processes], ids=["threads", "processes"])
def test_any_executor_gives_the_same_counts(make, tmp_path):
    whole, reports = ut.probability(FIG4, RANDOM), []
    with make() as executor:
        found = ut.probability(
            FIG4, RANDOM, executor=executor, shards=13, progress=lambda *done: reports.append(done), folder=tmp_path
        )
    assert (found.heads, found.tails, found.interval) == (whole.heads, whole.tails, whole.interval)
    assert len(reports) == 13 and reports[-1] == (1_000_003, 1_000_003) and reports == sorted(reports)
    assert len(list(tmp_path.iterdir())) == 13


def dying(space, plan, start, end, threads):
    """A worker that dies at its first part, and another time in the middle."""
    mark = Path(os.environ["UNFAIR_TOSS_TEST_MARK"]) / str(start)
    if start in (0, parts_start(plan, 7)) and not mark.exists():
        mark.touch()
        os._exit(9)
    return original(space, plan, start, end, threads)


def parts_start(plan, shard):
    return plan.points(FIG4) * shard // 13


original = parts.compute


def test_the_death_of_a_worker_changes_no_count(tmp_path, monkeypatch):
    monkeypatch.setenv("UNFAIR_TOSS_TEST_MARK", str(tmp_path))
    monkeypatch.setattr(parts, "compute", dying)
    whole = ut.probability(FIG4, RANDOM)
    found = ut.probability(FIG4, RANDOM, executor=processes, shards=13)
    assert (found.heads, found.tails) == (whole.heads, whole.tails)
    assert {mark.name for mark in tmp_path.iterdir()} == {"0", str(parts_start(RANDOM, 7))}


def failing(space, plan, start, end, threads):
    raise OSError("no such machine")


def test_a_part_that_always_fails_ends_the_run_and_what_is_done_is_kept(tmp_path, monkeypatch):
    calls = []

    def at_times(space, plan, start, end, threads):
        calls.append(start)
        if start == parts_start(RANDOM, 4):
            raise OSError("no such machine")
        return original(space, plan, start, end, threads)

    monkeypatch.setattr(parts, "compute", at_times)
    with ThreadPoolExecutor(1) as executor, pytest.raises(OSError, match="no such machine"):
        ut.probability(FIG4, RANDOM, executor=executor, shards=13, retries=2, folder=tmp_path)
    assert calls.count(parts_start(RANDOM, 4)) == 3
    kept = len(list(tmp_path.iterdir()))
    assert kept == 12
    monkeypatch.setattr(parts, "compute", original)
    again = []
    found = ut.probability(FIG4, RANDOM, shards=13, folder=tmp_path, progress=lambda done, _: again.append(done))
    assert found.heads == ut.probability(FIG4, RANDOM).heads


def test_a_part_that_is_there_is_not_computed_again_and_a_wrong_one_is_refused(tmp_path, monkeypatch):
    found = ut.probability(FIG4, RANDOM, shards=5, folder=tmp_path)
    monkeypatch.setattr(parts, "compute", failing)
    again = ut.probability(FIG4, RANDOM, shards=5, folder=tmp_path)
    assert (again.heads, again.tails, again.interval) == (found.heads, found.tails, found.interval)
    assert found.certified and not again.certified  # A file proves nothing.
    for path in tmp_path.iterdir():
        path.write_text("\ufeff" + path.read_text(encoding="utf-8"), encoding="utf-8")  # As some editors do.
    assert ut.probability(FIG4, RANDOM, shards=5, folder=tmp_path).heads == found.heads
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == [f"part-{index}-of-5.json" for index in range(1, 6)]
    (tmp_path / names[0]).write_text((tmp_path / names[1]).read_text())
    with pytest.raises(errors.PartError, match="part-1-of-5.json: it holds another part"):
        ut.probability(FIG4, RANDOM, shards=5, folder=tmp_path)
    right = (tmp_path / names[1]).read_bytes()
    for content in (b"", b"{}", b"[]", b"\xff\xfe\0", right[:-9], "é".encode("latin-1"), right.decode().encode("utf-16"), (tmp_path / names[1]).read_bytes()):
        (tmp_path / names[0]).write_bytes(content)
        with pytest.raises(errors.PartError, match="part-1-of-5.json: .*; remove it to compute it"):
            ut.probability(FIG4, RANDOM, shards=5, folder=tmp_path)
    (tmp_path / names[0]).unlink()
    (tmp_path / names[1]).write_bytes(b"\xef\xbb\xbf" + right)  # As editors of Windows write it.
    monkeypatch.setattr(parts, "compute", original)
    assert ut.probability(FIG4, RANDOM, shards=5, folder=tmp_path).heads == found.heads
    mask = os.umask(0o022)
    os.umask(mask)
    assert (tmp_path / names[0]).stat().st_mode & 0o777 == 0o666 & ~mask
    assert sorted(path.name for path in tmp_path.iterdir()) == names


@pytest.mark.parametrize("field", ["heads", "tails", "streams", "digest"])
def test_a_part_with_a_changed_digit_is_refused_with_its_file(tmp_path, field):
    ut.probability(FIG4, RANDOM, shards=2, folder=tmp_path)
    path = tmp_path / "part-2-of-2.json"
    text = path.read_text()
    head, value = text.split(f'"{field}":', 1)
    at = next(index for index, character in enumerate(value) if character.isdigit())
    changed = value[:at] + str((int(value[at]) + 1) % 10) + value[at + 1 :]
    path.write_text(f'{head}"{field}":{changed}')
    with pytest.raises(errors.PartError, match="part-2-of-2.json: .*digest"):
        ut.probability(FIG4, RANDOM, shards=2, folder=tmp_path)
    with pytest.raises(errors.InputError, match="digest"):
        ut.Tally.from_json(path.read_text())


@pytest.mark.skipif(os.name == "nt", reason="the system has no umask")
@pytest.mark.parametrize("umask", [0o022, 0o027])
def test_a_part_is_as_readable_as_any_new_file(tmp_path, umask):
    before = os.umask(umask)
    try:
        ut.probability(FIG4, RANDOM, shards=2, folder=tmp_path)
    finally:
        os.umask(before)
    assert {path.stat().st_mode & 0o777 for path in tmp_path.iterdir()} == {0o666 & ~umask}


def lying(space, plan, start, end, threads):
    return original(space, plan, 0, end - start, threads)


def test_a_worker_that_answers_with_another_part_is_found_out(monkeypatch):
    monkeypatch.setattr(parts, "compute", lying)
    with ThreadPoolExecutor(1) as executor, pytest.raises(errors.PartError, match="another part"):
        ut.probability(FIG4, RANDOM, executor=executor, shards=4)


def test_parts_are_those_of_the_command_line(program, ask, tmp_path):
    found = ut.probability(FIG4, RANDOM, shards=3, folder=tmp_path)
    files = sorted(str(path) for path in tmp_path.iterdir())
    assert ask("merge", *files)["heads"] == found.heads
    theirs = tmp_path / "theirs.json"
    options = "--space paper-fig4 --method random --points 1000003 --seed 5 --shard 2/3 --out".split()
    subprocess.run([program, "probability", *options, str(theirs)], check=True, capture_output=True)
    assert json.loads(theirs.read_text()) == json.loads(Path(files[1]).read_text())
    assert ut.Tally.from_json(theirs.read_text()) == ut.Tally.from_json(Path(files[1]).read_text())


def test_a_solver_decides_outcomes_and_proves_none():
    found = ut.probability(FIG4, ut.Plan.random(2_000), solver=ut.Solver("quaternion", scheme="taylor"))
    assert found.heads == ut.probability(FIG4, ut.Plan.random(2_000)).heads and not found.certified


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"accuracy": 1e-3}, "accuracy"),
        ({"solver": "gamma", "shards": 2}, "solver"),
        ({"shards": 0}, "shards"),
        ({"shards": 10**7}, "shards"),
        ({"shards": 2, "retries": -1}, "retries"),
        ({"shards": 2, "retries": 3}, "retries"),
        ({"retries": 99}, "retries"),
        ({"plan": None, "shards": 2}, "plan"),
        ({"plan": None, "solver": "gamma"}, "plan"),
        ({"plan": None, "accuracy": 0.0}, "accuracy"),
        ({"plan": None, "progress": print}, "progress"),
        ({"plan": ut.Plan.sobol(1000), "threads": 0}, "threads"),
    ],
)
def test_arguments_without_effect_are_refused(arguments, field):
    with pytest.raises(errors.InputError) as caught:
        ut.probability(FIG4, **({"plan": RANDOM} | arguments))
    assert caught.value.field == field


def test_impossible_plans_are_refused():
    for make in (
        lambda: ut.Plan.random(0),
        lambda: ut.Plan.sobol(9),
        lambda: ut.Plan.exact_speed(9),
        lambda: ut.Plan.exact_speed(scrambles=0),
        lambda: ut.Plan.exact_speed(seed=2).points(GRID),
        lambda: ut.Plan.exact_speed(scrambles=2).points(GRID),
        lambda: ut.Plan.exact_speed(8).points(ut.Space(rate_x=1, rate_y=0, rate_z=0, speed=(1, 2))),
        lambda: ut.Plan.random().to_json(),
    ):
        with pytest.raises(errors.MalformedError):
            make()
    with pytest.raises(errors.InputError):
        ut.probability(ut.Space(rate_x=(0, 1), rate_y=0, rate_z=0, speed=1), ut.Plan.grid())


def test_a_choice_of_the_planner_runs_where_a_plan_does(tmp_path):
    choice = ut.plan("probability", FIG4, 1e-3)
    assert isinstance(choice.plan, ut.Plan) and choice.plan.method == choice.method
    found = ut.probability(FIG4, choice)
    assert found == ut.probability(FIG4, choice.plan) == ut.merge([ut.tally(FIG4, choice)])
    assert ut.probability(FIG4, choice, shards=2, folder=tmp_path).probability == found.probability
    with pytest.raises(errors.MalformedError, match="plan is a Choice of the model .*, which tries no launches"):
        ut.probability(FIG4, ut.plan("tilt", ut.Toss((1, 2, 3), speed=3), 1e-3))


def test_a_generator_of_numpy_gives_a_seed():
    generator, sequence = np.random.default_rng(1), np.random.SeedSequence(7)
    drawn = [ut.Plan.random(10, seed=generator) for _ in range(2)]
    assert drawn[0] == ut.Plan.random(10, seed=int(np.random.default_rng(1).integers(2**63))) and drawn[0] != drawn[1]
    first = int(sequence.generate_state(1, np.uint64)[0])
    assert ut.Plan.sobol(16, seed=sequence) == ut.Plan.sobol(16, seed=first) == ut.Plan.sobol(16, seed=sequence)
    for wrong in (np.random.RandomState(1), np.random.PCG64(1), np.random):
        with pytest.raises(errors.MalformedError):
            ut.Plan.random(10, seed=wrong)


GRID = ut.Space(rate_x=(0, 40, 4), rate_y=5, rate_z=(10, 20, 3), speed=(3, 5))
BOOK = ut.Space(rate_x=(0, 9), rate_y=5, rate_z=0.1, speed=(3, 5), body=ut.Body.from_moments((1, 2, 2.8)))
AXES = {
    "paper-fig4": (FIG4, ["--space", "paper-fig4"]),
    "a grid": (GRID, "--rate-x 0:40:4 --rate-y 5 --rate-z 10:20:3 --speed 3:5".split()),
    "a book": (BOOK, "--rate-x 0:9 --rate-y 5 --rate-z 0.1 --speed 3:5 --moments 1,2,2.8".split()),
    "two rates": (ut.Space(rate_x=(0, 9), rate_y=5, rate_z=(0, 9), speed=(3, 5)), "--rate-x 0:9 --rate-y 5 --rate-z 0:9 --speed 3:5".split()),
    "three rates": (ut.Space(rate_x=(0, 2), rate_y=(0, 1), rate_z=(0, 1), speed=(1, 2), tilt=1), "--rate-x 0:2 --rate-y 0:1 --rate-z 0:1 --speed 1:2 --tilt 1".split()),
}


@pytest.mark.parametrize("name", AXES)
def test_what_is_not_given_is_what_the_command_line_takes(ask, name):
    """Every default of an estimate: the method, its launches, scrambles, seed and accuracy, for each kind of space."""
    space, options = AXES[name]
    plans = [("random", ut.Plan.random()), ("sobol", ut.Plan.sobol()), ("exact-speed", ut.Plan.exact_speed()), ("enclosure", ut.Plan.enclosure()), (None, None)]
    for method, plan in plans:
        expected = ask("probability", *options, *(["--method", method] if method else []))
        if "no effect" in expected.get("error", {}).get("message", ""):
            continue  # Points of axes that are typed for this method; a space of Python is for any.
        if "error" in expected:
            with pytest.raises(errors.TossError):
                ut.probability(space, plan)
            continue
        found = ut.probability(space, plan)
        assert (found.plan.method, found.points, found.probability) == (expected["method"], expected["points"], expected["probability"])
        assert (found.interval, found.interval_kind) == (expected["interval"] and tuple(expected["interval"]), expected["interval_kind"])
        assert found.certified == expected["certified"] and (plan is None or found.plan == plan.of(space))


def test_what_is_not_given_of_a_flight_is_what_the_command_line_takes(ask):
    toss, options = ut.Toss((9, 4, 3), speed=1.5), ["--rate", "9,4,3", "--speed", "1.5"]
    assert ut.toss(toss).cos_tilt == ask("toss", *options)["cos_tilt"]
    for solver in ("quaternion", "euler", "gamma"):
        landing, asked = ut.toss(toss, solver), ask("toss", *options, "--solver", solver)
        assert (landing.cos_tilt, landing.scheme, landing.work.rhs_calls) == (asked["cos_tilt"], asked["scheme"], asked["work"]["rhs_calls"])
        equal, asked = ut.toss(toss, ut.Solver(solver, scheme="rk4")), ask("toss", *options, "--solver", solver, "--scheme", "rk4")
        assert equal.work.rhs_calls == asked["work"]["rhs_calls"]
    planned = ask("plan", *options, "--want", "trace", "--accuracy", "1e-6")
    assert ut.plan("trace", toss, 1e-6).expected_cost_ns == planned["expected_cost_ns"]
    assert len(ut.trace(toss).t) == 101


def test_what_is_undecided_is_no_share_of_tails():
    coarse = ut.Solver("quaternion", scheme="rk4", step=0.1)
    found = ut.probability(ut.Space(rate_x=(0, 40), rate_y=5.0, rate_z=10.0, speed=(3, 5)), ut.Plan.random(64), solver=coarse)
    assert (found.probability, found.interval, found.half_width, found.undecided) == (None, (0.0, 1.0), None, 64)
    counts = ut.count([0.0, 40.0], 5.0, 10.0, 4.0, solver=coarse)
    assert counts.undecided == 2 and math.isnan(counts.probability)
    assert ut.Counts(3, 1, 60, False, None).probability == 0.75
