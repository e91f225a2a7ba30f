// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { centreAt } from '../../../studio/page/motion.js';
import { nearestOnPath, onScreen, pick, toSegment } from '../../../studio/page/overlay/pick.js';
import { handleShapes, handleUnder } from '../../../studio/page/overlay/handles.js';

// a screen of 100 px a metre that looks along y; depth = y + 5
const project = ([x, y, z]) => [100 * x, -100 * z, y + 5];
const thrown = (body, y = 0) => ({ body, center: [0, 0, 0], turns: new Float32Array([0, 1, 0, 0, 0]), arcs: new Float64Array([0, 0, y, 0, 2, 0, 5, 0, 0, -10]) });
const times = Array.from({ length: 21 }, (_, k) => k / 20);
const scene = (more = {}) => {
  const tracks = [thrown(0), thrown(1, 1)], motion = { tracks, end: 1, impacts: [{ t: 0.9, point: [1.8, 0, 0.4], bodies: [0, 2], nth: [1, 0], pairs: [[0, 2]], mode: 'stick' }] };
  return { motion, names: ['hat', 'cap', 'table'], paths: new Map([[0, onScreen(tracks[0], times, project)]]), project, time: 0.25, handle: () => null, nails: [], bodyUnder: () => null, ...more };
};

test('a segment, its ends and a point', () => {
  assert.deepEqual(toSegment(5, 3, 0, 0, 10, 0), { distance: 3, u: 0.5 });
  assert.deepEqual(toSegment(-3, 4, 0, 0, 10, 0), { distance: 5, u: 0 });
  assert.deepEqual(toSegment(3, 4, 0, 0, 0, 0), { distance: 5, u: 0 });
});

test('a path is hit within 12 px, at the millisecond that is nearest', () => {
  for (const t of [0.137, 0.5, 0.62]) {
    const [x, y] = project(centreAt(thrown(0), t)), hit = pick(scene(), x + 1, y + 0.5);
    assert.equal(hit.kind, 'path');
    assert.ok(Math.abs(hit.time - t) <= 0.006, `${hit.time} for ${t}`);
    const exact = pick(scene(), x, y);
    assert.ok(Math.abs(exact.time - t) < 1e-9);
  }
  const [x, y] = project(centreAt(thrown(0), 0.5));
  assert.equal(pick(scene(), x, y - 11)?.kind, 'path');
  assert.equal(pick(scene(), x, y - 13), null);
});

test('what is behind the camera is not there', () => {
  const behind = onScreen(thrown(0), times, ([x, , z]) => [100 * x, -100 * z, -1]);
  assert.equal(nearestOnPath(behind, 10, -10).distance, Infinity);
});

test('handles win over nails, nails over impacts, impacts over paths, paths over bodies', () => {
  const [x, y] = project([1.8, 0, 0.4]), nails = [{ id: 7, body: 0, place: [1.8, 0, 0.4], time: 0.9 }], bodyUnder = () => ({ body: 0 });
  assert.equal(pick(scene({ nails, bodyUnder, handle: () => ({ handle: 'x', body: 0 }) }), x, y).kind, 'handle');
  assert.equal(pick(scene({ nails, bodyUnder }), x, y).nail, 7);
  const impact = pick(scene({ bodyUnder }), x, y);
  assert.deepEqual([impact.kind, impact.at, impact.time, impact.body], ['impact', { impact: 1, with: 'table' }, 0.9, 0]);
  assert.equal(pick(scene({ bodyUnder }), 50, -93.75).kind, 'path');
  const body = pick(scene({ bodyUnder }), 400, 300);
  assert.deepEqual([body.kind, body.time], ['body', 0.25]);
});

test('where a path comes to rest it is the rest that is held, whenever that is', () => {
  const slid = { body: 0, center: [0, 0, 0], turns: new Float32Array([0, 1, 0, 0, 0]), arcs: new Float64Array([0, 0, 0, 0, 2, 0, 0, -4, 0, 0, 0.5, 0.5, 0, 0, 0, 0, 0, 0, 0, 0]) };
  const motion = { tracks: [slid], end: 1, impacts: [] }, of = scene({ motion, paths: new Map([[0, onScreen(slid, times, project)]]) });
  const [x, y] = project([0.5, 0, 0]), hit = pick(of, x + 5, y);
  assert.deepEqual([hit.kind, hit.at, hit.time, hit.body, hit.place], ['rest', { rest: true }, 0.5, 0, [0.5, 0, 0]]);
  assert.equal(pick(of, x - 20, y).kind, 'path');
});

test('handles: arrows, squares and rings, none where one looks along an axis', () => {
  const shapes = handleShapes('move', [0, 0, 0], 0.01, project);
  assert.deepEqual(shapes.map((shape) => shape.name), ['plane y', 'x', 'z']);
  assert.equal(handleUnder(shapes, 60, 1), 'x');
  assert.equal(handleUnder(shapes, 3, -60), 'z');
  assert.equal(handleUnder(shapes, 28, -28), 'plane y');
  assert.equal(handleUnder(shapes, -60, 0), '');
  const rings = handleShapes('turn', [0, 0, 0], 0.01, project);
  assert.equal(handleUnder(rings, 64 * Math.SQRT1_2, -64 * Math.SQRT1_2), 'ring y');
});
