// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { decodeFrame, motionOf, shapesOf } from '../../../studio/page/frames.js';
import { bytesOf, makeFrame } from './frame.mjs';

const track = (block, body, x) => ({ body, arcs: block(new Float64Array([0, x, 0, 0, 1, 2, 3, 0, 0, -9]), 1), turns: block(new Float32Array([0, 1, 0, 0, 0, 1, 0, 1, 0, 0]), 2), center: [0, 0, x] });
const frame = (build) => decodeFrame(bytesOf(makeFrame(build)));

test('numbers of a motion come out as they went in; tracks left out are those of before', () => {
  const first = motionOf(frame((block) => ({ type: 'motion', end: 1, tracks: [track(block, 0, 5), track(block, 1, 7)] })), null);
  assert.deepEqual([...first.tracks[1].arcs], [0, 7, 0, 0, 1, 2, 3, 0, 0, -9]);
  assert.deepEqual([...first.tracks[0].turns], [0, 1, 0, 0, 0, 1, 0, 1, 0, 0]);
  const second = motionOf(frame((block) => ({ type: 'motion', end: 2, seq: 3, gesture: 4, reached: false, obstacle: { kind: 'none', sentence: '' }, tracks: [track(block, 1, 8)] })), first);
  assert.equal(second.tracks[0], first.tracks[0]);
  assert.equal(second.tracks[1].arcs[1], 8);
  assert.deepEqual([second.seq, second.gesture, second.reached, second.obstacle, second.end], [3, 4, false, null, 2]);
  assert.throws(() => motionOf(frame((block) => ({ type: 'motion', end: 1, tracks: [track(block, 1, 0)] })), null), /lacks the track of body 0/);
});

test('shapes, with those that did not change taken over and others gone', () => {
  const mesh = (block, body) => ({ body, name: `b${body}`, fixed: false, colour: '#123456', radius: 1, vertices: block(new Float32Array(9), 3), triangles: block(new Uint32Array([0, 1, 2]), 1) });
  const extent = { min: [0, 0, 0], max: [1, 1, 1] };
  const first = shapesOf(frame((block) => ({ type: 'scene', count: 3, extent, bodies: [0, 1, 2].map((body) => mesh(block, body)) })), null);
  assert.deepEqual([...first.shapes[2].triangles], [0, 1, 2]);
  const second = shapesOf(frame((block) => ({ type: 'scene', count: 2, extent, bodies: [{ ...mesh(block, 1), name: 'new' }] })), first);
  assert.equal(second.shapes.length, 2);
  assert.equal(second.shapes[0], first.shapes[0]);
  assert.equal(second.shapes[1].name, 'new');
});

test('what is no frame is refused', () => {
  assert.throws(() => decodeFrame(new ArrayBuffer(4)), /CRM1/);
  assert.throws(() => decodeFrame(new Uint8Array([1, 2, 3, 4, 8, 0, 0, 0]).buffer), /CRM1/);
  const good = makeFrame(() => ({ type: 'motion' }));
  good.writeUInt32LE(1 << 20, 4);
  assert.throws(() => decodeFrame(bytesOf(good)), /has a header of/);
  assert.throws(() => motionOf(frame(() => ({ type: 'motion', end: 1, tracks: [{ body: 0, arcs: [0, 99], turns: [0, 1] }] })), null), /does not lie in its frame/);
});
