// SPDX-License-Identifier: MIT
// The bodies as they are at the time shown.

import * as THREE from 'three';
import { colours } from '../colours.js';
import { poseAt } from '../motion.js';
import { Crowd } from './crowd.js';
import { pipsFor } from './pips.js';
import { paintOf, setGlow } from './shading.js';

/** @typedef {import('../types.js').Shape} Shape */
/** @typedef {import('../types.js').State} State */
/** Two paints, by shade; userData: {body, inks}, the colours of these. @typedef {THREE.Mesh<THREE.BufferGeometry, import('./shading.js').Paint[]>} BodyMesh */

/** @param {Shape} shape */
export function geometryOf(shape) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(shape.vertices, 3));
  const { triangles = null, accent } = shape;
  if (triangles) {
    const index = new Uint32Array(triangles.length + (accent?.length ?? 0));
    index.set(triangles);
    index.set(accent ?? [], triangles.length);
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
    geometry.addGroup(0, triangles.length, 0);
    geometry.addGroup(triangles.length, accent?.length ?? 0, 1);
  }
  if (shape.normals) geometry.setAttribute('normal', new THREE.BufferAttribute(shape.normals, 3));
  geometry.computeBoundingSphere();
  return geometry;
}

/** Puts an object where a body is. @param {THREE.Object3D} object @param {import('../types.js').Track} track
 * @param {number} time s */
export function place(object, track, time) {
  const { place: [x, y, z], turn: [w, qx, qy, qz] } = poseAt(track, time);
  object.position.set(x, y, z);
  object.quaternion.set(qx, qy, qz, w);
}

export class Bodies {
  constructor() {
    this.group = new THREE.Group();
    /** @type {BodyMesh[]} by body; none for planes */
    this.meshes = [];
    /** @type {import('../types.js').SceneShapes | null} */
    this.shown = null;
    this.crowd = new Crowd();
    this.fast = false;
  }

  /** @param {State} state */
  update({ scene, motion, time, selected, quality }) {
    const fast = quality === 'low';
    if (scene !== this.shown || fast !== this.fast) this.rebuild(scene, fast);
    this.group.visible = this.crowd.group.visible = !!motion;
    if (!motion) return;
    this.meshes.forEach((mesh, body) => {
      const track = motion.tracks[body];
      if (track) place(mesh, track, Math.min(time, motion.end));
      for (const paint of mesh.material) setGlow(paint, body === selected ? 0x0a1018 : 0);
    });
    this.crowd.update(this.meshes, selected);
  }

  /** @param {State['scene']} scene @param {boolean} fast where software draws */
  rebuild(scene, fast) {
    const old = this.shown?.shapes.filter(({ body }) => this.meshes[body]).map((shape) => /** @type {const} */ ([shape, this.meshes[shape.body]]));
    const kept = new Map(old), same = fast === this.fast;
    this.fast = fast;
    this.shown = scene;
    this.group.clear();
    this.meshes = [];
    for (const shape of scene?.shapes ?? []) {
      if (shape.plane) continue;
      const mesh = (same && kept.get(shape)) || meshOf(shape, fast);
      if (same) kept.delete(shape);
      mesh.visible = true;
      this.meshes[shape.body] = mesh;
      this.group.add(mesh);
    }
    this.crowd.rebuild(scene?.shapes ?? [], this.meshes, fast);
    for (const mesh of kept.values()) {
      mesh.traverse((part) => {
        const { geometry, material } = /** @type {THREE.Mesh} */ (part);
        geometry.dispose();
        for (const one of [material].flat()) one.dispose();
      });
    }
  }

  /** Where a body is. @param {import('../types.js').Track} track @param {number} time */
  poseOf(track, time) {
    return poseAt(track, time);
  }

  /** The first place along a ray on a body, and the normal of the side that is seen. @param {THREE.Raycaster} caster
   * @param {number} except a body that does not count @returns {{point: import('../types.js').Vec3, normal: import('../types.js').Vec3} | null} */
  surface(caster, except = -1) {
    this.group.updateMatrixWorld(true);
    const hit = caster.intersectObjects(this.group.children.filter((mesh) => mesh !== this.meshes[except]), false)[0];
    if (!hit?.face) return null;
    const normal = hit.face.normal.clone().transformDirection(hit.object.matrixWorld);
    if (normal.dot(caster.ray.direction) > 0) normal.negate();
    return { point: [hit.point.x, hit.point.y, hit.point.z], normal: [normal.x, normal.y, normal.z] };
  }

  /** The first body along a ray. @param {THREE.Raycaster} caster @returns {{body: number, point: THREE.Vector3} | null} */
  pick(caster) {
    this.group.updateMatrixWorld(true);
    const hit = caster.intersectObjects(this.group.children, false)[0];
    return hit ? { body: this.meshes.indexOf(/** @type {any} */ (hit.object)), point: hit.point } : null;
  }
}

/** @param {Shape} shape @param {boolean} fast @returns {BodyMesh} */
function meshOf(shape, fast) {
  const colour = shape.fixed ? colours.fixed : shape.colour;
  const light = new THREE.Color(colour).lerp(new THREE.Color('#ffffff'), 0.45);
  const inks = [new THREE.Color(colour), light], mesh = new THREE.Mesh(geometryOf(shape), inks.map((ink) => paintOf(ink, { fast, flat: !shape.normals })));
  mesh.userData = { body: shape.body, inks };
  mesh.castShadow = mesh.receiveShadow = true;
  const pips = pipsFor(shape);
  if (pips) mesh.add(pips);
  return mesh;
}
