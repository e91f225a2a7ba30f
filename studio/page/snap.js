// SPDX-License-Identifier: MIT
// Where a target goes while Alt is held: onto a mark near the pointer, else onto the surface below it, which the body just touches.

import { surfaceUnder } from './build.js';
import { centreAt, rotate, turnAt } from './motion.js';
import { singleNails } from './overlay/hoops.js';
import { along, dot, minus } from './tools/move.js';

/** @typedef {import('./types.js').Vec3} Vec3 */
/** @typedef {import('./types.js').State} State */
/** @typedef {{place: Vec3, name: string}} Snapped  name: of what it went to */

const within = 14;  // px

/** How far a body reaches from a point of it, its centre of mass where none is given, against a direction. @param {import('./types.js').Shape} shape
 * @param {import('./types.js').Quat} turn @param {Vec3} normal out of what is touched @returns {number} m */
export function reachOf({ vertices, center, radius }, turn, normal) {
  if (!vertices?.length) return radius;
  let most = 0;
  for (let i = 0; i < vertices.length; i += 3) most = Math.max(most, -dot(rotate(turn, [vertices[i] - center[0], vertices[i + 1] - center[1], vertices[i + 2] - center[2]]), normal));
  return most;
}

/** Impacts, nails, and the middles of other bodies. @param {State} state @param {import('./types.js').Hit} hit what is held @returns {Snapped[]} */
export function marksFor(state, hit) {
  const { motion, scene, time, before } = state;
  if (!motion || !scene) return [];
  // where they were as the drag began: those of now go where the hand goes
  const impacts = (before ?? motion).impacts.filter((one) => one !== hit.impact).map(({ point }) => ({ place: point, name: 'impact' }));
  const nails = singleNails(state).filter(({ id }) => id !== hit.nail).map(({ place }) => ({ place, name: 'nail' }));
  const bodies = scene.shapes.filter(({ plane, body }) => !plane && body !== hit.body).map(({ body, name }) => ({ place: centreAt(motion.tracks[body], Math.min(time, motion.end)), name: `middle of ${name}` }));
  return [...nails, ...impacts, ...bodies];
}

/** @param {import('./view/view.js').View} view @param {State} state @param {import('./types.js').Hit} hit what is held @param {number} x @param {number} y px
 * @returns {Snapped | null} none: there is nothing */
export function snapped(view, state, hit, x, y) {
  const far = (/** @type {Snapped} */ { place }) => {
    const [px, py, depth] = view.camera.project(place);
    return depth > 0 ? Math.hypot(px - x, py - y) : Infinity;
  };
  const marks = marksFor(state, hit).map((mark) => ({ mark, off: far(mark) })).sort((a, b) => a.off - b.off);
  if (marks[0]?.off <= within) return marks[0].mark;
  const on = surfaceUnder(view, state, x, y, hit.body), shape = state.scene?.shapes[hit.body], track = state.motion?.tracks[hit.body];
  if (!on || !shape || !track) return null;
  // an impact, or what stands on a surface, is held by the place that touches there
  const reach = hit.kind === 'impact' ? 0 : reachOf(shape, turnAt(track, hit.time), on.normal);
  return { place: along(on.point, on.normal, reach), name: 'surface' };
}
