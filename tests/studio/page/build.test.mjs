// SPDX-License-Identifier: MIT
// Drags at the start of the motion are numbers of the document: which, when, and how they are sent.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { addedBody, additions, arrowSeconds, fileFrom, PlaceSender, placing } from '../../../studio/page/build.js';

const half = Math.SQRT1_2;
const track = (center) => ({ body: 1, arcs: new Float64Array([0, 1, 2, 3, 0, 0, 0, 0, 0, 0]), turns: new Float32Array([0, 1, 0, 0, 0]), center });
const state = ({ fixed = false, controls = [], center = [0, 0, 0], orientation = [1, 0, 0, 0] } = {}) => ({
  motion: { tracks: [track([0, 0, 0]), track(center)] },
  document: { controls, bodies: [{ name: 'floor', fixed: true }, { name: 'box', fixed, position: [1, 2, 3], orientation, velocity: [4, 0, 0], angular_velocity: [1, 2, 3] }] },
});
const hit = (more = {}) => ({ kind: 'body', body: 1, time: 0, at: 0, place: [1, 2, 3], ...more });

test('a mesh file is named as the document sees it, and the body after it', () => {
  assert.equal(fileFrom('mug.obj', null), 'mug.obj');
  assert.equal(fileFrom('parts/mug.obj', 'a.json'), 'parts/mug.obj');
  assert.equal(fileFrom('mug.obj', 'scenes/a.json'), '../mug.obj');
  assert.equal(fileFrom('scenes/parts/mug.obj', 'scenes/a.json'), 'parts/mug.obj');
  assert.equal(fileFrom('other/mug.obj', 'scenes/deep/a.json'), '../../other/mug.obj');
  assert.deepEqual(addedBody({ adding: additions.length, mesh: '../parts/mug.v2.obj' }), { name: 'mug.v2', shape: { mesh: { file: '../parts/mug.v2.obj' } }, density: 600 });
  assert.equal(addedBody({ adding: 1, mesh: '' }), additions[1][1]);
});

test('a body is placed at the start, a fixed one at any time, and what may vary is left to the solver', () => {
  assert.deepEqual(placing(state(), hit(), false)({ place: [1, 2.5, 3.0000001] }), [{ pointer: '/bodies/1/position', value: [1, 2.5, 3] }]);
  assert.equal(placing(state(), hit({ time: 0.2 }), false), null);
  assert.notEqual(placing(state({ fixed: true }), hit({ time: 0.2 }), false), null);
  for (const kind of ['impact', 'rest', 'nail']) assert.equal(placing(state(), hit({ kind }), false), null);
  const varies = state({ controls: [{ vary: 'position', body: 'box' }] });
  assert.equal(placing(varies, hit(), false), null);
  assert.notEqual(placing(varies, hit(), true), null, 'its turn does not vary');
  assert.equal(placing(state(), hit({ body: 0 }), false), null, 'a body without numbers');
});

test('a turn keeps the centre of mass where it is', () => {
  const edits = placing(state({ center: [0, 0, 0.5] }), hit(), true)({ place: [1, 2, 3.5], orientation: [half, half, 0, 0] });
  assert.deepEqual(edits[0], { pointer: '/bodies/1/orientation', value: [half, half, 0, 0] });
  assert.equal(edits[1].pointer, '/bodies/1/position');
  edits[1].value.forEach((c, i) => assert.ok(Math.abs(c - [1, 2.5, 3.5][i]) <= 1e-12, `${edits[1].value}`));
  assert.equal(placing(state(), hit(), true)({ place: [1, 2, 3], orientation: [half, half, 0, 0] }).length, 1);
});

test('the arrow of a throw changes the velocity by how far its tip goes', () => {
  const [spun] = placing(state(), hit({ kind: 'handle', handle: 'spin y' }), { swept: 0.5 })({ place: [1, 2, 3] });
  assert.deepEqual(spun, { pointer: '/bodies/1/angular_velocity', value: [1, 7, 3] }, 'as far as in a tenth of a second');
  const [{ pointer, value }] = placing(state(), hit({ kind: 'handle', handle: 'throw' }), false)({ place: [1, 2, 3 + 0.2] });
  assert.equal(pointer, '/bodies/1/velocity');
  assert.deepEqual(value, [4, 0, 0.2 / arrowSeconds]);
});

test('one target is tried at a time, the newest of the others waits, and what cannot be is told', async () => {
  const asked = [], failed = [];
  const sender = new PlaceSender({ rev: 3, gesture: 7, edits: ({ place }) => [{ pointer: '/x', value: place }], failed: (error) => failed.push(error.code),
    request: (type, members) => new Promise((done, fail) => asked.push({ type, members, done, fail })) });
  assert.equal(sender.last(), null, 'a hand that did not move means nothing');
  for (const place of [1, 2, 3]) sender.offer({ place });
  assert.deepEqual(asked.map(({ type, members }) => [type, members]), [['try', { rev: 3, gesture: 7, seq: 1, edits: [{ pointer: '/x', value: 1 }] }]]);
  asked[0].fail({ code: 'overlap' });
  await new Promise((next) => setTimeout(next));
  assert.deepEqual(failed, ['overlap']);
  assert.deepEqual([asked.length, asked[1].members.edits[0].value, asked[1].members.seq], [2, 3, 2]);
  sender.offer({ place: 4 });
  assert.deepEqual(sender.last(), { rev: 3, edits: [{ pointer: '/x', value: 4 }] });
  asked[1].done();
  await new Promise((next) => setTimeout(next));
  assert.equal(asked.length, 2, 'what waited goes with the release');
});
