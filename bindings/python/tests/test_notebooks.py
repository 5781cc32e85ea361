"""The notebooks run from their first line to their last, and draw what they promise."""

import os
import runpy
from pathlib import Path

import pytest

plt = pytest.importorskip("matplotlib.pyplot")

NOTEBOOKS = Path(__file__).resolve().parents[1] / "notebooks"


@pytest.mark.parametrize(
    ("name", "charts"), [("the_unfair_toss", 4), ("choosing_a_solver", 2), ("dzhanibekovs_racket", 4)]
)
def test_a_notebook_runs(name, charts, tmp_path):
    plt.switch_backend("Agg")
    plt.close("all")
    runpy.run_path(str(NOTEBOOKS / f"{name}.py"))
    # Set to a folder, the charts are kept there to be looked at.
    folder = Path(os.environ.get("UNFAIR_TOSS_CHARTS", tmp_path))
    for number in plt.get_fignums():
        path = folder / f"{name}-{number}.png"
        plt.figure(number).savefig(path, dpi=80)
        assert path.stat().st_size > 10_000
    assert len(plt.get_fignums()) == charts
    plt.close("all")


def test_every_notebook_is_run():
    assert {path.stem for path in NOTEBOOKS.glob("*.py")} == {"the_unfair_toss", "choosing_a_solver", "dzhanibekovs_racket"}
