// SPDX-License-Identifier: MIT
// The pen: a curve that is drawn from a body, or its path, on. The path is to go along it as near as may be.

import { centreAt, velocityAt } from './motion.js';
import { refusal } from './take.js';
import { dot, inPlane } from './tools/move.js';

/** @typedef {import('./types.js').State} State */
/** @typedef {import('./types.js').Vec3} Vec3 */

const spacing = 4, leastPixels = 16, most = 2000;
/** Of the view across the upright plane of the path, from which on that is drawn in. */
const leastAcross = 0.35;

/** The normal of the plane that is drawn in: the upright one along the way that the body goes, where it is not seen edge-on; else that of
 * the view. @param {Vec3} view @param {Vec3} velocity @returns {Vec3} */
export function planeOf(view, velocity) {
  const flat = Math.hypot(velocity[0], velocity[1]);
  if (flat < 1e-6) return view;
  /** @type {Vec3} */
  const normal = [velocity[1] / flat, -velocity[0] / flat, 0];
  return Math.abs(dot(normal, view)) >= leastAcross ? normal : view;
}

export class Sketching {
  /** @param {{store: import('./store.js').Store<State>, overlay: import('./overlay/overlay.js').Overlay, view: import('./view/view.js').View,
   *    commands: import('./commands.js').Commands}} parts */
  constructor({ store, overlay, view, commands }) {
    this.store = store;
    this.overlay = overlay;
    this.view = view;
    this.commands = commands;
    /** @type {Vec3} */
    this.normal = [0, 1, 0];
    this.last = [0, 0];
    this.drawing = false;
    this.length = 0;  // px
    store.on(['sketch', 'tool'], (state) => this.tell(state));
  }

  /** @param {State} state */
  tell({ sketch, tool, document, notice }) {
    const name = sketch && `'${document?.bodies[sketch.body]?.name}'`;
    const message = sketch?.searching ? `Looking for a path of ${name} along the curve. Esc drops it.`
      : sketch ? '' : tool === 'pen' ? 'Press a body or its path, and draw where it is to go.' : '';
    if (!message) return notice?.key === 'sketch' ? this.store.set({ notice: null }) : undefined;
    if (notice?.message !== message && (!notice || notice.key === 'sketch' || sketch)) this.store.set({ notice: { message, key: 'sketch' } });
  }

  /** @param {number} x @param {number} y px @returns {boolean} whether the press is meant for this */
  press(x, y) {
    const { state } = this.store;
    if (state.tool !== 'pen' || state.gesture.state !== 'idle') return false;
    if (state.sketch) return true;
    const hit = this.overlay.under(x, y), track = hit && state.motion?.tracks[hit.body];
    if (!hit || !track || hit.kind === 'handle' || hit.kind === 'nail') return false;
    const why_not = refusal(state, hit);
    if (why_not) return this.store.set({ notice: { message: why_not } }), true;
    const from = Math.min(hit.time, state.motion?.end ?? 0), place = centreAt(track, from);
    this.normal = planeOf(this.view.camera.axes().view, velocityAt(track, from));
    this.last = [x, y];
    this.length = 0;
    this.drawing = true;
    this.store.set({ selected: hit.body, playing: false, hover: null, card: null, sketch: { body: hit.body, from, places: [place], searching: false } });
    return true;
  }

  /** @param {number} x @param {number} y px @returns {boolean} whether the pointer is busy with this */
  move(x, y) {
    const { sketch } = this.store.state, far = Math.hypot(x - this.last[0], y - this.last[1]);
    if (!this.drawing || !sketch) return false;
    const place = far >= spacing && sketch.places.length < most && inPlane(this.view.camera.ray(x, y), sketch.places[0], this.normal);
    if (!place) return true;
    this.last = [x, y];
    this.length += far;
    this.store.set({ sketch: { ...sketch, places: [...sketch.places, place] } });
    return true;
  }

  /** @param {number} x @param {number} y px */
  up(x, y) {
    if (!this.drawing) return;
    this.move(x, y);
    this.drawing = false;
    if (this.length >= leastPixels) void this.commands.sketchPath();
    else this.store.set({ sketch: null });
  }

  /** Escape. @returns {boolean} whether there was something to leave */
  cancel() {
    const { sketch } = this.store.state;
    if (!sketch) return false;
    if (sketch.searching) this.commands.connection.send('stop');
    else this.store.set({ sketch: null });
    this.drawing = false;
    return true;
  }
}
