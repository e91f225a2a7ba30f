// SPDX-License-Identifier: MIT
// How a body is taken hold of: whether it can be, by what tool, and what of it is held.

import { placing } from './build.js';
import { pointAt, turnAt } from './motion.js';
import { Move } from './tools/move.js';
import { Slide } from './tools/slide.js';
import { Turn } from './tools/turn.js';

/** @typedef {import('./types.js').Hit} Hit */
/** @typedef {import('./types.js').State} State */
/** @typedef {import('./types.js').Vec3} Vec3 */
/** @typedef {{ray: (x: number, y: number) => import('./tools/move.js').Ray, project: (p: Vec3) => [number, number],
 *    touched: (hit: Hit) => import('./tools/slide.js').Touched | null, snapped?: (hit: Hit, x: number, y: number) => import('./snap.js').Snapped | null,
 *    camera: () => {view: Vec3, right: Vec3, up: Vec3, perPixel: (p: Vec3) => number}}} Space */

/** Why a body cannot be held; empty where it can. @param {State} state @param {Hit} hit */
export function refusal({ document, locked }, hit) {
  const body = document?.bodies[hit.body];
  if (!document || !body) return 'Nothing is open.';
  if (body.fixed && hit.kind !== 'handle') return `'${body.name}' is fixed: it does not move. Select it, and place it by its handles.`;
  if (body.kinematic) return `'${body.name}' is kinematic: its motion is prescribed.`;
  if (locked.has(body.name)) return `'${body.name}' is locked; the switch is in the list of bodies.`;
  return '';
}

/** @param {State} state @param {Space} space @param {Hit} hit @param {[number, number]} from the pointer, px @returns {Move | Turn} */
export function toolFor(state, space, hit, from) {
  const { motion, tool } = state, track = motion?.tracks[hit.body];
  if (!track) throw new Error('a body without a track is held');
  const { view, right, up } = space.camera(), handle = hit.handle ?? '';
  const turn = turnAt(track, hit.time);
  if (hit.kind !== 'nail' && (/^(ring|spin) /.test(handle) || (!handle && tool === 'turn'))) {
    const centre = space.project(hit.place);
    return new Turn({ start: hit.place, turn, view, right, up, pointer: from, centre, axis: handle.slice(5) });
  }
  const ray = space.ray(...from), touched = handle || placing(state, hit, false) ? null : space.touched(hit);
  if (touched) return new Slide({ turn, ray, view, touched });
  const move = new Move({ start: contactOf(hit) ?? hit.place, turn, ray, view });
  if (handle && handle !== 'throw') move.setAxis(handle);
  return move;
}

/** What of a body is held. @param {State} state @param {Hit} hit @param {Move | Turn} tool */
export function gripOf({ motion, leaveRestFree, turnLeavesPlace }, hit, tool) {
  const center = motion?.tracks[hit.body].center ?? [0, 0, 0], off_origin = center.some((c) => Math.abs(c) > 1e-12);
  if (tool instanceof Turn) return { orientation: true, ...(turnLeavesPlace ? { place: false } : off_origin ? { point: center } : {}) };
  const components = tool.held(leaveRestFree);
  return { ...(contactOf(hit) ? { contact: true } : off_origin ? { point: center } : {}), ...(components ? { components } : {}) };
}

/** The middle of the contacts of an impact that is held. @param {Hit} hit @returns {Vec3 | null} */
const contactOf = (hit) => (hit.kind === 'impact' && hit.impact ? hit.impact.point : null);

/** What a body is held by where the play head is. @param {import('./types.js').Motion} motion @param {number} body
 * @param {number} time @returns {Hit} */
export function hitAt(motion, body, time) {
  const track = motion.tracks[body];
  return { kind: 'body', body, time, at: time, place: pointAt(track, track.center, time) };
}
