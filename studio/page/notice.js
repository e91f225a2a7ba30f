// SPDX-License-Identifier: MIT
// One notice at a time, the card that says why a target was not reached, and what screen readers hear of them.

import { byId, el, iconButton } from './dom.js';

/** @typedef {import('./types.js').Notice} Notice */

/** @param {import('./store.js').Store<import('./types.js').State>} store */
export function showNotices(store) {
  const notice = byId('notice'), card = byId('card'), live = byId('live');
  /** @param {HTMLElement} place @param {Notice | null} shown @param {() => void} close */
  const show = (place, shown, close) => {
    place.replaceChildren();
    place.hidden = !shown;
    if (!shown) return;
    place.className = `card ${shown.kind ?? 'plain'}`;
    const buttons = (shown.actions ?? []).map(({ name, act }) => el('button', { type: 'button', onclick: () => {
      act();
      if (name === 'Undo') close();
    } }, name));
    place.append(el('span', {}, shown.message), ...buttons, iconButton('close', 'Close', close));
  };
  store.on(['notice'], (state) => {
    show(notice, state.notice, () => store.set({ notice: null, changesShown: false }));
    if (state.notice) live.textContent = state.notice.message;
  });
  store.on(['card'], (state) => {
    show(card, state.card, () => store.set({ card: null }));
    if (state.card) live.textContent = state.card.message;
  });
}
