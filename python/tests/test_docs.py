"""What the documentation prints is run as it is printed."""

import re

import pytest

from conftest import ROOT

FILES = [ROOT / "python" / "README.md", ROOT / "docs" / "python.md"]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_programs_run_as_printed(path, monkeypatch, tmp_path):
    for needed in ("pandas", "scipy"):
        pytest.importorskip(needed)
    blocks = re.findall(r"^```python\n(.*?)^```", path.read_text(), re.S | re.M)
    assert len(blocks) >= 3
    # Paths are those of a clone; what is written goes elsewhere.
    for folder in ("machines",):
        (tmp_path / folder).symlink_to(ROOT / folder)
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks:
        exec(compile(block, str(path), "exec"), names)
