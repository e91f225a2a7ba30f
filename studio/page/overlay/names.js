// SPDX-License-Identifier: MIT
// Names at paths whose colours others have as well: there are eight that everybody tells apart.

import { colours, inkOf } from '../colours.js';
import { centreAt } from '../motion.js';
import { label } from './hoops.js';

/** @typedef {import('../types.js').State} State */

/** Where along a path its name may stand, as shares of the motion; the first with room for it. */
const along = [0, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 1];

/** Those of the bodies that another one looks like. @param {State['scene']} scene @param {number[]} bodies */
export function lookAlike(scene, bodies) {
  /** @type {Map<string, number>} */
  const times = new Map();
  const colour = (/** @type {number} */ body) => scene?.shapes[body]?.colour ?? colours.fixed;
  for (const body of bodies) times.set(colour(body), (times.get(colour(body)) ?? 0) + 1);
  return bodies.filter((body) => (times.get(colour(body)) ?? 0) > 1);
}

/** @param {CanvasRenderingContext2D} pen @param {State} state @param {number[]} bodies @param {import('./pick.js').Project} project */
export function drawNames(pen, { motion, scene, document, selected }, bodies, project) {
  if (!motion || !document) return;
  /** @type {[number, number, number, number][]} left, top, right, bottom */
  const taken = [], { clientWidth, clientHeight } = pen.canvas, high = 12;
  for (const body of lookAlike(scene, bodies).sort((a, b) => Number(b === selected) - Number(a === selected))) {
    const { name } = document.bodies[body], wide = pen.measureText(name).width;
    for (const share of along) {
      const [x, y, depth] = project(centreAt(motion.tracks[body], share * motion.end)), left = x + 8, top = y - high;
      if (depth <= 0 || left < 0 || left + wide > clientWidth || top < 0 || y > clientHeight) continue;
      if (taken.some(([l, t, r, b]) => left < r && left + wide > l && top < b && y > t)) continue;
      taken.push([left, top, left + wide, y]);
      label(pen, name, left, y - 2, inkOf(scene?.shapes[body]?.colour ?? colours.fixed));
      break;
    }
  }
}
