// SPDX-License-Identifier: MIT
// The selected body as the document has it: its name, place, throw, size and mass, each to be typed; its copy, its removal.

import { byId, el } from '../dom.js';
import { facesOf } from '../faces.js';
import { lyingOn } from '../motion.js';
import { numberField } from '../number_field.js';

/** @typedef {import('../types.js').BodyState} BodyState */
/** @typedef {import('../commands.js').Commands} Commands */
/** @typedef {{name: string, pointer: string, values: number[], scale: number}} Row */

/** Rows of numbers of a body. @param {BodyState} body @param {number} i @returns {Row[]} */
export function rowsOf(body, i) {
  const at = `/bodies/${i}`;
  /** @type {Row[]} */
  const rows = [];
  const row = (/** @type {string} */ name, /** @type {string} */ member, /** @type {number | number[] | undefined} */ value, scale = 1) =>
    value !== undefined && rows.push({ name, pointer: `${at}/${member}`, values: [value].flat(), scale });
  row('position, m', 'position', body.position, 0.1);
  if (!body.fixed) {
    row('velocity, m/s', 'velocity', body.velocity);
    row('angular velocity, rad/s', 'angular_velocity', body.angular_velocity);
    if (body.density !== undefined) row('density, kg/m³', 'density', body.density, 100);
    else if (body.written_mass !== undefined) row('mass, kg', 'mass', body.written_mass, 0.1);
  }
  for (const [kind, members] of Object.entries(body.shape ?? {})) {
    for (const [member, value] of Object.entries(members)) {
      const number = typeof value === 'number' || (Array.isArray(value) && value.every((one) => typeof one === 'number'));
      if (number) row(`${member} of the ${kind}${member === 'normal' ? '' : ', m'}`, `shape/${kind}/${member}`, value, 0.05);
    }
  }
  return rows;
}

/** @param {import('../store.js').Store<import('../types.js').State>} store @param {Commands} commands
 * @param {import('../facing.js').Facing} facing */
export function showBody(store, commands, facing) {
  const place = byId('body'), section = byId('body-section'), lying = byId('lying');
  let structure = '';
  /** @type {((row: Row) => void)[]} */
  let updates = [];
  const fields = (/** @type {Row} */ { name, pointer, values, scale }) => {
    let now = values;
    const all = values.map((value, k) => numberField({ name: values.length > 1 ? `${name}, ${'xyz'[k]}` : name, value, scale, act: (next) =>
      void commands.setValue(pointer, values.length > 1 ? now.map((one, j) => (j === k ? next : one)) : next) }));
    updates.push((row) => {
      now = row.values;
      all.forEach((one, k) => one.show(now[k]));
    });
    return el('div', { class: 'body-row' }, el('span', { class: 'dim' }, name), el('div', { class: 'body-fields' }, ...all.map(({ field }) => field)));
  };
  /** @param {BodyState} body @param {number} i @param {{name: string}[]} materials */
  const materialChoice = (body, i, materials) => {
    const names = materials.map(({ name }) => name), select = el('select', { 'aria-label': 'Material', onchange: () => void commands.setValue(`/bodies/${i}/material`, names[select.selectedIndex]) }, ...names.map((name) => el('option', {}, name)));
    select.selectedIndex = names.indexOf(body.material ?? '');
    return el('label', { class: 'body-choice' }, el('span', { class: 'dim' }, 'material'), select);
  };
  /** Faces that can be up at rest, each a button. @param {number} i @param {import('../faces.js').Face[]} faces */
  const facesRow = (i, faces) => el('div', { class: 'body-row', role: 'group', 'aria-label': 'Face up at rest' }, el('span', { class: 'dim' }, 'face up at rest'), el('div', { class: 'body-faces' },
    ...faces.map((face) => el('button', { type: 'button', onclick: () => facing.begin(i, face) && byId('overlay').focus() }, face.name))));
  store.on(['motion', 'time', 'selected', 'scene'], ({ motion, time, selected, scene }) => {
    const words = motion && scene && selected >= 0 ? lyingOn(motion, selected, time, scene.shapes.map(({ name }) => name)) : '';
    if (lying.textContent !== words) lying.textContent = words;
    lying.hidden = !words;
  });
  store.on(['document', 'selected', 'scene'], ({ document, selected, scene }) => {
    const body = document?.open ? document.bodies[selected] : undefined;
    section.hidden = !body?.position;
    if (!body?.position) return void (structure = '');
    const rows = rowsOf(body, selected), shape = scene?.shapes[selected], faces = shape && shape.name === body.name ? facesOf(shape) : [];
    const next = JSON.stringify([faces, selected, body.name, body.fixed, body.material, document?.materials?.map(({ name: of }) => of), rows.map(({ name }) => name)]);
    if (next !== structure) {
      structure = next;
      updates = [];
      const name = el('input', { type: 'text', class: 'wide', value: body.name, 'aria-label': 'Name', autocomplete: 'off', spellcheck: false, maxLength: 200 });
      name.addEventListener('keydown', (event) => {
        if (event.key === 'Enter') name.blur();
        if (event.key === 'Escape') name.value = body.name;
        event.stopPropagation();
      });
      name.addEventListener('change', () => name.value.trim() && void commands.renameBody(body.name, name.value.trim()));
      const fixed = el('input', { type: 'checkbox', checked: body.fixed, disabled: !!body.kinematic || !!body.shape?.plane, onchange: () => void commands.fixBody(selected, !body.fixed) });
      place.replaceChildren(name, el('label', { class: 'switch' }, fixed, 'fixed'), ...(document?.materials?.length ? [materialChoice(body, selected, document.materials)] : []), ...rows.map(fields), ...(faces.length ? [facesRow(selected, faces)] : []), el('div', { class: 'body-buttons' },
        el('button', { type: 'button', onclick: () => void commands.copyBody(body.name) }, 'Duplicate'),
        el('button', { type: 'button', onclick: () => void commands.removeBody(body.name) }, 'Delete')));
    }
    rows.forEach((row, i) => updates[i](row));
  });
}
