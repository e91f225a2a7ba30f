// SPDX-License-Identifier: MIT
// Nails as hoops: green where met, amber with the error where not, grey and dashed where they cannot be evaluated.

import { colours } from '../colours.js';
import { centreAt, impactAt, pointAt, timeOf } from '../motion.js';
import { lengthText } from '../number_field_text.js';

/** @typedef {import('../types.js').Vec3} Vec3 */
/** @typedef {import('../types.js').NailState} NailState */
/** @typedef {import('../types.js').State} State */
/** @typedef {{nail: NailState, id: number, body: number, place: Vec3, now: Vec3, time: number}} NailPlace */

/** The number of a held component; none where it is free or a range. @param {import('../types.js').Target | undefined} t */
const held = (t) => (typeof t === 'number' ? t : null);

/** What a nail holds of a place: which point, or its contact (no point), and three targets.
 * @param {import('../types.js').Constraint} constraint
 * @returns {{point: Vec3 | null, targets: import('../types.js').Target[]} | null} none where it holds no place */
export function placeHeld({ point, position, contact }) {
  if (contact) return { point: null, targets: contact };
  if (point) return { point: point.body_point, targets: point.world };
  return position ? { point: [0, 0, 0], targets: position } : null;
}

/** Where nails are, with those that hold no place where their body is. @param {State} state @returns {NailPlace[]} */
export function nailPlaces({ document, motion }) {
  if (!document || !motion) return [];
  const names = document.bodies.map((body) => body.name);
  return document.nails.flatMap((nail) => {
    const { constraint } = nail, body = names.indexOf(constraint.body), track = motion.tracks[body];
    if (!track || constraint.at === undefined || constraint.relative_to !== undefined) return [];
    const time = nail.time ?? timeOf(constraint.at, body, motion, names) ?? Math.min(motion.end, typeof constraint.at === 'number' ? constraint.at : motion.end);
    const place = placeHeld(constraint);
    const touches = constraint.contact && constraint.at !== undefined && impactAt(constraint.at, body, motion, names)?.point;
    const now = touches || (place?.point ? pointAt(track, place.point, time) : centreAt(track, time));
    /** @type {Vec3} */
    const target = [held(place?.targets[0]) ?? now[0], held(place?.targets[1]) ?? now[1], held(place?.targets[2]) ?? now[2]];
    return [{ nail, id: nail.id, body, place: target, now, time }];
  });
}

/** Whether a nail is one of a drawn curve. @param {import('../types.js').NailState} nail */
export const isDrawn = ({ constraint: { soft, at, notes } }) => soft !== undefined && typeof at === 'object' && 'between' in at && !!notes;

/** Where nails are, but for those of drawn curves. @param {State} state */
export const singleNails = (state) => nailPlaces(state).filter(({ nail }) => !isDrawn(nail));

/** @param {NailState} nail */
export function nailColour({ on, available, met }) {
  if (!available || !on) return colours.before;
  return met ? colours.nail : colours.amber;
}

/** A hoop behind a wall is fainter, and still green or amber. */
const behindHoop = 0.5;

/** @param {CanvasRenderingContext2D} pen @param {NailPlace[]} places @param {import('./pick.js').Project} project
 * @param {number} scale @param {number} chosen id, -1: none @param {(point: import('../types.js').Vec3) => boolean} hidden */
export function drawHoops(pen, places, project, scale, chosen, hidden) {
  for (const { nail, place, now } of places) {
    const [x, y, depth] = project(place);
    if (depth <= 0) continue;
    const [nx, ny] = project(now), colour = nailColour(nail), radius = 10 * scale;
    pen.strokeStyle = colour;
    pen.lineWidth = nail.id === chosen ? 4 : nail.on && nail.available ? 3 : 1.5;
    pen.setLineDash(nail.available ? [] : [4, 4]);
    pen.globalAlpha = (nail.on ? 1 : 0.7) * (nail.id !== chosen && hidden(place) ? behindHoop : 1);
    pen.beginPath();
    pen.ellipse(x, y, radius, radius, 0, 0, 2 * Math.PI);
    pen.stroke();
    if (Math.hypot(nx - x, ny - y) > radius + 2 && nail.on) {
      pen.setLineDash([2, 4]);
      pen.lineWidth = 1;
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(nx, ny);
      pen.stroke();
    }
    pen.setLineDash([]);
    pen.globalAlpha = 1;
    const words = nailWords(nail);
    if (words) label(pen, words, x + radius + 5, y + 4, colour);
  }
}

/** @param {NailState} nail */
function nailWords({ on, available, met, error, message, constraint }) {
  if (!available) return message || `${atText(constraint.at)} does not come`;
  return on && !met && placeHeld(constraint) ? lengthText(error) : '';
}

/** For people: "0.600 s", "impact 3 with table", "rest". @param {import('../types.js').When | undefined} at */
export function atText(at) {
  if (at === undefined) return 'all the time';
  if (typeof at === 'number') return `${at.toFixed(3)} s`;
  if ('between' in at) return `between ${at.between[0]} and ${at.between[1]} s`;
  if ('rest' in at) return 'rest';
  return `impact ${at.impact}${at.with ? ` with ${at.with}` : ''}`;
}

/** Text that can be read on anything, and is not cut at the right. @param {CanvasRenderingContext2D} pen @param {string} text @param {number} x
 * @param {number} y @param {string} colour */
export function label(pen, text, x, y, colour) {
  const { clientWidth } = pen.canvas, wide = pen.measureText(text).width;
  if (x + wide > clientWidth - 4) x = Math.max(4, Math.min(x - wide - 30, clientWidth - 4 - wide));
  pen.save();  // or marks drawn later have round corners, too
  pen.lineJoin = 'round';
  pen.lineWidth = 3;
  pen.strokeStyle = colours.view;
  pen.strokeText(text, x, y);
  pen.fillStyle = colour;
  pen.fillText(text, x, y);
  pen.restore();
}
