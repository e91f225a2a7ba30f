// SPDX-License-Identifier: MIT
// For tests, behind ?test alone: where things are on the screen, and counts of what was drawn and heard.

import { centreAt } from './motion.js';

/** @param {{store: import('./store.js').Store<import('./types.js').State>, view: import('./view/view.js').View,
 *    overlay: import('./overlay/overlay.js').Overlay, connection: import('./connection.js').Connection,
 *    gesture: import('./gesture.js').Gesture}} parts */
export function addTestHooks({ store, view, overlay, connection, gesture }) {
  /** @type {{decoded: number[], drawn: number[]}} ms from a move of the mouse in a drag to its motion and its frame */
  const latency = { decoded: [], drawn: [] };
  let moved = 0, waiting = 0, undrawn = false;
  overlay.canvas.addEventListener('pointermove', (event) => {
    if (store.state.gesture.state === 'dragging' && !waiting) {
      moved = event.timeStamp;
      waiting = gesture.sender?.seq ?? 0;
    }
  });
  store.on(['motion'], ({ motion }) => {
    if (!waiting || !motion || motion.seq === undefined || motion.seq < waiting) return;
    latency.decoded.push(performance.now() - moved);
    undrawn = true;
  });
  const drawn = view.drawn;
  view.drawn = () => {
    drawn();
    if (!undrawn) return;
    const gl = view.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));  // the work is in another process: wait for it
    latency.drawn.push(performance.now() - moved);
    [undrawn, waiting] = [false, 0];
  };
  Object.assign(globalThis, { carom: {
    store, gesture, latency, connection,
    frames: () => view.frames,
    gliding: () => view.glide.from !== null,
    received: () => connection.received,
    /** On the page, px. @param {import('./types.js').Vec3} point */
    screenOf: (point) => {
      const box = overlay.canvas.getBoundingClientRect(), [x, y] = view.camera.project(point);
      return [box.left + x, box.top + y];
    },
    /** @param {string} name @param {number} time s */
    bodyOnScreen: (name, time) => {
      const body = store.state.document?.bodies.findIndex((one) => one.name === name) ?? -1, track = store.state.motion?.tracks[body];
      if (!track) throw new Error(`no body '${name}'`);
      const box = overlay.canvas.getBoundingClientRect(), [x, y] = view.camera.project(centreAt(track, time));
      return [box.left + x, box.top + y];
    },
    /** Of the motion before. @param {number} body @param {number} time s */
    beforeOnScreen: (body, time) => {
      const track = store.state.before?.tracks[body], box = overlay.canvas.getBoundingClientRect();
      if (!track) throw new Error('no motion before');
      const [x, y] = view.camera.project(centreAt(track, time));
      return [box.left + x, box.top + y];
    },
    /** The colour drawn there by the scene, [r, g, b]. @param {number} x @param {number} y px of the page */
    inkAt: (x, y) => {
      const box = overlay.canvas.getBoundingClientRect(), gl = view.renderer.getContext(), bytes = new Uint8Array(4), ratio = view.renderer.getPixelRatio();
      view.draw();
      gl.readPixels(Math.round((x - box.left) * ratio), Math.round((box.bottom - y) * ratio), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
      return [...bytes.subarray(0, 3)];
    },
    redraw: () => {
      const began = performance.now(), gl = view.renderer.getContext();
      view.draw();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      return performance.now() - began;
    },
  } });
}
