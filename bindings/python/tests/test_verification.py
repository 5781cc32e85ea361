"""`verify`: the suite judges functions of Python in this process, and says what a wrong one does wrong."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import unfair_toss as ut


def product(one, two):
    w, x, y, z = one
    return np.array([[w, -x, -y, -z], [x, w, -z, y], [y, z, w, -x], [z, -y, x, w]]) @ two


def turn(vector):
    angle = np.linalg.norm(vector)
    return np.append(np.cos(angle / 2), vector / angle * np.sin(angle / 2) if angle else vector)


def closed_form(toss):
    """A coin turns about its momentum and about its normal."""
    i1, _, i3 = toss.body.moments
    x, y, z = np.array(toss.rate) * toss.flight_time
    return product(product(toss.attitude, turn([x, y, z * i3 / i1])), turn([0.0, 0.0, z * (1 - i3 / i1)]))


def test_a_right_function_passes(suite, tmp_path):
    found = ut.verify(closed_form, quick=True, program=suite, folder=tmp_path)
    assert found.require() is found and found.passed and not found.diagnosis
    assert {"random-attitude", "adversarial-silence", "work-precision"} <= set(found.check) and len(found) == len(set(found.check))
    assert found.cases.max() >= 1000 and not found.without_answer.any() and np.nanmin(found.reserve) > 1.0
    assert (tmp_path / "report.html").exists()
    assert repr(found) == f"Verification(passes all {len(found)} checks)"
    assert found._repr_html_().count("<tr>") == 1 + len(found)
    pandas = pytest.importorskip("pandas")
    assert isinstance(found.to_pandas(), pandas.DataFrame) and list(found.to_pandas().check) == found.check.tolist()


@pytest.mark.parametrize(
    ("f", "options", "checks"),
    [
        # The functions of this package, of one launch with the error that each answer states, and of columns.
        (ut.toss, {"bodies": True}, ("random-cos-tilt", "bodies-within-estimate")),
        (ut.solve, {}, ("random-attitude", "claims-measured")),
        (ut.attitude, {"columns": True, "bodies": True}, ("random-attitude", "bodies-attitude")),
    ],
    ids=["toss", "solve", "attitude"],
)
def test_functions_of_this_package_pass(suite, f, options, checks):
    for check in checks:
        assert ut.verify(f, quick=True, only=check, program=suite, **options).require().check.tolist() == [check]


def conjugated(toss):
    w, x, y, z = closed_form(toss)
    return w, -x, -y, -z


def first_row(rate_x, rate_y, rate_z, time, attitude, moments):
    return np.repeat(ut.attitude(rate_x, rate_y, rate_z, time=time, attitude=attitude, moments=moments)[:1], len(time), axis=0)


def coarse(toss, rtol):
    """It integrates at a million times the tolerance that it is asked for."""
    return ut.solve(toss, rtol=1e6 * rtol).attitude[-1]


@pytest.mark.parametrize(
    ("f", "diagnosis"),
    [
        (conjugated, r"right if its quaternion is conjugated, .*: 143 of 143\."),
        (first_row, r"none of the \d+ known mistakes .* Toss\(.* landed at .*, expected "),
        (coarse, r"right up to a tolerance of about"),
    ],
)
def test_a_wrong_function_is_told_what_it_does_wrong(suite, f, diagnosis):
    found = ut.verify(f, columns=f is first_row, quick=True, only="random-attitude", program=suite)
    assert not found.passed and found.status.tolist() == ["fail-by-claim"]
    with pytest.raises(ut.errors.NotVerifiedError, match=r"^fails 1 of 1 checks \(random-attitude\)\. ") as caught:
        found.require()
    print(caught.value)
    assert re.search(diagnosis, str(caught.value)) and found.diagnosis in found._repr_html_()


def test_an_exception_of_the_function_comes_out_with_its_launch(suite):
    def raising(toss):
        return {}["no such key"]

    with pytest.raises(KeyError, match="no such key") as caught:
        ut.verify(raising, quick=True, program=suite)
    assert caught.traceback[-1].name == "raising"
    note = re.fullmatch("raised at (Toss.*)", caught.value.__notes__[0])
    assert isinstance(eval(note[1], vars(ut)), ut.Toss)
    for answer in (None, "1,0,0,0", [1.0, 0.0, 0.0], np.eye(4)):
        with pytest.raises(ut.errors.MalformedError, match="f returned"):
            ut.verify(lambda toss, answer=answer: answer, quick=True, program=suite)
    with pytest.raises(SystemExit):
        ut.verify(sys.exit, quick=True, program=suite)


def test_a_function_that_declines_has_no_answer_and_goes_on(suite):
    def declining(toss):
        if toss.rate[0] > 0.0:
            raise ut.errors.SolveError("it turns\nforwards, and 1, 2")
        return closed_form(toss)

    found = ut.verify(declining, quick=True, only="random-attitude", program=suite)
    assert not found.passed and 0 < found.without_answer[0] < found.cases[0]
    assert found.failure[0].endswith(r"it turns\nforwards, and 1, 2")
    assert "no answer there: it turns" in found.diagnosis


def test_a_function_that_hangs_fails_within_its_time(suite):
    begun = time.monotonic()
    found = ut.verify(lambda toss: time.sleep(60), quick=True, only="random-attitude", answer_seconds=0.2, program=suite)
    assert not found.passed and "gave no first answer within 1.2 s" in found.failure[0]
    assert time.monotonic() - begun < 10.0


def test_rotations_and_the_context_of_the_caller(suite):
    rotation = pytest.importorskip("scipy.spatial.transform").Rotation
    states = set()

    def rotated(toss):
        states.add(np.geterr()["under"])
        return rotation.from_quat(closed_form(toss), scalar_first=True)

    with np.errstate(under="call"):
        ut.verify(rotated, quick=True, only="reference-attitude", claim=1e-13, program=suite).require()
    assert states == {"call"}


@pytest.mark.parametrize(
    ("options", "field", "words"),
    [
        ({"only": "no-check"}, "only", "no such check: 'no-check'"),
        ({"claim": 2}, "claim", "expected an error above 0 and below 1"),
        ({"answer_seconds": -1}, "answer_seconds", "expected 0.001 to 86400 s"),
        ({"total_seconds": float("nan")}, "total_seconds", "expected 0.001 to 86400 s"),
        ({"time_factor": 0}, "time_factor", "the time factor must be finite and above 0"),
        ({"deep": True}, "deep", "contradict each other"),
        ({"columns": 1}, "columns", "expected True or False"),
        ({"folder": 1}, "folder", "expected a path"),
        ({"program": 1}, "program", "expected a path"),
    ],
)
def test_wrong_arguments_are_refused(suite, options, field, words):
    with pytest.raises(ut.errors.MalformedError, match=words) as caught:
        ut.verify(closed_form, quick=True, **{"program": suite} | options)
    assert caught.value.field == field
    with pytest.raises(ut.errors.MalformedError, match="a function"):
        ut.verify(3, program=suite)


def test_a_program_that_is_missing_or_another_one_is_an_error_that_says_how_to_get_it(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr("sysconfig.get_path", lambda _: str(tmp_path))
    for program in (None, tmp_path / "nothing", tmp_path):
        with pytest.raises(ut.errors.ProgramError, match=r"pip install \./bindings/verify .* program= ") as caught:
            ut.verify(closed_form, program=program)
        assert caught.value.field == "program"
    other = tmp_path / "unfair-toss-verify"
    other.write_text("nothing that can be started")
    other.chmod(0o755)
    with pytest.raises(ut.errors.ProgramError, match="can't be started"):
        ut.verify(closed_form)
    other.write_text("#!/bin/sh\necho out of order >&2; exit 4\n")
    with pytest.raises(ut.errors.ProgramError, match="ended with 4: out of order"):
        ut.verify(closed_form)
    (tmp_path / "report.json").write_text('{"version": "0.1.0"}')
    other.write_text("#!/bin/sh\nexit 0\n")
    with pytest.raises(ut.errors.ProgramError, match=rf"is of version 0\.1\.0, and this package of {ut.__version__}"):
        ut.verify(closed_form, folder=tmp_path)


RUN = """
import sys, time
import unfair_toss as ut

def {f}
    print("begun", flush=True)
    return ut.toss(toss)

try:
    ut.verify(f, program=sys.argv[1])
except KeyboardInterrupt:
    print("stopped", time.monotonic(), flush=True)
"""


HANGS = """f(toss):
    print("begun", flush=True); time.sleep(600)"""

# An interrupt inside of `Popen.poll` leaves a lock locked. Here one comes there wherever the thread that is interrupted calls it.
POLLS = """in_poll(frame, event, _):
    if event == "c_return" and frame.f_code.co_name == "_internal_poll" and calls and time.monotonic() < calls[0] + 0.3:
        sys.setprofile(None)
        raise KeyboardInterrupt

calls = []
sys.setprofile(in_poll)

def f(toss):
    if not calls: calls.append(time.monotonic())"""


@pytest.mark.skipif(sys.platform != "linux", reason="it looks at the processes of Linux")
@pytest.mark.parametrize("f", ["f(toss):", HANGS, POLLS], ids=["runs", "hangs", "polls"])
def test_ctrl_c_ends_it_and_leaves_no_process(suite, f):
    code = [sys.executable, "-c", RUN.format(f=f), suite]
    with subprocess.Popen(code, stdout=subprocess.PIPE, text=True, start_new_session=True) as process:
        try:
            assert process.stdout.readline() == "begun\n"
            time.sleep(0.5)
            assert len(of_session(process.pid)) >= 3
            sent = time.monotonic()
            os.kill(process.pid, signal.SIGINT)
            *_, word, at = process.communicate(timeout=60)[0].split()
        finally:
            process.kill()
    print(f"{float(at) - sent:.3f} s")
    assert word == "stopped" and float(at) - sent < 1.0
    while of_session(process.pid) and time.monotonic() - sent < 1.0:
        time.sleep(0.01)
    assert not of_session(process.pid)


def of_session(session: int) -> list[str]:
    """The processes of a session that have not ended."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            name, fields = stat.read_text().rsplit(") ", 1)
        except OSError:
            continue
        state, _, _, of = fields.split()[:4]
        if int(of) == session and state != "Z":
            found.append(name)
    return found
