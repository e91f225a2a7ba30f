// SPDX-License-Identifier: MIT
// Dots at every frame along paths, impacts by mode, what is hovered or held, and where the hand wants it.

import { impactsThatChanged } from '../changes.js';
import { colours, impactColours, inkOf } from '../colours.js';
import { centreAt } from '../motion.js';
import { offText } from '../live.js';
import { atText, label } from './hoops.js';
import { restPlaces } from './pick.js';

/** @typedef {import('../types.js').State} State */
/** @typedef {import('./pick.js').Project} Project */
/** @typedef {CanvasRenderingContext2D} Pen */

const mostDots = 400;

/** @param {Pen} pen @param {State} state @param {number[]} bodies @param {Project} project @param {number} scale */
export function drawDots(pen, { motion, scene, selected, dots }, bodies, project, scale) {
  if (!motion || !dots) return;
  for (const body of bodies) {
    pen.fillStyle = inkOf(scene?.shapes[body]?.colour ?? colours.fixed);
    const radius = (body === selected ? 2.4 : 1.5) * scale;
    pen.beginPath();
    for (let k = 0; k <= Math.min(motion.end * dots + 1e-9, mostDots); ++k) {
      const [x, y, depth] = project(centreAt(motion.tracks[body], k / dots));
      if (depth <= 0) continue;
      pen.moveTo(x + radius, y);
      pen.arc(x, y, radius, 0, 2 * Math.PI);
    }
    pen.fill();
  }
}

/** The mark of an impact: ring, dashed ring, square, double ring. @param {Pen} pen @param {string} mode
 * @param {number} x @param {number} y @param {number} radius */
export function impactMark(pen, mode, x, y, radius) {
  pen.setLineDash(mode === 'slide' ? [3, 2.5] : []);
  pen.beginPath();
  if (mode === 'frictionless') pen.rect(x - 0.85 * radius, y - 0.85 * radius, 1.7 * radius, 1.7 * radius);
  else pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.stroke();
  if (mode === 'joint') {
    pen.beginPath();
    pen.arc(x, y, radius / 2, 0, 2 * Math.PI);
    pen.stroke();
  }
  pen.setLineDash([]);
}

/** What lies behind a wall is fainter. */
export const behind = 0.35;

/** @param {Pen} pen @param {State} state @param {number[]} bodies @param {Project} project @param {number} scale
 * @param {(point: import('../types.js').Vec3) => boolean} hidden */
export function drawImpacts(pen, { motion, hover, selected }, bodies, project, scale, hidden) {
  const many = (motion?.impacts.length ?? 0) > 40;
  for (const impact of motion?.impacts ?? []) {
    if (!impact.bodies.some((body) => bodies.includes(body))) continue;
    if (many && selected >= 0 && !impact.bodies.includes(selected)) continue;
    const [x, y, depth] = project(impact.point);
    if (depth <= 0) continue;
    pen.strokeStyle = impactColours[impact.mode] ?? impactColours.stick;
    const crowd = many && selected < 0, hovered = hover?.impact === impact;
    pen.lineWidth = hovered ? 3 : crowd ? 1.2 : 1.8;
    pen.globalAlpha = hovered ? 1 : crowd ? 0.75 : selected >= 0 && !impact.bodies.includes(selected) && bodies.includes(selected) ? 0.5 : 1;
    if (!hovered && hidden(impact.point)) pen.globalAlpha *= behind;
    impactMark(pen, impact.mode, x, y, (crowd ? 3.5 : 6) * scale);
  }
  pen.globalAlpha = 1;
}

/** A bar under each place of rest. @param {Pen} pen @param {State} state @param {number[]} bodies @param {Project} project
 * @param {number} scale @param {(point: import('../types.js').Vec3) => boolean} hidden */
export function drawRests(pen, { motion, scene, hover }, bodies, project, scale, hidden) {
  for (const { body, place } of motion ? restPlaces(motion, bodies) : []) {
    const [x, y, depth] = project(place);
    if (depth <= 0) continue;
    const hovered = hover?.kind === 'rest' && hover.body === body, half = (hovered ? 8 : 6) * scale;
    pen.fillStyle = inkOf(scene?.shapes[body]?.colour ?? colours.fixed);
    pen.globalAlpha = !hovered && hidden(place) ? behind : 1;
    pen.fillRect(x - half, y + 4 * scale, 2 * half, (hovered ? 4 : 3) * scale);
    pen.globalAlpha = 1;
  }
}

/** Impacts that came and went, with words, once a person asked to see them. @param {Pen} pen @param {State} state
 * @param {Project} project @param {number} scale */
export function drawChangedImpacts(pen, { motion, before, changesShown, document }, project, scale) {
  if (!changesShown || !motion || !before || !document) return;
  for (const { impact, pair, came } of impactsThatChanged(before, motion)) {
    const [x, y, depth] = project(impact.point);
    if (depth <= 0 || x < 0 || y < 0 || x > pen.canvas.clientWidth || y > pen.canvas.clientHeight) continue;
    pen.strokeStyle = came ? colours.text : colours.before;
    pen.lineWidth = 1.8;
    pen.setLineDash(came ? [] : [3, 3]);
    circle(pen, x, y, 10 * scale);
    pen.setLineDash([]);
    label(pen, `${pair.map((body) => document.bodies[body].name).join(' and ')} ${came ? 'came' : 'went'}`, x + 14 * scale, y + 4, came ? colours.text : colours.dim);
  }
}

/** What lies under the pointer: its time, its impact, or that it rests. @param {Pen} pen @param {import('../types.js').Hit} hit
 * @param {string} name of its body, where there are several @param {Project} project @param {number} scale */
export function drawHover(pen, hit, name, project, scale) {
  if (hit.kind === 'handle') return;
  const [x, y, depth] = project(hit.kind === 'impact' && hit.impact ? hit.impact.point : hit.place);
  if (depth <= 0) return;
  if (hit.kind === 'path') {
    pen.fillStyle = '#ffffff';
    pen.beginPath();
    pen.arc(x, y, 4 * scale, 0, 2 * Math.PI);
    pen.fill();
  }
  const at = hit.at, time = `${hit.time.toFixed(2)} s`;
  label(pen, (name && `${name}, `) + (typeof at === 'object' && !('between' in at) ? `${atText(at)}, ${time}` : time), x + 9 * scale, y - 9 * scale, colours.text);
}

/** The held point, and while dragging the target with the way to it. @param {Pen} pen @param {State} state
 * @param {[number, number, number]} held on the screen, where the body is @param {Project} project @param {number} scale */
export function drawHeld(pen, { gesture, motion }, held, project, scale) {
  pen.strokeStyle = '#ffffff';
  pen.lineWidth = 2;
  if (gesture.state === 'pressed' || !gesture.target) return circle(pen, held[0], held[1], 7 * scale);
  const [x, y, depth] = project(gesture.target);
  if (depth <= 0) return;
  circle(pen, x, y, 7 * scale);
  const far = Math.hypot(x - held[0], y - held[1]);
  if (far < 9 * scale) return;
  pen.setLineDash([2, 4]);
  pen.lineWidth = 1.5;
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(held[0], held[1]);
  pen.stroke();
  pen.setLineDash([]);
  if (motion && gesture.answered === gesture.seq && !motion.reached) {
    label(pen, offText(motion), x + 12 * scale, y - 8 * scale, colours.amber);
  }
}

/** @param {Pen} pen @param {number} x @param {number} y @param {number} radius */
function circle(pen, x, y, radius) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.stroke();
}
