// SPDX-License-Identifier: MIT
// What belongs to the whole scene: its duration, gravity, and the materials.

import { byId, el } from '../dom.js';
import { numberField } from '../number_field.js';

/** @typedef {import('../commands.js').Commands} Commands */
/** @typedef {import('../number_field.js').NumberField} NumberField */

/** m/s^2, of gravity that is switched on. */
const earth = [0, 0, -9.81];

/** A part of a JSON pointer. @param {string} name */
export const tokenOf = (name) => name.replaceAll('~', '~0').replaceAll('/', '~1');

/** A name that no material has. @param {{name: string}[]} materials */
export function newMaterial(materials) {
  for (let n = 1; ; ++n) {
    const name = n === 1 ? 'material' : `material ${n}`;
    if (!materials.some((one) => one.name === name)) return name;
  }
}

/** @param {import('../store.js').Store<import('../types.js').State>} store @param {Commands} commands */
export function showScene(store, commands) {
  const place = byId('scene'), section = byId('scene-section');
  let structure = '';
  /** @type {(() => void)[]} */
  let updates = [];
  const now = () => ({ duration: store.state.document?.duration ?? 1, gravity: [...(store.state.motion?.gravity ?? [0, 0, 0])], materials: store.state.document?.materials ?? [] });
  /** @param {string} name @param {() => number} value @param {number} scale @param {(value: number) => void} act */
  const field = (name, value, scale, act) => {
    const one = numberField({ name, value: value(), scale, act });
    updates.push(() => one.show(value()));
    return one.field;
  };
  const row = (/** @type {string} */ name, /** @type {HTMLElement[]} */ ...fields) => el('div', { class: 'body-row' }, el('span', { class: 'dim' }, name), el('div', { class: 'body-fields' }, ...fields));

  const gravityRows = () => {
    const on = el('input', { type: 'checkbox', onchange: () => void commands.setValue('/gravity', on.checked ? earth : [0, 0, 0]) });
    updates.push(() => (on.checked = now().gravity.some((g) => g !== 0)));
    const fields = [0, 1, 2].map((k) => field(`gravity, ${'xyz'[k]}`, () => now().gravity[k], 1, (g) => void commands.setValue('/gravity', now().gravity.map((one, j) => (j === k ? g : one)))));
    return [row('gravity, m/s²', ...fields), el('label', { class: 'switch' }, on, 'gravity')];
  };
  /** @param {string} name */
  const materialRow = (name) => {
    const of = (/** @type {'elasticity' | 'friction'} */ word) => field(`${word} of ${name}`, () => now().materials.find((one) => one.name === name)?.[word] ?? 0, 0.1,
      (value) => void commands.setValue(`/materials/${tokenOf(name)}/${word}`, value));
    return el('div', { class: 'material' }, el('span', { class: 'cut', title: name }, name), of('elasticity'), of('friction'));
  };
  const add = () => {
    const { materials } = now(), name = newMaterial(materials), value = { elasticity: 0.5, friction: 0.4 };
    void (materials.length ? commands.setValue(`/materials/${name}`, value) : commands.setValue('/materials', { [name]: value }));
  };

  store.on(['document', 'motion'], ({ document }) => {
    section.hidden = !document?.open;
    if (!document?.open) return void (structure = '');
    const { materials } = now(), next = JSON.stringify(materials.map(({ name }) => name));
    if (next !== structure) {
      structure = next;
      updates = [];
      const heads = materials.length ? [el('div', { class: 'material dim' }, el('span', {}, 'materials'), el('span', {}, 'elasticity'), el('span', {}, 'friction'))] : [];
      place.replaceChildren(row('duration, s', field('duration', () => now().duration, 1, (value) => void commands.setValue('/duration', value))), ...gravityRows(),
        ...heads, ...materials.map(({ name }) => materialRow(name)), el('div', { class: 'body-buttons' }, el('button', { type: 'button', onclick: add }, 'Add a material')));
    }
    for (const update of updates) update();
  });
}
