// SPDX-License-Identifier: MIT
// Lines of paths, each over a dark casing: on what is as light as the line itself, that is what it is seen by; on the dark view the casing is
// not seen. A thin line has its casing drawn as thin lines shifted to three sides of it, which costs less than a wider one.

import * as THREE from 'three';
import { Line2 } from 'three/addons/lines/Line2.js';
import { LineGeometry } from 'three/addons/lines/LineGeometry.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { colours } from '../colours.js';

const fat = 2.5, shifts = [[0, 1.3], [1.15, -0.7], [-1.15, -0.7]];

const casings = shifts.map(() => new THREE.ShaderMaterial({
  uniforms: { shift: { value: new THREE.Vector2() }, ink: { value: new THREE.Color(colours.casing) } },
  vertexShader: 'uniform vec2 shift; void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); gl_Position.xy += shift * gl_Position.w; }',
  fragmentShader: 'uniform vec3 ink; void main() { gl_FragColor = vec4(ink, 1.0); }',
  transparent: true, depthWrite: false,
}));
const fatCasing = new LineMaterial({ color: colours.casing, linewidth: fat + 2.2, transparent: true, depthWrite: false });

/** Pixels that are drawn: what a pixel is, depends on them. @param {number} width @param {number} height */
export function linesOn(width, height) {
  casings.forEach(({ uniforms }, i) => uniforms.shift.value.set((2 * shifts[i][0]) / width, (2 * shifts[i][1]) / height));
}

/** @template {THREE.Object3D} T @param {T} line @param {THREE.Object3D[]} around */
function cased(line, around) {
  for (const casing of around) {
    casing.frustumCulled = false;
    casing.renderOrder = 0.5;
    line.add(casing);
  }
  line.renderOrder = 1;
  return line;
}

/** @template {THREE.Line} T @param {T} line */
const casedThin = (line) => cased(line, casings.map((material) => new THREE.Line(line.geometry, material)));

/** @param {Float32Array} positions */
const through = (positions) => new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(positions, 3));

/** @param {Float32Array} positions @param {string} colour */
export function thinLine(positions, colour) {
  return casedThin(faintLine(positions, colour, 0.85));
}

/** Without a casing, which would be stronger than the line. @param {Float32Array} positions @param {string} colour @param {number} opacity */
export function faintLine(positions, colour, opacity) {
  const line = new THREE.Line(through(positions), new THREE.LineBasicMaterial({ color: colour, transparent: true, opacity, depthWrite: false }));
  line.renderOrder = 1;
  return line;
}

/** @param {Float32Array} positions @param {string} colour */
export function fatLine(positions, colour) {
  const geometry = new LineGeometry();
  geometry.setPositions(positions);
  const line = new Line2(geometry, new LineMaterial({ color: new THREE.Color(colour).getHex(), linewidth: fat, transparent: true, depthWrite: false }));
  return cased(line, [new Line2(geometry, fatCasing)]);
}

/** @param {Float32Array} positions @param {number} scale m, of the scene */
export function dashedLine(positions, scale) {
  const material = new THREE.LineDashedMaterial({ color: colours.before, dashSize: 0.016 * scale, gapSize: 0.011 * scale, transparent: true, depthWrite: false });
  const line = casedThin(new THREE.Line(through(positions), material));
  line.computeLineDistances();
  return line;
}
