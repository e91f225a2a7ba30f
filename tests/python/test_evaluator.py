# SPDX-License-Identifier: MIT
"""An edit as a nonlinear program for other optimisers, and the checker of rows of one's own."""

import _thread
import gc
import threading
import weakref

import numpy as np
import pytest
import scipy.optimize
from test_edits import COURT
from test_interrupt import crowd_of

import carom


@pytest.fixture
def court():
    return carom.Scene(COURT)


def bounce(scene):
    edit = carom.Edit(scene)
    edit.vary(carom.velocity("ball"), carom.elasticity("court", min=0.5, max=0.9))
    edit.nail("ball", carom.nth_impact(2)).position(4.2, 0.5, None)
    return edit


def by_differences(function, x, scales):
    """Columns (f(x + h) - f(x - h)) / 2h, Richardson's from h and h / 2."""

    def central(j, h):
        step = np.eye(len(x))[j] * h
        return (np.asarray(function(x + step)) - np.asarray(function(x - step))) / (2 * h)

    return np.stack([(4 * central(j, 5e-4 * s) - central(j, 1e-3 * s)) / 3 for j, s in enumerate(scales)], axis=-1)


def assert_close(found, expected, tolerance):
    """Entry by entry, on the scale of the largest one."""
    found, expected = np.asarray(found), np.asarray(expected)
    assert found.shape == expected.shape
    wrong = ~(np.abs(found - expected) <= tolerance * np.abs(expected).max())
    assert not wrong.any(), (found, expected)


def test_variables_rows_and_bounds(court):
    evaluator = bounce(court).evaluator()
    names = [variable.name for variable in evaluator.variables]
    assert names == ["velocity.x of 'ball'", "velocity.y of 'ball'", "velocity.z of 'ball'", "elasticity of 'court'"]
    assert [row.name.split()[0] for row in evaluator.rows] == ["position.x", "position.y"]
    assert [(row.lower, row.upper) for row in evaluator.rows] == [(4.2, 4.2), (0.5, 0.5)]
    assert evaluator.start.tolist() == [variable.start for variable in evaluator.variables]
    assert evaluator.lower[3] == 0.5 and evaluator.upper[3] == 0.9 and evaluator.lower[0] == -np.inf
    assert all(variable.scale > 0 for variable in evaluator.variables)
    assert repr(evaluator) == "<NlpEvaluator of 4 variables and 2 rows>"
    assert "velocity.x of 'ball'" in repr(evaluator.variables[0]) and "4.2" in repr(evaluator.rows[0])


def test_values_are_those_of_the_motion(court):
    evaluator = bounce(court).evaluator()
    x = evaluator.start + 0.01
    point = evaluator.at(x)
    assert point.available and point.message == "" and point.x.tolist() == x.tolist()
    motion = carom.simulate(evaluator.scene_at(x))
    there = motion.state_before(motion.find_impact("ball", 2), "ball").position
    assert point.values.tolist() == there[:2].tolist()
    assert point.motion.state_at("ball", 0.1).position.tolist() == motion.state_at("ball", 0.1).position.tolist()
    assert point.signature == evaluator.at(evaluator.start).signature
    document = evaluator.scene_at(x).to_dict()
    assert document["bodies"][-1]["velocity"] == x[:3].tolist()


def test_derivatives_are_those_of_the_values(court):
    evaluator = bounce(court).evaluator()
    scales = [variable.scale for variable in evaluator.variables]
    x = evaluator.start + 0.02
    point = evaluator.at(x)
    assert point.has_hessian
    jacobian = point.jacobian()
    assert jacobian.entries.shape == (2, 4) and all(row.reliable for row in jacobian.reliability)
    assert_close(jacobian.entries, by_differences(lambda x: evaluator.at(x).values, x, scales), 1e-8)
    gradient = point.gradient()
    assert gradient.entries.shape == (4,) and gradient.reliability.reliable
    assert_close(gradient.entries, by_differences(lambda x: evaluator.at(x).objective, x, scales), 1e-8)
    weights = np.array([2.0, -3.0])
    hessian = point.hessian(0.5, weights)

    def lagrangian(x):
        at = evaluator.at(x)
        return 0.5 * at.gradient().entries + weights @ at.jacobian().entries

    assert hessian.shape == (4, 4) and (hessian == hessian.T).all()
    assert_close(hessian, by_differences(lagrangian, x, scales), 1e-7)
    direction = np.array([1.0, -2.0, 0.5, 0.1])
    assert_close(point.hessian_times(0.5, weights, direction), hessian @ direction, 1e-12)


@pytest.mark.parametrize("method", ["SLSQP", "trust-constr"])
def test_optimisers_of_scipy_find_the_answer(court, method):
    edit = bounce(court)
    program = edit.evaluator()
    scale = np.array([variable.scale for variable in program.variables])
    targets = np.array([row.lower for row in program.rows])
    rows = {"type": "eq", "fun": lambda y: program.at(y * scale).values - targets,
            "jac": lambda y: program.at(y * scale).jacobian().entries * scale}
    answer = scipy.optimize.minimize(
        lambda y: program.at(y * scale).objective, program.start / scale, method=method,
        jac=lambda y: program.at(y * scale).gradient().entries * scale, constraints=[rows],
        bounds=list(zip(program.lower / scale, program.upper / scale)),
        options={"maxiter": 500, "ftol": 1e-14} if method == "SLSQP" else {"maxiter": 500, "gtol": 1e-9})
    expected = edit.solve(sequence="stay")
    assert expected.solved and abs(answer.fun - expected.objective) <= 1e-8
    assert_close(answer.x * scale, [number.after for number in expected.changed], 1e-5)
    assert_close(program.at(answer.x * scale).values, targets, 1e-8)


def test_times_are_variables(court):
    edit = carom.Edit(court)
    edit.vary(carom.velocity("ball"))
    edit.nail("ball", carom.between(0.1, 0.3)).position(None, None, 1.2)
    evaluator = edit.evaluator()
    time_of = evaluator.variables[-1]
    assert time_of.component == "time" and time_of.control == -1 and (time_of.lower, time_of.upper) == (0.1, 0.3)
    x = np.append(evaluator.start[:-1], 0.2)
    assert_close(evaluator.at(x).jacobian().entries,
                 by_differences(lambda x: evaluator.at(x).values, x, [1, 1, 1, 0.05]), 1e-8)
    outside = evaluator.at(np.append(x[:-1], 0.5))
    assert not outside.available and "0.5 s" in outside.message


def test_what_a_point_lacks_is_said(court):
    evaluator = bounce(court).evaluator()
    x = np.array(evaluator.start)
    x[2] = 40.0
    point = evaluator.at(x)
    assert not point.available and "does not come" in point.message and point.message in repr(point)
    for ask in (lambda: point.values, lambda: point.objective, point.gradient, point.jacobian, lambda: point.signature,
                lambda: point.hessian(1, [0, 0])):
        with pytest.raises(carom.NotComputable, match="does not come"):
            ask()
    assert not point.has_hessian


def test_bad_arguments(court):
    evaluator = bounce(court).evaluator()
    for wrong in ([0.0] * 3, np.full(4, np.nan), np.zeros((2, 2)), ["a"] * 4, np.zeros(4, dtype=complex)):
        with pytest.raises(carom.InputError):
            evaluator.at(wrong)
        with pytest.raises(carom.InputError):
            evaluator.scene_at(wrong)
    point = evaluator.at(evaluator.start)
    for weights in ([1.0], [np.nan, 0.0], np.zeros((2, 1))):
        with pytest.raises(carom.InputError):
            point.hessian(1, weights)
    with pytest.raises(carom.InputError):
        point.hessian(float("inf"), [0, 0])
    with pytest.raises(carom.InputError):
        point.hessian_times(1, [0, 0], [1.0])
    assert point.jacobian().entries.dtype == np.float64
    with pytest.raises(ValueError, match="read-only"):
        point.values[0] = 1
    point.hessian(1, [0, 0])[0, 0] = 1  # the caller's own


def test_points_outlive_their_edit(court):
    edit = bounce(court)
    evaluator = edit.evaluator()
    expected = evaluator.at(evaluator.start).jacobian().entries.tolist()
    edit.vary(carom.mass("ball"))  # does not change what was made
    edit.nail("ball", 0.5).position(1, None, None)
    del edit
    gc.collect()
    point = evaluator.at(evaluator.start)
    motion, entries, values = point.motion, point.jacobian().entries, point.values
    del evaluator
    gc.collect()
    assert point.jacobian().entries.tolist() == expected == entries.tolist()
    del point
    gc.collect()
    assert motion.scene.bodies == ("floor", "ball") and np.isfinite(values).all()


def squared_speed(motion, time=0.3, factor=1.0, second=1.0):
    velocity = motion.state_at("ball", time).velocity

    def rates(rates):
        return [carom.Seed("ball", time, velocity=second * rates[0].velocity)]

    return carom.Reading(0.5 * float(velocity @ velocity), [carom.Seed("ball", time, velocity=factor * velocity)],
                         seed_rates=rates, second_order=True)


def test_rows_of_ones_own_with_second_derivatives(court):
    edit = carom.Edit(court)
    edit.vary(carom.velocity("ball"))
    edit.require("energy", squared_speed, 4.0, until=0.3)
    evaluator = edit.evaluator()
    point = evaluator.at(evaluator.start)
    assert point.has_hessian
    assert_close(point.hessian(0, [1.0]), np.eye(3), 1e-12)  # a flight: the velocity is that of the start, less g t

    def raising(motion):
        def rates(rates):
            raise KeyError("mine")

        reading = squared_speed(motion)
        return carom.Reading(reading.value, [carom.Seed("ball", 0.3, velocity=(1, 0, 0))], seed_rates=rates,
                             second_order=True)

    edit = carom.Edit(court)
    edit.vary(carom.velocity("ball"))
    edit.require("mine", raising, 4.0, until=0.3)
    evaluator = edit.evaluator()
    with pytest.raises(KeyError, match="mine"):
        evaluator.at(evaluator.start).hessian(0, [1.0])


def test_a_function_that_knows_the_evaluator_is_collected(court):
    class Marked:
        pass

    def made():
        mark, kept = Marked(), []

        def function(motion):
            return carom.Reading(mark, kept)

        edit = carom.Edit(court)
        edit.vary(carom.velocity("ball"))
        edit.require("speed", lambda motion: kept and None or squared_speed(motion), 1.0, until=0.3)
        edit.require("mine", function, 1.0)
        evaluator = edit.evaluator()
        kept.append(evaluator)
        return weakref.ref(mark)

    gone = made()
    gc.collect()
    assert gone() is None


def test_threads_share_an_evaluator(court):
    edit = bounce(court)
    edit.require("energy", squared_speed, 4.0, until=0.3)
    evaluator = edit.evaluator()
    points = [evaluator.start + 1e-3 * k for k in range(12)]
    expected = [evaluator.at(x).jacobian().entries.tobytes() for x in points]
    found = {}

    def work(first):
        for k in range(first, 12, 4):
            for _ in range(5):
                found[k] = evaluator.at(points[k]).jacobian().entries.tobytes()

    threads = [threading.Thread(target=work, args=[first]) for first in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
        assert not thread.is_alive(), "a row waits for the evaluator, which waits for it"
    assert [found[k] for k in range(12)] == expected


def test_ctrl_c_ends_an_evaluation_and_a_check():
    crowd = carom.Scene(crowd_of(7))
    name = "ball 000"
    edit = carom.Edit(crowd, 1e3)
    edit.vary(carom.velocity(name))
    edit.nail(name, 1e3).position(0, None, None)
    evaluator = edit.evaluator()
    threading.Timer(0.03, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(50):
            evaluator.at(evaluator.start)
    threading.Timer(0.03, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(50):
            carom.check_motion_function(
                crowd, lambda motion: carom.Reading(0.0, [carom.Seed(name, 0.1, position=(1, 0, 0))]),
                [carom.velocity(name)], duration=10)


def test_the_checker(court):
    controls = [carom.velocity("ball"), carom.elasticity("court")]
    check = carom.check_motion_function(court, squared_speed, controls, until=0.3)
    assert check.passed and check.findings == [] and check.compared == 4 + 16 and check.not_compared == 0, check
    assert check.gradient_error < 1e-6 and check.hessian_error < 1e-6
    wrong = carom.check_motion_function(court, lambda motion: squared_speed(motion, factor=0.5), controls, until=0.3)
    assert not wrong.passed and "derivative with respect to velocity" in repr(wrong)
    wrong = carom.check_motion_function(court, lambda motion: squared_speed(motion, second=2), controls, until=0.3)
    assert not wrong.passed and wrong.gradient_error < 1e-6 < wrong.hessian_error
    assert all("second derivative" in finding for finding in wrong.findings)
    late = carom.check_motion_function(court, lambda motion: squared_speed(motion, time=motion.end), controls, until=0.3)
    assert any("after `until`" in finding for finding in late.findings)
    with pytest.raises(ZeroDivisionError):
        carom.check_motion_function(court, lambda motion: 1 / 0, controls)
    with pytest.raises(TypeError):
        carom.check_motion_function(court, 3, controls)
    with pytest.raises(carom.InputError):
        carom.check_motion_function(court, squared_speed, [carom.velocity("bal")])
