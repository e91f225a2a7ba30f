// SPDX-License-Identifier: MIT
// Paths of the centres of mass: a thin line each, a fat one for the selected body with the thin path of one point of its
// surface, and dashed ones of a motion before.

import * as THREE from 'three';
import { colours, inkOf } from '../colours.js';
import { centreAt, moves, pathTimes, pointAt } from '../motion.js';
import { dashedLine, faintLine, fatLine, thinLine } from './lines.js';

/** @typedef {import('../types.js').State} State */
/** @typedef {import('../types.js').Track} Track */

const turnNumbers = 5, mostBodies = 50;

/** m: what a chord of a path may be off. @param {State['scene']} scene */
export function sagOf(scene) {
  return scene ? 2e-4 * Math.max(1e-3, Math.hypot(...scene.max.map((m, i) => m - scene.min[i]))) : 1e-3;
}

/** @param {(time: number) => number[]} at @param {number[]} times */
function lineOf(at, times) {
  const positions = new Float32Array(3 * times.length);
  times.forEach((time, i) => positions.set(at(time), 3 * i));
  return positions;
}

/** Times for the path of a point that turns with the body. @param {Track} track @param {number} end @param {number} sag */
function turningTimes(track, end, sag) {
  const times = pathTimes(track, end, sag);
  for (let k = 0; k < track.turns.length; k += turnNumbers) {
    const from = track.turns[k], to = track.turns[k + turnNumbers] ?? end;
    for (let i = 0; i < 4; ++i) times.push(Math.min(end, from + ((to - from) * i) / 4));
  }
  return times.sort((a, b) => a - b).filter((t, i, all) => i === 0 || t > all[i - 1]);
}

export class Paths {
  constructor() {
    this.group = new THREE.Group();
    /** @type {Map<string, {object: THREE.Object3D & {geometry: THREE.BufferGeometry, material: THREE.Material}, of: unknown, opacity: number}>} */
    this.lines = new Map();
    /** @type {Map<string, THREE.Material>} the last that went of each kind: with it its shaders would go, and be compiled
     * again at every update of a drag, which took most of its frame */
    this.retired = new Map();
    this.scale = 1;
  }

  /** @param {State} state @param {State['motion']} [gone] a motion that fades away @param {number} [share] by now */
  update(state, gone = null, share = 1) {
    const { motion, scene, selected } = state, wanted = new Set(), sag = sagOf(scene);
    this.scale = 2500 * sag;
    const shown = motion ? this.shownBodies(state) : [];
    for (const body of motion ? shown : []) {
      const track = /** @type {NonNullable<typeof motion>} */ (motion).tracks[body], end = motion?.end ?? 0;
      const ink = inkOf(scene?.shapes[body]?.colour ?? colours.fixed);
      if (body === selected) {
        this.put(wanted, `fat ${body}`, [track, end], () => fatLine(lineOf((t) => centreAt(track, t), pathTimes(track, end, sag)), ink));
        const point = this.surfacePoint(scene, body);
        this.put(wanted, `surface ${body}`, [track, end], () =>
          faintLine(lineOf((t) => pointAt(track, point, t), turningTimes(track, end, sag)), ink, 0.55));
      } else {
        this.put(wanted, `path ${body}`, [track, end], () => thinLine(lineOf((t) => centreAt(track, t), pathTimes(track, end, sag)), ink));
      }
    }
    const before = beforeOf(state);
    for (const track of before?.tracks ?? []) {
      if (!shown.includes(track.body) || track === motion?.tracks[track.body]) continue;
      const end = /** @type {NonNullable<typeof before>} */ (before).end;
      this.put(wanted, `before ${track.body}`, [track, end], () =>
        dashedLine(lineOf((t) => centreAt(track, t), pathTimes(track, end, sag)), this.scale));
    }
    const { preview } = state;
    for (const track of preview?.tracks ?? []) {
      if (!shown.includes(track.body)) continue;
      const end = preview?.end ?? 0;
      this.put(wanted, `preview ${track.body}`, [track, end], () => thinLine(lineOf((t) => centreAt(track, t), pathTimes(track, end, sag)), colours.preview));
    }
    for (const track of gone?.tracks ?? []) {
      if (!shown.includes(track.body) || track === motion?.tracks[track.body]) continue;
      const ink = inkOf(scene?.shapes[track.body]?.colour ?? colours.fixed), end = gone?.end ?? 0;
      this.put(wanted, `gone ${track.body}`, [track, end], () => thinLine(lineOf((t) => centreAt(track, t), pathTimes(track, end, sag)), ink));
    }
    for (const [key, { object, opacity }] of this.lines) {
      const kind = key.split(' ')[0];
      if (kind !== 'before') object.material.opacity = opacity * (kind === 'gone' ? 1 - share : share);
      if (wanted.has(key)) continue;
      this.remove(object);
      this.lines.delete(key);
    }
  }

  /** Moving bodies; of very many the selected one and those it meets. @param {State} state @returns {number[]} */
  shownBodies({ motion, scene, selected }) {
    const moving = motion?.tracks.filter((t) => !scene?.shapes[t.body]?.fixed && moves(t)).map((t) => t.body) ?? [];
    if (moving.length <= mostBodies) return moving;
    const met = new Set([selected]);
    for (const { bodies } of motion?.impacts ?? []) if (bodies.includes(selected)) bodies.forEach((body) => met.add(body));
    return moving.filter((body) => met.has(body));
  }

  /** @param {State['scene']} scene @param {number} body @returns {import('../types.js').Vec3} farthest from the centre */
  surfacePoint(scene, body) {
    const shape = scene?.shapes[body];
    let best = -1;
    /** @type {import('../types.js').Vec3} */
    let point = [0, 0, 0];
    for (let i = 0; shape && i + 2 < shape.vertices.length; i += 3) {
      const [x, y, z] = shape.vertices.subarray(i, i + 3), [a, b, c] = shape.center;
      const far = (x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2;
      if (far > best * (1 + 1e-6)) [best, point] = [far, [x, y, z]];
    }
    return point;
  }

  /** @param {Set<string>} wanted @param {string} key @param {[Track, number]} of
   * @param {() => THREE.Object3D & {geometry: THREE.BufferGeometry, material: THREE.Material}} make */
  put(wanted, key, of, make) {
    wanted.add(key);
    const line = this.lines.get(key), known = /** @type {[Track, number] | undefined} */ (line?.of);
    if (known && known[0] === of[0] && known[1] === of[1]) return;
    if (line) this.remove(line.object);
    const object = make();
    object.frustumCulled = false;
    this.lines.set(key, { object, of, opacity: object.material.opacity });
    this.group.add(object);
  }

  /** @param {THREE.Object3D & {geometry: THREE.BufferGeometry, material: THREE.Material}} object */
  remove(object) {
    this.group.remove(object);
    object.geometry.dispose();
    this.retired.get(object.material.type)?.dispose();
    this.retired.set(object.material.type, object.material);
  }
}

/** The motion whose paths are dashed. @param {State} state */
export function beforeOf({ gesture, before, opened, savedMotion, showBefore, changesShown }) {
  if (gesture.state !== 'idle' && gesture.state !== 'pressed') return before;
  if (showBefore === 'opened') return opened;
  if (showBefore === 'saved') return savedMotion;
  return changesShown ? before : null;
}
