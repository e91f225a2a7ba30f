# SPDX-License-Identifier: MIT
"""Wrong shapes, types, NaN, files and pickles: an exception that says what was found, and nothing else happens."""

import copy
import pickle

import numpy as np
import pytest
from conftest import BALL, ROOT

import carom

NAN = float("nan")


@pytest.fixture
def motion(ball):
    return carom.simulate(ball)


@pytest.mark.parametrize("times", [[[0.1, 0.2]], np.zeros((2, 2)), 0.5, "abc", ["a"], [1j], [None], [0.1, NAN], [-1.0], [1e9],
                                   [np.inf], {"a": 1}, np.array([object()]), np.array(["0.5"]), np.array([True])])
def test_times(motion, times):
    with pytest.raises(carom.InputError):
        motion.sample("ball", times)


@pytest.mark.parametrize("times", [[], (), np.zeros(0), np.zeros(0, dtype=int), range(2), np.float32([0.5]), np.arange(2),
                                   np.linspace(0, 2, 7)[::-2], np.asfortranarray(np.linspace(0, 1, 3)), (0.5, 1),
                                   np.array([0.5]).astype(">f8"), np.broadcast_to(0.5, 3)])
def test_times_of_all_kinds(motion, times):
    given = np.asarray(times, dtype=float)
    states = motion.sample("ball", times)
    assert states.position.shape == (len(given), 3) and states.times.tolist() == given.tolist()
    for at, position in zip(given, states.position, strict=True):
        assert position.tolist() == motion.state_at("ball", at).position.tolist()


def test_a_read_only_array_is_an_argument(motion):
    times = np.linspace(0, 1, 3)
    times.flags.writeable = False
    states = motion.sample(["ball", "floor"], times)
    assert states.position.shape == (2, 3, 3)
    states.position[0, 0, 0] = 7  # the caller's own, and not the times that were given
    assert times.tolist() == [0, 0.5, 1] and states.times.flags.writeable


@pytest.mark.parametrize("vector", [(0, 0), (0, 0, 0, 0), [[0, 0, 1]], "abc", (0, 0, "x"), (0, 0, None), np.zeros((3, 1))])
def test_vectors(motion, vector):
    with pytest.raises(carom.InputError):
        carom.Seed("ball", 0.5, position=vector)
    with pytest.raises(carom.InputError):
        carom.SceneTangent(motion.scene, velocity={"ball": vector})
    session = carom.EditSession(motion.scene)
    session.set_controls([carom.velocity("ball")])
    session.grab("ball", 0.3)
    with pytest.raises(carom.InputError):
        session.drag_to(vector)


def test_numbers_that_are_none(motion):
    for wrong in (carom.Seed("ball", 0.5, position=(NAN, 0, 0)), carom.Seed("ball", 0.5, size=[np.inf]),
                  carom.Seed("ball", NAN, position=(1, 0, 0)), carom.Seed("ball", 0.5, size=[1, 2, 3, 4]),
                  carom.Seed("ball", 0.5, inertia=np.full((3, 3), NAN))):
        with pytest.raises(carom.InputError):
            carom.adjoint(motion, wrong)
    for wrong in ({"velocity": {"ball": (NAN, 0, 0)}}, {"mass": {"ball": NAN}}, {"gravity": (0, 0, np.inf)}):
        with pytest.raises(carom.InputError):
            carom.tangent(motion, carom.SceneTangent(motion.scene, **wrong))
    for wrong in (NAN, -1.0, np.inf, 1e10):
        with pytest.raises(carom.InputError):
            carom.simulate(motion.scene, wrong)
    for wrong in ({"lowest_bounce": NAN}, {"lowest_bounce": -1.0}):
        with pytest.raises(carom.InputError):
            carom.simulate(motion.scene, **wrong)
    for wrong in ({"impact_limit": -1}, {"step_limit": 1.5}, {"impact_limit": "many"}, {"impact_limit": 2**70}):
        with pytest.raises(TypeError):
            carom.simulate(motion.scene, **wrong)
    with pytest.raises(carom.InputError):
        motion.state_at("ball", NAN)
    edit = carom.Edit(motion.scene)
    edit.vary(carom.velocity("ball", min=1.0, max=-1.0))
    edit.nail("ball", 0.5).position(1, None, None)
    with pytest.raises(carom.InputError):
        edit.solve()
    for wrong in ({"tolerance": NAN}, {"time_budget": -1.0}, {"alternatives": 0}, {"threads": -1}, {"seed": 100000}):
        with pytest.raises(carom.InputError):
            carom.Edit(motion.scene).solve(**wrong)


@pytest.mark.parametrize("document, pointer", [
    ({**BALL, "duration": NAN}, "/duration"), ({**BALL, "gravity": [0, 0]}, "/gravity"),
    ({**BALL, "gravity": np.zeros(2)}, "/gravity"), ({**BALL, "bodies": [{"name": "a", "shape": {"sphere": {"radius": "x"}}}]}, "/bodies/0"),
    ({**BALL, "bodies": [{**BALL["bodies"][1], "mass": np.float64("nan")}]}, "/bodies/0/mass"), ({**BALL, "what": 1}, "/what"),
    ({**BALL, "bodies": object()}, "/bodies")])
def test_documents_have_a_pointer(document, pointer):
    with pytest.raises(carom.InputError) as error:
        carom.Scene(document, name="mine")
    assert error.value.where.startswith(pointer) and error.value.message
    assert not isinstance(error.value, carom.FormatError) or error.value.file == "mine"


def test_half_a_character_is_no_text(motion):
    for wrong in ('{"carom": 1, "name": "\ud800"}', {**BALL, "name": "\ud800"}):
        with pytest.raises(carom.InputError):
            carom.Scene(wrong)
    with pytest.raises(TypeError):
        motion.state_at("\ud800", 0.5)


def test_what_is_no_function(motion):
    edit = carom.Edit(motion.scene)
    session = carom.EditSession(motion.scene)
    session.set_controls([carom.velocity("ball")])
    session.grab("ball", 0.3)
    session.drag_to((0.6, 0, 1))
    for wrong in (lambda: carom.simulate(motion.scene, progress=3), lambda: edit.solve(progress=3), lambda: session.dwell(3)):
        with pytest.raises(TypeError, match="expected a function or None"):
            wrong()


def test_what_is_no_control(motion):
    edit, session = carom.Edit(motion.scene), carom.EditSession(motion.scene)
    for vary in (edit.vary, session.vary):
        for wrong in (3, None, "velocity", [carom.velocity("ball")]):
            with pytest.raises(TypeError, match="expected controls such as"):
                vary(carom.velocity("ball"), wrong)
    assert not edit.controls and not session.controls


def test_files(motion, tmp_path):
    closed = open(tmp_path / "closed.json", "w")
    closed.close()
    for wrong in (closed, 3, None):
        with pytest.raises(TypeError):
            carom.Scene.read(wrong)
        with pytest.raises(TypeError):
            motion.export(wrong)
        with pytest.raises(TypeError):
            motion.scene.write(wrong)
    for path in (tmp_path, tmp_path / "none.json", tmp_path / "closed.json", "\0"):  # a folder, nothing, an empty file
        with pytest.raises((carom.FormatError, TypeError)):
            carom.Scene.read(path)
    with pytest.raises(carom.FormatError) as error:
        carom.Scene.read(tmp_path / "none.json")
    assert error.value.file == str(tmp_path / "none.json") and error.value.message
    (tmp_path / "bytes.json").write_bytes(b'{"carom": 1, "bodies": "\xff\xfe"}')
    with pytest.raises(carom.FormatError):
        carom.Scene.read(tmp_path / "bytes.json")
    for name in ("motion.mp4", "motion", "none/motion.csv"):
        with pytest.raises(carom.InputError):
            motion.export(tmp_path / name)
    with pytest.raises(carom.InputError):
        motion.scene.write(tmp_path / "none" / "scene.json")
    assert not (tmp_path / "motion.mp4").exists()


def test_pickles(motion):
    scene = pickle.loads(pickle.dumps(motion.scene))
    assert scene.to_text() == motion.scene.to_text()
    assert carom.simulate(scene).sample("ball", [2.0]).position.tobytes() == motion.sample("ball", [2.0]).position.tobytes()
    assert copy.deepcopy(motion.scene).to_text() == scene.to_text()
    for error in (carom.InputError("/a", "b"), carom.FormatError("f", "/a", "b"), carom.NotComputable("c")):
        again = pickle.loads(pickle.dumps(error))
        assert str(again) == str(error) and again.__dict__ == error.__dict__
    for act in (pickle.dumps, copy.copy, copy.deepcopy):
        with pytest.raises(TypeError, match="pickle its scene and simulate that again"):
            act(motion)
    edit = carom.Edit(motion.scene)
    for one in (motion.events, motion.events[0], motion.state_at("ball", 0), edit, edit.evaluator(), carom.Seed("ball", 0.5),
                carom.adjoint(motion, carom.Seed("ball", 0.5)), carom.EditSession(motion.scene), carom.velocity("ball")):
        with pytest.raises(TypeError, match="pickle"):
            pickle.dumps(one)


def test_a_mesh_file_of_a_pickled_scene_is_found_elsewhere(monkeypatch, tmp_path):
    monkeypatch.chdir(ROOT / "examples" / "scenes")
    scene = carom.Scene.read("mug.json")
    text = pickle.dumps(scene)
    monkeypatch.chdir(tmp_path)
    assert pickle.loads(text).bodies == scene.bodies


def test_objects_of_another_motion(motion):
    other = carom.simulate(motion.scene)
    for wrong in (lambda: motion.state_before(other.events[0], "ball"),
                  lambda: carom.adjoint(motion, carom.Seed("ball", before=other.events[0], time=1)),
                  lambda: carom.tangent(motion, carom.SceneTangent(motion.scene)).event_time(other.events[0]),
                  lambda: carom.settles_at_gradient(motion, other.events[0])):
        with pytest.raises(carom.InputError, match="another motion"):
            wrong()
    two = carom.Scene({**BALL, "bodies": [*BALL["bodies"], {**BALL["bodies"][1], "name": "b", "position": [1, 1, 1]}]})
    with pytest.raises(carom.InputError):
        carom.tangent(motion, carom.SceneTangent(two))
    for event in (-1, 99, 2**31 - 1):
        with pytest.raises(carom.InputError):
            motion.state_before(event, "ball")
    for body in ("bal", -1, 2, 99):
        with pytest.raises(carom.InputError):
            motion.state_at(body, 0.1)


@pytest.mark.filterwarnings("ignore:nanobind")
def test_nothing_is_made_without_its_constructor():
    for kind in (carom.Motion, carom.Event, carom.SceneGradient, carom.NlpEvaluator, carom.EditResult, carom.SessionReplay):
        with pytest.raises(TypeError):
            kind()
    for kind in (carom.Scene, carom.Edit, carom.EditSession, carom.Motion, carom.NlpPoint):
        with pytest.raises((TypeError, RuntimeError)):
            repr(kind.__new__(kind))
