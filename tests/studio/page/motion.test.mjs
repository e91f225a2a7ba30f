// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { atOf, centreAt, moves, multiply, pathTimes, pointAt, poseAt, restTime, rotate, timeOf, turnAbout, turnAt, velocityAt, lyingOn } from '../../../studio/page/motion.js';

const near = (found, expected, tolerance) => {
  assert.equal(found.length, expected.length);
  found.forEach((f, i) => assert.ok(Math.abs(f - expected[i]) <= tolerance, `${found} is not ${expected} within ${tolerance}`));
};
// two parabolas, the second with another acceleration; a turn about y of 1 rad/s
const track = {
  body: 1, center: [0.1, 0, 0],
  arcs: new Float64Array([0, 1, 2, 3, 4, 5, 6, 0, 0, -10, 0.5, 3, 4.5, 4.75, -1, 0, 0, 2, 0, 0]),
  turns: new Float32Array([0, 0.25, 0.5, 0.75, 1].flatMap((t) => [t, Math.cos(t / 2), 0, Math.sin(t / 2), 0])),
};

test('a centre of mass is on its parabola, before and after an impact', () => {
  near(centreAt(track, 0.3), [1 + 1.2, 2 + 1.5, 3 + 1.8 - 0.45], 1e-12);
  near(centreAt(track, 0.5), [3, 4.5, 4.75], 0);
  near(centreAt(track, 0.9), [3 - 0.4 + 0.16, 4.5, 4.75], 1e-12);
  near(velocityAt(track, 0.3), [4, 5, 3], 1e-12);
  near(velocityAt(track, 0.9), [-1 + 0.8, 0, 0], 1e-12);
});

test('a turn between keys is as fast as the keys say, and stays at the ends', () => {
  for (const t of [0, 0.1, 0.33, 0.5, 0.77, 1]) near(turnAt(track, t), [Math.cos(t / 2), 0, Math.sin(t / 2), 0], 1e-6);
  near(turnAt(track, 9), [Math.cos(0.5), 0, Math.sin(0.5), 0], 1e-6);
});

test('points of a body turn about the centre of mass', () => {
  const t = 0.8, [x, y, z] = centreAt(track, t);
  near(pointAt(track, [0.1, 0, 0], t), [x, y, z], 1e-12);
  near(pointAt(track, [1.1, 0, 0], t), [x + Math.cos(t), y, z - Math.sin(t)], 1e-6);
  near(poseAt(track, t).place, [x - 0.1 * Math.cos(t), y, z + 0.1 * Math.sin(t)], 1e-6);
  near(rotate(multiply(turnAbout([0, 0, 1], 0.3), turnAbout([0, 0, 1], 0.4)), [1, 0, 0]), [Math.cos(0.7), Math.sin(0.7), 0], 1e-12);
});

test('no chord of a drawn path is off by more than it may', () => {
  const times = pathTimes(track, 1, 1e-3);
  assert.deepEqual([times[0], times.at(-1)], [0, 1]);
  assert.ok(times.includes(0.5), 'the impact is a corner of the path');
  for (let i = 0; i + 1 < times.length; ++i) {
    const [a, b, m] = [times[i], times[i + 1], (times[i] + times[i + 1]) / 2].map((t) => centreAt(track, t - 1e-15));
    assert.ok(Math.hypot(...m.map((c, k) => c - (a[k] + b[k]) / 2)) <= 1.001e-3);
  }
  assert.ok(moves(track));
  assert.ok(!moves({ ...track, arcs: new Float64Array(10), turns: new Float32Array([0, 1, 0, 0, 0]) }));
});

test('impacts are named as documents name them', () => {
  const impacts = [[0.1, 0, 1], [0.2, 1, 2], [0.3, 0, 1]].map(([t, a, b], i) => ({ t, point: [0, 0, 0], bodies: [a, b], nth: [a === 0 ? 0 : i + 1, i + 1], pairs: [[a, b]], mode: 'stick' }));
  const names = ['floor', 'ball', 'pin'], motion = { end: 1, impacts };
  assert.deepEqual(atOf(impacts, impacts[2], 1, names), { impact: 2, with: 'floor' });
  assert.equal(timeOf({ impact: 2, with: 'floor' }, 1, motion, names), 0.3);
  assert.equal(timeOf({ impact: 3 }, 1, motion, names), 0.3);
  assert.equal(timeOf({ impact: 3, with: 'floor' }, 1, motion, names), null);
  assert.equal(timeOf(2, 1, motion, names), null);
});

test('what a body lies on at a time', () => {
  const contacts = [{ body: 2, on: [0, 1], kind: 'rest', from: 0.5, to: 2 }, { body: 1, on: [0], kind: 'slide', from: 0, to: 0.4 }, { body: 3, on: [0, 1, 2], kind: 'ride', from: 1, to: 2 }];
  const motion = { contacts, end: 2, impacts: [], tracks: [] }, names = ['left', 'right', 'top', 'ball'];
  assert.equal(lyingOn(motion, 2, 0.5, names), 'rests on left and right');
  assert.equal(lyingOn(motion, 2, 2, names), 'rests on left and right', 'at the end as well');
  assert.equal(lyingOn(motion, 2, 0.4, names), '');
  assert.equal(lyingOn(motion, 1, 0.2, names), 'slides on left');
  assert.equal(lyingOn(motion, 1, 0.4, names), '');
  assert.equal(lyingOn(motion, 3, 1.5, names), 'rides on left, right and top');
});

test('a rest is where what moves moves no more', () => {
  const fall = [0, 0, 0, 1, 0, 0, 0, 0, 0, -10], rest = (t) => [t, 0, 0, 0.1, 0, 0, 0, 0, 0, 0];
  const track = (...rows) => ({ body: 0, center: [0, 0, 0], turns: new Float32Array([0, 1, 0, 0, 0]), arcs: new Float64Array(rows.flat()) });
  assert.equal(restTime(track(fall, rest(0.4))), 0.4);
  assert.equal(restTime(track(fall, rest(0.4), rest(0.7))), 0.4, 'hit, and still at rest');
  assert.equal(restTime(track(fall, rest(0.4), fall)), null);
  assert.equal(restTime(track(rest(0))), null, 'it never moved');
  assert.equal(timeOf({ rest: true }, 0, { end: 1, impacts: [], tracks: [track(fall, rest(0.4))] }, ['ball']), 0.4);
});
