// SPDX-License-Identifier: MIT
// The surface that a body touches where it is held: at an impact, at rest, on a path in contact.

import * as THREE from 'three';
import { accelerationAt, metBy, poseAt, rotate } from '../motion.js';
import { along, dot, length, minus } from '../tools/move.js';

/** @typedef {import('../types.js').Vec3} Vec3 */
/** @typedef {import('../types.js').State} State */
/** @typedef {import('../tools/move.js').Ray} Ray */
/** @typedef {import('../tools/slide.js').Touched} Touched */

/** Of a radius: a surface that is farther below a body than this beyond its radius is not what it lies on. */
const farBelow = 0.3;

/** Where a ray meets fixed bodies first, and the normal there. @param {State} state @param {import('./bodies.js').BodyMesh[]} meshes
 * @param {Ray} ray @param {number[]} bodies @returns {{point: Vec3, normal: Vec3} | null} */
function cutOf({ scene, motion }, meshes, { origin, direction }, bodies) {
  let nearest = Infinity, best = null;
  const caster = new THREE.Raycaster(new THREE.Vector3(...origin), new THREE.Vector3(...direction));
  for (const body of bodies) {
    const shape = scene?.shapes[body], track = motion?.tracks[body], mesh = meshes[body];
    if (!shape || !track) continue;
    if (shape.plane) {
      const { place, turn } = poseAt(track, 0), normal = rotate(turn, shape.plane.normal), rate = dot(direction, normal);
      const s = Math.abs(rate) > 1e-6 ? (shape.plane.offset - dot(minus(origin, place), normal)) / rate : -1;
      if (s > 0 && s < nearest) [nearest, best] = [s, { point: along(origin, direction, s), normal }];
    } else if (mesh) {
      mesh.updateMatrixWorld(true);
      const hit = caster.intersectObject(mesh, false)[0];
      if (!hit?.face || hit.distance >= nearest) continue;
      const { x, y, z } = hit.face.normal.clone().transformDirection(mesh.matrixWorld);
      [nearest, best] = [hit.distance, { point: /** @type {Vec3} */ ([hit.point.x, hit.point.y, hit.point.z]), normal: /** @type {Vec3} */ ([x, y, z]) }];
    }
  }
  return best;
}

/** What is touched where a body is held; none where it flies. @param {State} state @param {import('./bodies.js').BodyMesh[]} meshes
 * @param {import('../types.js').Hit} hit @returns {Touched | null} */
export function touchedAt(state, meshes, hit) {
  const { scene, motion } = state;
  if (!scene || !motion) return null;
  const fixed = (/** @type {number} */ body) => !!scene.shapes[body]?.fixed;
  if (hit.kind === 'impact' && hit.impact) {
    const met = metBy(hit.impact, hit.body).filter(fixed), point = hit.impact.point, towards = minus(point, hit.place), far = length(towards);
    if (!met.length || far === 0) return null;
    const seen = cutOf(state, meshes, { origin: hit.place, direction: along([0, 0, 0], towards, 1 / far) }, met);
    return { point, normal: seen?.normal ?? [0, 0, 1], cut: (ray) => cutOf(state, meshes, ray, met) };
  }
  const track = motion.tracks[hit.body], { radius } = scene.shapes[hit.body];
  const free = minus(accelerationAt(track, hit.time), motion.gravity).every((a) => Math.abs(a) < 1e-9);
  if (hit.kind !== 'rest' && (free || hit.kind === 'nail')) return null;
  const below = cutOf(state, meshes, { origin: hit.place, direction: [0, 0, -1] }, scene.shapes.map((shape) => shape.body).filter(fixed));
  const lies = below && hit.place[2] - below.point[2] <= radius * (1 + farBelow);
  return lies ? { point: hit.place, normal: below.normal, cut: null } : null;
}
