"""The program of the verification suite, and the function of this process that it asks."""

from __future__ import annotations

import contextvars
import hmac
import inspect
import json
import os
import re
import secrets
import select
import shlex
import shutil
import socket
import subprocess
import sys
import sysconfig
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ._native import Body, Toss, __version__
from .errors import MalformedError, ProgramError, SolveError
from .given import wrong
from .results import fastest_turn

_NAME = "unfair-toss-verify"
"""The program, as its wheel installs it."""

_WAY_OUT = "pip install ./bindings/verify in a clone of unfair-toss, or program= with the path of verify as cargo builds it"

_RELAY = Path(__file__).with_name("_relay.py")

_OTHERS = np.array([[2.0, 2.0, 3.0, 0.1, 0.2, 0.3, 0.6, 0.8, 0.0, 0.0, 0.5], [1.0, 1.0, 0.5, 3.0, -1.0, 2.0, 1.0, 0.0, 0.0, 0.0, 1.5]])
"""The launches of a column before and after the one that is judged: moments, rates, attitude and time. A function that takes
one row of a column for another is wrong."""

_LOOK = 0.05
"""Seconds between two looks at the program."""


def report_on(
    f: Callable[..., Any],
    of_columns: bool,
    options: list[str],
    folder: str | os.PathLike[str] | None,
    program: str | os.PathLike[str] | None,
) -> tuple[dict[str, Any], str]:
    """The report of the program on a function, and what that most likely does wrong, in words. The arguments are those of
    ``verify``."""
    relay = [sys.executable, "-I", str(_RELAY)]
    command = [_found(program), "--command", subprocess.list2cmdline(relay) if os.name == "nt" else shlex.join(relay), *options]
    with tempfile.TemporaryDirectory(prefix="unfair-toss-") as scratch:
        try:
            kept = Path(scratch if folder is None else folder)
        except TypeError:
            raise wrong("folder", folder, "a path") from None
        code, said = _Run(_Call(f, of_columns)).of([*command, f"--out={kept}"], Path(scratch, "said"))
        if code == 2:
            raise _refused(said)
        if code not in (0, 1, 3):
            raise ProgramError(f"{_NAME} ended with {code}: {said[-1]}", field="program")
        report = json.loads((kept / "report.json").read_text(encoding="utf-8"))
    if report["version"] != __version__:
        message = f"{_NAME} is of version {report['version']}, and this package of {__version__}: {_WAY_OUT}"
        raise ProgramError(message, field="program", valid=__version__)
    return report, " ".join(map(_in_words, report["diagnoses"]))


def _found(program: str | os.PathLike[str] | None) -> str:
    """The path of the program: the one that is given, or that of this environment, or of the PATH."""
    try:
        name = _NAME if program is None else os.fspath(Path(program))
        places = (sysconfig.get_path("scripts"), None) if program is None else (None,)
        found = next(filter(None, (shutil.which(name, path=place) for place in places)), None)
    except (TypeError, ValueError):
        raise wrong("program", program, "a path") from None
    if found is None:
        raise ProgramError(f"there is no program {name}: {_WAY_OUT}", field="program", valid=_WAY_OUT)
    return found


def _refused(said: list[str]) -> MalformedError:
    """The exception of an argument that the program refused."""
    message = next((line.removeprefix("error: ") for line in said if line.startswith("error: ")), said[-1])
    option = re.search(r"--([a-z-]+)", message)
    field = option[1].replace("-", "_") if option else None
    return MalformedError(re.sub(r"'--[a-z-]+[^']*'", field or "", message), field=field)


def _toss(row: dict[str, float]) -> Toss:
    """The toss of a question."""
    i1, i2, i3 = row["i1"], row["i2"], row["i3"]
    rate, attitude = ([row[name] for name in names] for names in (("rate_x", "rate_y", "rate_z"), "wxyz"))
    return Toss(rate, time=row["time"], attitude=attitude, body=Body.from_moments((i1, i3) if i1 == i2 else (i1, i2, i3)))


def _row(header: str, question: str) -> dict[str, float]:
    return dict(zip(header.strip().split(","), map(float, question.split(",")), strict=True))


def _in_words(diagnosis: dict[str, Any]) -> str:
    """What the function most likely does wrong, and the smallest launch that this does not explain."""
    words, example = f"{diagnosis['cause']}.", diagnosis["example"]
    if diagnosis["explains_all"]:
        return words
    answer = example["answer"].partition(",")[2] if example["answer"][:1].isdigit() else example["answer"]
    toss = _toss(_row(*example["question"].splitlines()))
    return f"{words} The smallest launch that this does not explain: {toss!r} landed at {answer}, expected {example['expected']}"


class _Call:
    """A function, and the answers that it gives in the words of the program."""

    def __init__(self, f: Callable[..., Any], of_columns: bool) -> None:
        self.f, self.of_columns = f, of_columns
        try:
            self.takes_rtol = "rtol" in inspect.signature(f).parameters
        except (TypeError, ValueError):  # Some functions in C have no signature.
            self.takes_rtol = False

    def answer(self, row: dict[str, float]) -> str:
        rtol = {"rtol": row["tolerance"]} if self.takes_rtol else {}
        if self.of_columns:
            names = ["i1", "i2", "i3", "rate_x", "rate_y", "rate_z", *"wxyz", "time"]
            table = np.insert(_OTHERS, 1, [row[name] for name in names], axis=0)
            rates = [table[:, place].copy() for place in (3, 4, 5)]
            found = self.f(*rates, time=table[:, 10].copy(), attitude=table[:, 6:10].copy(), moments=table[:, :3].copy(), **rtol)
            return _line(_quaternions(found, table.shape[:1])[1])
        toss = _toss(row)
        found = self.f(toss, **rtol)
        if not hasattr(found, "attitude"):
            return _line(_quaternions(found, ()))
        fields = [_line(np.reshape(found.attitude, (-1, 4))[-1])]
        if found.error_estimate is not None:
            # The time and the attitude of a question are rounded, and so is the quaternion, of which its solver says nothing.
            rounded = sys.float_info.epsilon * (4.0 + fastest_turn(toss) * toss.flight_time)
            fields.append(f"error={float(found.error_estimate) + rounded!r}")
        rate = map(repr, np.reshape(found.rate, (-1, 3))[-1].tolist())
        return ",".join([*fields, f"calls={found.work.rhs_calls}", f"rate={';'.join(rate)}"])


def _quaternions(found: Any, shape: tuple[int, ...]) -> npt.NDArray[np.float64]:
    """What a function returned, if it is as many quaternions."""
    valid = f"an attitude: numbers of shape {(*shape, 4)}, or rotations of SciPy" + ("" if shape else ", or a Landing or a Solution")
    try:
        array = np.asarray(found.as_quat(scalar_first=True) if hasattr(found, "as_quat") else found, np.float64)
    except (TypeError, ValueError):
        raise wrong("f returned what", found, valid) from None
    if array.shape != (*shape, 4):
        raise MalformedError(f"f returned numbers of shape {array.shape}: expected {valid}", field="f", valid=valid)
    return array


def _line(quaternion: npt.NDArray[np.float64]) -> str:
    return ",".join(map(repr, quaternion.tolist()))


class _Run:
    """The program, and the function that answers it."""

    def __init__(self, call: _Call) -> None:
        self.call = call
        self.failure: BaseException | None = None
        self.token = secrets.token_hex()

    def of(self, command: list[str], place: Path) -> tuple[int, list[str]]:
        """The exit code of the program and what it said, or the exception of the function."""
        connections = []
        with socket.create_server(("127.0.0.1", 0)) as server, open(place, "w+b") as said:
            relay = f"{server.getsockname()[1]} {self.token}"
            # One thread, so that it asks one question at a time.
            environment = os.environ | {"UNFAIR_TOSS_RELAY": relay, "RAYON_NUM_THREADS": "1"}
            try:
                program = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=said, env=environment)
            except OSError as error:
                raise ProgramError(f"{command[0]} can't be started: {error}; {_WAY_OUT}", field="program", valid=_WAY_OUT) from None
            # Not by `poll` in this thread: interrupted inside of it, it keeps a lock for which `wait` would wait for ever.
            end = threading.Thread(target=program.wait, daemon=True)
            end.start()
            try:
                while program.returncode is None and self.failure is None:
                    if select.select([server], [], [], _LOOK)[0]:
                        connections.append(server.accept()[0])
                        # With the context of the caller, which has NumPy's handling of errors.
                        run = contextvars.copy_context().run
                        threading.Thread(target=run, args=(self.serve, connections[-1]), daemon=True).start()
            finally:
                program.kill()
                end.join()
                for connection in connections:
                    connection.close()
            if self.failure is not None:
                raise self.failure
            said.seek(0)
            return program.returncode, said.read().decode(errors="replace").strip().splitlines() or [""]

    def serve(self, connection: socket.socket) -> None:
        """Answers what a relay passes on, until its connection ends."""
        try:
            with connection.makefile("rw", encoding="utf-8", newline="\n") as lines:
                if not hmac.compare_digest(lines.readline().strip().encode(), self.token.encode()):
                    return
                header = lines.readline()
                for question in lines:
                    answer = self.answered(_row(header, question))
                    if answer is None:
                        return
                    lines.write(f"{question.partition(',')[0]},{answer}\n")
                    lines.flush()
        except OSError:
            return

    def answered(self, row: dict[str, float]) -> str | None:
        """The answer of the function; none if it raised an exception."""
        try:
            return self.call.answer(row)
        except SolveError as error:
            return f"failed,{error}"
        except BaseException as error:
            error.add_note(f"raised at {_toss(row)!r}")
            self.failure = error
            return None
