// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { controlsMove, throwOf } from '../../../studio/page/causes.js';
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

test('controls move what they name, and what that meets before', () => {
  const document = { bodies: names.map((name, i) => ({ name, material: i === 4 ? 'bone' : 'wood' })), controls: [{ vary: 'velocity', body: 'ball' }] };
  const impacts = [impact(0.3, 1, 2), impact(0.5, 2, 3)];
  const moved = (body, time) => controlsMove(document, impacts, body, time);
  assert.deepEqual([moved(1, 0), moved(2, 0.2), moved(2, 0.4), moved(3, 0.4), moved(3, 0.6), moved(4, 9)], [true, false, true, false, true, false]);
  assert.ok(controlsMove({ ...document, controls: [{ vary: 'gravity' }] }, [], 4, 0));
  assert.ok(controlsMove({ ...document, controls: [{ vary: 'elasticity', material: 'bone' }] }, [impact(0.1, 0, 4)], 4, 0.2));
  assert.deepEqual(throwOf('die').map((control) => [control.vary, control.body, control.weight]), [['velocity', 'die', 0.2], ['angular_velocity', 'die', 0.2]]);
});
