// SPDX-License-Identifier: MIT
// A soft dark disc below each moving body, on the first fixed thing there: enough to tell how high it is.

import * as THREE from 'three';
import { centreAt, moves } from '../motion.js';

/** @typedef {import('../types.js').State} State */

/** Of more moving bodies none has one. */
const most = 50;
const down = new THREE.Vector3(0, 0, -1), upwards = new THREE.Vector3(0, 0, 1);

function softDisc() {
  const size = 64, bytes = new Uint8Array(4 * size * size);
  for (let i = 0; i < size * size; ++i) {
    const x = (2 * ((i % size) + 0.5)) / size - 1, y = (2 * (Math.floor(i / size) + 0.5)) / size - 1;
    const inside = Math.max(0, 1 - Math.hypot(x, y));
    bytes[4 * i + 3] = Math.round(255 * inside * inside * (3 - 2 * inside));
  }
  const texture = new THREE.DataTexture(bytes, size, size);
  texture.magFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

export class Shadows {
  constructor() {
    this.group = new THREE.Group();
    this.texture = softDisc();
    this.geometry = new THREE.PlaneGeometry(2, 2);
    this.caster = new THREE.Raycaster();
    /** @type {THREE.Mesh<THREE.PlaneGeometry, THREE.MeshBasicMaterial>[]} */
    this.discs = [];
  }

  /** @param {State} state @param {(THREE.Mesh | undefined)[]} bodies */
  update({ scene, motion, time }, bodies) {
    const moving = motion?.tracks.filter((track) => !scene?.shapes[track.body]?.fixed && moves(track)) ?? [];
    const fixed = scene?.shapes.filter((s) => s.fixed && !s.plane).flatMap((s) => bodies[s.body] ?? []) ?? [];
    const planes = scene?.shapes.filter((s) => s.plane) ?? [];
    let used = 0;
    for (const track of moving.length <= most ? moving : []) {
      const shape = scene?.shapes[track.body];
      if (!shape) continue;
      const x = new THREE.Vector3(...centreAt(track, Math.min(time, motion?.end ?? 0)));
      const below = this.below(x, fixed, planes, motion?.tracks ?? []);
      if (!below) continue;
      const disc = this.discs[used] ?? this.another();
      ++used;
      const height = Math.max(0, x.distanceTo(below.point) - shape.radius), reach = height / (4 * shape.radius + 1e-9);
      disc.visible = true;
      disc.position.copy(below.point).addScaledVector(below.normal, 1e-3 * shape.radius);
      disc.quaternion.setFromUnitVectors(upwards, below.normal);
      disc.scale.setScalar(shape.radius * (1.15 + 0.12 * Math.min(reach, 4)));
      disc.material.opacity = 0.62 / (1 + 0.35 * reach);
    }
    for (let i = used; i < this.discs.length; ++i) this.discs[i].visible = false;
  }

  /** What is straight below a point. @param {THREE.Vector3} from @param {THREE.Mesh[]} fixed
   * @param {import('../types.js').Shape[]} planes @param {import('../types.js').Track[]} tracks */
  below(from, fixed, planes, tracks) {
    this.caster.set(from, down);
    const hit = this.caster.intersectObjects(fixed, false)[0];
    let best = hit?.face ? { point: hit.point, normal: hit.face.normal.clone().transformDirection(hit.object.matrixWorld) } : null;
    if (best && best.normal.z < 0) best.normal.negate();
    for (const plane of planes) {
      const turns = tracks[plane.body].turns, x = new THREE.Vector3(...centreAt(tracks[plane.body], 0));
      const normal = new THREE.Vector3(...(plane.plane?.normal ?? [0, 0, 1]));
      normal.applyQuaternion(new THREE.Quaternion(turns[2], turns[3], turns[4], turns[1]));
      x.addScaledVector(normal, plane.plane?.offset ?? 0);
      if (normal.z < 0.1) continue;
      const s = from.clone().sub(x).dot(normal) / normal.z;
      if (s >= 0 && (!best || s < from.z - best.point.z)) best = { point: from.clone().addScaledVector(down, s), normal };
    }
    return best;
  }

  another() {
    const material = new THREE.MeshBasicMaterial({ map: this.texture, color: 0, transparent: true, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 });
    const disc = new THREE.Mesh(this.geometry, material);
    this.discs.push(disc);
    this.group.add(disc);
    return disc;
  }
}
