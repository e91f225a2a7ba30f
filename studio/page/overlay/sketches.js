// SPDX-License-Identifier: MIT
// Curves that were drawn: as they were, and how far from them the path is, place by place.

import { colours } from '../colours.js';
import { lengthText } from '../number_field_text.js';
import { isDrawn, label } from './hoops.js';

/** @typedef {import('../types.js').Vec3} Vec3 */
/** @typedef {import('./hoops.js').NailPlace} NailPlace */

/** Nails of drawn curves, by curve. @template {{nail: import('../types.js').NailState}} T @param {T[]} places @returns {T[][]} */
export function curvesOf(places) {
  /** @type {Map<string, T[]>} */
  const curves = new Map();
  for (const place of places.filter(({ nail }) => isDrawn(nail))) {
    const name = `${place.nail.constraint.notes} ${place.nail.constraint.body}`;
    curves.set(name, [...(curves.get(name) ?? []), place]);
  }
  return [...curves.values()];
}

/** Of the size of a pixel: distances above it are shown. */
const shownPixels = 3;

/** @param {CanvasRenderingContext2D} pen @param {Vec3[]} places @param {import('./pick.js').Project} project */
function trace(pen, places, project) {
  pen.beginPath();
  for (const place of places) {
    const [x, y, depth] = project(place);
    if (depth > 0) pen.lineTo(x, y);
  }
  pen.stroke();
}

/** @param {CanvasRenderingContext2D} pen @param {NailPlace[]} nails @param {Vec3[]} drawing the curve under way
 * @param {import('./pick.js').Project} project @param {number} scale */
export function drawSketches(pen, nails, drawing, project, scale) {
  pen.save();
  pen.lineJoin = pen.lineCap = 'round';
  if (drawing.length > 1) {
    for (const [colour, width] of /** @type {[string, number][]} */ ([[colours.casing, 5], [colours.preview, 2.5]])) {
      pen.strokeStyle = colour;
      pen.lineWidth = width * scale;
      trace(pen, drawing, project);
    }
  }
  for (const curve of curvesOf(nails)) drawCurve(pen, curve, project, scale);
  pen.restore();
}

/** @param {CanvasRenderingContext2D} pen @param {NailPlace[]} curve @param {import('./pick.js').Project} project @param {number} scale */
function drawCurve(pen, curve, project, scale) {
  pen.strokeStyle = colours.preview;
  pen.globalAlpha = 0.6;
  pen.lineWidth = 1.5 * scale;
  pen.setLineDash([6, 5]);
  trace(pen, curve.map(({ place }) => place), project);
  pen.setLineDash([]);
  pen.globalAlpha = 1;
  let worst = { error: 0, x: 0, y: 0 };
  for (const { place, now, nail } of curve) {
    const [x, y, depth] = project(place), [nx, ny] = project(now);
    if (depth <= 0 || !nail.on || !nail.available) continue;
    const off = Math.hypot(nx - x, ny - y) > shownPixels;
    pen.strokeStyle = pen.fillStyle = off ? colours.amber : colours.nail;
    if (off) {
      pen.lineWidth = 2 * scale;
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(nx, ny);
      pen.stroke();
      if (nail.error > worst.error) worst = { error: nail.error, x, y };
    }
    pen.beginPath();
    pen.arc(x, y, 3 * scale, 0, 2 * Math.PI);
    pen.fill();
  }
  if (worst.error > 0) label(pen, lengthText(worst.error), worst.x + 8, worst.y + 4, colours.amber);
}
