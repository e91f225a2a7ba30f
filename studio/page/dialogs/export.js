// SPDX-License-Identifier: MIT
// Handing on: the motion as a file of another program, which the browser keeps where it keeps downloads.

import { el } from '../dom.js';
import { filmKind, recordFilm } from '../film.js';
import { dialog } from './ask.js';

/** @typedef {import('../types.js').State} State */
/** What is seen, as a PNG or into a canvas. @typedef {{picture: () => Promise<Blob | null>, compose: (canvas: HTMLCanvasElement) => unknown}} Pictures */

/** What the button says, its format, and whether it can show the motion as it was opened. @type {[string, string, boolean][]} */
const formats = [
  ['Page for any browser (.html)', 'html', true], ['Picture with paths (.svg)', 'svg', true], ['glTF for the web, exact in flight (.glb)', 'glb cubic', false], ['glTF for Blender and all others (.glb)', 'glb', false],
  ['Script for Blender (.py)', 'py', false], ['Table (.csv)', 'csv', false],
];
const types = /** @type {Record<string, string>} */ ({ html: 'text/html', svg: 'image/svg+xml', glb: 'model/gltf-binary', py: 'text/x-python', csv: 'text/csv' });

/** The browser keeps it. @param {string} name @param {Blob} blob */
function keep(name, blob) {
  const url = URL.createObjectURL(blob);
  el('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60000);
}

/** @param {import('../store.js').Store<State>} store @param {import('../commands.js').Commands} commands
 * @param {Pictures} pictures */
export async function exportDialog(store, commands, pictures) {
  const { document, motion, opened, bodiesAsOpened } = store.state;
  if (!document?.open) return;
  const film = filmKind(), box = el('input', { type: 'checkbox', checked: bodiesAsOpened && motion !== opened && !!opened, disabled: !bodiesAsOpened }), stem = (document.path ?? document.suggested ?? 'motion').replace(/^.*\//, '').replace(/\.json$/, '');
  const answer = await dialog('Export', [el('div', { class: 'choices' },
    ...formats.map(([words, format]) => el('button', { type: 'button', class: 'row', onclick: (/** @type {Event} */ event) => close(event, format) }, words)),
    el('button', { type: 'button', class: 'row', onclick: (/** @type {Event} */ event) => close(event, 'png') }, 'Picture of the view (.png)'),
    film && el('button', { type: 'button', class: 'row', onclick: (/** @type {Event} */ event) => close(event, 'film') }, `Film of the view (.${film.extension})`)),
  el('label', { class: 'switch' }, box, 'beside the motion as it was opened (.html, .svg)')], (end) => [el('button', { type: 'button', onclick: () => end('') }, 'Cancel')], 'small');
  if (!answer) return;
  if (answer === 'png') {
    const blob = await pictures.picture();
    if (blob) keep(`${stem}.png`, blob);
    return;
  }
  if (answer === 'film' && film) {
    let goes_on = true;
    store.set({ notice: { message: 'The motion is filmed, a frame for each dot.', key: 'film', actions: [{ name: 'Cancel', act: () => void (goes_on = false) }] } });
    const blob = await recordFilm(store, pictures.compose, film.type, () => goes_on);
    store.set({ notice: null });
    if (blob) keep(`${stem}.${film.extension}`, blob);
    return;
  }
  const [format, keys] = answer.split(' ');
  const file = await commands.tell('export', { format, ...(keys ? { keys } : {}), ...(box.checked && formats.some(([, one, compares]) => one === answer && compares) ? { before: true } : {}) });
  if (file) keep(file.name, new Blob([file.bytes], { type: types[format] }));
}

/** @param {Event} event of a button @param {string} format */
const close = (event, format) => /** @type {HTMLElement} */ (event.target).closest('dialog')?.close(format);
