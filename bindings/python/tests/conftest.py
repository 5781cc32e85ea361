"""What the tests share: the program of the command line, and the random launches."""

import json
import os
import shutil
import subprocess
import sysconfig
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[3]


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--slow", action="store_true", help="also run the tests that take minutes")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if not config.getoption("--slow"):
        skip = pytest.mark.skip(reason="takes minutes; --slow runs it")
        for item in items:
            if "slow" in item.keywords:
                item.add_marker(skip)


def built(name: str, *others: str | None) -> str:
    """The program of this name as cargo builds it, or else one of the others."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    for place in (target / "release" / name, *others):
        if place and Path(place).exists():
            return str(place)
    pytest.skip(f"there is no program: cargo build --release --bin {name}")


@pytest.fixture(scope="session")
def program() -> str:
    """The program `unfair-toss`."""
    return os.environ.get("UNFAIR_TOSS") or built("unfair-toss", shutil.which("unfair-toss"))


@pytest.fixture(scope="session")
def suite(tmp_path_factory) -> Iterator[str]:
    """The program of `verify`, as its wheel installs it; or else as cargo builds it, on the PATH under the same name."""
    name = "unfair-toss-verify"
    installed = shutil.which(name, path=sysconfig.get_path("scripts"))
    with pytest.MonkeyPatch.context() as patch:
        if installed is None:
            folder = tmp_path_factory.mktemp("programs")
            (folder / name).symlink_to(built("verify", shutil.which(name)))
            patch.setenv("PATH", str(folder), prepend=os.pathsep)
        yield installed or str(folder / name)


@pytest.fixture(scope="session")
def ask(program: str):
    """Asks the command line, and reads its JSON."""

    def answer(*arguments: str) -> dict:
        run = subprocess.run([program, *arguments, "--format", "json"], capture_output=True, text=True, check=False)
        return json.loads(run.stdout)

    return answer


@pytest.fixture(scope="session")
def launches() -> tuple[np.ndarray, ...]:
    """A million launches: rates about x, y, z in rad/s, and speeds in m/s."""
    random = np.random.default_rng(1)
    return (*random.uniform(-40.0, 40.0, (3, 1_000_000)), random.uniform(0.0, 5.0, 1_000_000))
