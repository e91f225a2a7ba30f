// SPDX-License-Identifier: MIT
// Where a body is at any time, from its track: arcs of the centre of mass (exact parabolas; polynomials of degree 5
// round bends of a slide) and keys of its turn.
// No drawing library here: tests use it as well.

/** @typedef {import('./types.js').Vec3} Vec3 */
/** @typedef {import('./types.js').Quat} Quat */
/** @typedef {import('./types.js').Track} Track */

const parabolaNumbers = 10, turnNumbers = 5;

/** Index of the last row whose time is at most t; 0 before the first.
 * @param {Float64Array | Float32Array} rows @param {number} width @param {number} t */
function rowAt(rows, width, t) {
  let low = 0, high = rows.length / width;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (rows[middle * width] <= t) low = middle;
    else high = middle;
  }
  return low;
}

/** m, of the centre of mass. @param {Track} track @param {number} t s @returns {Vec3} */
export function centreAt({ arcs, stride = parabolaNumbers }, t) {
  const row = rowAt(arcs, stride, t) * stride, s = t - arcs[row];
  const along = (/** @type {number} */ k) => {
    const bend = stride > parabolaNumbers ? s * (arcs[k + 9] + s * (arcs[k + 12] + s * arcs[k + 15])) : 0;
    return arcs[k] + s * (arcs[k + 3] + s * (0.5 * arcs[k + 6] + bend));
  };
  return [along(row + 1), along(row + 2), along(row + 3)];
}

/** m/s, of the centre of mass. @param {Track} track @param {number} t s @returns {Vec3} */
export function velocityAt({ arcs, stride = parabolaNumbers }, t) {
  const row = rowAt(arcs, stride, t) * stride, s = t - arcs[row];
  const along = (/** @type {number} */ k) => {
    const bend = stride > parabolaNumbers ? s * (3 * arcs[k + 9] + s * (4 * arcs[k + 12] + s * 5 * arcs[k + 15])) : 0;
    return arcs[k + 3] + s * (arcs[k + 6] + bend);
  };
  return [along(row + 1), along(row + 2), along(row + 3)];
}

/** m/s^2, of the centre of mass. @param {Track} track @param {number} t s @returns {Vec3} */
export function accelerationAt({ arcs, stride = parabolaNumbers }, t) {
  const row = rowAt(arcs, stride, t) * stride, s = t - arcs[row];
  const along = (/** @type {number} */ k) => arcs[k + 6] + (stride > parabolaNumbers ? s * (6 * arcs[k + 9] + s * (12 * arcs[k + 12] + s * 20 * arcs[k + 15])) : 0);
  return [along(row + 1), along(row + 2), along(row + 3)];
}

/** Shape to world. @param {Track} track @param {number} t s @returns {Quat} */
export function turnAt({ turns }, t) {
  const i = rowAt(turns, turnNumbers, t), k = i * turnNumbers, next = k + turnNumbers;
  const t0 = turns[k], a = quatIn(turns, k);
  if (next >= turns.length || t <= t0) return unit(a);
  return slerp(a, quatIn(turns, next), (t - t0) / (turns[next] - t0));
}

/** @param {Float32Array} turns @param {number} k @returns {Quat} */
function quatIn(turns, k) {
  return [turns[k + 1], turns[k + 2], turns[k + 3], turns[k + 4]];
}

/** @param {Quat} a @param {Quat} b @param {number} u in [0, 1] @returns {Quat} */
export function slerp(a, b, u) {
  const dot = Math.min(1, a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]);
  const angle = Math.acos(dot), sine = Math.sin(angle);
  const wa = sine > 1e-6 ? Math.sin((1 - u) * angle) / sine : 1 - u, wb = sine > 1e-6 ? Math.sin(u * angle) / sine : u;
  return unit([wa * a[0] + wb * b[0], wa * a[1] + wb * b[1], wa * a[2] + wb * b[2], wa * a[3] + wb * b[3]]);
}

/** @param {Quat} q @returns {Quat} */
export function unit(q) {
  const length = Math.hypot(...q);
  return [q[0] / length, q[1] / length, q[2] / length, q[3] / length];
}

/** p turned by q. @param {Quat} q @param {Vec3} p @returns {Vec3} */
export function rotate([w, x, y, z], [px, py, pz]) {
  const tx = 2 * (y * pz - z * py), ty = 2 * (z * px - x * pz), tz = 2 * (x * py - y * px);
  return [px + w * tx + y * tz - z * ty, py + w * ty + z * tx - x * tz, pz + w * tz + x * ty - y * tx];
}

/** First b, then a. @param {Quat} a @param {Quat} b @returns {Quat} */
export function multiply(a, b) {
  return [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
  ];
}

/** @param {Vec3} axis unit @param {number} angle rad @returns {Quat} */
export function turnAbout(axis, angle) {
  const s = Math.sin(angle / 2);
  return [Math.cos(angle / 2), s * axis[0], s * axis[1], s * axis[2]];
}

/** Where a point of the body is, in the shape's axes. @param {Track} track @param {Vec3} point @param {number} t */
export function pointAt(track, point, t) {
  const { center } = track, x = centreAt(track, t);
  const r = rotate(turnAt(track, t), [point[0] - center[0], point[1] - center[1], point[2] - center[2]]);
  return /** @type {Vec3} */ ([x[0] + r[0], x[1] + r[1], x[2] + r[2]]);
}

/** The shape's origin and turn. @param {Track} track @param {number} t @returns {{place: Vec3, turn: Quat}} */
export function poseAt(track, t) {
  return { place: pointAt(track, [0, 0, 0], t), turn: turnAt(track, t) };
}

/** Whether the body moves or turns at all. @param {Track} track */
export function moves({ arcs, stride = parabolaNumbers, turns }) {
  if (arcs.length > stride || turns.length > turnNumbers) return true;
  for (let i = 4; i < stride; ++i) if (arcs[i] !== 0) return true;
  return false;
}

/** Times at which a path is drawn: the beginnings of its arcs, and between them so many that no chord is off the
 * parabola by more than `sag` m (|a| h^2 / 8 = sag).
 * @param {Track} track @param {number} end s @param {number} sag @param {number} most @returns {number[]} */
export function pathTimes({ arcs, stride = parabolaNumbers }, end, sag = 1e-3, most = 4000) {
  const times = [];
  for (let k = 0; k < arcs.length && arcs[k] < end; k += stride) {
    const from = arcs[k], to = Math.min(end, k + stride < arcs.length ? arcs[k + stride] : end);
    const step = Math.sqrt((8 * sag) / Math.max(Math.hypot(arcs[k + 7], arcs[k + 8], arcs[k + 9]), 1e-9));
    const count = Math.max(1, Math.min(200, Math.ceil((to - from) / step), most - times.length));
    for (let i = 0; i < count; ++i) times.push(from + ((to - from) * i) / count);
    if (times.length >= most) break;
  }
  times.push(end);
  return times;
}

/** Whom a body meets in an impact; several where it meets more at once. @param {import('./types.js').Impact} impact
 * @param {number} body */
export function metBy({ pairs }, body) {
  return pairs.flatMap(([a, b]) => (a === body ? [b] : b === body ? [a] : []));
}

const verbs = /** @type {Record<string, string>} */ ({ rest: 'rests', slide: 'slides', roll: 'rolls', pivot: 'pivots', ride: 'rides' });

/** What a body lies on at a time: "rests on left and right", or '' where it lies on nothing. @param {import('./types.js').Motion} motion
 * @param {number} body @param {number} time @param {string[]} names */
export function lyingOn({ contacts, end }, body, time, names) {
  const now = contacts.filter((one) => one.body === body && one.from <= time && (time < one.to || one.to === end));
  const parts = now.map(({ kind, on }) => {
    const whom = on.map((other) => names[other]), last = whom.pop();
    return `${verbs[kind]} on ${whom.length ? `${whom.join(', ')} and ` : ''}${last}`;
  });
  return parts.join(', ');
}

/** An impact as documents name it: the body's n-th with the first that it meets there.
 * @param {import('./types.js').Impact[]} impacts in order of time @param {import('./types.js').Impact} impact
 * @param {number} body @param {string[]} names @returns {import('./types.js').When} */
export function atOf(impacts, impact, body, names) {
  const other = metBy(impact, body)[0], same = impacts.filter((one) => metBy(one, body).includes(other));
  return { impact: same.indexOf(impact) + 1, with: names[other] };
}

/** When the body comes to rest, to stay so up to the end: from then on it neither moves nor would. @param {Track} track
 * @returns {number | null} none: it does not, or it never moves */
export function restTime({ arcs, stride = parabolaNumbers }) {
  const still = (/** @type {number} */ row) => {
    for (let i = 4; i < stride; ++i) if (arcs[row * stride + i] !== 0) return false;
    return true;
  };
  let first = arcs.length / stride;
  while (first > 0 && still(first - 1)) --first;
  return first > 0 && first < arcs.length / stride ? arcs[first * stride] : null;
}

/** Time of an `at` in this motion. @param {import('./types.js').When} at @param {number} body
 * @param {import('./types.js').Motion} motion @param {string[]} names @returns {number | null} none: it does not come */
export function timeOf(at, body, motion, names) {
  if (typeof at === 'number') return at <= motion.end ? at : null;
  if ('between' in at) return null;
  if ('rest' in at) return restTime(motion.tracks[body]);
  return impactAt(at, body, motion, names)?.t ?? null;
}

/** The impact that documents name so. @param {import('./types.js').When} at @param {number} body
 * @param {import('./types.js').Motion} motion @param {string[]} names @returns {import('./types.js').Impact | null} none: it does not come */
export function impactAt(at, body, motion, names) {
  if (typeof at === 'number' || !('impact' in at)) return null;
  let n = 0;
  for (const impact of motion.impacts) {
    const met = metBy(impact, body);
    if (at.with === undefined) {
      if (impact.nth[impact.bodies.indexOf(body)] === at.impact) return impact;
    } else if (met.some((other) => names[other] === at.with) && ++n === at.impact) {
      return impact;
    }
  }
  return null;
}
