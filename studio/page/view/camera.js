// SPDX-License-Identifier: MIT
// The camera: orbit, pan, zoom, framing, and what the screen means in space.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

/** @typedef {import('../types.js').Vec3} Vec3 */

/** @param {THREE.Vector3} v @returns {Vec3} */
const vec = (v) => [v.x, v.y, v.z];

export class Camera {
  /** @param {HTMLElement} element that the pointer is over @param {() => void} changed */
  constructor(element, changed) {
    this.element = element;
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(2, -4, 2);
    this.controls = new OrbitControls(this.camera, element);
    this.controls.mouseButtons = { LEFT: THREE.MOUSE.ROTATE, MIDDLE: THREE.MOUSE.ROTATE, RIGHT: THREE.MOUSE.PAN };
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', changed);
    this.caster = new THREE.Raycaster();
    this.width = 1;
    this.height = 1;
  }

  /** @param {number} width px @param {number} height px */
  resize(width, height) {
    this.width = width;
    this.height = height;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** Whether the pointer turns the camera. @param {boolean} on */
  enable(on) {
    this.controls.enabled = on;
  }

  /** Shows a box from where one looks now, or from another side. @param {Vec3} min @param {Vec3} max
   * @param {Vec3 | null} side direction from the box to the camera */
  frame(min, max, side) {
    const box = new THREE.Box3(new THREE.Vector3(...min), new THREE.Vector3(...max));
    const centre = box.getCenter(new THREE.Vector3()), radius = Math.max(1e-3, box.getSize(new THREE.Vector3()).length() / 2);
    const away = side ? new THREE.Vector3(...side) : this.camera.position.clone().sub(this.controls.target);
    const half = Math.min(1, this.camera.aspect) * Math.tan((this.camera.fov * Math.PI) / 360);
    const distance = (0.92 * radius) / Math.sin(Math.atan(half));
    this.camera.near = distance / 200;
    this.camera.far = distance * 50;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(away.normalize(), distance);
    this.controls.update();
    this.camera.updateMatrixWorld();
  }

  /** On the screen, px from the view's corner, and how far in front of the camera (m, below 0: behind it).
   * @param {Vec3} point @returns {[number, number, number]} */
  project(point) {
    const v = new THREE.Vector3(...point).applyMatrix4(this.camera.matrixWorldInverse), depth = -v.z;
    v.applyMatrix4(this.camera.projectionMatrix);
    return [((v.x + 1) / 2) * this.width, ((1 - v.y) / 2) * this.height, depth];
  }

  /** @param {number} x @param {number} y px */
  cast(x, y) {
    this.caster.setFromCamera(new THREE.Vector2((2 * x) / this.width - 1, 1 - (2 * y) / this.height), this.camera);
    return this.caster;
  }

  /** @param {number} x @param {number} y px @returns {import('../tools/move.js').Ray} */
  ray(x, y) {
    const { ray } = this.cast(x, y);
    return { origin: vec(ray.origin), direction: vec(ray.direction) };
  }

  axes() {
    const x = new THREE.Vector3(), y = new THREE.Vector3(), z = new THREE.Vector3();
    this.camera.matrixWorld.extractBasis(x, y, z);
    return {
      right: vec(x), up: vec(y), view: vec(z.negate()),
      perPixel: (/** @type {Vec3} */ p) => (2 * Math.max(this.project(p)[2], 1e-6) * Math.tan((this.camera.fov * Math.PI) / 360)) / this.height,
    };
  }
}
