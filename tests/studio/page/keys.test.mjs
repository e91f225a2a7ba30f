// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { actionOf, chordOf, keyTable, takesKeys } from '../../../studio/page/keys.js';

const press = (key, { ctrl = false, shift = false } = {}) => chordOf({ key, ctrlKey: ctrl, metaKey: false, shiftKey: shift });
const action = (chord, map = 'blender', dragging = false) => actionOf(chord, map, dragging)?.action;

test('no two actions share a key, outside of drags and in them', () => {
  for (const map of ['blender', 'maya']) {
    for (const in_drag of [false, true]) {
      const keys = keyTable.filter((row) => actionOf(row[map][0], map, in_drag)?.action === row.action).flatMap((row) => row[map]);
      assert.equal(new Set(keys).size, keys.length, map);
    }
    for (const row of keyTable) if (!row.action.startsWith('axis')) assert.equal(action(row[map][0], map), row.action);
  }
});

test('letters mean an axis in a drag alone, and Shift the plane across it', () => {
  assert.equal(action(press('x')), 'remove');
  assert.deepEqual(actionOf(press('x'), 'blender', true), { action: 'axis x', shift: false });
  assert.deepEqual(actionOf(press('Z', { shift: true }), 'blender', true), { action: 'axis z', shift: true });
  assert.equal(action(press('g'), 'blender', true), undefined);
  assert.equal(action(press('z', { ctrl: true }), 'blender', true), undefined);
});

test('chords', () => {
  assert.equal(action(press('Z', { ctrl: true, shift: true })), 'redo');
  assert.equal(action(press('z', { ctrl: true })), 'undo');
  assert.equal(action(press('?', { shift: true })), 'keys');
  assert.equal(action(press(' ')), 'play');
  assert.equal(action(press('w')), undefined);
  assert.equal(action(press('w'), 'maya'), 'move');
});

test('keys belong to fields that have the focus', () => {
  const element = (tagName, type) => ({ tagName, getAttribute: () => type ?? null });
  assert.ok(takesKeys(element('INPUT')));
  assert.ok(takesKeys(element('SELECT')));
  assert.ok(!takesKeys(element('INPUT', 'checkbox')));
  assert.ok(!takesKeys(element('BUTTON')));
  assert.ok(!takesKeys(null));
});
