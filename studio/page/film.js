// SPDX-License-Identifier: MIT
// The motion as a film of the view, by the browser's own encoder. It records what goes by; between frames it is paused, so that
// what goes on meanwhile takes no time of the film.

/** What the browser can write, the best first. */
const kinds = [['video/webm;codecs=vp9', 'webm'], ['video/webm;codecs=vp8', 'webm'], ['video/mp4', 'mp4']];
const bitsPerSecond = 8e6;

/** @returns {{type: string, extension: string} | null} null: it has no encoder */
export function filmKind() {
  const found = kinds.find(([type]) => globalThis.MediaRecorder?.isTypeSupported(type));
  return found ? { type: found[0], extension: found[1] } : null;
}

/** From the start to the end, a frame for each dot of the paths. The time that is shown goes along, and back in the end.
 * @param {import('./store.js').Store<import('./types.js').State>} store @param {(canvas: HTMLCanvasElement) => void} draw what is seen now
 * @param {string} type of filmKind @param {() => boolean} goesOn asked before each frame; false ends it
 * @returns {Promise<Blob | null>} null: it was ended */
export async function recordFilm(store, draw, type, goesOn) {
  const { motion, dots, time } = store.state;
  if (!motion) return null;
  const rate = dots || 24, count = Math.floor(motion.end * rate + 1e-6) + 1, canvas = document.createElement('canvas');
  const show = (/** @type {number} */ t) => (store.set({ time: Math.min(t, motion.end), playing: false, hover: null }), draw(canvas));
  show(0);
  const track = /** @type {CanvasCaptureMediaStreamTrack} */ (canvas.captureStream(0).getVideoTracks()[0]);
  const recorder = new MediaRecorder(new MediaStream([track]), { mimeType: type, videoBitsPerSecond: bitsPerSecond });
  /** @type {Blob[]} */
  const parts = [];
  recorder.ondataavailable = ({ data }) => data.size && parts.push(data);
  const ended = new Promise((done) => (recorder.onstop = done));
  recorder.start();
  recorder.pause();
  let whole = true;
  for (let k = 0; k < count && whole; ++k) {
    whole = goesOn() && store.state.motion === motion;
    recorder.resume();
    const began = performance.now();
    track.requestFrame();
    show(k / rate);
    await new Promise((done) => setTimeout(done, Math.max(0, 1000 / rate - (performance.now() - began))));
    recorder.pause();
  }
  recorder.stop();
  await ended;
  track.stop();
  store.set({ time: Math.min(time, store.state.motion?.end ?? 0) });
  return whole && parts.length ? new Blob(parts, { type: type.split(';')[0] }) : null;
}
