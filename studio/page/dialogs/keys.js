// SPDX-License-Identifier: MIT
// The sheet of keys.

import { el } from '../dom.js';
import { keyTable } from '../keys.js';
import { dialog } from './ask.js';

const mouse = [
  ['press a path and drag', 'takes the body there and then'], ['press an impact and drag', 'holds the body at that impact, whenever it comes'],
  ['press beside it and drag', 'orbits'], ['right button, or Shift', 'pans; in a drag: cancels'], ['wheel', 'zooms, in the view and in the time line'], ['Shift and drag in the time line', 'the range that loops; Shift and click: all'], ['a digit in a drag', 'types the target'],
];

/** @param {import('../store.js').Store<import('../types.js').State>} store */
export async function keysDialog(store) {
  const table = el('table', { class: 'keys' });
  const draw = () => {
    const map = store.state.keymap;
    table.replaceChildren(el('tbody', {},
      ...keyTable.map((row) => el('tr', {}, el('th', { scope: 'row' }, row.name), el('td', {}, ...row[map].flatMap((key) => [el('kbd', {}, keyText(key)), ' '])))),
      ...mouse.map(([does, what]) => el('tr', {}, el('th', { scope: 'row' }, does), el('td', {}, what)))));
  };
  const styles = /** @type {const} */ (['blender', 'maya']).map((map) => el('label', { class: 'switch' },
    el('input', { type: 'radio', name: 'keymap', checked: store.state.keymap === map, onchange: () => {
      store.set({ keymap: map });
      draw();
    } }), map === 'blender' ? 'Blender-like' : 'Maya-like'));
  draw();
  await dialog('Keys', [el('div', { class: 'switches' }, ...styles), el('div', { class: 'scrolls', tabIndex: 0, role: 'region', 'aria-label': 'Keys' }, table)],
    (close) => [el('button', { type: 'button', class: 'primary', onclick: () => close('') }, 'Close')]);
}

/** @param {string} key */
function keyText(key) {
  return key.replace('Arrow', '').replace('Left', '←').replace('Right', '→').replace('Up', '↑').replace('Down', '↓').replace('Escape', 'Esc');
}
