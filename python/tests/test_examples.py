"""Notebooks: those of the examples run and show what is in them, and the package shows itself in one.

UPDATE_NOTEBOOKS=1 writes what the examples show today into them, and two of their figures into docs/gallery (docs/renew notebooks does it).
"""

import base64
import os
from pathlib import Path

import pytest

nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
for module in ("ipykernel", "ipywidgets", "tqdm"):
    pytest.importorskip(module)

ROOT = Path(__file__).parents[2]
NOTEBOOKS = sorted((ROOT / "python/examples").glob("*.ipynb"))
GALLERY = {"map": "notebook-map.png", "torque_speed": "notebook-torque-speed.png"}
BAR = "application/vnd.jupyter.widget-view+json"
HARD = """
import squeezefilm as sf
mesh = {"film_nodes_along": 201, "film_nodes_across": 41, "contact_nodes": 1441, "steps_per_cycle": 1440}
hard = sf.preset("fundamental").with_({f"numerics.{key}": value for key, value in mesh.items()})
print("begun", flush=True)
hard.solve(method="paper")
"""


@pytest.fixture
def execute(monkeypatch):
    # Figures are shown, not kept back.
    monkeypatch.delenv("MPLBACKEND", raising=False)
    return lambda notebook, folder=ROOT: nbclient.NotebookClient(
        notebook, timeout=600, record_timing=False, resources={"metadata": {"path": str(folder)}}
    ).execute()


def shown(notebook, kind):
    """What the cells put out of a kind, "text" or "image/png"."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", ())]
    return [output.get(kind) or output.get("data", {}).get(kind) for output in outputs if kind in output or kind in output.get("data", {})]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_runs_and_shows_what_is_in_it(path, execute):
    notebook = nbformat.read(path, 4)
    for module in ("matplotlib", "scipy", "SALib"):
        if any(f"import {module}" in cell.source or f"from {module}" in cell.source for cell in notebook.cells):
            pytest.importorskip(module)
    execute(notebook, path.parent)
    figure = ROOT / "docs/gallery" / GALLERY.get(path.stem, "")
    if "UPDATE_NOTEBOOKS" in os.environ:
        # Without bars, which show times.
        notebook.metadata = {"kernelspec": notebook.metadata["kernelspec"]}
        for cell in notebook.cells:
            if "outputs" in cell:
                cell.outputs = [output for output in cell.outputs if BAR not in output.get("data", {})]
        nbformat.write(notebook, path)
        if path.stem in GALLERY:
            figure.write_bytes(base64.b64decode(shown(notebook, "image/png")[-1]))
    committed = nbformat.read(path, 4)
    assert shown(notebook, "text") == shown(committed, "text") != []
    assert len(shown(notebook, "image/png")) == len(shown(committed, "image/png")) > 0
    if path.stem in GALLERY:
        assert figure.read_bytes() == base64.b64decode(shown(committed, "image/png")[-1])


def test_a_notebook_has_a_bar_and_shows_a_run_with_its_wave(execute):
    cells = [
        "import squeezefilm as sf",
        "table = sf.sweep(sf.preset('fundamental'), 'film.min_spacing_nm', [100, 200, 300], fidelity='draft')",
        "sf.preset('fundamental').solve(fidelity='draft')",
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    execute(notebook)
    (bar,) = shown(notebook, BAR)
    widgets = notebook.metadata["widgets"]["application/vnd.jupyter.widget-state+json"]["state"]
    (progress,) = (widget["state"] for widget in widgets.values() if widget["model_name"] == "FloatProgressModel")
    assert bar["model_id"] in widgets and (progress["value"], progress["max"]) == (1, 1)
    (run,) = shown(notebook, "text/html")
    assert "film α</td><td>0.24" in run and run.rstrip().endswith("</svg>")


def test_the_stop_button_ends_a_solve():
    from jupyter_client.manager import start_new_kernel

    manager, client = start_new_kernel()
    try:
        client.execute(HARD)
        while client.get_iopub_msg(timeout=60)["content"].get("text") != "begun\n":
            pass
        manager.interrupt_kernel()
        assert client.get_shell_msg(timeout=60)["content"]["ename"] == "KeyboardInterrupt"
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=True)
