// SPDX-License-Identifier: MIT
// Many bodies, drawn at once: software takes as long to begin a body, or an instance of one, as to draw a thousand of its corners. So
// all are one mesh, whose corners find the pose of their body in a texture. Of very many, balls have fewer corners.

import * as THREE from 'three';
import { crowdPaint } from './shading.js';

/** @typedef {import('../types.js').Shape} Shape */
/** @typedef {import('./bodies.js').BodyMesh} BodyMesh */

/** Bodies from which on they are drawn at once, and balls are coarse. */
const fewest = 24, veryMany = 100;
/** A body with more triangles is drawn by itself. */
const mostTriangles = 1500;
/** Of a coarse ball; multiples of 4 and 2, as its shades change at each quarter and at the equator. */
const meridians = 8, rings = 6;

const at = (/** @type {Shape} */ { vertices }, /** @type {number} */ i) => new THREE.Vector3(vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]);

/** m; 0: it is no ball about its origin. @param {Shape} shape */
export function ballRadius(shape) {
  const radius = at(shape, 0).length();
  for (let i = 0; i < shape.vertices.length / 3; ++i) if (Math.abs(at(shape, i).length() - radius) > 1e-4 * radius) return 0;
  return shape.triangles ? radius : 0;
}

/** A ball of radius 1 with few corners, in the two shades of a finer one. @param {Shape} shape @returns {THREE.BufferGeometry[]} of each shade */
export function coarseBall(shape) {
  const ball = new THREE.SphereGeometry(1, meridians, rings).rotateX(Math.PI / 2), index = /** @type {THREE.BufferAttribute} */ (ball.getIndex());
  const middles = [shape.triangles, shape.accent].map((all) => Array.from({ length: (all?.length ?? 0) / 3 }, (_, k) => {
    const [a, b, c] = [0, 1, 2].map((i) => at(shape, /** @type {Uint32Array} */ (all)[3 * k + i]));
    return a.add(b).add(c).normalize();
  }));
  const nearest = (/** @type {THREE.Vector3} */ v, /** @type {THREE.Vector3[]} */ all) => all.reduce((best, one) => Math.max(best, one.dot(v)), -1);
  /** @type {number[][]} */
  const shades = [[], []], place = ball.getAttribute('position');
  for (let k = 0; k < index.count; k += 3) {
    const corners = [0, 1, 2].map((i) => index.getX(k + i)), middle = new THREE.Vector3();
    for (const corner of corners) middle.add(new THREE.Vector3().fromBufferAttribute(place, corner));
    middle.normalize();
    shades[nearest(middle, middles[1]) > nearest(middle, middles[0]) ? 1 : 0].push(...corners);
  }
  return shades.map((own) => {
    const part = new THREE.BufferGeometry();
    for (const name of ['position', 'normal']) part.setAttribute(name, ball.getAttribute(name));
    return part.setIndex(own);
  });
}

/** Corners, normals and triangles by shade of a body among others. @typedef {{place: ArrayLike<number>, normal: ArrayLike<number>, shades: ArrayLike<number>[], size: number}} Part */

/** @param {Shape} shape @param {boolean} coarse @returns {Part} */
function partOf(shape, coarse) {
  const radius = coarse ? ballRadius(shape) : 0;
  if (!radius) return { place: shape.vertices, normal: /** @type {Float32Array} */ (shape.normals), shades: [shape.triangles ?? [], shape.accent ?? []], size: 1 };
  const [first, second] = coarseBall(shape);
  const shades = [first, second].map((part) => /** @type {THREE.BufferAttribute} */ (part.getIndex()).array);
  return { place: first.getAttribute('position').array, normal: first.getAttribute('normal').array, shades, size: radius };
}

/** Corners of all bodies behind each other; a corner of both shades is there twice. @param {Part[]} parts @param {THREE.Color[][]} inks of each body by shade */
function merged(parts, inks) {
  /** @type {number[][]} */
  const [places, normals, colours, bodies, index] = [[], [], [], [], []];
  parts.forEach(({ place, normal, shades }, i) => shades.forEach((triangles, shade) => {
    /** @type {Map<number, number>} */
    const known = new Map();
    for (let k = 0; k < triangles.length; ++k) {
      const corner = triangles[k];
      let own = known.get(corner);
      if (own === undefined) {
        known.set(corner, (own = bodies.length));
        for (let c = 0; c < 3; ++c) places.push(place[3 * corner + c]), normals.push(normal[3 * corner + c]);
        colours.push(...inks[i][shade].toArray()), bodies.push(i);
      }
      index.push(own);
    }
  }));
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(places, 3));
  geometry.setAttribute('normal', new THREE.Float32BufferAttribute(normals, 3));
  geometry.setAttribute('ink', new THREE.Float32BufferAttribute(colours, 3));
  geometry.setAttribute('body', new THREE.Float32BufferAttribute(bodies, 1));
  return geometry.setIndex(index);
}

export class Crowd {
  constructor() {
    this.group = new THREE.Group();
    /** @type {number[]} */
    this.bodies = [];
    /** @type {number[]} */
    this.sizes = [];
    /** @type {THREE.DataTexture | null} two texels a body: place and size, turn */
    this.poses = null;
  }

  /** @param {Shape[]} shapes @param {BodyMesh[]} meshes @param {boolean} fast where software draws */
  rebuild(shapes, meshes, fast) {
    this.clear();
    const moving = shapes.filter(({ fixed, plane }) => !fixed && !plane);
    const all = moving.filter(({ body, normals, triangles }) => normals && (triangles?.length ?? 0) <= 3 * mostTriangles && !meshes[body].children.length);
    if (!fast || all.length < fewest) return;
    const parts = all.map((shape) => partOf(shape, moving.length > veryMany));
    this.bodies = all.map(({ body }) => body);
    this.sizes = parts.map(({ size }) => size);
    this.poses = new THREE.DataTexture(new Float32Array(8 * all.length), 2, all.length, THREE.RGBAFormat, THREE.FloatType);
    const mesh = new THREE.Mesh(merged(parts, this.bodies.map((body) => meshes[body].userData.inks)), crowdPaint(this.poses));
    mesh.frustumCulled = false;
    this.group.add(mesh);
  }

  clear() {
    for (const child of this.group.children) {
      const { geometry, material } = /** @type {THREE.Mesh<THREE.BufferGeometry, THREE.Material>} */ (child);
      geometry.dispose();
      material.dispose();
    }
    this.poses?.dispose();
    this.poses = null;
    this.bodies = this.sizes = [];
    this.group.clear();
  }

  /** Bodies are where their meshes are; the selected one is drawn by itself. @param {BodyMesh[]} meshes @param {number} selected */
  update(meshes, selected) {
    if (!this.poses) return;
    const texels = /** @type {Float32Array} */ (this.poses.image.data);
    this.bodies.forEach((body, i) => {
      const { position: p, quaternion: q } = meshes[body], alone = body === selected;
      meshes[body].visible = alone;
      texels.set([p.x, p.y, p.z, alone ? 0 : this.sizes[i], q.x, q.y, q.z, q.w], 8 * i);
    });
    this.poses.needsUpdate = true;
  }
}
