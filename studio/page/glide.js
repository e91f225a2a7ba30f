// SPDX-License-Identifier: MIT
// The way from one motion to the next after a release: what has the same impacts glides, anything else fades. Only what is
// drawn; the motion that the page works with is the new one at once.

import { centreAt, slerp, turnAt } from './motion.js';

/** @typedef {import('./types.js').Motion} Motion */
/** @typedef {import('./types.js').Track} Track */
/** @typedef {import('./types.js').State} State */

export const glideTime = 120;

/** @param {number} a @param {number} b @param {number} u */
const mix = (a, b, u) => a + u * (b - a);

/** Whether the motions differ in numbers alone. @param {Motion} a @param {Motion} b */
export function alike(a, b) {
  return a.impacts.length === b.impacts.length && a.tracks.length === b.tracks.length &&
    a.impacts.every((one, i) => one.bodies.join() === b.impacts[i].bodies.join()) &&
    a.tracks.every((one, i) => one.arcs.length === b.tracks[i].arcs.length && one.stride === b.tracks[i].stride);
}

/** @param {Track} a @param {Track} b @param {number} u @returns {Track} */
function trackBetween(a, b, u) {
  if (a === b) return b;
  const turns = b.turns.slice();
  for (let k = 0; k < turns.length; k += 5) {
    const from = turnAt(a, turns[k]), to = turnAt(b, turns[k]), sign = from.reduce((sum, c, i) => sum + c * to[i], 0) < 0 ? -1 : 1;
    turns.set(slerp([sign * from[0], sign * from[1], sign * from[2], sign * from[3]], to, u), k + 1);
  }
  return { ...b, arcs: b.arcs.map((value, i) => mix(a.arcs[i], value, u)), turns };
}

/** A motion between two that are alike. @param {Motion} a @param {Motion} b @param {number} u in [0, 1] @returns {Motion} */
export function between(a, b, u) {
  const impacts = b.impacts.map((one, i) => {
    const [x, y, z] = one.point.map((value, k) => mix(a.impacts[i].point[k], value, u));
    return { ...one, t: mix(a.impacts[i].t, one.t, u), point: /** @type {import('./types.js').Vec3} */ ([x, y, z]) };
  });
  return { ...b, end: mix(a.end, b.end, u), impacts, tracks: b.tracks.map((track, i) => trackBetween(a.tracks[i], track, u)) };
}

export class Glide {
  /** @param {() => boolean} still whether the person wants no movement */
  constructor(still) {
    this.still = still;
    this.from = /** @type {Motion | null} */ (null);
    this.last = /** @type {Motion | null} */ (null);
    this.began = 0;
  }

  /** The state as it is drawn at a moment. @param {State} state @param {number} now ms
   * @returns {{state: State, gone: Motion | null, share: number}} `gone`: what fades away, by now to this share */
  shown(state, now) {
    const { motion, gesture, opened } = state;
    if (motion !== this.last) {
      const follows = this.last && motion && opened !== motion && this.last.tracks.length === motion.tracks.length;
      const held = gesture.state === 'dragging' || gesture.state === 'typing';
      this.from = follows && !held && !this.still() && apart(this.last, motion) ? this.last : null;
      this.began = now;
      this.last = motion;
    }
    const share = (now - this.began) / glideTime;
    if (!this.from || !motion || share >= 1) {
      this.from = null;
      return { state, gone: null, share: 1 };
    }
    const u = share * share * (3 - 2 * share);
    if (!alike(this.from, motion)) return { state, gone: this.from, share: u };
    return { state: { ...state, motion: between(this.from, motion, u) }, gone: null, share: 1 };
  }
}

/** Whether there is anything to see between two motions. @param {Motion | null} a @param {Motion} b */
function apart(a, b) {
  return !!a && a.tracks.some((track, i) => {
    const other = b.tracks[i];
    if (track === other) return false;
    return [0, 0.25, 0.5, 0.75, 1].some((u) => centreAt(track, u * a.end).some((x, k) => Math.abs(x - centreAt(other, u * b.end)[k]) > 1e-6));
  });
}
