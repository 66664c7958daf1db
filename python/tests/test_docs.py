"""The docs: the notebook runs, and the names in the tables exist."""

import re
from pathlib import Path

import pytest

import mspskel
from test_formats import write_off

DOCS = Path(__file__).resolve().parents[2] / "docs"


def test_the_notebook_runs():
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    for needed in ("ipykernel", "matplotlib", "pandas"):
        pytest.importorskip(needed)
    notebook = nbformat.read(DOCS / "python.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    shown = [o.data for cell in notebook.cells if cell.cell_type == "code" for o in cell.outputs if "data" in o]
    assert any("<iframe" in data.get("text/html", "") for data in shown)
    assert "'proved', 1, 0" in str(shown)


def test_names_in_the_tables_exist(animal):
    text = (DOCS / "python.md").read_text()
    rows = re.findall(r"^\| (?:skeletor|osteoid.*|MeshParty|mspskel) \| (`.*?`)", text, re.M)
    names = [name for row in rows for name in re.findall(r"[a-z_]+", row.strip("`"))]
    assert len(names) > 50
    missing = [name for name in names if not hasattr(mspskel.Skeleton, name) and not hasattr(animal, name)]
    assert set(missing) <= {"path", "name"}


def test_the_examples_of_the_page_run(tmp_path, monkeypatch, request, torus):
    pytest.importorskip("distributed"), pytest.importorskip("pyarrow")
    blocks = re.findall(r"^```python\n(.*?)^```", (DOCS / "python.md").read_text(), re.M | re.S)
    assert len(blocks) == 4
    monkeypatch.chdir(tmp_path)
    (tmp_path / "meshes").mkdir()
    write_off(tmp_path / "meshes" / "ring.off", torus)
    names = {"mesh": mspskel.sample("quadruped"), "client": request.getfixturevalue("client")}
    for block in blocks:
        exec(compile(block, "python.md", "exec"), names)
    assert {"quadruped.swc", "mesh.glb", "skeletons"} <= {path.name for path in tmp_path.iterdir()}
    assert len(names["skeleton"].terminals()) > 4 and list(names["table"].status) == ["done"]


def test_the_page_has_the_options_of_the_batch():
    from mspskel.batch.command import parser

    text = (DOCS / "python.md").read_text()
    known = {option for action in parser()._actions for option in action.option_strings}
    block = text[text.index("## Batches") :]
    used = set(re.findall(r"mspskel batch .*", block))
    for line in used:
        assert set(re.findall(r" (--[a-z-]+)", line)) <= known | {"--smallest"}


def test_the_recipes_run(tmp_path, monkeypatch):
    blocks = re.findall(r"^```python\n(.*?)^```", (DOCS / "recipes.md").read_text(), re.M | re.S)
    assert len(blocks) == 3
    monkeypatch.chdir(tmp_path)
    (tmp_path / "out").mkdir()
    mesh = mspskel.sample("quadruped")
    mspskel.skeletonize(mesh).to("out/cell.swc")
    for block in blocks:
        code = compile(block, "recipes.md", "exec")
        if "import bpy" in block:
            continue  # Blender's own Python alone has it
        if "import navis" in block:
            pytest.importorskip("navis")
        exec(code, {"mspskel": mspskel, "mesh": mesh})
