// SPDX-License-Identifier: MIT
// Which places lie behind something that stands still, as the camera sees them.

import * as THREE from 'three';

/** @typedef {import('../types.js').Vec3} Vec3 */

/** Of the way to the camera: a mark lies on a surface, which does not hide it. */
const onSurface = 5e-3;
/** More places than these are not looked at in one view of them: all of them are taken for seen. */
const most = 300;

export class Hidden {
  /** @param {import('./bodies.js').Bodies} bodies @param {THREE.PerspectiveCamera} camera */
  constructor(bodies, camera) {
    this.bodies = bodies;
    this.camera = camera;
    this.caster = new THREE.Raycaster();
    /** @type {Map<string, boolean>} as seen from `from` */
    this.known = new Map();
    this.from = new THREE.Matrix4();
    /** @type {unknown} */
    this.scene = null;
  }

  /** @param {import('../types.js').SceneShapes | null} scene @param {Vec3} point */
  hides(scene, point) {
    if (!this.from.equals(this.camera.matrixWorld) || this.scene !== scene) {
      this.known.clear();
      this.from.copy(this.camera.matrixWorld);
      this.scene = scene;
    }
    const key = point.join(), known = this.known.get(key);
    if (known !== undefined) return known;
    if (this.known.size >= most) return false;
    const hidden = this.look(scene, point);
    this.known.set(key, hidden);
    return hidden;
  }

  /** @param {import('../types.js').SceneShapes | null} scene @param {Vec3} point */
  look(scene, point) {
    const eye = this.camera.getWorldPosition(new THREE.Vector3()), way = new THREE.Vector3(...point).sub(eye), far = way.length();
    const walls = (scene?.shapes ?? []).flatMap(({ body, fixed }) => (fixed && this.bodies.meshes[body] ? [this.bodies.meshes[body]] : []));
    this.caster.set(eye, way.divideScalar(far));
    this.caster.far = far * (1 - onSurface);
    return this.caster.intersectObjects(walls, false).length > 0;
  }
}
