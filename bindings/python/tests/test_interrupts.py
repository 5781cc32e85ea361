"""Ctrl-C: every call that may take long stops soon after it, whatever it computes."""

import os
import signal
import subprocess
import sys
import time

import pytest

PREPARED = """
import itertools, os, sys, time
import numpy as np
import unfair_toss as ut

BOOK = ut.Body.from_moments((1.0, 2.0, 2.8))
FIG4 = ut.Space.named("paper-fig4")
WIDE = ut.Space(rate_x=(0, 4000), rate_y="x", rate_z=(-3000, 5000), speed=(3, 5))
OF_BOOK = ut.Space(rate_x=(0, 9), rate_y=(4, 5), rate_z=(0, 0.1), speed=(3, 5), body=BOOK)
TUMBLING = ut.Toss((0.3, 50.0, 0.1), speed=300.0, body=BOOK)
MANY = np.linspace(1.0, 2.0, 4_000_000)

def again(call):
    while True:
        call()
"""

# What takes long, by a name: minutes, or for ever.
CALLS = {
    "random launches of a body": "ut.probability(OF_BOOK, ut.Plan.random(10**11))",
    "a tally of a body": "ut.tally(OF_BOOK, ut.Plan.random(10**11), (0, 10**11), threads=1)",
    "all speeds at 2^30 points": "ut.probability(FIG4.with_body('us-quarter'), ut.Plan.exact_speed(1 << 34))",
    "parts": "ut.probability(OF_BOOK, ut.Plan.random(10**11), shards=2)",
    "an accuracy of a body": "ut.probability(OF_BOOK, accuracy=1e-6)",
    "an enclosure": "again(lambda: ut.probability(WIDE, ut.Plan.enclosure(1e-13)))",
    "launches by an integrator": "ut.probability(FIG4, ut.Plan.random(10**10), solver=ut.Solver('gamma'))",
    "a plan": "again(lambda: ut.plan('probability', FIG4, 1e-5))",
    "a landing by many steps": "again(lambda: ut.toss(ut.Toss((1, 1, 2), time=1.0), ut.Solver('quaternion', step=1e-6)))",
    "a landing of a body": "again(lambda: ut.toss(TUMBLING))",
    "margins of a body": "again(lambda: ut.margins(ut.Toss((0.3, 5.0, 0.1), speed=3, body=BOOK)))",
    "intervals of a body": "again(lambda: ut.intervals(ut.Toss((0.3, 5.0, 0.1), speed=30, body=BOOK)))",
    "a trace of a body": "again(lambda: ut.trace(TUMBLING, 1_000_000))",
    "a trace by an integrator": "ut.trace(ut.Toss((1, 1, 2), time=10.0), 1_000_000, solver=ut.Solver('euler', step=1e-7))",
    "a solution": "ut.solve(ut.Toss((1, 1, 2), time=10.0), 'gamma', step=1e-7, t_eval=np.linspace(0, 10, 1_000_000))",
    "an exact solution": "again(lambda: ut.solve(TUMBLING, t_eval=np.linspace(0, TUMBLING.flight_time, 1_000_000)))",
    "launches that land on their edge": "ut.count(MANY * 0 + 1.0, 0.0, 0.0, time=np.pi / 2)",
    "the same on two threads": "ut.outcome(MANY * 0 + 1.0, 0.0, 0.0, time=np.pi / 2, threads=2)",
    "columns by an integrator": "ut.cos_tilt(MANY, 1.0, 2.0, 3.0, solver=ut.Solver('euler', step=1e-5))",
    "the same on all threads": "ut.attitude(MANY, 1.0, 2.0, 3.0, solver=ut.Solver('euler', step=1e-6), threads=None)",
    "columns of a body": "again(lambda: ut.attitude(MANY, 50.0, 0.1, 3.0, body=BOOK, threads=2))",
    "counts of a body": "again(lambda: ut.count(MANY, 50.0, 0.1, 300.0, body=BOOK))",
}

RUN = """
print("begun", flush=True)
try:
    {call}
except KeyboardInterrupt:
    print("stopped", time.monotonic(), flush=True)
    # What is left behind computes on until its next block, and is not waited for.
    os._exit(0)
print("ended", flush=True)
"""

LIMIT = 2.0
"""Seconds that may pass. It is a quarter of that on an idle machine, and this one may be busy with other tests."""


@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_stops_every_call(name):
    code = PREPARED + RUN.format(call=CALLS[name])
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout.readline() == "begun\n"
            time.sleep(0.5)
            sent = time.monotonic()
            os.kill(process.pid, signal.SIGINT)
            word, *at = process.communicate(timeout=60)[0].split()
        finally:
            process.kill()
    assert word == "stopped", word
    taken = float(at[0]) - sent
    print(f"{taken:.3f} s: {name}")
    assert taken < LIMIT


LEFT = """
def work():
    begun = time.process_time()
    time.sleep(1.0)
    return time.process_time() - begun

try:
    print("begun", flush=True)
    {call}
except KeyboardInterrupt:
    time.sleep(1.0)
    print("stopped", work(), flush=True)
    os._exit(0)
"""


@pytest.mark.parametrize(
    "name",
    [
        "random launches of a body",
        "all speeds at 2^30 points",
        "an accuracy of a body",
        "launches by an integrator",
        "a trace of a body",
        "a solution",
        "columns by an integrator",
    ],
)
def test_nothing_computes_on_after_ctrl_c(name):
    code = PREPARED + LEFT.format(call=CALLS[name])
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout.readline() == "begun\n"
            time.sleep(0.5)
            os.kill(process.pid, signal.SIGINT)
            word, work = process.communicate(timeout=60)[0].split()
        finally:
            process.kill()
    assert word == "stopped" and float(work) < 0.2


def test_a_handler_of_a_signal_runs_meanwhile_and_the_call_goes_on():
    code = """
import signal, threading, os
import unfair_toss as ut

heard = []
signal.signal(signal.SIGINT, lambda *_: heard.append(1))
plan, space = ut.Plan.random(200_000_000), ut.Space.named("paper-fig4")
threading.Timer(0.05, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
found = ut.probability(space, plan)
print(len(heard), found.points, ut.Toss((1, 1, 2.5), speed=3) is not None)
"""
    assert subprocess.check_output([sys.executable, "-c", code], text=True).split() == ["1", "200000000", "True"]


ALONE = """
import os, resource
import unfair_toss as ut

resource.setrlimit(resource.RLIMIT_NPROC, (1, 1))
os.setgroups([])
os.setuid(65534)
toss, space = ut.Toss((1, 2, 3), speed=3, body="racket"), ut.Space.named("paper-fig4")
print(ut.trace(toss, 3).t.size, ut.intervals(ut.Toss((1, 1, 2.5), speed=3)).probability, ut.cos_tilt(1.0, 2.0, 3.0, 3.0, threads=1))
for threads in (1, 2):
    try:
        ut.probability(space, ut.Plan.random(10), threads=threads)
    except RuntimeError as error:
        print(error)
"""


@pytest.mark.skipif(sys.platform != "linux" or os.geteuid() != 0, reason="only the administrator can become a user without threads")
def test_where_no_thread_can_start_calls_without_threads_need_none_and_others_say_so():
    done = subprocess.run([sys.executable, "-c", ALONE], capture_output=True, text=True, env=os.environ | {"OPENBLAS_NUM_THREADS": "1"})
    lines = done.stdout.splitlines()
    assert lines[0].startswith("3 "), done.stderr
    assert lines[1].startswith("cannot start a thread: ") and "try" not in lines[1], lines
    assert lines[2].startswith("cannot start 2 threads: ") and lines[2].endswith("; try threads=1"), lines
