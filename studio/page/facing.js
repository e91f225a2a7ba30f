// SPDX-License-Identifier: MIT
// A body that is to come to rest with a face up: a press on the side chooses it, a drag from there or the next press the place.

import { surfaceUnder } from './build.js';
import { faceOfSide, facesOf } from './faces.js';
import { rotate } from './motion.js';
import { refusal } from './take.js';

/** @typedef {import('./types.js').State} State */

const dragPixels = 4;

export class Facing {
  /** @param {{store: import('./store.js').Store<State>, view: import('./view/view.js').View, commands: import('./commands.js').Commands}} parts */
  constructor({ store, view, commands }) {
    this.store = store;
    this.view = view;
    this.commands = commands;
    /** @type {[number, number] | null} where the press was that chose the side */
    this.from = null;
    store.on(['facing'], (state) => this.tell(state));
  }

  /** Whether a place is to be chosen. */
  get chooses() {
    return !!this.store.state.facing && !this.store.state.facing.searching;
  }

  /** @param {State} state */
  tell({ facing, document, notice }) {
    if (!facing) return notice?.key === 'facing' ? this.store.set({ notice: null }) : undefined;
    const name = `'${document?.bodies[facing.body]?.name}'`;
    const message = facing.searching ? `Looking for a throw with ${facing.name} up${facing.tried ? `: ${facing.tried} tried` : ''}. Esc ends it.`
      : `${facing.name} up: press where ${name} is to lie; Enter: anywhere; Esc: not at all.`;
    if (notice?.message !== message) this.store.set({ notice: { message, key: 'facing' } });
  }

  /** @param {number} x @param {number} y px @returns {boolean} whether the press is meant for this */
  press(x, y) {
    const { state } = this.store;
    if (this.chooses) {
      this.follow(x, y);
      if (this.store.state.facing?.place) void this.commands.faceUp();
      return true;
    }
    if (state.tool !== 'face' || state.facing) return false;
    const caster = this.view.camera.cast(x, y), hit = this.view.bodies.pick(caster), side = this.view.bodies.surface(caster);
    const shape = hit && state.scene?.shapes[hit.body], track = hit && state.motion?.tracks[hit.body];
    if (!hit || !side || !shape || !track || shape.fixed) return false;
    const [w, ...axis] = this.view.bodies.poseOf(track, Math.min(state.time, state.motion?.end ?? 0)).turn;
    const face = faceOfSide(facesOf(shape), rotate([w, -axis[0], -axis[1], -axis[2]], side.normal)), name = `'${shape.name}'`;
    this.store.set({ selected: hit.body, playing: false });
    if (!face) return this.store.set({ notice: { message: `${name} cannot lie with this side up: what is opposite is not flat, or it would fall over.` } }), true;
    if (this.begin(hit.body, face)) this.from = [x, y];
    return true;
  }

  /** @param {number} body @param {import('./faces.js').Face} face @returns {boolean} whether a place can be chosen now */
  begin(body, { name, up }) {
    const { motion, document, gesture } = this.store.state;
    if (!motion || !document || gesture.state !== 'idle') return false;
    const why_not = refusal(this.store.state, { kind: 'body', body, time: 0, at: 0, place: [0, 0, 0] });
    if (why_not) return this.store.set({ notice: { message: why_not } }), false;
    this.from = null;
    this.store.set({ selected: body, hover: null, playing: false, card: null, facing: { body, name, up, place: null, searching: false, tried: 0 } });
    return true;
  }

  /** @param {number} x @param {number} y px @returns {boolean} whether the pointer is busy with this */
  move(x, y) {
    if (!this.chooses) return false;
    if (!this.from || Math.hypot(x - this.from[0], y - this.from[1]) > dragPixels) this.follow(x, y);
    return true;
  }

  /** @param {number} x @param {number} y px */
  follow(x, y) {
    const { facing } = this.store.state, on = facing && surfaceUnder(this.view, this.store.state, x, y, facing.body);
    if (facing) this.store.set({ facing: { ...facing, place: on && on.normal[2] > 0.5 ? on.point : null } });
  }

  /** A drag from the side ends at the place. @param {number} x @param {number} y px */
  up(x, y) {
    const { from } = this;
    this.from = null;
    if (!from || !this.chooses || Math.hypot(x - from[0], y - from[1]) <= dragPixels) return;
    this.follow(x, y);
    if (this.store.state.facing?.place) void this.commands.faceUp();
  }

  /** Enter: wherever it comes to rest. @returns {boolean} */
  anywhere() {
    const { facing } = this.store.state;
    if (!facing || facing.searching) return false;
    this.store.set({ facing: { ...facing, place: null } });
    void this.commands.faceUp();
    return true;
  }

  /** Escape. @returns {boolean} whether there was something to leave */
  cancel() {
    const { facing } = this.store.state;
    if (!facing) return false;
    if (facing.searching) this.commands.connection.send('stop');
    else this.store.set({ facing: null });
    return true;
  }
}
