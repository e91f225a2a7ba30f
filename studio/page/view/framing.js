// SPDX-License-Identifier: MIT
// What the camera shows at first, and by F and A: everything, or one body with its path.

import * as THREE from 'three';
import { centreAt, moves, pathTimes } from '../motion.js';

/** @typedef {import('../types.js').State} State */
/** @typedef {import('../types.js').Vec3} Vec3 */

/** Sides from which a scene is seen at first, the usual one before those for scenes with walls in front. */
const sides = [[0.16, -1, 0.3], [0.16, -1, 0.8], [-0.9, -1, 0.7], [0.16, 1, 0.3], [0.16, -0.7, 1.6]];
const mostHidden = 0.25, looks = 60;

/** Sides by name, where the camera is then; above, a little from the front, so that x is to the right. @type {Record<'front' | 'side' | 'top', Vec3>} */
export const namedSides = { front: [0, -1, 0], side: [1, 0, 0], top: [0, -1e-4, 1] };

/** Shows everything, or one body with its path. @param {import('./view.js').View} view @param {State} state
 * @param {number} body -1: everything @param {boolean} anew from the usual side
 * @param {'front' | 'side' | 'top'} [side] from that one */
export function frameView(view, state, body, anew, side) {
  const { scene, motion } = state;
  if (!scene || !motion) return;
  let { min, max } = scene;
  const ground = scene.shapes.flatMap(({ plane, body: of }) => (plane && plane.normal[2] > 0.9 ? [centreAt(motion.tracks[of], 0)[2] + plane.offset] : []));
  min = [min[0], min[1], Math.min(min[2], ...ground.filter((z) => z > min[2] - 2 * Math.max(max[0] - min[0], max[2] - min[2], 0.1)))];
  const track = motion.tracks[body];
  if (track && moves(track)) {
    const places = pathTimes(track, motion.end, 1e-2).map((t) => centreAt(track, t)), r = scene.shapes[body].radius;
    const corner = (/** @type {(...v: number[]) => number} */ pick, /** @type {number} */ sign) => /** @type {Vec3} */ ([0, 1, 2].map((i) => pick(...places.map((p) => p[i])) + sign * r));
    [min, max] = [corner(Math.min, -1), corner(Math.max, 1)];
  }
  if (anew) view.bodies.update(state);  // which may not have been drawn yet
  view.bodies.group.updateMatrixWorld(true);
  view.camera.frame(min, max, side ? namedSides[side] : anew ? bestSide(view, scene, motion) : null);
  view.invalidate();
}

/** The first side from which fixed bodies hide little of the paths; else the one from which they hide least.
 * @param {import('./view.js').View} view @param {NonNullable<State['scene']>} scene
 * @param {NonNullable<State['motion']>} motion @returns {Vec3} */
function bestSide(view, scene, motion) {
  const walls = scene.shapes.flatMap((shape) => (shape.fixed && view.bodies.meshes[shape.body] ? [view.bodies.meshes[shape.body]] : []));
  const moving = motion.tracks.filter((track) => !scene.shapes[track.body]?.fixed && moves(track));
  const each = Math.max(2, Math.ceil(looks / Math.max(1, moving.length)));
  const places = moving.slice(0, looks / 2).flatMap((track) => Array.from({ length: each }, (_, i) => new THREE.Vector3(...centreAt(track, (motion.end * i) / (each - 1)))));
  const caster = new THREE.Raycaster();
  /** @param {number[]} side */
  const hidden = (side) => {
    const towards = new THREE.Vector3(side[0], side[1], side[2]).normalize();
    return places.filter((place) => {
      caster.set(place, towards);
      return caster.intersectObjects(walls, false).length > 0;
    }).length / Math.max(1, places.length);
  };
  let best = sides[0], least = Infinity;
  for (const side of sides) {
    const share = hidden(side);
    if (share < least - 0.05) [best, least] = [side, share];
    if (share <= mostHidden) break;
  }
  return [best[0], best[1], best[2]];
}
