// SPDX-License-Identifier: MIT
// The flat faces on which a body can lie, and what is up then. No drawing library here: tests use it as well.

import { multiply, rotate, turnAbout } from './motion.js';
import { cross, dot, length, minus } from './tools/move.js';

/** @typedef {import('./types.js').Vec3} Vec3 */
/** @typedef {import('./types.js').Shape} Shape */
/** What can be up: its name for people, and its direction in the axes of the shape. @typedef {{name: string, up: Vec3}} Face */

/** Triangles whose normals differ by no more (cosine), and whose planes by no more than this share of the radius, are one face. */
const flat = 0.99999, near = 1e-4;
/** More are not offered: a fine mesh of a ball has no faces to speak of. */
const most = 24;

/** Sides of a die: 1, 2 and 3 counterclockwise about the corner where they meet, opposite ones make seven. @type {[string, Vec3][]} */
const sides = [['1', [1, 0, 0]], ['2', [0, 1, 0]], ['3', [0, 0, 1]], ['4', [0, 0, -1]], ['5', [0, -1, 0]], ['6', [-1, 0, 0]]];

/** Half the edge of a die: a cube that is called one. @param {Shape} shape @returns {number} 0: it is none */
export function dieSize({ name, vertices, normals }) {
  if (!/\b(die|dice)\b/i.test(name) || !vertices.length) return 0;
  const most_of = [0, 1, 2].map((i) => vertices.reduce((high, c, k) => (k % 3 === i ? Math.max(high, Math.abs(c)) : high), 0)), [half] = most_of;
  const cube = most_of.every((c) => Math.abs(c - half) <= 1e-6 * half) && vertices.every((c) => Math.abs(Math.abs(c) - half) <= 1e-6 * half);
  return cube && (normals === null || normals.length === vertices.length) ? half : 0;
}

/** Corners of a triangle. @param {Shape} shape @param {Uint32Array} triangles @param {number} k @returns {[Vec3, Vec3, Vec3]} */
function cornersOf({ vertices }, triangles, k) {
  const at = (/** @type {number} */ i) => /** @type {Vec3} */ ([...vertices.subarray(3 * triangles[k + i], 3 * triangles[k + i] + 3)]);
  return [at(0), at(1), at(2)];
}

/** The flat faces on which a body can lie: nothing of it is beyond their plane, and its centre of mass is above them.
 * @param {Shape} shape @returns {Vec3[]} normals, outwards */
export function layingFaces(shape) {
  const { center, radius, vertices } = shape, tolerance = near * radius;
  /** @type {{normal: Vec3, offset: number, below: boolean}[]} */
  const planes = [];
  for (const triangles of [shape.triangles, shape.accent]) {
    for (let k = 0; triangles && k + 2 < triangles.length; k += 3) {
      const [a, b, c] = cornersOf(shape, triangles, k), across = cross(minus(b, a), minus(c, a)), size = length(across);
      if (!(size > tolerance * tolerance)) continue;
      const normal = /** @type {Vec3} */ (across.map((x) => x / size)), offset = dot(normal, a);
      let plane = planes.find((one) => dot(one.normal, normal) > flat && Math.abs(one.offset - offset) <= tolerance);
      if (!plane) planes.push((plane = { normal, offset, below: false }));
      const inside = [[a, b], [b, c], [c, a]].every(([p, q]) => dot(cross(minus(q, p), minus(center, p)), normal) >= -tolerance * length(minus(q, p)));
      plane.below ||= inside;
    }
    if (planes.length > 4000) return [];
  }
  return planes.filter(({ normal, offset, below }) => {
    if (!below) return false;
    for (let k = 0; k + 2 < vertices.length; k += 3) if (normal[0] * vertices[k] + normal[1] * vertices[k + 1] + normal[2] * vertices[k + 2] > offset + tolerance) return false;
    return true;
  }).map(({ normal }) => normal);
}

/** What can be up when the body lies: sides of a die by their numbers, others by their axis. @param {Shape} shape @returns {Face[]} */
export function facesOf(shape) {
  if (shape.fixed || shape.plane) return [];
  if (dieSize(shape)) return sides.map(([name, up]) => ({ name, up }));
  const found = layingFaces(shape);
  if (found.length > most) return [];
  return found.map((normal, i) => {
    const up = /** @type {Vec3} */ (normal.map((c) => (c === 0 ? 0 : -c))), axis = up.findIndex((c) => Math.abs(c) > 0.99999);
    return { name: axis < 0 ? `side ${i + 1}` : `${up[axis] > 0 ? '+' : '−'}${'xyz'[axis]}`, up };
  }).sort((a, b) => (a.name < b.name ? -1 : 1));
}

/** The face that a press on a side means: that side up, where the body can lie on what is opposite. @param {Face[]} faces @param {Vec3} normal
 * of the side, in the axes of the shape @returns {Face | null} */
export function faceOfSide(faces, normal) {
  return faces.find(({ up }) => dot(up, normal) > 0.999) ?? null;
}

/** Circles of pips on a die: their centres and the sides that they are on. @param {number} half edge, m
 * @returns {{centre: Vec3, normal: Vec3}[]} */
export function pipsOf(half) {
  const s = 0.5;
  /** @type {Record<string, [number, number][]>} */
  const patterns = { 1: [[0, 0]], 2: [[-s, -s], [s, s]], 3: [[-s, -s], [0, 0], [s, s]], 4: [[-s, -s], [s, -s], [-s, s], [s, s]],
    5: [[-s, -s], [s, -s], [0, 0], [-s, s], [s, s]], 6: [[-s, -s], [s, -s], [-s, 0], [s, 0], [-s, s], [s, s]] };
  return sides.flatMap(([name, normal]) => {
    const i = normal.findIndex((c) => c !== 0), [a, b] = [(i + 1) % 3, (i + 2) % 3];
    return patterns[name].map(([u, v]) => {
      /** @type {Vec3} */
      const centre = [0, 0, 0];
      centre[i] = half * normal[i], centre[a] = half * u, centre[b] = half * v;
      return { centre, normal };
    });
  });
}

/** How a body lies with a face up, turned no more than that takes. @param {Shape} shape @param {Vec3} up in the axes of the shape
 * @param {Vec3} on where its centre of mass is above, on a level surface @param {import('./types.js').Quat} turn as it lies now
 * @returns {{place: Vec3, turn: import('./types.js').Quat}} */
export function lyingPose({ vertices, center }, up, on, turn) {
  const now = rotate(turn, up), across = cross(now, [0, 0, 1]), size = length(across);
  const by = turnAbout(size > 1e-9 ? /** @type {Vec3} */ (across.map((c) => c / size)) : [1, 0, 0], Math.atan2(size, now[2])), next = multiply(by, turn);
  let low = Infinity;
  for (let k = 0; k + 2 < vertices.length; k += 3) low = Math.min(low, rotate(next, [vertices[k], vertices[k + 1], vertices[k + 2]])[2]);
  const middle = rotate(next, center);
  return { place: [on[0] - middle[0], on[1] - middle[1], on[2] - low], turn: next };
}
