// SPDX-License-Identifier: MIT
// The view with the canvas of marks above it, which draw a state whenever it changes.

import { byId } from './dom.js';
import { Overlay } from './overlay/overlay.js';
import { frameView } from './view/framing.js';
import { View } from './view/view.js';

/** @param {import('./store.js').Store<import('./types.js').State>} store @param {boolean} shadowMap whether high quality may have one
 * @returns {{view: View, overlay: Overlay, frame: (body: number, anew?: boolean, side?: 'front' | 'side' | 'top') => void,
 *    picture: () => Promise<Blob | null>, compose: (canvas: HTMLCanvasElement) => unknown, small: (motion: import('./types.js').Motion, canvas: HTMLCanvasElement) => void}} `frame`: shows a body, -1: everything, from a side where one is named;
 *    `picture`: what is seen, as a PNG; `compose`: the same, into a canvas; `small`: draws another motion, as it would be seen, into a canvas */
export function makeStage(store, shadowMap) {
  const canvas = /** @type {HTMLCanvasElement} */ (byId('overlay'));
  /** @type {Overlay | null} */
  let marks = null;
  const view = new View({ host: byId('view'), input: canvas, store, shadowMap, drawn: () => marks?.draw(), resized: (width, height) => marks?.resize(width, height) });
  const overlay = (marks = new Overlay(canvas, store, view));
  overlay.resize(view.camera.width, view.camera.height);
  store.on(['scene', 'motion', 'opened', 'before', 'showBefore', 'changesShown', 'preview', 'time', 'selected', 'hover', 'tool', 'gesture', 'document', 'selectedNail', 'quality', 'dots', 'facing', 'sketch'], () => view.invalidate());
  const compose = (/** @type {HTMLCanvasElement} */ both) => {
    const layers = [...byId('view').querySelectorAll(':scope > canvas')].map((layer) => /** @type {HTMLCanvasElement} */ (layer)), pen = both.getContext('2d');
    const [width, height] = [Math.max(...layers.map((layer) => layer.width)), Math.max(...layers.map((layer) => layer.height))];
    if (both.width !== width || both.height !== height) [both.width, both.height] = [width, height];
    view.draw();  // what WebGL drew is there until the end of this task
    for (const layer of layers) pen?.drawImage(layer, 0, 0, both.width, both.height);
    return both;
  };
  const picture = () => new Promise((/** @type {(blob: Blob | null) => void} */ done) => compose(document.createElement('canvas')).toBlob(done, 'image/png'));
  const small = (/** @type {import('./types.js').Motion} */ motion, /** @type {HTMLCanvasElement} */ place) =>
    view.drawSmall({ ...store.state, motion, preview: null, before: null, hover: null, time: Math.min(store.state.time, motion.end) }, place);
  return { view, overlay, picture, compose, small, frame: (body, anew = false, side = undefined) => frameView(view, store.state, body, anew, side) };
}
