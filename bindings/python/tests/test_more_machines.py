"""The recipes of docs/more-machines.md run as they are printed, with fewer launches, and without their engines."""

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import unfair_toss as ut

from conftest import ROOT

PAGE = (ROOT / "docs" / "more-machines.md").read_text(encoding="utf-8")
FIG4 = ut.Space.named("paper-fig4")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)


@pytest.mark.parametrize(("number", "needs"), [(0, "unfair_toss"), (1, "distributed")])
def test_the_lines_for_python_run(number, needs, tmp_path):
    pytest.importorskip(needs)
    script = tmp_path / "study.py"
    lines = blocks("python")[number]
    assert "100_000_000" in lines
    script.write_text(lines.replace("100_000_000", "1_000_000"), encoding="utf-8")
    printed = subprocess.check_output([sys.executable, script], cwd=tmp_path, text=True).splitlines()
    found = ut.probability(FIG4, ut.Plan.random(1_000_000))
    assert printed[-1] == f"{found.probability} {found.interval}"
    assert len(list((tmp_path / "parts").iterdir())) == 8
    assert number or printed[-2] == "1000000 of 1000000"


def slurm(folder: Path) -> list[tuple[str, dict[str, str]]]:
    """The job of each part, with what Slurm sets in its environment."""
    job = blocks("sh")[0]
    last, processors = (re.search(rf"--{name}=(?:1-)?(\d+)\n", job).group(1) for name in ("array", "cpus-per-task"))
    return [
        (job, {"SLURM_ARRAY_TASK_ID": str(part), "SLURM_CPUS_PER_TASK": processors})
        for part in range(1, int(last) + 1)
    ]


def kubernetes(folder: Path) -> list[tuple[str, dict[str, str]]]:
    """The command of each pod, with what Kubernetes sets in its environment."""
    job = blocks("yaml")[0]
    (folder / "parts").mkdir()
    command = " ".join(re.search(r"- >\n((?: {14}\S.*\n)+)", job).group(1).split())
    command = command.replace('"/parts/', f'"{folder}/parts/')
    completions = int(re.search(r"completions: (\d+)", job).group(1))
    return [(command, {"JOB_COMPLETION_INDEX": str(index)}) for index in range(completions)]


@pytest.mark.parametrize("recipe", [slurm, kubernetes])
def test_the_jobs_of_all_parts_merge_also_after_two_were_lost(
    recipe: Callable[[Path], list[tuple[str, dict[str, str]]]], program: str, tmp_path: Path
):
    jobs = recipe(tmp_path)
    path = f"{Path(program).parent}:{os.environ['PATH']}"

    def run(command: str, **environment: str) -> str:
        assert command.count("100000000000") == int("probability" in command)
        command = command.replace("100000000000", "1000000")
        environment = {**os.environ, "PATH": path, **environment}
        return subprocess.check_output(["/bin/bash", "-ec", command], cwd=tmp_path, env=environment, text=True)

    for command, environment in jobs:
        run(command, **environment)
    merged, files = run(blocks("sh")[1]), sorted((tmp_path / "parts").iterdir())
    assert len(files) == len(jobs) == 97
    files[3].unlink()
    files[70].unlink()
    kept = {file: file.stat().st_ino for file in files if file.exists()}
    with pytest.raises(subprocess.CalledProcessError):
        run(blocks("sh")[1])
    for command, environment in jobs:
        run(command, **environment)
    assert {file: file.stat().st_ino for file in kept} == kept and all(file.exists() for file in files)
    assert run(blocks("sh")[1]) == merged
    whole = ut.probability(FIG4, ut.Plan.random(1_000_000))
    parts = [ut.Tally.from_json(file.read_text(encoding="utf-8")) for file in files]
    assert ut.merge(parts).heads == whole.heads
