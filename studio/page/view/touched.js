// SPDX-License-Identifier: MIT
// The surface that a body touches where it is held: at an impact, at rest, on a path in contact.

import { accelerationAt, centreAt, impactAt, metBy, poseAt, rotate } from '../motion.js';
import { along, dot, length, minus } from '../tools/move.js';
import { facesOf, nearestSeen, reachable, seenBy } from './surface.js';

/** @typedef {import('../types.js').Vec3} Vec3 */
/** @typedef {import('../types.js').State} State */
/** @typedef {import('../tools/move.js').Ray} Ray */
/** @typedef {import('../tools/slide.js').Touched} Touched */
/** @typedef {import('./surface.js').Face} Face */

/** Of a radius: a surface that is farther below a body than this beyond its radius is not what it lies on. */
const farBelow = 0.3;

/** A body that stands still: a plane, or its faces.
 * @typedef {{plane: {point: Vec3, normal: Vec3} | null, faces: Face[]}} Still */

/** @param {State} state @param {number[]} bodies */
function stillOf({ scene, motion }, bodies) {
  /** @type {Still[]} */
  const still = [];
  for (const body of bodies) {
    const shape = scene?.shapes[body], track = motion?.tracks[body];
    if (!shape || !track) continue;
    const pose = poseAt(track, 0), normal = shape.plane && rotate(pose.turn, shape.plane.normal);
    if (shape.plane && normal) still.push({ plane: { point: along(pose.place, normal, shape.plane.offset), normal }, faces: [] });
    else still.push({ plane: null, faces: facesOf(shape, pose) });
  }
  return still;
}

/** Where a ray meets them first. @param {Still[]} still @param {Ray} ray */
function cutOf(still, ray) {
  /** @type {{point: Vec3, normal: Vec3, far: number, face: Face | null, faces: Face[]} | null} */
  let first = null;
  for (const { plane, faces } of still) {
    const rate = plane ? dot(ray.direction, plane.normal) : 0, far = plane ? dot(minus(plane.point, ray.origin), plane.normal) / rate : -1;
    const seen = plane ? (Math.abs(rate) > 1e-6 && far > 0 ? { point: along(ray.origin, ray.direction, far), normal: plane.normal, far, face: null } : null) : seenBy(faces, ray);
    if (seen && (!first || seen.far < first.far)) first = { ...seen, faces };
  }
  return first;
}

/** The impact at which the contact of a body is held: that of a mark, or of a nail. @param {State} state @param {import('../types.js').Hit} hit */
function impactOf({ document, motion }, hit) {
  if (hit.kind === 'impact') return hit.impact ?? null;
  const constraint = hit.kind === 'nail' ? document?.nails.find((nail) => nail.id === hit.nail)?.constraint : undefined;
  if (!constraint?.contact || constraint.at === undefined || !motion || !document) return null;
  return impactAt(constraint.at, hit.body, motion, document.bodies.map((body) => body.name));
}

/** What is touched where a body is held; none where it flies. @param {State} state @param {import('../types.js').Hit} hit
 * @returns {Touched | null} */
export function touchedAt(state, hit) {
  const { scene, motion } = state;
  if (!scene || !motion) return null;
  const fixed = (/** @type {number} */ body) => !!scene.shapes[body]?.fixed;
  const impact = impactOf(state, hit);
  if (impact) {
    const nailed = hit.kind === 'nail', still = stillOf(state, metBy(impact, hit.body).filter(fixed));
    const centre = nailed ? centreAt(motion.tracks[hit.body], impact.t) : hit.place, point = nailed ? hit.place : impact.point;
    const towards = minus(impact.point, centre), far = length(towards);
    if (!still.length || far === 0) return null;
    const seen = cutOf(still, { origin: centre, direction: along([0, 0, 0], towards, 1 / far) });
    const faces = seen?.face ? reachable(seen.faces, seen.face, seen.point) : null;
    return { point, normal: seen?.normal ?? [0, 0, 1], contact: !nailed, cut: (ray) => (faces ? seenBy(faces, ray) ?? nearestSeen(faces, ray) : cutOf(still, ray)) };
  }
  const track = motion.tracks[hit.body], { radius } = scene.shapes[hit.body];
  const free = minus(accelerationAt(track, hit.time), motion.gravity).every((a) => Math.abs(a) < 1e-9);
  if (hit.kind !== 'rest' && (free || hit.kind === 'nail')) return null;
  const below = cutOf(stillOf(state, scene.shapes.map((shape) => shape.body).filter(fixed)), { origin: hit.place, direction: [0, 0, -1] });
  const lies = below && hit.place[2] - below.point[2] <= radius * (1 + farBelow);
  return lies ? { point: hit.place, normal: below.normal, cut: null } : null;
}
