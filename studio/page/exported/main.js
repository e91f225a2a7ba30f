// SPDX-License-Identifier: MIT
// The page that `carom export -o motion.html` writes: a motion that is looked at, by the same parts as in the studio, and
// by nothing that is asked for.

import { tableDialog } from '../dialogs/table.js';
import { byId } from '../dom.js';
import { decodeFrame, motionOf, shapesOf } from '../frames.js';
import { drawIcons, icon } from '../icons.js';
import { showReadout } from '../live.js';
import { poseAt } from '../motion.js';
import { forPeople } from '../number_field_text.js';
import { showBodies } from '../panels/bodies.js';
import { PlayHead } from '../play_head.js';
import { showPlayer } from '../player.js';
import { makeStage } from '../stage.js';
import { speak } from '../speech.js';
import { initialState, Store } from '../store.js';
import { TimeLine } from '../timeline.js';
import { isHardware, qualityFor, rendererName } from '../view/quality.js';
import { keysDialog, listen } from './look.js';
import { showNailsHeld, showValues } from './values.js';

/** @typedef {import('../types.js').State} State */
/** @typedef {import('../store.js').Store<State>} PageStore */

/** @param {{state: import('../types.js').DocumentState, scene: ArrayBuffer, motion: ArrayBuffer, before: ArrayBuffer | ''}} given
 *    as carom wrote them into the file */
export function show({ state: document, scene, motion: bytes, before: bytes_before }) {
  drawIcons(globalThis.document);
  byId('loading').hidden = true;
  const query = new URLSearchParams(location.search), renderer = rendererName();
  byId('blocked').hidden = !!renderer;
  if (!renderer) return;
  const motion = motionOf(decodeFrame(bytes), null), before = bytes_before ? motionOf(decodeFrame(bytes_before), null) : null;
  /** @type {State} */
  const state = {
    ...initialState(), looking: true, connected: 'open', quality: qualityFor(renderer, query.get('quality')), document, scene: shapesOf(decodeFrame(scene), null),
    motion, opened: before ?? motion, showBefore: before ? 'opened' : 'none',
  };
  const store = new Store(state);
  const { view, overlay, frame } = makeStage(store, isHardware(renderer) || query.get('shadows') === 'map'), head = new PlayHead(store);
  showBodies(store, { locks: false });
  showValues(document, !!before);
  showNailsHeld(store, head);
  showReadout(store);
  speak(store);
  showPlayer(store, head);
  showLayout(store, before);
  byId('table').addEventListener('click', () => void tableDialog(store));
  byId('help').addEventListener('click', () => void keysDialog(!!before));
  new TimeLine(/** @type {HTMLCanvasElement} */ (byId('timeline')), store, head);
  listen({ store, head, overlay, view, frame, compared: !!before });
  frame(-1, true);
  if (query.has('test')) Object.assign(globalThis, { carom: { store, view, overlay, poseAt: (/** @type {number} */ body, /** @type {number} */ time) => poseAt(motion.tracks[body], time) } });
}

/** @param {PageStore} store @param {State['motion']} before */
function showLayout(store, before) {
  const fold = byId('fold'), compare = byId('before'), { motion, document: shown } = store.state;
  const early = !!motion && !!shown && motion.end < shown.duration - 1e-9;
  byId('ended').hidden = !early;
  byId('ended').textContent = byId('ended').title = early ? forPeople(motion.message || `The motion ends at ${motion.end.toFixed(3)} s.`) : '';
  compare.hidden = !before;
  compare.addEventListener('click', () => store.set({ showBefore: store.state.showBefore === 'opened' ? 'none' : 'opened' }));
  store.on(['showBefore'], ({ showBefore }) => compare.setAttribute('aria-pressed', String(showBefore === 'opened')));
  store.on(['panel'], ({ panel }) => {
    document.body.classList.toggle('folded', !panel);
    fold.setAttribute('aria-expanded', String(panel));
    fold.setAttribute('aria-label', panel ? 'Fold the panel' : 'Unfold the panel');
    fold.replaceChildren(icon(panel ? 'unfolded' : 'folded'));
  });
  fold.addEventListener('click', () => store.set({ panel: !store.state.panel }));
}
