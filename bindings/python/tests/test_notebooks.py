"""The notebooks run in a kernel from their first cell to their last, draw what they promise, and are kept without output."""

import base64
import json
import os
from pathlib import Path

import pytest

nbclient = pytest.importorskip("nbclient")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("ipykernel")

NOTEBOOKS = Path(__file__).resolve().parents[1] / "notebooks"
FIGURES = {
    "a_class_of_tossers": 2,
    "a_measured_launch": 2,
    "choosing_a_solver": 2,
    "dzhanibekovs_racket": 4,
    "ten_million_launches": 1,
    "the_unfair_toss": 4,
}


@pytest.mark.parametrize(("name", "figures"), FIGURES.items())
@pytest.mark.filterwarnings("default")  # Those of the client; the kernel has its own.
def test_a_notebook_runs(name, figures, tmp_path):
    notebook = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    drawn = [output.data["image/png"] for output in outputs if "image/png" in output.get("data", {})]
    # Set to a folder, the charts are kept there to be looked at.
    folder = Path(os.environ.get("UNFAIR_TOSS_CHARTS", tmp_path))
    for number, picture in enumerate(drawn):
        path = folder / f"{name}-{number + 1}.png"
        path.write_bytes(base64.b64decode(picture))
        assert path.stat().st_size > 8_000
    assert len(drawn) == figures
    assert not [output.text for output in outputs if output.get("name") == "stderr" and "Warning" in output.text]


def test_every_notebook_is_run_and_has_no_output():
    assert {path.stem for path in NOTEBOOKS.glob("*.ipynb")} == set(FIGURES)
    for path in NOTEBOOKS.glob("*.ipynb"):
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            assert not cell.get("outputs") and cell.get("execution_count") is None, path.name
