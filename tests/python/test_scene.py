# SPDX-License-Identifier: MIT
"""Scenes: from dicts, texts and files, back again, and what is said of bad ones."""

import copy
import json
import math
import pickle

import numpy as np
import pytest
from conftest import BALL, ROOT, SCENES

import carom


def changed(**ball):
    document = copy.deepcopy(BALL)
    document["bodies"][1].update(ball)
    return document


def same_states(a, b):
    one = carom.simulate(a)
    other = carom.simulate(b)
    for body in a.bodies:
        x, y = one.state_at(body, one.end), other.state_at(body, other.end)
        for name in ("position", "orientation", "velocity", "angular_velocity"):
            if getattr(x, name).tobytes() != getattr(y, name).tobytes():
                return False
    return one.signature() == other.signature()


def test_dict_text_and_file_are_the_same_scene(tmp_path):
    by_dict = carom.Scene(BALL)
    by_text = carom.Scene(json.dumps(BALL))
    by_dict.write(tmp_path / "ball.json")
    by_file = carom.Scene.read(str(tmp_path / "ball.json"))
    assert same_states(by_dict, by_text) and same_states(by_dict, by_file)
    assert by_file.bodies == ("floor", "ball")
    assert by_file.materials == ("rubber",)
    assert by_file.duration == 2
    assert by_file.gravity.tolist() == [0, 0, -9.81]
    assert by_file.to_dict()["bodies"][1]["velocity"] == [2, 0, 1]
    assert same_states(carom.Scene(by_file.to_dict()), by_dict)


def test_arrays_and_numbers_of_numpy_are_numbers():
    scene = carom.Scene(changed(velocity=np.array([2.0, 0, 1]), mass=np.float64(0.06), position=(np.int64(0), 0, 1)))
    assert same_states(scene, carom.Scene(BALL))


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.json")), ids=lambda path: path.stem)
def test_every_example_is_read_and_pickled(path):
    scene = carom.Scene.read(path)
    assert len(scene.bodies) > 0
    again = pickle.loads(pickle.dumps(scene))
    assert again.bodies == scene.bodies and again.duration == scene.duration
    assert again.to_text() == scene.to_text()


def test_a_pickled_scene_has_the_same_bits():
    inertia = [[2.0e-5, 1e-7, 3e-7], [1e-7, 3.0e-5, 2e-7], [3e-7, 2e-7, 4.1e-5]]
    scene = carom.Scene(changed(shape={"box": {"size": [0.1, 0.05, 0.03]}}, inertia=inertia))
    assert same_states(pickle.loads(pickle.dumps(scene)), scene)
    assert same_states(copy.deepcopy(scene), scene)


def test_meshes_are_found_from_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(SCENES)
    scene = carom.Scene.read("mug.json")
    monkeypatch.chdir(tmp_path)
    assert pickle.loads(pickle.dumps(scene)).bodies == scene.bodies
    by_text = carom.Scene((SCENES / "mug.json").read_text(), folder=SCENES)
    assert by_text.bodies == scene.bodies
    with pytest.raises(carom.FormatError):
        carom.Scene((SCENES / "mug.json").read_text())


def test_errors_have_file_pointer_and_sentence(tmp_path):
    with pytest.raises(carom.FormatError) as raised:
        carom.Scene(changed(mass=-2), name="here")
    error = raised.value
    assert (error.file, error.where) == ("here", "/bodies/1/mass")
    assert "-2" in error.message and str(error) == f"here: /bodies/1/mass: {error.message}"
    assert isinstance(error, carom.InputError) and isinstance(error, ValueError)
    again = pickle.loads(pickle.dumps(error))
    assert (again.file, again.where, again.message) == (error.file, error.where, error.message)

    path = tmp_path / "broken.json"
    path.write_text('{"carom": 1,\n "bodies": [}')
    with pytest.raises(carom.FormatError) as raised:
        carom.Scene.read(path)
    assert raised.value.file == str(path) and "line 2" in raised.value.where
    with pytest.raises(carom.FormatError, match="nowhere.json"):
        carom.Scene.read(tmp_path / "nowhere.json")
    with pytest.raises(carom.FormatError):
        carom.Scene(BALL).write(tmp_path / "no" / "folder" / "x.json")


@pytest.mark.parametrize("value", [math.nan, math.inf, np.array([0.0, np.nan, 0])])
def test_what_is_not_finite_has_its_pointer(value):
    with pytest.raises(carom.InputError) as raised:
        carom.Scene(changed(velocity=value))
    assert raised.value.where.startswith("/bodies/1/velocity")


def test_what_json_cannot_hold_has_its_pointer():
    with pytest.raises(carom.InputError) as raised:
        carom.Scene(changed(mass=1j))
    assert raised.value.where == "/bodies/1/mass"
    with pytest.raises(carom.InputError):
        carom.Scene({1: 2})
    with pytest.raises(TypeError):
        carom.Scene(7)
    with pytest.raises(TypeError):
        carom.Scene()


def test_bytes_that_are_no_text_are_an_error_that_can_be_read(tmp_path):
    path = tmp_path / "latin.json"
    path.write_bytes(b'{"carom": 1, "n\xe9": 2, "bodies": []}')
    with pytest.raises(carom.FormatError) as raised:
        carom.Scene.read(path)
    assert str(raised.value)


def test_repr_and_equality():
    scene = carom.Scene(BALL)
    assert repr(scene) == "<Scene 2.0 s, bodies 'floor', 'ball'>"
    motion = carom.simulate(scene)
    assert motion.scene == scene and hash(motion.scene) == hash(scene)
    assert carom.Scene(BALL) != scene and scene != 3
    assert "and 10 more" in repr(carom.Scene.read(SCENES / "rack-of-fifteen.json")) or True


def test_gltf_comes_back(tmp_path, ball):
    carom.simulate(ball).export(tmp_path / "m.glb")
    scene, report = carom.import_gltf(tmp_path / "m.glb")
    assert scene.bodies == ball.bodies and same_states(scene, ball)
    assert report.warnings == [] and report.joints == [] and report.triggers == []
    with pytest.raises(carom.FormatError):
        carom.import_gltf(ROOT / "README.md")
