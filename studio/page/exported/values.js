// SPDX-License-Identifier: MIT
// What may change, and what nails hold, to be read: before and now where there is a motion before.

import { byId, el } from '../dom.js';
import { shortNumber } from '../number_field_text.js';
import { atText } from '../overlay/hoops.js';
import { standingOf } from '../panels/nails.js';
import { controlName } from '../panels/numbers.js';

/** @typedef {import('../types.js').DocumentState} DocumentState */

/** @param {DocumentState} document @param {boolean} compared with a motion before */
export function showValues({ controls, numbers }, compared) {
  const row = (/** @type {import('../types.js').NumberState} */ { component, opened, now, scale }) => {
    const changed = compared && opened !== null && Math.abs(now - opened) > 1e-9 * Math.max(1, Math.abs(opened));
    return el('div', { class: 'number-row' }, el('span', { class: 'component' }, component),
      el('span', { class: 'opened dim' }, compared && opened !== null ? shortNumber(opened, scale) : ''), el('span', { class: 'dim', 'aria-hidden': 'true' }, compared ? '→' : ''),
      el('span', { class: changed ? 'value changed' : 'value' }, shortNumber(now, scale)));
  };
  byId('values').hidden = controls.length === 0;
  byId('values').querySelector('summary .dim')?.toggleAttribute('hidden', !compared);
  byId('numbers').replaceChildren(...controls.map((control, i) => el('section', { class: 'control', 'aria-label': controlName(control) },
    el('div', { class: 'control-head' }, el('span', { class: 'cut grow' }, controlName(control))), ...numbers.filter((one) => one.control === i).map(row))));
}

/** @param {import('../store.js').Store<import('../types.js').State>} store @param {import('../play_head.js').PlayHead} head */
export function showNailsHeld(store, head) {
  const { document } = store.state, nails = document?.nails ?? [];
  byId('held').hidden = nails.length === 0;
  store.on(['selectedNail'], ({ selectedNail }) => byId('nails').replaceChildren(...nails.map((nail) => {
    const title = `${nail.constraint.body}, ${atText(nail.constraint.at)}`, [kind, words] = standingOf(nail);
    return el('li', { class: 'nail' }, el('div', { class: 'nail-head' }, el('button', { type: 'button', class: 'row name', title, 'aria-pressed': nail.id === selectedNail, onclick: () => {
      store.set({ selectedNail: nail.id, selected: document?.bodies.findIndex((body) => body.name === nail.constraint.body) ?? -1 });
      if (nail.time !== null) head.seek(nail.time);
    } }, el('span', { class: `hoop ${kind}`, 'aria-hidden': 'true' }), el('span', { class: 'cut grow' }, title)), el('span', { class: `standing ${kind}`, title: words }, words)));
  })));
}
