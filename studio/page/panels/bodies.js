// SPDX-License-Identifier: MIT
// The list of bodies: choosing one, locking one.

import { byId, el, iconButton } from '../dom.js';
import { colours } from '../colours.js';

/** More than are seen at a glance are searched. */
const many = 12;

/** @param {import('../store.js').Store<import('../types.js').State>} store @param {{locks?: boolean}} options whether bodies can be locked */
export function showBodies(store, { locks = true } = {}) {
  const list = byId('bodies'), search = /** @type {HTMLInputElement} */ (byId('body-search'));
  search.addEventListener('input', () => show(store.state));
  const show = (/** @type {import('../types.js').State} */ { document, scene, selected, locked }) => {
    const focused = globalThis.document.activeElement?.getAttribute('data-key');
    search.hidden = (document?.bodies.length ?? 0) <= many;
    if (search.hidden) search.value = '';
    list.classList.toggle('many', !search.hidden);
    const wanted = search.value.trim().toLowerCase();
    const found = (document?.bodies ?? []).map((body, i) => ({ ...body, i })).filter(({ name }) => name.toLowerCase().includes(wanted));
    list.replaceChildren(...found.map(({ name, fixed, i }) => {
      const swatch = el('span', { class: fixed ? 'swatch fixed' : 'swatch', 'aria-hidden': 'true' });
      swatch.style.setProperty('--colour', fixed ? colours.fixed : (scene?.shapes[i]?.colour ?? colours.fixed));
      const choose = el('button', {
        type: 'button', class: 'row name', 'aria-pressed': i === selected, 'data-key': `body ${i}`,
        onclick: () => store.set({ selected: i === selected ? -1 : i, selectedNail: -1 }),
      }, swatch, el('span', { class: 'cut' }, name), fixed && el('span', { class: 'dim' }, 'fixed'));
      const is_locked = locked.has(name);
      const lock = fixed || !locks ? null : iconButton(is_locked ? 'locked' : 'unlocked', is_locked ? `Unlock ${name}` : `Lock ${name}`, () => {
        const next = new Set(locked);
        if (!next.delete(name)) next.add(name);
        store.set({ locked: next });
      }, { 'aria-pressed': is_locked, 'data-key': `lock ${i}` });
      return el('li', {}, choose, lock);
    }));
    const again = focused && /** @type {HTMLElement | null} */ (list.querySelector(`[data-key="${CSS.escape(focused)}"]`));
    if (again) again.focus();
  };
  store.on(['document', 'scene', 'selected', 'locked'], show);
}
