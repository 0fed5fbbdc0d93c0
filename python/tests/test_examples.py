"""The examples run, and what they say of themselves holds."""

import runpy
from pathlib import Path

import pytest

EXAMPLES = sorted((Path(__file__).parents[1] / "examples").glob("*.py"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_it_runs(path, capsys):
    for module in ("matplotlib", "scipy", "SALib"):
        if f"import {module}" in path.read_text() or f"from {module}" in path.read_text():
            pytest.importorskip(module)
    runpy.run_path(str(path))
    assert capsys.readouterr().out
