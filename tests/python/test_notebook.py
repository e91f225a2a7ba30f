# SPDX-License-Identifier: MIT
"""What notebooks show, and the three of python/notebooks, run cell by cell."""

import importlib
import os
import sys
import xml.etree.ElementTree

import pytest
from conftest import BALL, ROOT

import carom
import carom.notebook


def edited(scene):
    edit = carom.Edit(scene)
    edit.vary(carom.velocity("ball"))
    edit.nail("ball", 1.5).position(2.5, 0.3, None)
    return edit.solve(effort="fast")


def test_a_motion_shows_a_picture(ball):
    picture = xml.etree.ElementTree.fromstring(carom.simulate(ball)._repr_svg_())
    assert picture.tag.endswith("svg")


def test_an_answer_shows_its_changes_and_both_motions(ball):
    result = edited(ball)
    text = result._repr_html_()
    table = text[text.index("<table>"):text.index("</table>") + len("</table>")]
    rows = xml.etree.ElementTree.fromstring(table).findall("tr")
    assert [cell.text for cell in rows[1]][:2] == ["velocity.x of 'ball'", "2"] and len(rows) == 1 + len(result.changed)
    picture = text[text.index("<svg"):]
    xml.etree.ElementTree.fromstring(picture)
    assert picture == carom.simulate(result.scene).text("svg", before=carom.simulate(ball)).decode().split("?>\n", 1)[1]


def need_pages():
    if not os.environ.get("CAROM_COMMAND"):
        pytest.skip("the command is not built")
    try:
        carom.notebook.page(carom.simulate(carom.Scene(BALL)))
    except carom.InputError as error:
        assert "three.js is not installed" in error.message
        pytest.skip(error.message)


def test_a_page_plays_a_motion(ball, tmp_path):
    need_pages()
    page = carom.notebook.page(carom.simulate(ball, 1.25), height=321)
    page.write(tmp_path / "motion.html")
    assert (tmp_path / "motion.html").read_text().lower().startswith("<!doctype html>")
    frame = page._repr_html_()
    assert frame.startswith('<iframe srcdoc="&lt;') and 'height="321"' in frame and frame.count("<") == 2
    assert carom.notebook.page(carom.simulate(ball), before=carom.simulate(ball, 1.0)).text != page.text


def test_a_page_without_the_command_says_so(ball, monkeypatch):
    monkeypatch.delenv("CAROM_COMMAND", raising=False)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(FileNotFoundError, match="CAROM_COMMAND"):
        carom.notebook.page(carom.simulate(ball))


@pytest.fixture
def build(monkeypatch, tmp_path):
    for name in ("nbclient", "ipykernel", "matplotlib"):
        pytest.importorskip(name, reason=f"left out: {name} is not installed; scripts/setup frameworks")
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    monkeypatch.setattr(sys, "path", [str(ROOT / "python" / "notebooks"), *sys.path])
    return importlib.import_module("build")


def outputs(notebook):
    return [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]


def printed(notebook):
    return "".join(output.text for output in outputs(notebook) if output.output_type == "stream" and output.name == "stdout")


def shown(notebook, kind):
    return [output.data[kind] for output in outputs(notebook) if kind in output.get("data", {})]


def test_first_edit(build):
    notebook = build.run("first_edit")
    assert "solved [0.5  0.6" in printed(notebook)
    assert len(shown(notebook, "image/svg+xml")) == 1 and len(shown(notebook, "image/png")) == 2
    assert "<table>" in shown(notebook, "text/html")[0]
    assert "There is no page" in printed(notebook) or "<iframe" in shown(notebook, "text/html")[1]


def test_gradients_through_impacts(build):
    text = printed(build.run("gradients_through_impacts"))
    try:
        importlib.import_module("mujoco")
    except ImportError:
        assert "MuJoCo is not installed" in text
        pytest.skip("left out beside carom: MuJoCo is not installed; scripts/setup frameworks")
    finest = next(line for line in text.splitlines() if line.startswith(" 1e-04"))
    height, *errors = map(float, finest.split()[1:])
    assert abs(height) < 2e-3  # that of MuJoCo is right
    assert min(errors) > 1e-3 and max(errors) > 1


def test_identification(build):
    text = printed(build.run("identification"))
    assert "elasticity of 'wood'" in text and "expected 199 +- 20" in text and text.count("spread") == 5
