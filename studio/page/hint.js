// SPDX-License-Identifier: MIT
// What a person who is here for the first time has to know: one gesture. Gone with the first drag.

import { byId } from './dom.js';

/** @param {import('./store.js').Store<import('./types.js').State>} store */
export function showHint(store) {
  const hint = byId('hint');
  let known = localStorage.getItem('carom dragged') !== null;
  store.on(['motion', 'gesture', 'notice', 'selected', 'connected'], ({ motion, gesture, notice, selected, connected }) => {
    if (gesture.state === 'dragging' && !known) {
      known = true;
      localStorage.setItem('carom dragged', 'yes');
    }
    hint.hidden = known || !motion || !!notice || selected >= 0 || connected !== 'open';
  });
}
