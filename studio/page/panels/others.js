// SPDX-License-Identifier: MIT
// Other motions that meet the same, as a strip of small views: pointing at one shows its paths, a press takes it.

import { byId, el, iconButton } from '../dom.js';
import { forPeople } from '../number_field_text.js';
import { say } from '../speech.js';

/** @typedef {import('../types.js').State} State */
/** @typedef {import('../types.js').Other} Other */

/** px, of a small view: six are to be side by side. */
const widest = 132, narrowest = 104;

/** @param {import('../store.js').Store<State>} store @param {import('../commands.js').Commands} commands
 * @param {(motion: import('../types.js').Motion, canvas: HTMLCanvasElement) => void} draw */
export function showOthers(store, commands, draw) {
  const place = byId('others'), find = /** @type {HTMLButtonElement} */ (byId('find-others'));
  /** @type {Map<import('../types.js').Motion, HTMLCanvasElement>} drawn, or to be drawn next */
  let pictures = new Map(), said = '';
  find.onclick = () => void commands.findOthers();
  const keep = byId('keep-sequence'), keeps = /** @type {HTMLInputElement} */ (keep.querySelector('input'));
  keeps.onchange = () => void commands.tell('keep_sequence', { on: keeps.checked });
  store.on(['document'], ({ document: shown }) => {
    keep.hidden = find.hidden = !shown?.open || !shown.controls.length;
    keeps.checked = !!shown?.keep_sequence;
  });
  // what they meet is no longer what is asked for
  store.on(['document', 'gesture'], ({ others, document: shown, gesture }) => {
    if (!others || others.taking) return;
    if (gesture.state === 'dragging' || (shown && shown.rev > others.rev)) store.set({ others: null, preview: null });
  });

  const close = () => store.set({ others: null, preview: null });
  store.on(['others'], ({ others }) => {
    place.hidden = !others;
    const focused = document.activeElement?.getAttribute('data-other');
    place.replaceChildren();
    if (!others) return void (pictures = new Map());
    const words = others.searching ? 'Looking for other solutions…' : others.list.length
      ? `${others.list.length} other ${others.list.length === 1 ? 'solution' : 'solutions'}` : forPeople(others.message);
    place.append(el('div', { class: 'head' }, el('span', { class: others.searching ? 'dim grow' : 'grow' }, words),
      iconButton('close', 'Close the other solutions', close)), ...(others.list.length ? [el('div', { class: 'strip' }, ...others.list.map((other) => card(other, others.taken)))] : []));
    if (focused) /** @type {HTMLElement | null} */ (place.querySelector(`[data-other="${focused}"]`))?.focus();
    if (!others.searching && words !== said) say(said = words);
    if (others.searching) said = '';
  });

  /** @param {Other} other @param {number} taken */
  function card({ index, motion, size, impacts }, taken) {
    const width = Math.max(narrowest, Math.min(widest, Math.floor(byId('view').clientWidth / 6) - 24));
    const known = pictures.get(motion), canvas = known ?? el('canvas', { width, height: 80 });
    if (!known) {
      pictures.set(motion, canvas);
      drawNext();
    }
    const change = size === null ? '' : size < 1.005 ? 'smallest change' : `${size < 9.95 ? size.toFixed(1) : Math.round(size)}× the change`;
    const name = [`Solution ${index + 1}`, change, ...impacts.map(forPeople)].filter(Boolean).join('. ');
    const point = (/** @type {boolean} */ on) => () => store.set({ preview: on ? motion : null });
    return el('button', { type: 'button', 'data-other': index, 'aria-label': name, title: [change, ...impacts.map(forPeople)].filter(Boolean).join('\n'), 'aria-pressed': index === taken,
      onclick: () => void commands.takeOther(index), onpointerenter: point(true), onpointerleave: point(false), onfocus: point(true), onblur: point(false) },
    canvas, el('span', {}, change || `solution ${index + 1}`), el('span', { class: 'dim' }, impacts.length ? 'other impacts' : 'the same impacts'));
  }

  /** One a frame, so that nothing waits for them. */
  let drawing = false;
  function drawNext() {
    if (drawing) return;
    drawing = true;
    requestAnimationFrame(() => {
      drawing = false;
      const next = [...pictures].find(([, canvas]) => !canvas.dataset.drawn);
      if (!next) return;
      draw(...next);
      next[1].dataset.drawn = 'yes';
      drawNext();
    });
  }
}
