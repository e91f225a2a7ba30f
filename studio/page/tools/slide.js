// SPDX-License-Identifier: MIT
// A hand that moves a point on the surface that it touches: what is out of the surface is left to the motion. Lifted off it,
// or along an axis, as any other drag.

import { along, dot, inPlane, Move } from './move.js';

/** @typedef {import('../types.js').Vec3} Vec3 */
/** @typedef {import('./move.js').Ray} Ray */
/** Where, the normal there, whether the place of a contact is held, and where rays meet that body or pass it nearest; null: only the plane there counts.
 * @typedef {{point: Vec3, normal: Vec3, contact?: boolean, cut: ((ray: Ray) => {point: Vec3, normal: Vec3} | null) | null}} Touched */

/** The axis that is least in a surface: where a point is along it, the surface says. @param {Vec3} normal */
const leastIn = (normal) => 'xyz'[normal.reduce((best, c, i, all) => (Math.abs(c) > Math.abs(all[best]) ? i : best), 0)];

export class Slide extends Move {
  /** @param {{turn: import('../types.js').Quat, ray: Ray, view: Vec3, touched: Touched}} options */
  constructor({ touched, ...options }) {
    super({ ...options, start: touched.point });
    this.touched = touched;
    this.lifted = false;
    this.across = leastIn(touched.normal);
  }

  /** Off the surface, or back onto it. @returns {boolean} whether that makes a difference */
  lift() {
    this.lifted = !this.lifted;
    return true;
  }

  /** @param {boolean} leave_rest_free */
  held(leave_rest_free) {
    if (this.lifted || leave_rest_free && this.axis || this.axis === this.across) return super.held(leave_rest_free);
    return [...'xyz'].filter((c) => c !== this.across);
  }

  /** @param {Ray} ray */
  pointOn(ray) {
    if (this.axis || this.lifted) return super.pointOn(ray);
    const { cut, normal, point } = this.touched;
    if (!cut) return inPlane(ray, point, normal);
    const on = cut(ray);
    if (on) this.across = leastIn(on.normal);
    return on?.point ?? null;
  }

  /** Of a contact with what is held of it there: on another side of a body that is something else. @param {Ray} ray */
  target(ray) {
    const target = super.target(ray);
    return this.axis || this.lifted || !this.touched.contact ? target : { ...target, components: [...'xyz'].filter((c) => c !== this.across) };
  }

  /** @param {Vec3} right @param {Vec3} up @param {number} dx @param {number} dy */
  nudge(right, up, dx, dy) {
    if (this.axis || this.lifted) return super.nudge(right, up, dx, dy);
    const { normal } = this.touched, flat = (/** @type {Vec3} */ v) => along(v, normal, -dot(v, normal));
    return super.nudge(flat(right), flat(up), dx, dy);
  }
}
