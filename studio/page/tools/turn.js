// SPDX-License-Identifier: MIT
// How a hand on the screen turns a body: about an axis, by the angle about its place on the screen, or freely.

/** @typedef {import('../types.js').Vec3} Vec3 */
/** @typedef {import('../types.js').Quat} Quat */

import { toStep } from '../grid.js';
import { multiply, turnAbout, unit } from '../motion.js';
import { axisOf, dot, length } from './move.js';

const radiansPerPixel = 0.01;

export class Turn {
  /** @param {{start: Vec3, turn: Quat, view: Vec3, right: Vec3, up: Vec3, pointer: [number, number],
   *    centre: [number, number], axis?: string}} options place held, turn of the body when it was taken, axes of the
   *    camera, and on the screen the pointer and the body's centre */
  constructor({ start, turn, view, right, up, pointer, centre, axis = '' }) {
    this.start = start;
    this.turn = turn;
    this.view = view;
    this.right = right;
    this.up = up;
    this.pointer = pointer;
    this.centre = centre;
    this.axis = axis;
    this.angle = 0;
    this.previous = this.direction(pointer);
    this.last = turn;
    this.snap = 0;  // rad, steps of a turn about an axis; 0: none
  }

  /** @param {[number, number]} pointer */
  direction(pointer) {
    return Math.atan2(-(pointer[1] - this.centre[1]), pointer[0] - this.centre[0]);
  }

  /** @param {string} axis */
  setAxis(axis) {
    this.axis = axis.replace('plane ', '');
    this.angle = 0;
  }

  held() {
    return null;
  }

  lift() {
    return false;
  }

  /** @param {[number, number]} pointer now @returns {{place: Vec3, orientation: Quat}} */
  target(pointer) {
    const axis = axisOf(this.axis, this.turn);
    const now = this.direction(pointer);
    let step = now - this.previous;
    step -= 2 * Math.PI * Math.round(step / (2 * Math.PI));
    this.previous = now;
    if (axis) {
      this.angle += dot(axis, this.view) > 0 ? -step : step;
      this.last = multiply(turnAbout(axis, this.swept), this.turn);
    } else {
      const dx = (pointer[0] - this.pointer[0]) * radiansPerPixel, dy = (pointer[1] - this.pointer[1]) * radiansPerPixel;
      this.last = multiply(multiply(turnAbout(this.up, dx), turnAbout(this.right, dy)), this.turn);
    }
    return this.answer();
  }

  /** By an arrow key. @param {Vec3} right @param {Vec3} up @param {number} dx @param {number} dy */
  nudge(right, up, dx, dy) {
    const axis = axisOf(this.axis, this.turn), angle = 0.05 * (Math.sign(dx) + Math.sign(dy));
    if (axis) this.angle += angle;
    const about = axis ?? (dx ? up : right), by = axis || dx ? angle : -angle;
    this.last = multiply(turnAbout(about, by), this.last);
    return this.answer();
  }

  /** Degrees about the axis; the screen's where there is none. @param {number[]} numbers */
  typed(numbers) {
    if (numbers.length !== 1) return null;
    /** @type {Vec3} */
    const towards = [-this.view[0], -this.view[1], -this.view[2]];
    this.angle = (numbers[0] * Math.PI) / 180;
    this.last = multiply(turnAbout(axisOf(this.axis, this.turn) ?? towards, this.angle), this.turn);
    return this.answer();
  }

  /** @returns {{place: Vec3, orientation: Quat}} */
  answer() {
    this.last = unit(this.last);
    return { place: this.start, orientation: this.last };
  }

  /** rad, about the axis that it is held to; in steps, where there are such. */
  get swept() {
    return this.snap ? toStep(this.angle, this.snap) : this.angle;
  }

  /** rad, from where it was taken */
  turned() {
    const [w, ...v] = multiply(this.last, [this.turn[0], -this.turn[1], -this.turn[2], -this.turn[3]]);
    return 2 * Math.atan2(length(/** @type {Vec3} */ (v)), Math.abs(w));
  }
}
