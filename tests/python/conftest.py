# SPDX-License-Identifier: MIT
"""What the tests of the Python package share."""

import importlib
import os
import pathlib

import pytest

import carom

os.environ.pop("LD_PRELOAD", None)  # of a sanitizer: not for the programs that tests run, and the one that reads its traces

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "examples" / "scenes"


def torch_or_skip():
    """PyTorch; without it the test is left out, but not where CI runs it."""
    if os.environ.get("CAROM_REQUIRE_TORCH"):
        return importlib.import_module("torch")
    return pytest.importorskip("torch", reason="left out: PyTorch is not installed; scripts/setup torch, then tests/python/run /usr")


# A ball that bounces on a floor, from the README.
BALL = {
    "carom": 1,
    "gravity": [0, 0, -9.81],
    "duration": 2,
    "materials": {"rubber": {"elasticity": 0.8, "friction": 0.5}},
    "bodies": [
        {"name": "floor", "fixed": True, "material": "rubber", "shape": {"plane": {"normal": [0, 0, 1], "offset": 0}}},
        {"name": "ball", "material": "rubber", "mass": 0.06, "shape": {"sphere": {"radius": 0.03}},
         "position": [0, 0, 1], "velocity": [2, 0, 1], "angular_velocity": [0, 10, 0]},
    ],
}


@pytest.fixture
def ball() -> carom.Scene:
    return carom.Scene(BALL)
