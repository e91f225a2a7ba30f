// SPDX-License-Identifier: MIT
// Handles of the selected body where the play head is: arrows and squares to move it, rings to turn it.

import { colours } from '../colours.js';
import { arrowSeconds } from '../build.js';
import { along, cross } from '../tools/move.js';
import { reach, toSegment } from './pick.js';

/** @typedef {import('../types.js').Vec3} Vec3 */
/** @typedef {import('./pick.js').Project} Project */
/** @typedef {{name: string, colour: string, points: [number, number, number][], fill: boolean}} HandleShape */

/** @type {Record<string, Vec3>} */
const axes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const arrowPixels = 72, ringPixels = 64, ringSegments = 48;

/** @param {'move' | 'turn'} tool @param {Vec3} place @param {number} per_pixel m there @param {Project} project
 * @returns {HandleShape[]} */
export function handleShapes(tool, place, per_pixel, project) {
  return tool === 'move' ? [...squares(place, per_pixel, project), ...arrows(place, per_pixel, project)] : rings('ring', place, per_pixel, project);
}

/** What a body is thrown by at the start: the arrow of its velocity, and rings of its spin. @param {Vec3} place @param {Vec3} velocity m/s
 * @param {number} per_pixel m there @param {Project} project @returns {HandleShape[]} */
export const throwHandles = (place, velocity, per_pixel, project) => [throwArrow(place, velocity, project), ...rings('spin', place, per_pixel, project)];

/** The velocity at the start, as an arrow from the centre; a body at rest has a short one upwards. @param {Vec3} place @param {Vec3} velocity m/s
 * @param {Project} project @returns {HandleShape} */
function throwArrow(place, velocity, project) {
  const still = Math.hypot(...velocity) < 1e-9;
  return { name: 'throw', colour: colours.accent, points: [project(place), project(along(place, still ? [0, 0, 0.3] : velocity, arrowSeconds))], fill: false };
}

/** @param {Vec3} place @param {number} per_pixel @param {Project} project @returns {HandleShape[]} */
function arrows(place, per_pixel, project) {
  return Object.entries(axes).flatMap(([name, axis]) => {
    const points = [0.22, 1].map((s) => project(along(place, axis, s * arrowPixels * per_pixel)));
    const size = Math.hypot(points[1][0] - points[0][0], points[1][1] - points[0][1]);
    return size > 14 ? [{ name, colour: axisColour(name), points, fill: false }] : [];
  });
}

/** @param {Vec3} place @param {number} per_pixel @param {Project} project @returns {HandleShape[]} */
function squares(place, per_pixel, project) {
  return Object.keys(axes).flatMap((name) => {
    const [u, v] = Object.entries(axes).filter(([other]) => other !== name).map(([, axis]) => axis);
    const points = [[0.3, 0.3], [0.5, 0.3], [0.5, 0.5], [0.3, 0.5]].map(([a, b]) =>
      project(along(along(place, u, a * arrowPixels * per_pixel), v, b * arrowPixels * per_pixel)));
    return Math.abs(areaOf(points)) > 40 ? [{ name: `plane ${name}`, colour: axisColour(name), points, fill: true }] : [];
  });
}

/** @param {string} kind @param {Vec3} place @param {number} per_pixel @param {Project} project @returns {HandleShape[]} */
function rings(kind, place, per_pixel, project) {
  return Object.entries(axes).map(([name, axis]) => {
    const u = cross(axis, name === 'x' ? axes.y : axes.x), v = cross(axis, u), size = ringPixels * per_pixel;
    const points = Array.from({ length: ringSegments + 1 }, (_, i) => {
      const a = (2 * Math.PI * i) / ringSegments;
      return project(along(along(place, u, size * Math.cos(a)), v, size * Math.sin(a)));
    });
    return { name: `${kind} ${name}`, colour: axisColour(name), points, fill: false };
  });
}

/** @param {string} name */
const axisColour = (name) => colours.axes[/** @type {'x' | 'y' | 'z'} */ (name)];

/** @param {[number, number, number][]} points */
function areaOf(points) {
  return points.reduce((sum, [x, y], i) => {
    const [nx, ny] = points[(i + 1) % points.length];
    return sum + (x * ny - nx * y) / 2;
  }, 0);
}

/** @param {HandleShape[]} shapes @param {number} x @param {number} y @returns {string} '' where there is none */
export function handleUnder(shapes, x, y) {
  let best = '', least = reach.handle;
  for (const { name, points, fill } of shapes) {
    if (points.some(([, , depth]) => depth <= 0)) continue;
    const closed = fill ? [...points, points[0]] : points;
    for (let i = 0; i + 1 < closed.length; ++i) {
      const { distance } = toSegment(x, y, closed[i][0], closed[i][1], closed[i + 1][0], closed[i + 1][1]);
      if (distance < least) [best, least] = [name, distance];
    }
    if (fill && inside(points, x, y)) [best, least] = [name, 0];
  }
  return best;
}

/** @param {[number, number, number][]} points @param {number} x @param {number} y */
function inside(points, x, y) {
  const sides = points.map(([ax, ay], i) => {
    const [bx, by] = points[(i + 1) % points.length];
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0;
  });
  return sides.every((side) => side === sides[0]);
}

/** @param {CanvasRenderingContext2D} pen @param {HandleShape[]} shapes @param {string} lit name under the pointer */
export function drawHandles(pen, shapes, lit) {
  for (const { name, colour, points, fill } of shapes) {
    if (points.some(([, , depth]) => depth <= 0)) continue;
    pen.strokeStyle = pen.fillStyle = name === lit ? colours.text : colour;
    pen.lineWidth = name === lit ? 3 : 2;
    pen.beginPath();
    points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    if (fill) {
      pen.globalAlpha = name === lit ? 0.8 : 0.4;
      pen.fill();
      pen.globalAlpha = 1;
      continue;
    }
    pen.stroke();
    if (points.length === 2) arrowHead(pen, points[0], points[1]);
  }
}

/** @param {CanvasRenderingContext2D} pen @param {[number, number, number]} from @param {[number, number, number]} to */
function arrowHead(pen, [ax, ay], [bx, by]) {
  const size = Math.hypot(bx - ax, by - ay), ux = (bx - ax) / size, uy = (by - ay) / size;
  pen.beginPath();
  pen.moveTo(bx + 4 * ux, by + 4 * uy);
  pen.lineTo(bx - 7 * ux - 5 * uy, by - 7 * uy + 5 * ux);
  pen.lineTo(bx - 7 * ux + 5 * uy, by - 7 * uy - 5 * ux);
  pen.fill();
}
