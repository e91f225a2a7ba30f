// SPDX-License-Identifier: MIT
// Where things of the time line are: seconds to pixels and back, ticks, lanes.

/** @typedef {{from: number, to: number, left: number, width: number}} Axis seconds, pixels */

/** @param {Axis} axis @param {number} t s */
export const xOf = ({ from, to, left, width }, t) => left + ((t - from) / (to - from)) * width;

/** @param {Axis} axis @param {number} x px */
export const tOf = ({ from, to, left, width }, x) => from + ((x - left) / width) * (to - from);

/** Labels at least 56 px apart, at 1, 2 or 5 times a power of ten. @param {Axis} axis
 * @returns {{t: number, text: string}[]} */
export function ticks({ from, to, width }) {
  const least = ((to - from) * 56) / Math.max(width, 1), power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= least * (1 - 1e-9)) ?? 10 * power;
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), found = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; ++k) found.push({ t: k * step, text: (k * step).toFixed(digits) });
  return found;
}

/** A span around a moment that stays where it is on the screen; never beyond the motion, never below a millisecond.
 * @param {Axis} axis @param {number} x px @param {number} factor below 1: nearer @param {number} end s */
export function zoomed(axis, x, factor, end) {
  const t = Math.max(0, Math.min(end, tOf(axis, x)));
  const span = Math.min(end, Math.max(1e-3, (axis.to - axis.from) * factor)), share = (t - axis.from) / (axis.to - axis.from);
  const from = Math.max(0, Math.min(end - span, t - share * span));
  return { from, to: from + span };
}

/** Lanes of the moving bodies, top to bottom, each with room for a name. @param {number[]} bodies @param {number} top @param {number} height px of
 * all @param {number} scroll lanes above the first that is seen
 * @returns {{body: number, y: number, height: number}[]} those that are seen */
export function lanes(bodies, top, height, scroll) {
  const fits = Math.max(1, Math.min(8, Math.floor(height / 12))), seen = bodies.slice(scroll, scroll + fits);
  const each = Math.min(28, height / Math.max(1, seen.length));
  return seen.map((body, i) => ({ body, y: top + i * each, height: each }));
}
