// SPDX-License-Identifier: MIT
// Fixed bodies that stand before most of what moves are seen through, whoever looks from where: a pen shows its balls.

import * as THREE from 'three';
import { centreAt, moves } from '../motion.js';
import { setOpacity } from './shading.js';

/** @typedef {import('../types.js').State} State */
/** @typedef {import('./bodies.js').BodyMesh} BodyMesh */

/** Places of bodies that are looked at, each at so many moments of the motion. */
const most = 24, moments = [0, 0.5, 1];
/** Share of them, behind one body or all together, from which on these are seen through. */
const share = 0.4;
const seenThrough = 0.3;

export class Walls {
  constructor() {
    this.caster = new THREE.Raycaster();
    this.from = new THREE.Matrix4();
    /** @type {unknown} */
    this.motion = null;
    /** @type {unknown} */
    this.scene = null;
    /** @type {Set<number>} */
    this.before = new Set();
  }

  /** @param {State} state @param {BodyMesh[]} meshes @param {THREE.PerspectiveCamera} camera */
  update({ scene, motion }, meshes, camera) {
    if (!scene || !motion || (this.from.equals(camera.matrixWorld) && this.scene === scene && this.motion === motion)) return;
    this.from.copy(camera.matrixWorld);
    this.scene = scene;
    this.motion = motion;
    const fixed = scene.shapes.flatMap(({ body, fixed: stays, plane }) => (stays && !plane && meshes[body] ? [meshes[body]] : []));
    this.before = fixed.length ? this.look(motion.tracks.filter((track) => !scene.shapes[track.body]?.fixed && moves(track)), motion.end, fixed, camera) : new Set();
    for (const mesh of fixed) for (const paint of mesh.material) setOpacity(paint, this.before.has(mesh.userData.body) ? seenThrough : 1);
  }

  /** @param {import('../types.js').Track[]} moving @param {number} end @param {BodyMesh[]} fixed @param {THREE.Camera} camera
   * @returns {Set<number>} bodies */
  look(moving, end, fixed, camera) {
    const eye = camera.getWorldPosition(new THREE.Vector3()), step = Math.max(1, Math.floor(moving.length / most));
    /** @type {Map<BodyMesh, number>} */
    const hides = new Map();
    let places = 0, hidden = 0;
    for (const mesh of fixed) mesh.updateMatrixWorld(true);
    for (let i = 0; i < moving.length; i += step) {
      for (const moment of moments) {
        const way = new THREE.Vector3(...centreAt(moving[i], moment * end)).sub(eye), far = way.length();
        this.caster.set(eye, way.divideScalar(far));
        this.caster.far = far;
        const walls = new Set(this.caster.intersectObjects(fixed, false).map(({ object }) => /** @type {BodyMesh} */ (object)));
        ++places;
        if (walls.size) ++hidden;
        for (const wall of walls) hides.set(wall, (hides.get(wall) ?? 0) + 1);
      }
    }
    const all = hidden >= share * places;
    return new Set([...hides].filter(([, count]) => all && count >= 0.1 * places).map(([mesh]) => mesh.userData.body));
  }
}
