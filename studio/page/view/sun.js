// SPDX-License-Identifier: MIT
// The lights. The main one casts shadows where hardware draws: on a software renderer a shadow map costs a third of a frame.

import * as THREE from 'three';

/** @typedef {import('../types.js').SceneShapes} SceneShapes */

/** Lights by colour and intensity; towards: where they come from. The sky is up along y, as three.js has it. */
export const sunLight = { colour: '#ffffff', intensity: 2, towards: new THREE.Vector3(-1.2, -2.4, 3).normalize() };
export const fillLight = { colour: '#bfd4ff', intensity: 0.6, towards: new THREE.Vector3(2, 1, 0.5).normalize() };
export const skyLight = { colour: '#ffffff', ground: '#868c94', intensity: 1.45 };
const { towards } = sunLight;

export class Lights {
  constructor() {
    this.sun = new THREE.DirectionalLight(sunLight.colour, sunLight.intensity);
    this.fill = new THREE.DirectionalLight(fillLight.colour, fillLight.intensity);
    this.fill.position.copy(fillLight.towards);
    this.sun.position.copy(towards);
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 3;
    this.all = [new THREE.HemisphereLight(skyLight.colour, skyLight.ground, skyLight.intensity), this.sun, this.sun.target, this.fill];
    /** @type {SceneShapes | null} */
    this.around = null;
  }

  /** @param {SceneShapes | null} scene @param {boolean} shadows */
  update(scene, shadows) {
    this.sun.castShadow = shadows;
    if (!shadows || !scene || scene === this.around) return;
    this.around = scene;
    const box = new THREE.Box3(new THREE.Vector3(...scene.min), new THREE.Vector3(...scene.max));
    const centre = box.getCenter(new THREE.Vector3()), radius = Math.max(1e-3, box.getSize(new THREE.Vector3()).length() / 2);
    this.sun.target.position.copy(centre);
    this.sun.position.copy(centre).addScaledVector(towards, 2 * radius);
    Object.assign(this.sun.shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: 0.5 * radius, far: 3.5 * radius });
    this.sun.shadow.camera.updateProjectionMatrix();
    this.sun.shadow.normalBias = 0.004 * radius;
  }
}
