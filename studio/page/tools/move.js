// SPDX-License-Identifier: MIT
// Where a hand that moves on the screen wants a point to be: in the plane that faces the camera, along an axis, or in
// the plane across one.

/** @typedef {import('../types.js').Vec3} Vec3 */
/** @typedef {import('../types.js').Quat} Quat */
/** @typedef {{origin: Vec3, direction: Vec3}} Ray  direction of length 1 */

import { toStep } from '../grid.js';
import { rotate } from '../motion.js';

/** @param {Vec3} a @param {Vec3} b */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/** @param {Vec3} a @param {Vec3} b @returns {Vec3} */
export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
/** a + s b. @param {Vec3} a @param {Vec3} b @param {number} s @returns {Vec3} */
export const along = (a, b, s) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
/** @param {Vec3} a @param {Vec3} b @returns {Vec3} */
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
/** @param {Vec3} a */
export const length = (a) => Math.hypot(...a);

/** What a drag is held to: '' the plane of the camera, 'x' an axis, 'plane x' the plane across it, 'own x' and
 * 'own plane x' those of the body. @param {string} axis @param {Quat} turn of the body @returns {Vec3 | null} */
export function axisOf(axis, turn) {
  const letter = axis.at(-1);
  if (!letter || !'xyz'.includes(letter)) return null;
  /** @type {Vec3} */
  const world = [letter === 'x' ? 1 : 0, letter === 'y' ? 1 : 0, letter === 'z' ? 1 : 0];
  return axis.startsWith('own') ? rotate(turn, world) : world;
}

/** The next meaning of a letter that is pressed in a drag: the axis, the body's own axis, free again.
 * @param {string} axis @param {'x' | 'y' | 'z'} letter @param {boolean} plane with Shift */
export function nextAxis(axis, letter, plane) {
  const world = plane ? `plane ${letter}` : letter, own = `own ${world}`;
  if (axis === world) return own;
  return axis === own ? '' : world;
}

/** As near as an axis, or the plane across one, allows. @param {Vec3} place @param {Vec3} start @param {Vec3 | null} axis @param {boolean} plane @returns {Vec3} */
function heldTo(place, start, axis, plane) {
  if (!axis) return place;
  const far = dot(minus(place, start), axis);
  return plane ? along(place, axis, -far) : along(start, axis, far);
}

/** Point of the ray in the plane; none where the plane is seen from its edge.
 * @param {Ray} ray @param {Vec3} point @param {Vec3} normal unit @returns {Vec3 | null} */
export function inPlane({ origin, direction }, point, normal) {
  const rate = dot(direction, normal);
  if (Math.abs(rate) < 0.02) return null;
  const s = dot(minus(point, origin), normal) / rate;
  return s > 0 ? along(origin, direction, s) : null;
}

/** Point of the line that the ray points at: of the plane through the line that faces the camera most; none where one
 * looks along the line. @param {Ray} ray @param {Vec3} point @param {Vec3} axis unit @param {Vec3} view unit
 * @returns {Vec3 | null} */
export function onLine(ray, point, axis, view) {
  const across = along(view, axis, -dot(view, axis)), size = length(across);
  if (size < 0.02) return null;
  const hit = inPlane(ray, point, along([0, 0, 0], across, 1 / size));
  return hit && along(point, axis, dot(minus(hit, point), axis));
}

/** A drag of a point. `view`: the direction in which the camera looks. */
export class Move {
  /** @param {{start: Vec3, turn: Quat, ray: Ray, view: Vec3}} options where the point was when it was taken, the
   *    body's turn, and the pointer's ray at that moment */
  constructor({ start, turn, ray, view }) {
    this.start = start;
    this.turn = turn;
    this.from = ray;
    this.view = view;
    this.axis = '';
    /** @type {Vec3} */
    this.shift = [0, 0, 0];  // by arrow keys
    this.last = start;
    this.snap = 0;  // m, steps of the target; 0: none
  }

  /** @param {string} axis */
  setAxis(axis) {
    this.axis = axis;
    this.shift = [0, 0, 0];
  }

  /** The components of the place that this axis holds, for a grip that leaves the rest free; null: all. */
  components() {
    return this.axis.length === 1 ? [this.axis] : this.axis.length === 7 ? [...'xyz'].filter((c) => !this.axis.endsWith(c)) : null;
  }

  /** What a grip holds; null: all of the place. @param {boolean} leave_rest_free */
  held(leave_rest_free) {
    return leave_rest_free ? this.components() : null;
  }

  /** @returns {boolean} whether there is a surface to lift it off */
  lift() {
    return false;
  }

  /** @param {Ray} ray the pointer's now @returns {{place: Vec3}} */
  target(ray) {
    const from = this.pointOn(this.from), to = this.pointOn(ray);
    if (from && to) this.last = along(along(this.start, minus(to, from), 1), this.shift, 1);
    return { place: this.snapped() };
  }

  /** The target on the grid: in the coordinates that move, or along an own axis in steps from where it was. @returns {Vec3} */
  snapped() {
    const { axis, last, start, snap } = this, own = axis.startsWith('own') ? axisOf(axis, this.turn) : null;
    if (!snap || (own && axis.includes('plane'))) return last;
    if (own) return along(start, own, toStep(dot(minus(last, start), own), snap));
    const moves = (/** @type {number} */ i) => !axis || axis.includes('plane') !== (axis.at(-1) === 'xyz'[i]);
    return [0, 1, 2].map((i) => (moves(i) ? toStep(last[i], snap) : last[i])).reduce((place, c, i) => ((place[i] = c), place), /** @type {Vec3} */ ([0, 0, 0]));
  }

  /** @param {Ray} ray */
  pointOn(ray) {
    const axis = axisOf(this.axis, this.turn);
    if (!axis) return inPlane(ray, this.start, this.view);
    return this.axis.includes('plane') ? inPlane(ray, this.start, axis) : onLine(ray, this.start, axis, this.view);
  }

  /** To a place that something else says. @param {Vec3} place @returns {{place: Vec3}} */
  put(place) {
    this.last = heldTo(place, this.start, axisOf(this.axis, this.turn), this.axis.includes('plane'));
    return { place: this.last };
  }

  /** By an arrow key: m to the right and up on the screen, held to the axis.
   * @param {Vec3} right unit @param {Vec3} up unit @param {number} dx @param {number} dy @returns {{place: Vec3}} */
  nudge(right, up, dx, dy) {
    let step = along(along([0, 0, 0], right, dx), up, dy);
    const axis = axisOf(this.axis, this.turn);
    if (axis && this.axis.includes('plane')) step = along(step, axis, -dot(step, axis));
    else if (axis) step = along([0, 0, 0], axis, Math.sign(dot(step, axis) || dx + dy) * Math.hypot(dx, dy));
    this.shift = along(this.shift, step, 1);
    this.last = along(this.last, step, 1);
    return { place: this.last };
  }

  /** By numbers typed: a coordinate of the axis, a distance along an own axis, or up to three coordinates.
   * @param {number[]} numbers @returns {{place: Vec3} | null} none where they say nothing here */
  typed(numbers) {
    const axis = axisOf(this.axis, this.turn);
    /** @type {Vec3} */
    const place = [...this.start];
    if (axis && this.axis.length === 1) {
      if (numbers.length !== 1) return null;
      place['xyz'.indexOf(this.axis)] = numbers[0];
      this.last = place;
    } else if (axis && !this.axis.includes('plane')) {
      if (numbers.length !== 1) return null;
      this.last = along(this.start, axis, numbers[0]);
    } else {
      if (numbers.length === 0 || numbers.length > 3) return null;
      numbers.forEach((number, i) => (place[i] = number));
      this.last = place;
    }
    this.shift = minus(this.last, this.start);
    return { place: this.last };
  }
}
