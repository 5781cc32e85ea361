"""The package: fast to import, fast to run, documented and typed, and its README's lines run."""

import inspect
import pickle
import re
import subprocess
import sys
from pathlib import Path

import mypy.api
import pytest

import unfair_toss as ut

from conftest import ROOT


def python_blocks(page: Path) -> list[str]:
    return re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


PAGES = ["README.md", "bindings/python/README.md", "docs/guide/python.md"]


@pytest.mark.parametrize("page", PAGES)
def test_the_lines_of_the_readme_run(page, suite):
    blocks = python_blocks(ROOT / page)
    assert blocks
    for block in blocks:
        exec(compile(block, page, "exec"), {})


def test_the_types_of_the_lines_agree(tmp_path):
    for page in [*PAGES, "docs/more-machines.md"]:
        for number, block in enumerate(python_blocks(ROOT / page)):
            (tmp_path / f"{re.sub(r'[^a-z]', '_', page)}_{number}.py").write_text(block, encoding="utf-8")
    settings = ["--config-file", str(ROOT / "bindings/python/pyproject.toml"), "--cache-dir", str(tmp_path / "cache")]
    said, errors, code = mypy.api.run([*settings, "--allow-untyped-defs", "--allow-untyped-calls", *map(str, tmp_path.glob("*.py"))])
    assert code == 0, said + errors


def test_the_guide_shows_the_table_of_a_notebook():
    landing = ut.toss(ut.Toss((20.0, 0.0, 30.0), speed=2.4, body="us-quarter"))
    page = (ROOT / "docs" / "guide" / "python.md").read_text(encoding="utf-8")
    shown = re.findall(r"^\| `(\w+)` \| (.*) \|$", page, re.MULTILINE)
    assert shown == re.findall(r"<th>(\w+)</th><td>(.*?)</td>", landing._repr_html_())[:4]


def test_everything_public_is_documented_with_units_and_errors():
    for name in ut.__all__:
        thing = getattr(ut, name)
        if name in ("__version__",):
            continue
        assert inspect.getdoc(thing), name
        if inspect.isfunction(thing):
            text = inspect.getdoc(thing)
            for word in ("Parameters", "Returns", "Raises"):
                assert f"{word}\n{'-' * len(word)}" in text, f"{name}: {word}"
            for parameter in inspect.signature(thing).parameters:
                assert re.search(rf"\b{parameter}\b", text), f"{name}: {parameter}"
    assert (Path(ut.__file__).parent / "py.typed").exists()


def test_functions_and_methods_are_pickled_by_their_names():
    functions = [getattr(ut, name) for name in ut.__all__ if inspect.isroutine(getattr(ut, name))]
    for function in [*functions, ut.Body.named, ut.Plan.random, ut.Space.with_body, ut.Trace.plot]:
        assert pickle.loads(pickle.dumps(function)) is function and inspect.signature(function)


def test_each_exception_is_a_value_error_or_a_runtime_error():
    for name, kind in inspect.getmembers(ut.errors, inspect.isclass):
        if issubclass(kind, ut.errors.TossError) and kind is not ut.errors.TossError:
            assert issubclass(kind, ValueError) != issubclass(kind, RuntimeError), name


def test_the_import_brings_few_modules_beyond_numpys():
    code = "import numpy, sys; before = set(sys.modules); import unfair_toss; print(*set(sys.modules) - before)"
    modules = set(subprocess.check_output([sys.executable, "-c", code], text=True).split())
    assert not {"scipy", "matplotlib", "dask", "distributed", "concurrent.futures"} & modules
    assert len(modules) < 30, modules


@pytest.mark.parametrize(
    ("name", "options", "words"),
    [
        ("columns", ["--tosses", "1000", "--rounds", "1", "--no-rust"], "count: "),
        ("executors", ["--launches", "1000000", "--rounds", "1"], " heads of 1000000 by both"),
    ],
)
def test_a_benchmark_runs(name, options, words):
    script = ROOT / "bindings" / "python" / "benchmarks" / f"{name}.py"
    assert words in subprocess.check_output([sys.executable, script, *options], text=True)
