"""The notebook that ships runs from its first cell to its last, and its results show themselves."""

from __future__ import annotations

import os
from pathlib import Path

import nbclient
import nbformat
import pytest

ROOT = Path(__file__).parents[2]
NOTEBOOK = ROOT / "examples" / "first_notebook.ipynb"
LONGEST = 10_000
"""Characters of HTML that a result may take in a notebook; a player has its run inside."""


def cells(notebook: nbformat.NotebookNode) -> list[nbformat.NotebookNode]:
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def shown(cell: nbformat.NotebookNode) -> dict[str, str]:
    """What the last line of a cell shows, by kind."""
    return next((dict(o.data) for o in cell.outputs if o.output_type == "execute_result"), {})


def test_the_notebook_is_stored_without_outputs() -> None:
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbformat.validate(notebook)
    assert all(cell.outputs == [] and cell.execution_count is None for cell in cells(notebook))


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> list[nbformat.NotebookNode]:
    folder = tmp_path_factory.mktemp("notebook")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("IPYTHONDIR", str(folder / "ipython"))
        patch.setenv("OPENBLAS_NUM_THREADS", "1")
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        client = nbclient.NotebookClient(notebook, timeout=600, resources={"metadata": {"path": str(folder)}})
        client.execute(env=dict(os.environ))
    return cells(notebook)


@pytest.mark.slow
def test_every_cell_ends_in_something_to_look_at(played: list[nbformat.NotebookNode]) -> None:
    for cell in played:
        assert {"text/html", "image/png"} & set(shown(cell)), cell.source


@pytest.mark.slow
def test_results_are_short_and_pictures_are_pictures(played: list[nbformat.NotebookNode]) -> None:
    for cell in played:
        found = shown(cell)
        if "plot" in cell.source:
            assert found["image/png"].startswith("iVBOR")
        elif "show(" in cell.source:
            assert found["text/html"].startswith("<iframe")
        elif "run[" not in cell.source:  # xarray's own, with its style sheet
            assert len(found["text/html"]) < LONGEST, cell.source


@pytest.mark.slow
def test_progress_stays_on_one_line_and_nothing_is_warned_of(played: list[nbformat.NotebookNode]) -> None:
    streams = [output for cell in played for output in cell.outputs if output.output_type == "stream"]
    told = "".join(o.text for o in streams if o.name == "stdout")
    assert told.count("\r") >= 8
    assert "\n" not in told
    assert told.endswith("100%")
    assert [o.text for o in streams if o.name == "stderr" and "compil" not in o.text] == []
