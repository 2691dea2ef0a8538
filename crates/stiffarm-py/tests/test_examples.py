"""The examples and the notebook run as they stand."""

import json
import runpy
from pathlib import Path

import matplotlib.pyplot as plt
import pytest

EXAMPLES = Path(__file__).parents[1] / "examples"


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.py")), ids=lambda path: path.stem)
def test_example(path, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(path), run_name="__main__")
    plt.close("all")
    assert capsys.readouterr().out
    assert ("savefig" in path.read_text()) == (tmp_path / f"{path.stem}.png").is_file()


def test_notebook(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    notebook = json.loads((EXAMPLES / "report.ipynb").read_text())
    code = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    names: dict[str, object] = {}
    for i, cell in enumerate(code):
        exec(compile(cell, f"cell {i}", "exec"), names)
    plt.close("all")
    assert "nearest limit" in capsys.readouterr().out
    assert all(not cell.get("outputs") for cell in notebook["cells"])
