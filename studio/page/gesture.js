// SPDX-License-Identifier: MIT
// The one state machine of the hand: idle, pressed, dragging, typing, settling. Escape leaves every state. It sees the
// screen through `space` and the server through `connection`, so that tests can stand in for both.

import { PlaceSender, placing } from './build.js';
import { DragSender } from './connection.js';
import { gridOf, turnStep } from './grid.js';
import { evaluate } from './number_field_text.js';
import { idleGesture } from './store.js';
import { gripOf, refusal, toolFor } from './take.js';
import { Move, nextAxis } from './tools/move.js';
import { Turn } from './tools/turn.js';

/** @typedef {import('./types.js').Hit} Hit */
/** @typedef {import('./types.js').Vec3} Vec3 */
/** @typedef {import('./take.js').Space} Space */
/** @typedef {{store: import('./store.js').Store<import('./types.js').State>, space: Space,
 *    connection: Pick<import('./connection.js').Connection, 'send' | 'request'>,
 *    select: (hit: Hit | null) => void, ended: (how: 'released' | 'cancelled', answer: any, nailed: boolean) => void,
 *    refused?: (error: any) => void, later?: (act: () => void, ms: number) => unknown}} Parts  refused: what a gesture was to come to cannot be */

const clickPixels = 4, settlingShownAfter = 150;

export class Gesture {
  /** @param {Parts} parts */
  constructor({ store, space, connection, select, ended, refused = (error) => store.set({ notice: { message: error.message, kind: 'red' } }), later = (act, ms) => setTimeout(act, ms) }) {
    this.store = store;
    this.space = space;
    this.connection = connection;
    this.select = select;
    this.ended = ended;
    this.refused = refused;
    this.later = later;
    this.number = this.dragId = 0;
    /** @type {DragSender | PlaceSender | null} */
    this.sender = null;
    /** @type {Move | Turn | null} */
    this.tool = null;
    /** @type {[number, number]} */
    this.from = [0, 0];
    /** @type {[number, number]} */
    this.pointer = [0, 0];
    this.byKey = false;
    this.near = false;  // whether targets go to surfaces and marks
    this.grid = 0;  // of the grid, the steps in which they go; 0: none
  }

  get now() {
    return this.store.state.gesture;
  }

  /** @param {Partial<import('./types.js').GestureState>} patch */
  put(patch) {
    this.store.set({ gesture: { ...this.now, ...patch } });
  }

  /** The left button went down on something that can be held, or on nothing. @param {Hit | null} hit
   * @param {number} x @param {number} y @returns {boolean} whether the press is the gesture's: nothing orbits then */
  press(hit, x, y) {
    if (this.now.state === 'dragging' || this.now.state === 'typing') {
      if (this.byKey) this.release();
      return true;
    }
    if (this.now.state === 'settling') {
      this.connection.send('stop');
      this.store.set({ gesture: idleGesture });
    }
    this.from = this.pointer = [x, y];
    if (!hit) return false;
    this.store.set({ gesture: { ...idleGesture, state: 'pressed', hit }, playing: false, hover: null });
    return true;
  }

  /** @param {number} x @param {number} y */
  move(x, y) {
    this.pointer = [x, y];
    const { state, hit } = this.now;
    if (state === 'pressed' && hit && Math.hypot(x - this.from[0], y - this.from[1]) > clickPixels) this.begin(hit, false);
    if (this.now.state === 'dragging') this.follow();
  }

  /** @param {number} x @param {number} y */
  up(x, y) {
    // a quick hand comes here without a move before it
    if (!this.byKey && (x !== this.pointer[0] || y !== this.pointer[1])) this.move(x, y);
    const { state, hit } = this.now;
    if (state === 'pressed') {
      this.store.set({ gesture: idleGesture });
      this.select(hit);
    } else if ((state === 'dragging' || state === 'typing') && !this.byKey) {
      this.release();
    }
  }

  /** By G or R: takes the selected body at the play head. @param {Hit} hit @param {'move' | 'turn'} tool */
  beginByKey(hit, tool) {
    if (this.now.state === 'settling') this.connection.send('stop');
    else if (this.now.state !== 'idle') return;
    this.from = this.pointer = this.space.project(hit.place);
    this.store.set({ tool, playing: false, hover: null });
    this.begin({ ...hit, handle: undefined }, true);
  }

  /** @param {Hit} hit @param {boolean} by_key */
  begin(hit, by_key) {
    const why_not = refusal(this.store.state, hit);
    if (why_not) return this.store.set({ gesture: idleGesture, notice: { message: why_not } });
    const { motion } = this.store.state;
    if (!motion) return;
    this.byKey = by_key;
    this.tool = toolFor(this.store.state, this.space, hit, this.from);
    this.store.set({
      before: motion, changesShown: false, card: null, selected: hit.body, time: hit.time,
      gesture: { ...idleGesture, state: 'dragging', hit, axis: this.tool.axis },
    });
    this.grab();
  }

  /** Tells the server what is held; again where the axis changes what is held. */
  grab() {
    const { hit } = this.now, { document, motion } = this.store.state;
    if (!hit || !document || !motion || !this.tool) return;
    const gesture = ++this.number, edits = placing(this.store.state, hit, this.tool instanceof Turn && this.tool);
    if (edits) {
      this.put({ number: gesture, seq: 0, answered: -1 });
      this.sender = new PlaceSender({ request: (type, members) => this.connection.request(type, members), rev: document.rev, gesture, edits,
        failed: (error) => this.now.number === gesture && this.store.set({ card: { message: error.message, kind: 'amber' } }) });
      return;
    }
    this.sender = new DragSender((members) => void (this.dragId = this.connection.send('drag', members)), gesture);
    this.put({ number: gesture, seq: 0, answered: -1 });
    let asked;
    if (hit.kind === 'nail') {
      asked = this.connection.request('grab_nail', { gesture, nail: hit.nail });
    } else {
      const body = document.bodies[hit.body].name, grip = gripOf(this.store.state, hit, this.tool);
      asked = this.connection.request('grab', { gesture, body, at: hit.at, grip, free: true }).then((answer) => {
        if (answer.freed) this.sayThatThrowVaries(body);
      });
    }
    asked.catch((error) => {
      if (this.now.number !== gesture) return;
      this.store.set({ gesture: idleGesture, notice: error.code === 'lost' ? this.store.state.notice : { message: error.message, kind: 'red' } });
    });
  }

  /** @param {string} body */
  sayThatThrowVaries(body) {
    this.store.set({ notice: { message: `The throw of '${body}' may change now.`, actions: [{ name: 'Undo', act: () => void this.connection.send('undo') }] } });
  }

  /** Targets go to the grid, or a tenth of it, from here on; or to surfaces and marks. @param {boolean} on @param {boolean} fine @param {boolean} [near] */
  snapTo(on, fine, near = this.near) {
    const grid = on ? (fine ? 0.1 : 1) : 0;
    if (grid === this.grid && near === this.near) return;
    [this.grid, this.near] = [grid, near];
    if (this.now.state === 'dragging') this.follow();
  }

  /** The hand is where the pointer is. */
  follow() {
    if (!this.tool) return;
    const { hit } = this.now, on = this.near && hit && hit.handle !== 'throw' && this.tool instanceof Move && this.space.snapped?.(hit, ...this.pointer);
    if (on && this.tool instanceof Move) return this.offer(this.tool.put(on.place), on.name);
    this.tool.snap = (hit?.handle === 'throw' ? 0 : this.grid) * (this.tool instanceof Turn ? turnStep : gridOf(this.store.state.scene));
    this.offer(this.tool instanceof Turn ? this.tool.target(this.pointer) : this.tool.target(this.space.ray(...this.pointer)));
  }

  /** @param {import('./connection.js').DragTarget} target @param {string} [snapOn] what it went to */
  offer(target, snapOn = '') {
    this.sender?.offer(target);
    this.put({ target: target.place, turn: target.orientation ?? null, seq: this.sender?.seq ?? 0, snap: this.tool?.snap ?? 0, snapOn });
  }

  /** A letter in a drag. @param {'x' | 'y' | 'z'} letter @param {boolean} plane */
  setAxis(letter, plane) {
    if (this.now.state !== 'dragging' || !this.tool) return;
    const axis = nextAxis(this.tool.axis, letter, plane);
    this.alter((tool) => tool.setAxis(axis));
  }

  /** Off the surface that the drag slides on, or back onto it. */
  lift() {
    if (this.now.state === 'dragging') this.alter((tool) => void tool.lift());
  }

  /** Another way to move: where other components are held, the body is taken hold of anew. @param {(tool: Move | Turn) => void} change */
  alter(change) {
    const { tool } = this, free = this.store.state.leaveRestFree;
    if (!tool) return;
    const before = String(tool.held(free));
    change(tool);
    this.put({ axis: tool.axis });
    if (String(tool.held(free)) !== before && this.now.hit?.kind !== 'nail') {
      if (!(this.sender instanceof PlaceSender)) this.connection.send('cancel', { gesture: this.now.number });
      this.grab();
    }
    this.follow();
  }

  /** An arrow key in a drag. @param {number} dx @param {number} dy in steps */
  nudge(dx, dy) {
    const { hit, state } = this.now;
    if (state !== 'dragging' || !this.tool || !hit) return;
    const { right, up, perPixel } = this.space.camera(), step = 4 * perPixel(hit.place);
    this.offer(this.tool.nudge(right, up, dx * step, dy * step));
  }

  startTyping() {
    if (this.now.state === 'dragging') this.put({ state: 'typing' });
  }

  stopTyping() {
    if (this.now.state === 'typing') this.put({ state: 'dragging' });
  }

  /** Takes the numbers of the field as the target, and ends the drag there. @param {string} text
   * @returns {boolean} whether they say something here */
  type(text) {
    const parts = text.trim().split(/[\s,;]+/).map(evaluate);
    const target = parts.every((part) => part !== null) ? this.tool?.typed(parts.map(Number)) : null;
    if (!target) return false;
    this.offer(target);
    this.release();
    return true;
  }

  release() {
    const { sender } = this;
    if (!sender || !['dragging', 'typing'].includes(this.now.state)) return;
    const gesture = this.now.number, nail = this.now.hit?.kind !== 'nail' && (this.now.nailing || this.store.state.nailOnRelease);
    this.put({ state: 'settling' });
    this.later(() => {
      if (this.now.state === 'settling' && this.now.number === gesture) this.put({ settlingShown: true });
    }, settlingShownAfter);
    this.end(sender, nail).then(
      (answer) => this.settled(gesture, 'released', answer, nail),
      (error) => {
        if (this.now.number !== gesture) return;
        this.store.set({ gesture: idleGesture, card: null });
        if (sender instanceof PlaceSender) this.connection.send('stop');  // what was tried goes
        if (error.code !== 'lost') this.refused(error);
      },
    );
    this.sender = null;
  }

  /** @param {DragSender | PlaceSender} sender @param {boolean | undefined} nail @returns {Promise<any>} */
  end(sender, nail) {
    if (!(sender instanceof PlaceSender)) return this.connection.request('release', { ...sender.last(), ...(nail ? { nail } : {}) });
    const last = sender.last();
    return last ? this.connection.request('set', last) : this.connection.request('stop');
  }

  /** @param {number} gesture @param {'released' | 'cancelled'} how @param {any} answer @param {boolean} nailed */
  settled(gesture, how, answer, nailed) {
    if (this.now.state === 'settling' && this.now.number === gesture) this.store.set({ gesture: idleGesture });
    this.ended(how, answer, nailed);
  }

  /** Escape, or the right button. @returns {boolean} whether there was something to leave */
  cancel() {
    const { state, number } = this.now;
    if (state === 'typing') {
      this.stopTyping();
    } else if (state === 'pressed') {
      this.store.set({ gesture: idleGesture });
    } else if (state === 'dragging') {
      const asked = this.sender instanceof PlaceSender ? this.connection.request('stop') : this.connection.request('cancel', { gesture: number });
      this.sender = null;
      this.store.set({ gesture: idleGesture, before: null, card: null });
      asked.then((answer) => this.ended('cancelled', answer, false), () => {});
    } else if (state === 'settling') {
      this.connection.send('stop');
    } else {
      return false;
    }
    return true;
  }

  /** A motion of this gesture came. @param {{gesture?: number, seq?: number}} motion */
  answered({ gesture, seq }) {
    if (gesture !== this.now.number || seq === undefined) return;
    this.sender?.answered(seq);
    this.put({ answered: seq, seq: this.sender?.seq ?? this.now.seq });
  }

  /** An error came; where it is that of the last drag, the next may go. @param {number | undefined} re */
  failed(re) {
    if (re && re === this.dragId && this.sender) this.sender.answered(this.sender.seq);
  }

  /** The connection broke. @returns {boolean} whether a gesture was under way */
  lost() {
    const { state } = this.now, was_held = state === 'dragging' || state === 'typing';
    this.sender = null;
    if (state !== 'idle') this.store.set({ gesture: idleGesture, before: null });
    return was_held;
  }
}
