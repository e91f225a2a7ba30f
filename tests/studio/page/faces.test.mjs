// SPDX-License-Identifier: MIT
// The faces on which bodies can lie, and the pips of dice.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { dieSize, faceOfSide, facesOf, lyingPose, pipsOf } from '../../../studio/page/faces.js';
import { rotate } from '../../../studio/page/motion.js';

/** A convex solid over its corners, lower ring first, with a fan below and above. */
function prism(name, ring, heights, center = [0, 0, 0]) {
  const n = ring.length, vertices = heights.flatMap((z, i) => ring.flatMap(([x, y]) => [i && heights.length === 3 ? 0 : x, i && heights.length === 3 ? 0 : y, z]));
  const triangles = [];
  for (let k = 1; k + 1 < n; ++k) triangles.push(0, k + 1, k, n, n + k, n + k + 1);
  for (let k = 0; k < n; ++k) triangles.push(k, (k + 1) % n, n + k, (k + 1) % n, n + ((k + 1) % n), n + k);
  return { name, fixed: false, plane: null, body: 0, vertices: new Float32Array(vertices), normals: null, triangles: new Uint32Array(triangles), accent: null, center, radius: 1 };
}
const square = (s) => [[-s, -s], [s, -s], [s, s], [-s, s]];
const box = (name, s = 0.5, h = 0.5, center = [0, 0, 0]) => prism(name, square(s), [-h, h], center);

test('a cube that is called a die has six numbered sides, opposite ones make seven', () => {
  for (const name of ['die', 'die 2', 'red die', 'Dice']) assert.equal(dieSize(box(name)), 0.5, name);
  for (const shape of [box('box'), box('diesel'), box('die', 0.5, 0.6)]) assert.equal(dieSize(shape), 0, shape.name);
  const faces = facesOf(box('die'));
  assert.deepEqual(faces.map(({ name }) => name), ['1', '2', '3', '4', '5', '6']);
  for (const { name, up } of faces) assert.equal(faceOfSide(faces, up.map((c) => -c)).name, String(7 - name));
  const pips = pipsOf(0.5);
  assert.equal(pips.length, 21);
  for (const { name, up } of faces) assert.equal(pips.filter(({ normal }) => normal.every((c, i) => c === up[i])).length, Number(name));
  for (const { centre, normal } of pips) assert.equal(centre.reduce((sum, c, i) => sum + c * normal[i], 0), 0.5);
});

test('other bodies lie on their flat faces, not where they would fall over', () => {
  assert.deepEqual(facesOf(box('box', 0.5, 0.2)).map(({ name }) => name).sort(), ['+x', '+y', '+z', '−x', '−y', '−z']);
  assert.deepEqual(facesOf({ ...box('box'), fixed: true }), []);
  const leaning = prism('leaning', square(0.2), [-0.5, 0.5]);
  for (let k = 12; k < 24; k += 3) leaning.vertices[k] += 2;
  assert.equal(facesOf({ ...leaning, center: [1, 0, 0] }).some(({ up }) => Math.abs(up[2]) > 0.99), false, 'its middle is not above its foot');
});

test('it lies with a face up on the surface, turned no more than that takes', () => {
  const shape = box('die', 0.5, 0.5), turn = [Math.SQRT1_2, 0, 0, Math.SQRT1_2];  // about z
  const { place, turn: now } = lyingPose(shape, [1, 0, 0], [2, 3, 1], turn);
  const up = rotate(now, [1, 0, 0]);
  assert.ok(up[2] > 1 - 1e-12, String(up));
  for (const [i, c] of [2, 3, 1.5].entries()) assert.ok(Math.abs(place[i] - c) <= 1e-12, String(place));
  assert.ok(rotate(lyingPose(shape, [0, 0, -1], [0, 0, 0], [1, 0, 0, 0]).turn, [0, 0, -1])[2] > 1 - 1e-12, 'upside down');
});
