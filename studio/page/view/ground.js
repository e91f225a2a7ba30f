// SPDX-License-Identifier: MIT
// The ground as lines that fade with distance; never a plane, which costs a software renderer a third of a frame.

import * as THREE from 'three';
import { spacingOf } from '../grid.js';
import { place } from './bodies.js';

/** @typedef {import('../types.js').State} State */

const lines = 21, upwards = new THREE.Vector3(0, 0, 1);

export class Ground {
  constructor() {
    this.group = new THREE.Group();
    /** @type {State['scene']} */
    this.shown = null;
    this.tracks = /** @type {unknown} */ (null);
  }

  /** @param {State} state */
  update({ scene, motion }) {
    if (scene === this.shown && (this.tracks || !motion)) return;
    this.shown = scene;
    this.tracks = motion;
    for (const child of this.group.children) {
      const line = /** @type {THREE.LineSegments<THREE.BufferGeometry, THREE.Material>} */ (child);
      line.geometry.dispose();
      line.material.dispose();
    }
    this.group.clear();
    if (!scene || !motion) return;
    const extent = Math.max(...scene.max.map((m, i) => m - scene.min[i]));
    for (const shape of scene.shapes) {
      if (!shape.plane) continue;
      const grid = gridOf(spacingOf(extent), Math.max(extent, 0.5) * 1.6);
      place(grid, motion.tracks[shape.body], 0);
      const normal = new THREE.Vector3(...shape.plane.normal), turn = new THREE.Quaternion().setFromUnitVectors(upwards, normal);
      grid.position.addScaledVector(normal.clone().applyQuaternion(grid.quaternion), shape.plane.offset);
      grid.quaternion.multiply(turn);
      centre(grid, scene, spacingOf(extent));
      this.group.add(grid);
    }
  }
}

/** Moves a grid in its own plane to below the middle of the scene, by whole cells.
 * @param {THREE.Object3D} grid @param {NonNullable<State['scene']>} scene @param {number} spacing */
function centre(grid, scene, spacing) {
  const middle = new THREE.Vector3(...scene.min).add(new THREE.Vector3(...scene.max)).multiplyScalar(0.5).sub(grid.position);
  const local = middle.applyQuaternion(grid.quaternion.clone().invert());
  local.set(Math.round(local.x / spacing) * spacing, Math.round(local.y / spacing) * spacing, 0);
  grid.position.add(local.applyQuaternion(grid.quaternion));
}

/** @param {number} spacing @param {number} radius m, where it has faded away */
function gridOf(spacing, radius) {
  const half = Math.min(60, Math.ceil(radius / spacing)), positions = [], inks = [];
  const alpha = (/** @type {number} */ x, /** @type {number} */ y) => 0.42 * Math.max(0, 1 - Math.hypot(x, y) / radius) ** 1.5;
  for (let i = -half; i <= half; ++i) {
    for (let k = 0; k < lines; ++k) {
      const a = i * spacing, b = radius * ((2 * k) / lines - 1), c = radius * ((2 * (k + 1)) / lines - 1);
      if (alpha(a, b) + alpha(a, c) === 0) continue;
      positions.push(a, b, 0, a, c, 0, b, a, 0, c, a, 0);
      for (const end of [b, c, b, c]) inks.push(0.22, 0.235, 0.255, alpha(a, end));
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute('color', new THREE.Float32BufferAttribute(inks, 4));
  return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false }));
}
