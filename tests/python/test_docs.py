# SPDX-License-Identifier: MIT
"""The page docs/python.md runs as it is written, and so do the examples; mypy accepts them."""

import os
import pathlib
import re
import subprocess
import sys

import pytest
from conftest import ROOT

import carom

PAGE = ROOT / "docs" / "python.md"
EXAMPLES = sorted((ROOT / "python" / "examples").glob("*.py"))


def test_the_page_runs(monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    snippets = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(), re.DOTALL | re.MULTILINE)
    assert len(snippets) >= 5
    names: dict[str, object] = {}
    for snippet in snippets:
        exec(compile(snippet, str(PAGE), "exec"), names)
    printed = capsys.readouterr().out
    assert "<Motion 0.6 s, 2 impacts, complete>" in printed
    assert "/bodies/0/mass found -2, expected a number > 0" in printed
    # every public name that the page uses is there
    for name in re.findall(r"\bcarom\.([A-Za-z_]+)", PAGE.read_text()):
        assert hasattr(carom, name) or name == "carom", name


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_run(path):
    run = subprocess.run([sys.executable, path], capture_output=True, text=True, cwd=ROOT)
    assert run.returncode == 0, run.stderr
    expected = path.with_suffix(".txt").read_text()
    assert run.stdout == expected


def test_types():
    """The stub is complete and true for what the examples do."""
    stub = (pathlib.Path(carom.__file__).parent / "_carom.pyi").read_text()
    for line in stub.splitlines():
        untyped = re.search(r"(->|:) (object|Any)\b", line)
        assert not untyped or "__eq__" in line, line
    package = pathlib.Path(carom.__file__).parent
    files = [*EXAMPLES, *package.glob("*.py"), *package.glob("*.pyi")]
    run = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", ROOT / "build" / "venv" / "mypy", *files],
        capture_output=True, text=True, cwd=ROOT, env=dict(os.environ, MYPYPATH=os.environ["PYTHONPATH"]))
    assert run.returncode == 0, run.stdout + run.stderr
