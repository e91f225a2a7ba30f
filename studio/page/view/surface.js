// SPDX-License-Identifier: MIT
// The surface of a body as it is drawn, for a hand that slides on it: where a ray meets it, which of its faces belong to the
// place that is touched, and which point of them is seen nearest to the ray.

import { rotate } from '../motion.js';
import { along, cross, dot, length, minus } from '../tools/move.js';

/** @typedef {import('../types.js').Vec3} Vec3 */
/** @typedef {import('../tools/move.js').Ray} Ray */
/** A triangle in the world, its normal of length 1. @typedef {{corners: [Vec3, Vec3, Vec3], normal: Vec3}} Face */
/** @typedef {{point: Vec3, normal: Vec3, face: Face, far: number}} Seen  far: m along the ray */

/** Faces whose normals differ by no more (cosine) are one plane; by more than the other they meet in an edge. */
const flat = 0.9998, sharp = 0.5;
/** A face that is turned away by more than this (cosine) from the flat one that is touched is another side of the body. */
const sameSide = 0.3;

/** Faces of a body that stands still. @param {import('../types.js').Shape} shape @param {{place: Vec3, turn: import('../types.js').Quat}} pose
 * @returns {Face[]} */
export function facesOf(shape, { place, turn }) {
  const faces = [];
  for (const triangles of [shape.triangles, shape.accent]) {
    for (let k = 0; triangles && k + 2 < triangles.length; k += 3) {
      const [a, b, c] = [0, 1, 2].map((i) => {
        const at = 3 * triangles[k + i];
        return along(place, rotate(turn, [shape.vertices[at], shape.vertices[at + 1], shape.vertices[at + 2]]), 1);
      });
      const across = cross(minus(b, a), minus(c, a)), size = length(across);
      if (size > 0) faces.push({ corners: /** @type {[Vec3, Vec3, Vec3]} */ ([a, b, c]), normal: along([0, 0, 0], across, 1 / size) });
    }
  }
  return faces;
}

/** The first face that a ray meets from outside. @param {Face[]} faces @param {Ray} ray @returns {Seen | null} */
export function seenBy(faces, { origin, direction }) {
  /** @type {Seen | null} */
  let best = null;
  for (const face of faces) {
    const { corners, normal } = face, rate = dot(normal, direction);
    if (rate > -1e-9) continue;
    const far = dot(minus(corners[0], origin), normal) / rate;
    if (far <= 0 || (best && far >= best.far)) continue;
    const point = along(origin, direction, far);
    const inside = corners.every((a, i) => dot(cross(minus(corners[(i + 1) % 3], a), minus(point, a)), normal) >= -1e-12);
    if (inside) best = { point, normal, face, far };
  }
  return best;
}

/** Whether a face is one of a curved side, or what is touched lies on an edge of it: then there is no one plane to stay in.
 * @param {Face[]} faces @param {Face} face @param {Vec3} point */
export function bends(faces, face, point) {
  const size = Math.max(...face.corners.map((a, i) => length(minus(a, face.corners[(i + 1) % 3])))), near = 1e-4 * size;
  const same = (/** @type {Vec3} */ a, /** @type {Vec3} */ b) => length(minus(a, b)) <= near;
  return faces.some((other) => {
    const shared = face.corners.filter((a) => other.corners.some((b) => same(a, b)));
    const between = dot(other.normal, face.normal);
    if (other === face || shared.length !== 2 || between > flat) return false;
    const [a, b] = shared, way = minus(b, a), off = length(cross(way, minus(point, a))) / length(way);
    return between > sharp || off <= 10 * near;
  });
}

/** The faces that a hand may slide on from one: all of them where the body is curved there or the place is on an edge, else
 * those of its side. @param {Face[]} faces @param {Face} face @param {Vec3} point */
export function reachable(faces, face, point) {
  return bends(faces, face, point) ? faces : faces.filter(({ normal }) => dot(normal, face.normal) > sameSide);
}

/** The point of faces turned to the eye that is seen nearest to a ray that misses them. With e1, e2 across the ray and depth d, a corner
 * is seen at (p.e1, p.e2)/d; of an edge from a to b seen at share t of the way, s = t d_a / (t d_a + (1 - t) d_b) of it lies there.
 * @param {Face[]} faces @param {Ray} ray @returns {{point: Vec3, normal: Vec3} | null} */
export function nearestSeen(faces, { origin, direction }) {
  const side = Math.abs(direction[2]) < 0.9 ? cross(direction, [0, 0, 1]) : cross(direction, [1, 0, 0]);
  const e1 = along([0, 0, 0], side, 1 / length(side)), e2 = cross(e1, direction);
  let least = Infinity, best = null;
  for (const { corners, normal } of faces) {
    if (dot(normal, minus(corners[0], origin)) >= 0) continue;
    const seen = corners.map((p) => {
      const q = minus(p, origin), depth = dot(q, direction);
      return { x: dot(q, e1) / depth, y: dot(q, e2) / depth, depth };
    });
    if (seen.some(({ depth }) => depth <= 0)) continue;
    for (let i = 0; i < 3; ++i) {
      const a = seen[i], b = seen[(i + 1) % 3], dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
      const t = square > 0 ? Math.min(1, Math.max(0, -(a.x * dx + a.y * dy) / square)) : 0, off = Math.hypot(a.x + t * dx, a.y + t * dy);
      if (off >= least) continue;
      const s = (t * a.depth) / (t * a.depth + (1 - t) * b.depth);
      [least, best] = [off, { point: along(corners[i], minus(corners[(i + 1) % 3], corners[i]), s), normal }];
    }
  }
  return best;
}
