// SPDX-License-Identifier: MIT
// The pips of dice, as flat discs just off their sides.

import * as THREE from 'three';
import { dieSize, pipsOf } from '../faces.js';

/** Shares of half the edge. */
const radius = 0.17, off = 0.006;
const corners = 14;

/** @param {import('../types.js').Shape} shape @returns {THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial> | null} none: it is no die */
export function pipsFor(shape) {
  const half = dieSize(shape);
  if (!half) return null;
  /** @type {number[]} */
  const places = [], triangles = [];
  for (const { centre, normal } of pipsOf(half)) {
    const i = normal.findIndex((c) => c !== 0), [a, b] = [(i + 1) % 3, (i + 2) % 3], first = places.length / 3;
    for (let k = 0; k < corners; ++k) {
      const angle = (2 * Math.PI * k) / corners, point = centre.map((c, axis) => c + half * off * normal[axis]);
      point[a] += half * radius * Math.cos(angle), point[b] += half * radius * Math.sin(angle);
      places.push(...point);
    }
    for (let k = 1; k + 1 < corners; ++k) triangles.push(first, ...(normal[i] > 0 ? [first + k, first + k + 1] : [first + k + 1, first + k]));
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(places, 3));
  geometry.setIndex(triangles);
  const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color: '#10141a' }));
  mesh.renderOrder = 3;  // after the outline of the selected body, and that body
  return mesh;
}
