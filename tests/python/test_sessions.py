# SPDX-License-Identifier: MIT
"""Drags, nails and undo."""

import os
import signal
import subprocess
import threading
import time
import _thread

import numpy as np
import pytest
from conftest import SCENES

import carom

THROW = {
    "carom": 1,
    "duration": 1,
    "bodies": [
        {"name": "floor", "fixed": True, "shape": {"plane": {"normal": [0, 0, 1], "offset": 0}}},
        {"name": "ball", "mass": 1, "shape": {"sphere": {"radius": 0.1}}, "position": [0, 0, 1], "velocity": [2, 0, 3]},
    ],
}


@pytest.fixture
def session():
    made = carom.EditSession(carom.Scene(THROW), drag_seconds=60, release_seconds=60)
    made.vary(carom.velocity("ball"), carom.position("ball"))
    return made


def test_a_drag_reaches_its_target_and_is_undone(session):
    before = session.scene.to_dict()["bodies"][1]["velocity"]
    assert session.grab("ball", 0.4).reached and session.is_grabbed
    update = session.drag_to((1.0, 0.1, 1.5))
    assert update.reached and update.moved and update.distance < 1e-6 and update.simulations >= 1
    np.testing.assert_allclose(update.motion.state_at("ball", 0.4).position, [1, 0.1, 1.5], atol=1e-6)
    update = session.release()
    assert update.stage == "solved" and not session.is_grabbed and session.last.stage == "solved"
    np.testing.assert_allclose(session.motion.state_at("ball", 0.4).position, [1, 0.1, 1.5], atol=1e-6)
    after = session.scene.to_dict()["bodies"][1]["velocity"]
    assert after != before and carom.simulate(session.scene).status == "complete"
    assert session.can_undo and "ball" in session.undo_name and session.undo_depth == 2
    session.undo()
    assert session.scene.to_dict()["bodies"][1]["velocity"] == before
    assert session.can_redo and session.redo_name
    session.redo()
    assert session.scene.to_dict()["bodies"][1]["velocity"] == after
    assert [number.name for number in session.numbers if number.varies][0].startswith("velocity")


def test_nails_are_kept_while_dragging(session):
    nail = session.nail("ball", 0.0, position=(0, 0, 1))
    session.grab("ball", 0.5, components=["x", "z"])
    session.drag_to((1.5, 0, 1.2))
    session.release_nailed()
    states = session.nails
    assert [state.id for state in states] == [nail, nail + 1] and all(state.met and state.on for state in states)
    np.testing.assert_allclose(session.motion.state_at("ball", 0).position, [0, 0, 1], atol=1e-8)
    session.set_nail_on(nail, False)
    assert not session.nails[0].on
    assert session.meet_nails().reached
    session.unnail(nail)
    assert len(session.nails) == 1
    as_it_is = session.nail_as_it_is("ball", 0.2)
    assert session.nails[-1].id == as_it_is and session.nails[-1].met
    session.grab_nail(as_it_is)
    session.cancel()
    assert len(session.scene.to_dict()["constraints"]) == 2


def test_what_is_out_of_reach_says_why(session):
    session.set_controls([carom.velocity("ball", components=["x"])])
    session.grab("ball", 0.4)
    update = session.drag_to((1, 0, 3))
    assert not update.reached and update.distance > 1 and update.obstacle != "none" and update.message
    better = []
    session.dwell(lambda update: better.append(update.motion.end))
    session.cancel()
    assert better == [] or all(end == 1 for end in better)


def test_misuse_leaves_the_session(session):
    for wrong in (lambda: session.drag_to((0, 0, 1)), lambda: session.release(), lambda: session.grab("bal", 0.1),
                  lambda: session.grab("ball", 5), lambda: session.unnail(7), lambda: session.release_nailed("here")):
        with pytest.raises(carom.InputError):
            wrong()
    session.grab("ball", 0.4)
    with pytest.raises(carom.InputError):
        session.drag_to((0, 0))
    with pytest.raises(carom.InputError):
        carom.EditSession(carom.Scene(THROW), measure_from="end")
    assert session.drag_to((1, 0, 1.5)).reached


def test_journals_are_replayed(session, tmp_path):
    session.grab("ball", 0.4)
    session.drag_to((1, 0, 1.5))
    session.release()
    path = tmp_path / "journal.json"
    session.write_journal(path)
    program = os.environ.get("CAROM_COMMAND") or pytest.skip("CAROM_COMMAND names no command")
    run = subprocess.run([program, "replay", path], capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr


def test_ctrl_c_and_other_threads():
    session = carom.EditSession(carom.Scene.read(SCENES / "die-at-rest.json"), release_seconds=100)
    session.grab("die", carom.at_rest())
    refused = []

    def look():
        time.sleep(0.2)
        try:
            session.scene
        except RuntimeError as error:
            refused.append(str(error))
        _thread.interrupt_main(signal.SIGINT)

    threading.Thread(target=look, daemon=True).start()
    with pytest.raises(KeyboardInterrupt):
        for k in range(1000):  # an update of a drag ends by itself; between two of them Python looks for signals
            session.drag_to((0.1 + 0.001 * k, 0.2, 0.02))
            session.dwell()
    assert all("in use" in text for text in refused)
    assert session.scene.bodies  # usable after it


def test_nails_are_changed(session):
    nail = session.nail("ball", 0.4, position=(1.0, 0.1, 1.5))
    session.set_nail(nail, "ball", 0.5, position=(1.2, 0.0, 1.4))
    assert session.nails[0].met and session.nails[0].id == nail
    np.testing.assert_allclose(session.motion.state_at("ball", 0.5).position, [1.2, 0, 1.4], atol=1e-8)
    session.undo()
    np.testing.assert_allclose(session.motion.state_at("ball", 0.4).position, [1, 0.1, 1.5], atol=1e-8)
    for wrong in (lambda: session.set_nail(nail + 7, "ball", 0.5, position=(0, 0, 1)),
                  lambda: session.set_nail(nail, "bal", 0.5, position=(0, 0, 1)),
                  lambda: session.set_nail(nail, "ball", 0.5, position=(0, float("nan"), 1))):
        with pytest.raises(carom.InputError):
            wrong()


def test_the_content_is_replaced(session):
    kept = session.nail("ball", 0.4, position=(1.0, 0.1, 1.5))
    session.set_nail_on(kept, False)
    document = session.scene.to_dict()
    document["duration"] = 2
    document["bodies"].append({"name": "wall", "fixed": True, "shape": {"plane": {"normal": [-1, 0, 0], "offset": -3}}})
    document["constraints"].append({"body": "ball", "at": 0.2, "position": [None, 0, None]})
    session.set_content(carom.Scene(document), "a wall", nail_ids=[kept, None])
    assert session.duration == 2 and session.scene.bodies[-1] == "wall" and session.undo_name == "a wall"
    assert session.motion.duration == 2
    states = session.nails
    assert states[0].id == kept and not states[0].on and states[1].id != kept
    with pytest.raises(carom.InputError, match="expected 2"):
        session.set_content(carom.Scene(document), "again", nail_ids=[kept])
    with pytest.raises(carom.InputError):
        session.set_content(carom.Scene(document), "again", nail_ids=[77, None])
    session.set_content(carom.Scene(document), "all new")
    assert kept not in [state.id for state in session.nails]
    session.undo()
    session.undo()
    assert session.duration == 1 and len(session.scene.bodies) == 2
    assert repr(session) == "<EditSession with 2 controls and 1 nails>"


def test_what_is_grabbed(session):
    with pytest.raises(carom.InputError):
        session.grabbed_place
    session.grab("ball", 0.4, orientation=True)
    assert session.grabbed_place.tolist() == session.motion.state_at("ball", 0.4).position.tolist()
    assert session.grabbed_orientation.tolist() == [1, 0, 0, 0]


def test_a_replay_gives_the_same_bits(session, tmp_path):
    session.nail("ball", 0.2, position=(0.4, 0, 1.4))
    session.grab("ball", 0.5)
    session.drag_to((1, 0, 1.2))
    session.drag_to((1.1, 0.1, 1.2))
    session.release()
    session.undo()
    path = tmp_path / "journal.json"
    session.write_journal(path)
    replay = carom.SessionReplay.read(path)
    assert not replay.done and "gestures" in repr(replay)
    gestures = list(replay)
    assert [gesture.kind for gesture in gestures] == ["controls", "nail", "drag", "undo"] and replay.done
    assert all(gesture.differences == [] for gesture in gestures), gestures
    assert gestures[2].body == "ball" and gestures[2].updates == 2 and gestures[2].update.reached
    assert gestures[2].update.motion.duration == 1
    assert replay.scene.to_text() == session.scene.to_text()
    states = [of.motion.sample("ball", [0.3, 0.9]).position.tobytes() for of in (replay, session)]
    assert states[0] == states[1]
    with pytest.raises(carom.FormatError) as error:
        carom.SessionReplay.read(tmp_path / "none.json")
    assert "none.json" in error.value.file
    path.write_text(path.read_text().replace('"drag"', '"drug"'))
    with pytest.raises(carom.FormatError):
        carom.SessionReplay.read(path)
