// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { lanes, ticks, tOf, xOf, zoomed } from '../../../studio/page/timeline_layout.js';

const axis = { from: 0.2, to: 0.9, left: 12, width: 700 };

test('seconds and pixels are each other\'s inverse', () => {
  for (const t of [0.2, 0.5, 0.9]) assert.ok(Math.abs(tOf(axis, xOf(axis, t)) - t) < 1e-12);
  assert.equal(xOf(axis, 0.2), 12);
  assert.equal(xOf(axis, 0.9), 712);
});

test('labels have room and say what they stand for', () => {
  for (const [from, to, width] of [[0, 0.7, 400], [0, 60, 900], [0.1, 0.101, 600], [0, 3, 100]]) {
    const found = ticks({ from, to, left: 0, width }), gap = found.length > 1 ? xOf({ from, to, left: 0, width }, found[1].t) - xOf({ from, to, left: 0, width }, found[0].t) : 56;
    assert.ok(gap >= 55.9, `${gap} px`);
    for (const { t, text } of found) assert.ok(Math.abs(Number(text) - t) < 1e-9 && t >= from - 1e-9 && t <= to + 1e-9);
  }
});

test('zooming keeps the moment under the pointer and stays within the motion', () => {
  const near = zoomed(axis, 300, 0.5, 1), at = tOf(axis, 300);
  assert.ok(Math.abs(xOf({ ...axis, ...near }, at) - 300) < 1e-9);
  const far = zoomed(axis, 300, 50, 1);
  assert.deepEqual(far, { from: 0, to: 1 });
  const edge = zoomed({ from: 0, to: 1, left: 0, width: 100 }, 100, 0.5, 1);
  assert.deepEqual(edge, { from: 0.5, to: 1 });
  assert.ok(zoomed(axis, 300, 1e-9, 1).to - zoomed(axis, 300, 1e-9, 1).from >= 0.99e-3);
});

test('at most eight lanes are seen; the others by scrolling', () => {
  const bodies = Array.from({ length: 20 }, (_, i) => i);
  assert.deepEqual(lanes(bodies, 20, 100, 3).map((lane) => lane.body), [3, 4, 5, 6, 7, 8, 9, 10]);
  const seen = lanes(bodies, 20, 100, 0);
  assert.ok(seen.at(-1).y + seen.at(-1).height <= 120 + 1e-9);
  assert.equal(lanes([4], 20, 100, 0)[0].height, 28);
  assert.deepEqual(lanes([], 20, 100, 0), []);
});
