// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { changesText, countsThatChanged } from '../../../studio/page/changes.js';

const impact = (t, a, b) => ({ t, bodies: [a, b], pairs: [[a, b]], nth: [0, 0], point: [0, 0, 0], mode: 'stick' });
const names = ['floor', 'ball', 'pin', 'cap', 'die'];

test('other impacts are told by who meets whom how often', () => {
  const before = { impacts: [impact(0.1, 0, 1), impact(0.2, 0, 1), impact(0.3, 1, 2)] }, now = { impacts: [impact(0.1, 1, 0), impact(0.5, 2, 3)] };
  assert.deepEqual(countsThatChanged(before, now), [{ pair: [0, 1], before: 2, now: 1 }, { pair: [1, 2], before: 1, now: 0 }, { pair: [2, 3], before: 0, now: 1 }]);
  assert.equal(changesText(before, now, names), 'Other impacts: floor and ball ×1 went, ball and pin ×1 went, pin and cap ×1 came');
  assert.equal(changesText(before, now, names, 1), 'Other impacts: floor and ball ×1 went, and 2 more');
  assert.equal(changesText(before, before, names), '');
});
