"""Runs the first notebook of the README from top to bottom in a kernel, in its own environment."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import ROOT

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")


def blocks():
    text = (ROOT / "python" / "README.md").read_text()
    return re.findall(r"^```python\n(.*?)^```", text, re.S | re.M)


def cells(block):
    """The lines of a block as cells: each statement with output is a cell of its own, so that the
    output is shown."""
    lines = [line for line in block.splitlines() if line.strip()]
    return [nbformat.v4.new_code_cell(line) for line in lines] if "(\n" not in block else [nbformat.v4.new_code_cell(block)]


def run(notebook, folder, kernel):
    client = nbclient.NotebookClient(
        notebook, timeout=300, kernel_name=kernel, resources={"metadata": {"path": str(folder)}}
    )
    client.execute()


@pytest.mark.parametrize("place", ["here", "fresh environment"])
def test_the_first_notebook_runs_and_shows(place, tmp_path):
    (tmp_path / "machines").symlink_to(ROOT / "machines")
    kernel = "python3"
    environment = dict(os.environ)
    if place == "fresh environment":
        wheel = os.environ.get("LAGRANGIAN_WHEEL")
        if not wheel:
            pytest.skip("LAGRANGIAN_WHEEL names no wheel to be installed: maturin build --release --out dist")
        fresh = tmp_path / "fresh"
        subprocess.run([sys.executable, "-m", "venv", str(fresh)], check=True)
        python = fresh / "bin" / "python"
        wanted = [f"{Path(wheel).resolve()}[pandas]", "ipykernel"]
        subprocess.run([python, "-m", "pip", "install", "-q", *wanted], check=True)
        kernel = "lagrangian-fresh"
        subprocess.run([python, "-m", "ipykernel", "install", "--prefix", str(tmp_path / "kernels"), "--name", kernel], check=True)
        os.environ["JUPYTER_PATH"] = str(tmp_path / "kernels" / "share" / "jupyter")
    notebook = nbformat.v4.new_notebook()
    notebook.cells = cells(blocks()[0])
    try:
        run(notebook, tmp_path, kernel)
    finally:
        os.environ.clear()
        os.environ.update(environment)
    shown = [output["data"] for cell in notebook.cells for output in cell.outputs if "data" in output]
    tables = [data["text/html"] for data in shown if "<table>" in data.get("text/html", "")]
    pages = [data["text/html"] for data in shown if "<iframe sandbox" in data.get("text/html", "")]
    equations = [data["text/markdown"] for data in shown if "text/markdown" in data]
    assert tables and "theta1" in tables[0]
    assert pages and "DoublePendulum" in pages[-1]
    assert equations and "$" in equations[0]
