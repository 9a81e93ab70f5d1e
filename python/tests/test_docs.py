"""The examples in the documentation are run, and must print the output shown."""

import doctest
import importlib
import pkgutil
import re

import pytest

import lagrangian

from conftest import ROOT

FILES = [ROOT / "python" / "README.md", ROOT / "docs" / "python.md"]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_programs_run_as_printed(path, monkeypatch, tmp_path):
    for needed in ("pandas", "scipy"):
        pytest.importorskip(needed)
    blocks = re.findall(r"^```python\n(.*?)^```", path.read_text(), re.S | re.M)
    assert len(blocks) >= 3
    # Paths are those of a clone; outputs are written elsewhere.
    for folder in ("machines", "cli"):
        (tmp_path / folder).symlink_to(ROOT / folder)
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks:
        exec(compile(block, str(path), "exec"), names)


def test_docstrings_say_what_happens(monkeypatch):
    monkeypatch.chdir(ROOT)
    tried = 0
    for module in pkgutil.iter_modules(lagrangian.__path__, "lagrangian."):
        if module.name.endswith(("_native", "__main__")):
            continue
        found = doctest.testmod(importlib.import_module(module.name), extraglobs={"load": lagrangian.load})
        assert not found.failed, module.name
        tried += found.attempted
    tried += doctest.testmod(lagrangian).attempted
    assert tried >= 4
