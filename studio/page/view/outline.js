// SPDX-License-Identifier: MIT
// The outline of the selected body: its surface, pushed outwards by a few pixels on the screen, so that it is as wide far
// away as it is near. Drawn without depth between the other bodies and the selected one, which covers all but the rim.

import * as THREE from 'three';
import { colours } from '../colours.js';

/** @typedef {import('../types.js').State} State */
/** @typedef {import('./bodies.js').BodyMesh} BodyMesh */

const pixels = 2;

const vertexShader = `
uniform vec2 size;
uniform float width;
void main() {
  vec4 place = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  vec2 outwards = normalize(normalMatrix * normal).xy;
  float length_seen = length(outwards);
  if (length_seen > 1e-3) place.xy += outwards / length_seen * width * 2.0 / size * place.w;
  gl_Position = place;
}`;
const fragmentShader = `
uniform vec3 colour;
void main() {
  gl_FragColor = vec4(colour, 1.0);
  #include <colorspace_fragment>
}`;

/** The triangles of a mesh with normals that are the same for all vertices at one place: pushed along them, the surface
 * does not tear at edges. @param {THREE.BufferGeometry} geometry */
function seamless(geometry) {
  const position = geometry.getAttribute('position'), index = geometry.getIndex(), sums = new Map();
  const keys = Array.from({ length: position.count }, (_, i) => `${position.getX(i)} ${position.getY(i)} ${position.getZ(i)}`);
  const [a, b, c] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()], count = index ? index.count : position.count;
  for (let i = 0; i + 2 < count; i += 3) {
    const corners = [0, 1, 2].map((k) => (index ? index.getX(i + k) : i + k));
    [a, b, c].forEach((corner, k) => corner.fromBufferAttribute(position, corners[k]));
    const across = b.sub(a).cross(c.sub(a));
    for (const corner of corners) {
      const sum = sums.get(keys[corner]) ?? new THREE.Vector3();
      sums.set(keys[corner], sum.add(across));
    }
  }
  const normals = new Float32Array(3 * position.count);
  keys.forEach((key, i) => (sums.get(key) ?? a.set(0, 0, 0)).clone().normalize().toArray(normals, 3 * i));
  const result = new THREE.BufferGeometry();
  // its own: with buffers that are shared and go, what is drawn from them by others at that moment goes too
  result.setAttribute('position', /** @type {THREE.BufferAttribute} */ (position.clone()));
  result.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
  result.setIndex(index?.clone() ?? null);
  return result;
}

export class Outline {
  constructor() {
    const uniforms = { size: { value: new THREE.Vector2(1, 1) }, width: { value: pixels }, colour: { value: new THREE.Color(colours.accent) } };
    this.material = new THREE.ShaderMaterial({ uniforms, vertexShader, fragmentShader, side: THREE.DoubleSide, depthWrite: false });
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    this.mesh.renderOrder = 1;
    this.of = /** @type {THREE.BufferGeometry | null} */ (null);
  }

  /** @param {State} state @param {(BodyMesh | undefined)[]} bodies @param {number} width @param {number} height px */
  update({ selected, motion }, bodies, width, height) {
    bodies.forEach((one, i) => one && (one.renderOrder = i === selected ? 2 : 0));
    const body = motion ? bodies[selected] : undefined;
    this.mesh.visible = !!body;
    if (!body) return;
    if (this.of !== body.geometry) {
      this.mesh.geometry.dispose();
      this.mesh.geometry = seamless(body.geometry);
      this.of = body.geometry;
    }
    this.mesh.position.copy(body.position);
    this.mesh.quaternion.copy(body.quaternion);
    this.material.uniforms.size.value.set(width, height);
    this.material.uniforms.width.value = width > 1900 ? 1.25 * pixels : pixels;
  }
}
