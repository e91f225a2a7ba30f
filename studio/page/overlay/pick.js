// SPDX-License-Identifier: MIT
// What lies under the pointer, judged on the screen: nothing is too small to hit. Handles win over nails, nails over
// impacts, impacts over places of rest, these over paths, paths over bodies.

import { atOf, centreAt, restTime } from '../motion.js';

/** @typedef {import('../types.js').Hit} Hit */
/** @typedef {import('../types.js').Motion} Motion */
/** @typedef {import('../types.js').Vec3} Vec3 */
/** @typedef {(point: Vec3) => [number, number, number]} Project  px, px, m in front of the camera */
/** @typedef {{times: number[], x: number[], y: number[], depth: number[]}} ScreenPath */

export const reach = { handle: 7, nail: 12, impact: 8, path: 12 };

/** @param {import('../types.js').Track} track @param {number[]} times @param {Project} project @returns {ScreenPath} */
export function onScreen(track, times, project) {
  /** @type {ScreenPath} */
  const path = { times, x: [], y: [], depth: [] };
  for (const time of times) {
    const [x, y, depth] = project(centreAt(track, time));
    path.x.push(x);
    path.y.push(y);
    path.depth.push(depth);
  }
  return path;
}

/** From a point to a segment: the distance and where along it, in [0, 1].
 * @param {number} x @param {number} y @param {number} ax @param {number} ay @param {number} bx @param {number} by */
export function toSegment(x, y, ax, ay, bx, by) {
  const dx = bx - ax, dy = by - ay, size = dx * dx + dy * dy;
  const u = size > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / size)) : 0;
  return { distance: Math.hypot(x - ax - u * dx, y - ay - u * dy), u };
}

/** The nearest moment of a path on the screen; what is behind the camera does not count.
 * @param {ScreenPath} path @param {number} x @param {number} y @returns {{distance: number, time: number}} */
export function nearestOnPath({ times, x: xs, y: ys, depth }, x, y) {
  let distance = Infinity, time = times[0] ?? 0;
  for (let i = 0; i + 1 < times.length; ++i) {
    if (depth[i] <= 0 || depth[i + 1] <= 0) continue;
    const near = toSegment(x, y, xs[i], ys[i], xs[i + 1], ys[i + 1]);
    if (near.distance < distance) {
      distance = near.distance;
      time = times[i] + near.u * (times[i + 1] - times[i]);
    }
  }
  return { distance, time };
}

/** Sharper than between samples: the moment within `span` of `time` whose place on the screen is nearest.
 * @param {import('../types.js').Track} track @param {number} time @param {number} span @param {number} end
 * @param {Project} project @param {number} x @param {number} y */
export function sharpened(track, time, span, end, project, x, y) {
  const far = (/** @type {number} */ t) => {
    const [px, py] = project(centreAt(track, t));
    return Math.hypot(px - x, py - y);
  };
  let low = Math.max(0, time - span), high = Math.min(end, time + span);
  for (let i = 0; i < 40; ++i) {
    const a = low + (high - low) / 3, b = high - (high - low) / 3;
    if (far(a) < far(b)) high = b;
    else low = a;
  }
  const best = (low + high) / 2;
  return far(best) < far(time) ? best : time;
}

/** @param {number} time to what a person can point at: milliseconds */
export const rounded = (time) => Math.round(time * 1000) / 1000;

/** @typedef {{motion: Motion, names: string[], paths: Map<number, ScreenPath>, project: Project, time: number,
 *    handle: (x: number, y: number) => {handle: string, body: number} | null,
 *    nails: {id: number, body: number, place: Vec3, time: number}[],
 *    bodyUnder: (x: number, y: number) => {body: number} | null}} Pickable */

/** @param {Pickable} pickable @param {number} x @param {number} y px @returns {Hit | null} */
export function pick(pickable, x, y) {
  const { motion, names, project, time } = pickable;
  const handle = pickable.handle(x, y);
  if (handle) return { kind: 'handle', ...handle, time, at: time, place: centreAt(motion.tracks[handle.body], time) };

  const nail = nearestPoint(pickable.nails, project, x, y, reach.nail);
  if (nail) return { kind: 'nail', nail: nail.id, body: nail.body, time: nail.time, at: nail.time, place: nail.place };

  const impact = nearestPoint(motion.impacts.map((one) => ({ ...one, place: one.point, one })), project, x, y, reach.impact);
  const held = impact?.bodies.filter((body) => pickable.paths.has(body)) ?? [];
  if (impact && held.length) {
    const body = held.sort((a, b) => farFrom(pickable, a, impact.t, x, y) - farFrom(pickable, b, impact.t, x, y))[0];
    const at = atOf(motion.impacts, impact.one, body, names);
    return { kind: 'impact', body, time: impact.t, at, place: centreAt(motion.tracks[body], impact.t), impact: impact.one };
  }
  return pickRest(pickable, x, y) ?? pickPath(pickable, x, y) ?? pickBody(pickable, x, y);
}

/** Where a body comes to rest, whenever that is. @param {Pickable} pickable @param {number} x @param {number} y @returns {Hit | null} */
function pickRest({ motion, paths, project }, x, y) {
  const rest = nearestPoint(restPlaces(motion, [...paths.keys()]), project, x, y, reach.impact);
  return rest && { kind: 'rest', ...rest, at: { rest: true } };
}

/** Where bodies come to rest, and when. @param {Motion} motion @param {number[]} bodies */
export function restPlaces({ tracks }, bodies) {
  return bodies.flatMap((body) => {
    const time = restTime(tracks[body]);
    return time === null ? [] : [{ body, time, place: centreAt(tracks[body], time) }];
  });
}

/** @param {Pickable} pickable @param {number} x @param {number} y @returns {Hit | null} */
function pickPath({ motion, paths, project }, x, y) {
  let best = { distance: reach.path, time: 0, body: -1 };
  for (const [body, path] of paths) {
    const near = nearestOnPath(path, x, y);
    if (near.distance < best.distance) best = { ...near, body };
  }
  if (best.body < 0) return null;
  const track = motion.tracks[best.body], path = paths.get(best.body);
  const span = path && path.times.length > 1 ? motion.end / (path.times.length - 1) : 0;
  const time = Math.min(motion.end, rounded(sharpened(track, best.time, span, motion.end, project, x, y)));
  return { kind: 'path', body: best.body, time, at: time, place: centreAt(track, time) };
}

/** @param {Pickable} pickable @param {number} x @param {number} y @returns {Hit | null} */
function pickBody({ motion, time, bodyUnder }, x, y) {
  const under = bodyUnder(x, y);
  if (!under) return null;
  const at = Math.min(motion.end, rounded(time));
  return { kind: 'body', body: under.body, time: at, at, place: centreAt(motion.tracks[under.body], at) };
}

/** @template {{place: Vec3}} T @param {T[]} points @param {Project} project @param {number} x @param {number} y
 * @param {number} within px @returns {T | null} */
function nearestPoint(points, project, x, y, within) {
  let distance = within, best = null;
  for (const point of points) {
    const [px, py, depth] = project(point.place), far = Math.hypot(px - x, py - y);
    if (depth > 0 && far < distance) [distance, best] = [far, point];
  }
  return best;
}

/** @param {Pickable} pickable @param {number} body @param {number} time @param {number} x @param {number} y */
function farFrom({ motion, project }, body, time, x, y) {
  const [px, py] = project(centreAt(motion.tracks[body], time));
  return Math.hypot(px - x, py - y);
}
