# SPDX-License-Identifier: MIT
"""docs/python-frameworks.md runs as it is written, as far as its frameworks are installed."""

import re
import subprocess
import sys

import pytest
from conftest import ROOT, torch_or_skip

PAGE = ROOT / "docs" / "python-frameworks.md"


def test_the_page_runs():
    pytest.importorskip("jax", reason="left out: JAX is not installed; scripts/setup frameworks")
    pytest.importorskip("matplotlib", reason="left out: matplotlib is not installed; scripts/setup frameworks")
    snippets = re.findall(r"^```python\n(.*?)^```", PAGE.read_text(), re.DOTALL | re.MULTILINE)
    assert len(snippets) == 3
    page = subprocess.run([sys.executable, "-c", "\n".join(snippets)], capture_output=True, text=True, cwd=ROOT)
    assert page.returncode == 0, page.stderr
    value, gradient = re.findall(r"Array\((\[.*?\]|[^,]*), dtype=float64\)", page.stdout)[:2]
    assert float(value) == pytest.approx((0.862305 + 2) ** 2 + 0.3203517447724311**2, rel=1e-7)  # as far as it is printed
    assert len(gradient.split(",")) == 3


def test_the_snippet_of_torch_runs():
    torch_or_skip()
    snippet, = re.findall(r"^```\n(import torch.*?)^```", PAGE.read_text(), re.DOTALL | re.MULTILINE)
    setup = 'import carom\nevaluator = carom.Edit.of(carom.Scene.read("examples/scenes/bounce.json")).evaluator()\n'
    page = subprocess.run([sys.executable, "-c", setup + snippet], capture_output=True, text=True, cwd=ROOT)
    assert page.returncode == 0 and page.stdout.startswith("tensor(["), page.stderr
