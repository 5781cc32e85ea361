"""The parts of an estimate, computed by any executor, kept in files, and retried."""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from pathlib import Path
from typing import Any

from ._native import Plan, Space, Tally, count
from .errors import InputError, MalformedError, PartError
from .given import wrong
from .tallies import tally

_LAUNCHES = 10**9
"""Launches of a part by default: a second or more, beside which the work of an executor does not count."""

_FEWEST = 8
"""Fewest parts by default, so that several workers have something to do."""

_RETRIES = 3
"""How often a part is computed again by default."""

_AHEAD = 64
"""Parts that are handed to an executor at a time, so that a plan of many parts needs little memory."""


_WAY_OUT = "remove it to compute it"
"""What helps against a file that holds no part."""


def compute(space: Space, plan: Plan, start: int, end: int, threads: int | None) -> Tally:
    """The tally of a part, in a worker."""
    return tally(space, plan, (start, end), threads=threads)


class Parts:
    """The parts of a plan, and how they are computed. The arguments are those of ``probability``."""

    def __init__(
        self,
        space: Space,
        plan: Plan,
        shards: int | None,
        folder: str | os.PathLike[str] | None,
        threads: int | None,
        executor: Executor | Callable[[], Any] | None,
        retries: int | None,
        progress: Callable[[int, int], object] | None,
    ) -> None:
        self.space, self.plan = space, plan.of(space)
        self.points = plan.points(space)
        fewest = min(max(_FEWEST, -(-self.points // _LAUNCHES)), self.points)
        self.shards = fewest if shards is None else count("shards", shards)
        if not 1 <= self.shards <= self.points:
            message = f"shards = {shards}: valid are 1 to {self.points}"
            raise MalformedError(message, field="shards", valid=f"1 to {self.points}")
        try:
            self.folder = None if folder is None else Path(folder)
        except TypeError:
            raise wrong("folder", folder, "a path") from None
        self.threads = threads if executor is None or threads is not None else 1
        self.executor, self.progress = executor, progress
        self.retries = _RETRIES if retries is None else retries
        self.done = 0

    def range(self, shard: int) -> tuple[int, int]:
        """The launches of a part, counted from 0; the same as those of the command line."""
        return self.points * shard // self.shards, self.points * (shard + 1) // self.shards

    def path(self, shard: int) -> Path | None:
        """The file of a part."""
        digits = len(str(self.shards))
        return self.folder and self.folder / f"part-{shard + 1:0{digits}}-of-{self.shards}.json"

    def computed(self) -> Iterator[Tally]:
        """All parts: those that are there first, then each when it is done."""
        if self.folder is not None:
            self.folder.mkdir(parents=True, exist_ok=True)
        missing = []
        for shard in range(self.shards):
            kept = self.kept(shard)
            if kept is None:
                missing.append(shard)
            else:
                yield self.counted(kept)
        if self.executor is None:
            for shard in missing:
                yield self.finished(shard, compute(self.space, self.plan, *self.range(shard), self.threads))
        elif missing:
            yield from _Run(self, self.executor).results(missing)

    def kept(self, shard: int) -> Tally | None:
        """The part from its file, if there is one."""
        path = self.path(shard)
        if path is None or not path.exists():
            return None
        try:
            part = Tally.from_json(path.read_text(encoding="utf-8-sig"))
        except UnicodeDecodeError:
            raise PartError(f"{path}: it is no text in UTF-8; {_WAY_OUT}", field="folder") from None
        except InputError as error:
            raise PartError(f"{path}: {error}; {_WAY_OUT}", field="folder") from None
        return self.checked(shard, part, str(path), f"; {_WAY_OUT}, or keep this plan in another folder")

    def checked(self, shard: int, part: Tally, source: str, way_out: str = "") -> Tally:
        """The part, if it is the one that it should be."""
        if (part.space, part.plan, part.range) != (self.space, self.plan, self.range(shard)):
            message = f"{source}: it holds another part than number {shard + 1} of {self.shards} of this plan{way_out}"
            raise PartError(message, field="parts", valid="this part")
        return part

    def finished(self, shard: int, part: Tally) -> Tally:
        """A new part, once it is kept."""
        self.checked(shard, part, "a worker's answer")
        path = self.path(shard)
        if path is not None:
            _write_whole(path, part.to_json() + "\n")
        return self.counted(part)

    def counted(self, part: Tally) -> Tally:
        self.done += part.range[1] - part.range[0]
        if self.progress is not None:
            self.progress(self.done, self.points)
        return part


class _Run:
    """The parts that an executor computes."""

    def __init__(self, parts: Parts, executor: Executor | Callable[[], Any]) -> None:
        self.parts = parts
        self.make = None if hasattr(executor, "submit") else executor
        self.executor: Any = executor if self.make is None else self.make()
        self.failures: dict[int, int] = {}
        self.running: dict[Future[Tally], int] = {}

    def results(self, missing: list[int]) -> Iterator[Tally]:
        """Each part when it is done."""
        waiting = missing[::-1]
        try:
            while waiting or self.running:
                while waiting and len(self.running) < _AHEAD:
                    self.submit(waiting)
                done, _ = wait(self.running, return_when=FIRST_COMPLETED)
                for future in done:
                    shard = self.running.pop(future, None)
                    if shard is None:
                        continue
                    error = future.exception()
                    if error is None:
                        yield self.parts.finished(shard, future.result())
                    else:
                        self.failed(shard, error, waiting)
        finally:
            for future in self.running:
                future.cancel()
            if self.make is not None:
                self.executor.shutdown(wait=False, cancel_futures=True)

    def submit(self, waiting: list[int]) -> None:
        """Hands the next part to the executor."""
        shard, parts = waiting.pop(), self.parts
        try:
            future = self.executor.submit(compute, parts.space, parts.plan, *parts.range(shard), parts.threads)
        except BrokenExecutor as error:
            self.failed(shard, error, waiting)
        else:
            self.running[future] = shard

    def failed(self, shard: int, error: BaseException, waiting: list[int]) -> None:
        """Puts a part back, unless it failed too often or its input is at fault."""
        self.failures[shard] = self.failures.get(shard, 0) + 1
        if isinstance(error, InputError) or self.failures[shard] > self.parts.retries:
            raise error
        waiting.append(shard)
        if isinstance(error, BrokenExecutor):
            if self.make is None:
                raise error
            waiting.extend(self.running.values())
            self.running.clear()
            self.executor.shutdown(wait=False, cancel_futures=True)
            self.executor = self.make()


def _write_whole(path: Path, text: str) -> None:
    """Writes a file whole, or leaves what was there. Others may read it where the umask allows it."""
    unfinished = path.with_name(f".{path.name}-{os.getpid()}-{secrets.token_hex(4)}")
    try:
        with open(unfinished, "x", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(unfinished, path)
    except BaseException:
        unfinished.unlink(missing_ok=True)
        raise
