// SPDX-License-Identifier: MIT
// For tests, behind ?test alone: where things are on the screen, and counts of what was drawn and heard.

import { centreAt, poseAt } from './motion.js';

/** Calls when what was asked to be drawn has been: the work is in another process. @param {WebGL2RenderingContext} gl
 * @param {() => void} act */
function whenDone(gl, act) {
  const sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (!sync) throw new Error('the drawing context was lost');
  gl.flush();
  const look = () => {
    if (gl.getSyncParameter(sync, gl.SYNC_STATUS) !== gl.SIGNALED) return void setTimeout(look, 1);
    gl.deleteSync(sync);
    act();
  };
  setTimeout(look, 1);
}

/** @param {{store: import('./store.js').Store<import('./types.js').State>, view: import('./view/view.js').View,
 *    overlay: import('./overlay/overlay.js').Overlay, timeline: import('./timeline.js').TimeLine, connection: import('./connection.js').Connection,
 *    gesture: import('./gesture.js').Gesture}} parts */
export function addTestHooks({ store, view, overlay, timeline, connection, gesture }) {
  /** @type {{decoded: number[], drawn: number[]}} ms from a move of the mouse in a drag to its motion and its frame */
  const latency = { decoded: [], drawn: [] };
  /** @type {{frames: number[], motions: {time: number, seq: number, reached: boolean}[]}} when drawn and when heard, ms */
  const log = { frames: [], motions: [] };
  /** @type {{moved: number, seq: number, decoded: boolean}[]} moves whose frame has not been drawn */
  let moves = [];
  let stamp = 0;
  for (const kind of ['pointermove', 'pointerrawupdate']) overlay.canvas.addEventListener(kind, (event) => (stamp = event.timeStamp), { capture: true });
  const offer = gesture.offer.bind(gesture);
  gesture.offer = (target, snapOn) => {
    offer(target, snapOn);
    const { sender } = gesture;
    if (stamp && sender) moves.push({ moved: stamp, seq: sender.seq + (sender.waiting ? 1 : 0), decoded: false });
    stamp = 0;
  };
  store.on(['motion'], ({ motion }) => {
    const now = performance.now(), seq = motion?.seq ?? -1;
    log.motions.push({ time: now, seq, reached: motion?.reached ?? true });
    for (const move of moves) {
      if (move.decoded || seq < move.seq) continue;
      move.decoded = true;
      latency.decoded.push(now - move.moved);
    }
  });
  store.on(['gesture'], ({ gesture: now }) => {
    if (now.state === 'idle') moves = [];
  });
  const drawn = view.drawn;
  view.drawn = () => {
    drawn();
    const shown = moves.filter((move) => move.decoded);
    if (shown.length) {
      moves = moves.filter((move) => !move.decoded);
      whenDone(/** @type {WebGL2RenderingContext} */ (view.renderer.getContext()), () => {
        for (const { moved } of shown) latency.drawn.push(performance.now() - moved);
      });
    }
    log.frames.push(performance.now());
  };
  Object.assign(globalThis, { carom: {
    store, view, gesture, latency, log, connection, poseAt,
    invalidate: () => view.invalidate(),
    shaders: () => view.renderer.info.programs?.map((program) => /** @type {any} */ (program).id) ?? [],
    frames: () => view.frames,
    gliding: () => view.glide.from !== null,
    received: () => connection.received,
    /** On the page, px. @param {import('./types.js').Vec3} point */
    screenOf: (point) => {
      const box = overlay.canvas.getBoundingClientRect(), [x, y] = view.camera.project(point);
      return [box.left + x, box.top + y];
    },
    /** Whether something that stands still is before it. @param {import('./types.js').Vec3} point */
    hidden: (point) => view.hidden.hides(store.state.scene, point),
    lanes: () => timeline.seen.map(({ body }) => body),
    shownBodies: () => view.paths.shownBodies(store.state),
    /** m a pixel has there. @param {import('./types.js').Vec3} point */
    perPixel: (point) => view.camera.axes().perPixel(point),
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
