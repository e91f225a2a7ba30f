// SPDX-License-Identifier: MIT
// Faint poses every tenth of a second, the one under the pointer, and those that nails want. Depth is drawn first, so
// that inner faces do not show.

import * as THREE from 'three';
import { colours, inkOf } from '../colours.js';
import { lyingPose } from '../faces.js';
import { moves, turnAt } from '../motion.js';
import { singleNails, placeHeld } from '../overlay/hoops.js';
import { place } from './bodies.js';

/** @typedef {import('../types.js').State} State */
/** @typedef {import('./bodies.js').BodyMesh} BodyMesh */

const spacing = 0.1, most = 60;

/** Two meshes of one geometry: depth alone, then colour. @param {number} order @param {number} count
 * @param {THREE.BufferGeometry} geometry @param {string} colour @param {number} opacity @param {boolean} flat */
function pair(order, count, geometry, colour, opacity, flat) {
  const depth = new THREE.MeshBasicMaterial({ colorWrite: false, transparent: true });
  const paint = new THREE.MeshLambertMaterial({ color: colour, transparent: true, opacity, flatShading: flat });
  return [depth, paint].map((material, i) => {
    const mesh = new THREE.InstancedMesh(geometry, material, count);
    mesh.renderOrder = order + i;
    mesh.frustumCulled = false;
    return mesh;
  });
}

export class Ghosts {
  constructor() {
    this.group = new THREE.Group();
    /** @type {Map<string, {meshes: THREE.InstancedMesh[], count: number, geometry: THREE.BufferGeometry}>} */
    this.sets = new Map();
    this.dummy = new THREE.Object3D();
    this.arm = new THREE.Vector3();
  }

  /** @param {State} state @param {BodyMesh[]} bodies */
  update(state, bodies) {
    const { motion, hover } = state, wanted = new Set();
    const dragging = state.gesture.state !== 'idle';
    if (motion) {
      for (const body of this.bodiesWithGhosts(state)) {
        const times = [];
        for (let k = 0; k <= most && k * spacing <= motion.end + 1e-9; ++k) times.push(k * spacing);
        this.show(wanted, `ghosts ${body}`, bodies[body], inkOf(state.scene?.shapes[body]?.colour ?? colours.fixed), 0.24, 2,
          times, (time) => place(this.dummy, motion.tracks[body], time));
      }
      if (hover && !dragging && hover.kind !== 'handle' && bodies[hover.body]) {
        this.show(wanted, `hover ${hover.body}`, bodies[hover.body], colours.accent, 0.4, 4, [hover.time],
          (time) => place(this.dummy, motion.tracks[hover.body], Math.min(time, motion.end)));
      }
      const { facing } = state, lying = facing?.place && state.scene?.shapes[facing.body];
      if (lying) {
        this.show(wanted, `lying ${facing.body}`, bodies[facing.body], colours.nail, 0.5, 4, [0], () => this.lying(lying, facing, motion));
      }
      for (const held of singleNails(state)) {
        const { nail, body, time } = held;
        if (!nail.on || !nail.available) continue;
        this.show(wanted, `nail ${nail.id}`, bodies[body], colours.nail, 0.25, 4, [time], () => this.nailed(held, motion));
      }
    }
    // hidden rather than dropped: with the last of a kind its shaders would go, and be compiled again at the next hover
    const alive = new Set(bodies.map((body) => body?.geometry));
    for (const [key, set] of this.sets) {
      if (!alive.has(set.geometry)) this.drop(key, set);
      else if (!wanted.has(key)) for (const mesh of set.meshes) mesh.visible = false;
    }
  }

  /** On a surface with a face up. @param {import('../types.js').Shape} shape @param {import('../types.js').FacingState} facing
   * @param {NonNullable<State['motion']>} motion */
  lying(shape, { up, place: on }, motion) {
    if (!on) return;
    const { place: [x, y, z], turn: [w, qx, qy, qz] } = lyingPose(shape, up, on, turnAt(motion.tracks[shape.body], motion.end));
    this.dummy.position.set(x, y, z);
    this.dummy.quaternion.set(qx, qy, qz, w);
  }

  /** The pose that a nail wants; what it leaves free is as it is now. @param {import('../overlay/hoops.js').NailPlace} held
   * @param {NonNullable<State['motion']>} motion */
  nailed({ nail, body, place: [x, y, z], now, time }, motion) {
    place(this.dummy, motion.tracks[body], time);
    if (nail.constraint.contact) {  // as it is, moved to where it is to touch
      this.dummy.position.add(this.arm.set(x - now[0], y - now[1], z - now[2]));
      return;
    }
    const { orientation } = nail.constraint, point = placeHeld(nail.constraint)?.point ?? motion.tracks[body].center;
    if (orientation) this.dummy.quaternion.set(orientation[1], orientation[2], orientation[3], orientation[0]).normalize();
    const arm = this.arm.set(point[0], point[1], point[2]).applyQuaternion(this.dummy.quaternion);
    this.dummy.position.set(x, y, z).sub(arm);
  }

  /** @param {State} state @returns {number[]} */
  bodiesWithGhosts({ motion, scene, selected, quality }) {
    const moving = motion?.tracks.filter((track) => !scene?.shapes[track.body]?.fixed && moves(track)).map((t) => t.body) ?? [];
    if (quality === 'low' || moving.length > 12) return moving.includes(selected) ? [selected] : moving.length <= 2 ? moving : [];
    return moving;
  }

  /** @param {Set<string>} wanted @param {string} key @param {BodyMesh | undefined} body @param {string} colour
   * @param {number} opacity @param {number} order @param {number[]} times @param {(time: number) => void} put */
  show(wanted, key, body, colour, opacity, order, times, put) {
    if (!body) return;
    wanted.add(key);
    let set = this.sets.get(key);
    if (!set || set.count < times.length || set.geometry !== body.geometry) {
      if (set) this.drop(key, set);
      const meshes = pair(order, times.length, body.geometry, colour, opacity, !body.geometry.hasAttribute('normal'));
      set = { meshes, count: times.length, geometry: body.geometry };
      this.sets.set(key, set);
      this.group.add(...meshes);
    }
    times.forEach((time, i) => {
      put(time);
      this.dummy.updateMatrix();
      for (const mesh of set.meshes) mesh.setMatrixAt(i, this.dummy.matrix);
    });
    for (const mesh of set.meshes) {
      mesh.visible = true;
      mesh.count = times.length;
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  /** @param {string} key @param {{meshes: THREE.InstancedMesh[]}} set */
  drop(key, { meshes }) {
    for (const mesh of meshes) {
      this.group.remove(mesh);
      mesh.dispose();
      /** @type {THREE.Material} */ (mesh.material).dispose();
    }
    this.sets.delete(key);
  }
}
