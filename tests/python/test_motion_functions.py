# SPDX-License-Identifier: MIT
"""Rows and objectives of one's own."""

import gc
import threading
import weakref

import pytest
from test_edits import COURT

import carom


@pytest.fixture
def court():
    return carom.Scene(COURT)


def height_at(time, kept=None):
    def height(motion):
        if kept is not None:
            kept.append(motion)
        return carom.Reading(motion.state_at("ball", time).position[2], [carom.Seed("ball", time, position=(0, 0, 1))])

    return height


def test_a_row_of_ones_own_is_that_of_a_nail(court):
    nailed = carom.Edit(court)
    nailed.vary(carom.velocity("ball"))
    nailed.nail("ball", 1.8).position(None, None, 0.5)
    expected = nailed.solve(effort="fast", second_derivatives="secant")
    own = carom.Edit(court)
    own.vary(carom.velocity("ball"))
    own.require("height", height_at(1.8), 0.5, until=1.8)
    result = own.solve(effort="fast")
    assert expected.solved and result.solved and abs(result.motion.state_at("ball", 1.8).position[2] - 0.5) < 1e-8
    for mine, its in zip(result.changed, expected.changed, strict=True):
        assert abs(mine.after - its.after) < 1e-6, mine
    assert result.residuals[0].name == "'height'" and result.residuals[0].constraint == -1


def test_an_objective_of_ones_own(court):
    def far(motion):
        x = motion.state_at("ball", 1.0).position[0]
        return carom.Reading(-x, [carom.Seed("ball", 1.0, position=(-1, 0, 0))])

    edit = carom.Edit(court)
    edit.vary(carom.velocity("ball", components=["x"], max=4.5))
    edit.minimise("-x", far, until=1.0)
    result = edit.solve(effort="fast")
    assert abs(result.changed[0].after - 4.5) < 1e-6, result


def test_the_time_of_an_event(court):
    def time_of_second(motion):
        event = motion.find_impact("ball", 2)
        return carom.Reading(event.time,
                             [carom.Seed("ball", before=event, time=1)])

    edit = carom.Edit(court)
    edit.vary(carom.velocity("ball", components=["z"]))
    edit.require("second bounce", time_of_second, (1.6, 1.7), until=carom.nth_impact(2), body="ball")
    result = edit.solve(effort="fast")
    assert result.solved and 1.6 - 1e-8 <= result.motion.find_impact("ball", 2).time <= 1.7 + 1e-8


def test_motions_outlive_the_edit(court):
    kept = []
    edit = carom.Edit(court)
    edit.vary(carom.velocity("ball"))
    edit.require("height", height_at(1.8, kept), 0.5)
    edit.solve()
    del edit
    gc.collect()
    assert len(kept) > 3 and all(motion.has_events for motion in kept)
    for motion in kept:
        assert motion.scene.bodies == ("floor", "ball") and motion.state_at("ball", 0).position.tolist() == [0, 0, 1]
        assert all(event.bodies == ["ball"] for event in motion.events)
    assert carom.simulate(kept[0].scene).status == "complete"


def test_an_edit_that_its_function_refers_to_is_collected(court):
    class Marked:
        pass

    def made():
        mark, edit = Marked(), carom.Edit(court)

        def function(motion):
            return carom.Reading(mark, edit)

        edit.require("mine", function, 1.0)
        return weakref.ref(mark)

    gone = made()
    gc.collect()
    assert gone() is None


def test_what_is_raised_comes_out(court):
    def wrong(error):
        def function(motion):
            raise error

        edit = carom.Edit(court)
        edit.vary(carom.velocity("ball"))
        return edit.require("mine", function, 1.0)

    with pytest.raises(KeyError, match="mine"):
        wrong(KeyError("mine")).solve()
    for answer in (3.0, None, carom.Reading(1.0, [carom.Seed("bal", 0.1)]), carom.Reading(float("nan"), []),
                   carom.Reading(1.0, [])):
        edit = carom.Edit(court)
        edit.vary(carom.velocity("ball"))
        edit.require("mine", lambda motion, answer=answer: answer, 1.0)
        with pytest.raises((TypeError, carom.InputError)):
            edit.solve()
    with pytest.raises(TypeError):
        carom.Edit(court).require("mine", 3, 1.0)


def test_many_threads_do_not_wait_for_one_another(court):
    done = []

    def work():
        edit = carom.Edit(court)
        edit.vary(carom.velocity("ball"), carom.elasticity("court"))
        edit.require("height", height_at(2.2), 0.7)
        done.append(edit.solve(threads=2).solved)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
        assert not thread.is_alive(), "a function waits for the solver, which waits for it"
    assert done == [True] * 4


def test_an_edit_within_a_function_is_refused(court):
    def nested(motion):
        carom.Edit(court).solve()

    edit = carom.Edit(court)
    edit.vary(carom.velocity("ball"))
    edit.require("mine", nested, 1.0)
    with pytest.raises(RuntimeError, match="another edit"):
        edit.solve()
