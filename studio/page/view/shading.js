// SPDX-License-Identifier: MIT
// What bodies are painted with. Where software draws, light is worked out at the vertices, as Lambert's law has it for each pixel:
// a pixel then costs as little as it can, and on flat faces it is the same.

import * as THREE from 'three';
import { fillLight, skyLight, sunLight } from './sun.js';

/** @param {{colour: string, intensity: number}} light @returns {THREE.Vector3} linear, over pi: Lambert's law */
const radiance = ({ colour, intensity }) => new THREE.Vector3(...new THREE.Color(colour).toArray()).multiplyScalar(intensity / Math.PI);

/** One for all, so that they are there once. */
const lights = {
  sun: { value: radiance(sunLight) }, sunward: { value: sunLight.towards }, fill: { value: radiance(fillLight) }, fillward: { value: fillLight.towards },
  sky: { value: radiance(skyLight) }, ground: { value: radiance({ ...skyLight, colour: skyLight.ground }) },
};

const vertexShader = `
uniform vec3 sun, sunward, fill, fillward, sky, ground, paint, glow;
varying vec3 seen;
vec3 encoded(vec3 v) {
  return mix(pow(v, vec3(0.41666)) * 1.055 - vec3(0.055), v * 12.92, vec3(lessThanEqual(v, vec3(0.0031308))));
}
#ifdef CROWD
  uniform sampler2D poses;
  attribute vec3 ink;
  attribute float body;
  vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
#endif
void main() {
  vec3 place = position, n = normal, diffuse = paint;
  #ifdef CROWD
    vec4 at = texelFetch(poses, ivec2(0, int(body)), 0), turn = texelFetch(poses, ivec2(1, int(body)), 0);
    place = at.xyz + at.w * turned(turn, position);
    n = turned(turn, normal);
    diffuse = ink;
  #endif
  n = normalize(mat3(modelMatrix) * n);
  vec3 light = sun * max(dot(n, sunward), 0.0) + fill * max(dot(n, fillward), 0.0) + mix(ground, sky, 0.5 * n.y + 0.5);
  seen = encoded(clamp(diffuse * light + glow, 0.0, 1.0));
  gl_Position = projectionMatrix * (modelViewMatrix * vec4(place, 1.0));
}`;
const fragmentShader = 'uniform float opacity; varying vec3 seen; void main() { gl_FragColor = vec4(seen, opacity); }';
/** @typedef {THREE.MeshLambertMaterial | THREE.ShaderMaterial} Paint */

/** @param {THREE.ColorRepresentation} colour @param {{fast: boolean, flat: boolean}} how `fast`: light at the vertices, which flat meshes without
 * normals do not have @returns {Paint} */
export function paintOf(colour, { fast, flat }) {
  if (!fast || flat) return new THREE.MeshLambertMaterial({ color: colour, flatShading: flat });
  const uniforms = { ...lights, paint: { value: new THREE.Color(colour) }, glow: { value: new THREE.Color(0) }, opacity: { value: 1 } };
  return new THREE.ShaderMaterial({ uniforms, vertexShader, fragmentShader });
}

/** Of many bodies at once, each with colours at its corners. @param {THREE.Texture} poses of the bodies: place and size, turn */
export function crowdPaint(poses) {
  const uniforms = { ...lights, poses: { value: poses }, paint: { value: new THREE.Color(0) }, glow: { value: new THREE.Color(0) }, opacity: { value: 1 } };
  return new THREE.ShaderMaterial({ uniforms, vertexShader, fragmentShader, defines: { CROWD: '' } });
}

/** @param {Paint} paint @param {number} glow */
export function setGlow(paint, glow) {
  if (paint instanceof THREE.ShaderMaterial) paint.uniforms.glow.value.set(glow);
  else paint.emissive.set(glow);
}

/** @param {Paint} paint @param {number} opacity */
export function setOpacity(paint, opacity) {
  if (paint.opacity === opacity) return;
  paint.opacity = opacity;
  paint.transparent = opacity < 1;
  paint.depthWrite = opacity === 1;
  paint.needsUpdate = true;
  if (paint instanceof THREE.ShaderMaterial) paint.uniforms.opacity.value = opacity;
}
