// SPDX-License-Identifier: MIT
// One notice at a time, the card that says why a target was not reached, and what screen readers hear of them.

import { byId, el, iconButton } from './dom.js';
import { forPeople } from './number_field_text.js';

/** @typedef {import('./types.js').Notice} Notice */

/** ms, until what is no warning fades; with a button to press longer. */
const fades = 6000, fadesWithButtons = 15000;

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
    place.append(el('span', {}, forPeople(shown.message)), ...buttons, iconButton('close', 'Close', close));
  };
  const close = () => store.set({ notice: null, changesShown: false });
  /** What says that something went wrong stays until it is read; what is looked at or pointed at, too. */
  const fade = () => {
    const shown = store.state.notice;
    if (!shown || (shown.kind ?? 'plain') !== 'plain') return;
    if (notice.matches(':hover, :focus-within') || store.state.changesShown || store.state.noticesStay) timer = setTimeout(fade, 1000);
    else close();
  };
  let timer = /** @type {ReturnType<typeof setTimeout> | undefined} */ (undefined);
  store.on(['notice'], (state) => {
    show(notice, state.notice, close);
    clearTimeout(timer);
    if (state.notice) timer = setTimeout(fade, state.notice.actions?.length ? fadesWithButtons : fades);
    if (state.notice) live.textContent = forPeople(state.notice.message);
  });
  store.on(['card'], (state) => {
    show(card, state.card, () => store.set({ card: null }));
    if (state.card) live.textContent = forPeople(state.card.message);
  });
}
