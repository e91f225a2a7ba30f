// SPDX-License-Identifier: MIT
// One notice at a time, the card that says why a target was not reached, and what screen readers hear of them.

import { byId, el, iconButton } from './dom.js';
import { forPeople } from './number_field_text.js';
import { say } from './speech.js';

/** @typedef {import('./types.js').Notice} Notice */

/** ms, until what is no warning fades; with a button to press longer. */
const fades = 6000, fadesWithButtons = 15000;

/** So many remedies are offered; of those that do not reach it alone fewer. */
const mostRemedies = 4, mostOthers = 3;

/** @param {import('./store.js').Store<import('./types.js').State>} store @param {{takeRemedy: (name: string) => void}} commands */
export function showNotices(store, commands) {
  const notice = byId('notice'), card = byId('card');
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
    if (state.notice) say(forPeople(state.notice.message));
  });
  /** The answers come one by one: what was said is not said again. */
  let said = '';
  store.on(['card'], (state) => {
    const focused = document.activeElement?.getAttribute('data-remedy');
    show(card, state.card, () => store.set({ card: null }));
    const remedies = offered(state.card);
    if (state.card && (remedies.length || state.card.searching)) {
      card.append(el('div', { class: 'remedies' }, ...remedies.map((remedy) => remedyButton(remedy, commands.takeRemedy)),
        !!state.card.searching && el('span', { class: 'dim' }, 'Looking for what would help…')));
      if (focused) /** @type {HTMLElement | null} */ (card.querySelector(`[data-remedy="${CSS.escape(focused)}"]`))?.focus();
    }
    const solving = remedies.filter(({ solves }) => solves).map(({ name }) => `${forPeople(name)} reaches it.`);
    const words = state.card ? [forPeople(state.card.message), ...(state.card.searching ? [] : solving)].join(' ') : '';
    if (words !== said) say(words);
    said = words;
  });
}

/** @param {Notice | null} card @returns {import('./types.js').Remedy[]} those that reach it, or those that may */
function offered(card) {
  const all = card?.remedies ?? [], open = all.filter(({ solves }) => solves !== false);
  return open.length ? open.slice(0, mostRemedies) : all.slice(0, mostOthers);
}

/** @param {import('./types.js').Remedy} remedy @param {(name: string) => void} take */
function remedyButton({ name, solves }, take) {
  const [words, kind] = solves ? ['reaches it', 'good'] : solves === null ? ['…', 'dim'] : ['not enough alone', 'dim'];
  return el('button', { type: 'button', 'data-remedy': name, onclick: () => take(name) }, forPeople(name), el('span', { class: kind }, words));
}
