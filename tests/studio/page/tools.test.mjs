// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { rotate, turnAbout } from '../../../studio/page/motion.js';
import { Move, nextAxis } from '../../../studio/page/tools/move.js';
import { Turn } from '../../../studio/page/tools/turn.js';

const near = (found, expected) => found.forEach((f, i) => assert.ok(Math.abs(f - expected[i]) < 1e-9, `${found} is not ${expected}`));
// the camera is at y = -10 and looks along +y; a ray through (x, z) of the plane y = 0
const ray = (x, z) => {
  const d = [x, 10, z], size = Math.hypot(...d);
  return { origin: [0, -10, 0], direction: d.map((c) => c / size) };
};
const move = (start = [1, 2, 3]) => new Move({ start, turn: turnAbout([0, 0, 1], Math.PI / 2), ray: ray(0, 0), view: [0, 1, 0] });

test('a hand moves a point in the plane that faces the camera, from where it is', () => {
  near(move([1, 0, 3]).target(ray(0.5, -0.25)).place, [1.5, 0, 2.75]);
  near(move([1, 10, 3]).target(ray(0.5, -0.25)).place, [2, 10, 2.5]);
});

test('along an axis, its own axis and in planes', () => {
  const drag = move([0, 0, 0]);
  drag.setAxis('x');
  near(drag.target(ray(0.5, 0.3)).place, [0.5, 0, 0]);
  assert.deepEqual(drag.components(), ['x']);
  drag.setAxis('own y');  // the body is turned by 90 degrees about z: its y is -x of the world
  near(drag.target(ray(0.5, 0.3)).place, [0.5, 0, 0]);
  assert.equal(drag.components(), null);
  drag.setAxis('plane y');
  near(drag.target(ray(0.5, 0.3)).place, [0.5, 0, 0.3]);
  assert.deepEqual(drag.components(), ['x', 'z']);
});

test('an axis that points at the camera moves nothing wild', () => {
  const drag = move([0, 0, 0]);
  drag.setAxis('y');
  near(drag.target(ray(0, 0)).place, [0, 0, 0]);
});

test('letters go from the axis to its own and back to free', () => {
  assert.deepEqual(['', 'x', 'own x', 'y'].map((axis) => nextAxis(axis, 'x', false)), ['x', 'own x', '', 'x']);
  assert.equal(nextAxis('plane z', 'z', true), 'own plane z');
});

test('numbers that are typed are coordinates, or distances along an own axis', () => {
  const drag = move();
  near(drag.typed([7, 8]).place, [7, 8, 3]);
  drag.setAxis('z');
  near(drag.typed([0.8]).place, [1, 2, 0.8]);
  assert.equal(drag.typed([1, 2]), null);
  drag.setAxis('own x');
  near(drag.typed([0.5]).place, [1, 2.5, 3]);
});

test('arrow keys step on the screen, or along the axis', () => {
  const drag = move([0, 0, 0]);
  near(drag.nudge([1, 0, 0], [0, 0, 1], 0.1, 0).place, [0.1, 0, 0]);
  near(drag.nudge([1, 0, 0], [0, 0, 1], 0, 0.2).place, [0.1, 0, 0.2]);
});

test('a body turns by the angle about its place on the screen', () => {
  const options = { start: [0, 0, 0], turn: [1, 0, 0, 0], view: [0, 1, 0], right: [1, 0, 0], up: [0, 0, 1], pointer: [100, 0], centre: [0, 0] };
  const turn = new Turn({ ...options, axis: 'y' });
  turn.target([100, -100]);
  const { orientation, place } = turn.target([0, -100]);  // a quarter, counter-clockwise as seen
  near(rotate(orientation, [1, 0, 0]), [0, 0, 1]);
  near(place, [0, 0, 0]);
  assert.ok(Math.abs(turn.turned() - Math.PI / 2) < 1e-9);
  const typed = new Turn({ ...options, axis: 'z' }).typed([90]);
  near(rotate(typed.orientation, [1, 0, 0]), [0, 1, 0]);
  near([Math.hypot(...new Turn(options).target([180, 40]).orientation)], [1]);
});

test('on the grid a target goes in steps: all coordinates that move, or along an own axis from where it was', () => {
  const snapped = (axis, start, to, snap = 0.25) => {
    const one = move(start);
    one.setAxis(axis);
    one.snap = snap;
    return one.target(ray(...to)).place;
  };
  near(snapped('', [1.1, 0, 3.1], [0.5, -0.2]), [1.5, 0, 3]);
  near(snapped('x', [1.1, 0.07, 3.1], [0.5, 0]), [1.5, 0.07, 3.1]);
  near(snapped('plane y', [1.1, 0.07, 3.1], [0.5, 0]), [1.5, 0.07, 3]);
  near(snapped('own y', [1.1, 0.07, 3.1], [0.6, 0]), [1.6, 0.07, 3.1]);  // its y is -x here
  near(snapped('x', [1.1, 0, 3.1], [0.5, 0], 0), [1.6, 0, 3.1]);
});

test('a turn about an axis goes in steps, and on from where the hand is when the steps end', () => {
  const turn = new Turn({ start: [0, 0, 0], turn: [1, 0, 0, 0], view: [0, 1, 0], right: [1, 0, 0], up: [0, 0, 1], pointer: [110, 100], centre: [100, 100], axis: 'y' });
  const degrees = ({ orientation: [w] }) => (2 * Math.acos(Math.min(1, Math.abs(w))) * 180) / Math.PI;
  const at = (angle) => [100 + 10 * Math.cos((angle * Math.PI) / 180), 100 + 10 * Math.sin((angle * Math.PI) / 180)];
  turn.snap = Math.PI / 12;
  assert.ok(Math.abs(degrees(turn.target(at(50))) - 45) < 1e-6);
  assert.ok(Math.abs(degrees(turn.target(at(54))) - 60) < 1e-6);
  turn.snap = 0;
  assert.ok(Math.abs(degrees(turn.target(at(54))) - 54) < 1e-6);
});
