// SPDX-License-Identifier: MIT
// What may change: each control with its numbers as opened and now, its components, bounds and weight; and what could
// vary besides.

import { byId, el } from '../dom.js';
import { icon } from '../icons.js';
import { velocityAt } from '../motion.js';
import { evaluate, shortNumber } from '../number_field_text.js';
import { numberField, scrubs } from '../number_field.js';

/** @typedef {import('../types.js').Control} Control */
/** @typedef {import('../types.js').NumberState} NumberState */
/** @typedef {import('../types.js').DocumentState} DocumentState */
/** @typedef {import('../commands.js').Commands} Commands */

const componentsOf = { position: ['x', 'y', 'z'], velocity: ['x', 'y', 'z'], angular_velocity: ['x', 'y', 'z'], surface_velocity: ['x', 'y', 'z'], surface_angular_velocity: ['x', 'y', 'z'], orientation: ['x', 'y', 'z'], gravity: ['x', 'y', 'z'], inertia: ['x', 'y', 'z'] };

/** @param {Control} control */
export function controlName({ vary, body, material, impact }) {
  const word = vary.replaceAll('_', ' ');
  return impact ? `${word} of impact ${impact} of ${body}` : body || material ? `${word} of ${body ?? material}` : word;
}

/** @param {import('../store.js').Store<import('../types.js').State>} store @param {Commands} commands */
export function showNumbers(store, commands) {
  const place = byId('numbers'), unfolded = new Set();
  let structure = '';
  /** @type {Map<string, (number: NumberState) => void>} */
  let updates = new Map();
  /** Controls that were switched off: they come back as they were. @type {Control[]} */
  let off = [];

  const key = (/** @type {NumberState} */ n) => `${n.control} ${n.component}`;
  const redraw = () => {
    structure = '';
    show(store.state);
  };
  /** @param {import('../types.js').State} state */
  const show = ({ document, selected }) => {
    if (!document?.open) {
      off = [];
      return place.replaceChildren();
    }
    off = off.filter((one) => !document.controls.some((c) => controlName(c) === controlName(one)));
    const body = document.bodies[selected];
    const next = JSON.stringify([document.controls, document.numbers.map((n) => [n.control, n.component, n.min, n.max, n.pointer]), off, [...unfolded], body?.name]);
    if (next !== structure) {
      structure = next;
      updates = new Map();
      place.replaceChildren(
        ...document.controls.map((control, i) => controlRows(document, control, i)),
        ...off.map((control) => offRow(document, control)),
        ...suggestions(document, body).map((control) => offRow(document, control)));
    }
    for (const number of document.numbers) updates.get(key(number))?.(number);
  };

  /** @param {DocumentState} document @param {Control} control @param {number} i */
  const controlRows = (document, control, i) => {
    const name = controlName(control), open = unfolded.has(name);
    const numbers = document.numbers.filter((n) => n.control === i);
    const box = el('input', { type: 'checkbox', checked: true, 'aria-label': `${name} may change`, onchange: () => {
      off = [...off, control];
      void commands.setControls(document.controls.filter((_, k) => k !== i));
    } });
    const fold = el('button', { type: 'button', class: 'icon small', 'aria-expanded': open, 'aria-label': `Components, bounds and weight of ${name}`, onclick: () => {
      if (!unfolded.delete(name)) unfolded.add(name);
      redraw();
    } }, icon(open ? 'down' : 'right'));
    return el('section', { class: 'control', 'aria-label': name },
      el('div', { class: 'control-head' }, box, el('span', { class: 'cut grow' }, name), fold),
      ...numbers.map(numberRow), open && details(document, control, i));
  };

  /** @param {NumberState} number */
  const numberRow = (number) => {
    const label = el('span', { class: 'component' }, number.component);
    const opened = el('span', { class: 'opened dim' }), bar = el('span', { class: 'bound', title: 'at its bound' });
    let now = number.now;
    const field = numberField({ name: number.name, value: number.now, scale: number.scale, disabled: !number.pointer,
      act: (value) => number.pointer && void commands.setValue(number.pointer, value) });
    const { pointer } = number;
    if (pointer) scrubs(label, () => now, number.scale, (value, done) => {
      field.show(value);
      if (done) void commands.setValue(pointer, value);
    });
    updates.set(key(number), (next) => {
      now = next.now;
      opened.textContent = shortNumber(next.opened, next.scale);
      field.show(next.now);
      field.field.classList.toggle('changed', Math.abs(next.now - next.opened) > 1e-9 * Math.max(1, Math.abs(next.opened)));
      bar.className = `bound ${next.at_bound ?? ''}`;
    });
    return el('div', { class: 'number-row' }, label, opened, el('span', { class: 'dim', 'aria-hidden': 'true' }, '→'), field.field, bar);
  };

  /** @param {DocumentState} document @param {Control} control @param {number} i */
  const details = (document, control, i) => {
    const change = (/** @type {Partial<Control>} */ patch) => {
      const next = /** @type {Record<string, unknown>} */ ({ ...control, ...patch });
      for (const [k, value] of Object.entries(next)) if (value === undefined) delete next[k];
      void commands.setControls(document.controls.map((c, k) => (k === i ? /** @type {Control} */ (next) : c)));
    };
    const all = /** @type {Record<string, string[]>} */ (componentsOf)[control.vary] ?? [], on = control.components ?? all;
    const switches = all.map((c) => el('label', { class: 'switch' }, el('input', { type: 'checkbox', checked: on.includes(c), onchange: () => {
      const components = all.filter((o) => (o === c ? !on.includes(c) : on.includes(o)));
      if (components.length) change({ components: components.length === all.length ? undefined : components, min: single(control.min), max: single(control.max) });
      else redraw();
    } }), c));
    return el('div', { class: 'details' }, ...switches,
      bound('least', control.min, (min) => change({ min })), bound('most', control.max, (max) => change({ max })),
      bound('weight', control.weight ?? 1, (weight) => change({ weight })));
  };

  /** @param {string} name @param {number | number[] | undefined} value @param {(value: number | undefined) => void} act */
  const bound = (name, value, act) => {
    const field = el('input', { type: 'text', class: 'number', value: value === undefined ? '' : String(value), placeholder: 'any', autocomplete: 'off' });
    field.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') field.blur();
      event.stopPropagation();
    });
    field.addEventListener('change', () => {
      const next = field.value.trim() === '' ? undefined : evaluate(field.value);
      if (next === null) field.setAttribute('aria-invalid', 'true');
      else act(next);
    });
    return el('label', { class: 'bound-field' }, name, field);
  };

  /** A control that is not there. @param {DocumentState} document @param {Control} control */
  const offRow = (document, control) => {
    const name = controlName(control);
    const box = el('input', { type: 'checkbox', 'aria-label': `${name} may change`, onchange: () => void commands.setControls([...document.controls, control]) });
    return el('div', { class: 'control-head off' }, box, el('span', { class: 'cut grow dim' }, name));
  };

  store.on(['document', 'selected'], show);
  // while the hand drags, the server tells the numbers of the last step; a throw can be read off the motion
  store.on(['motion'], ({ motion, document, gesture }) => {
    if (!motion || !document || gesture.state !== 'dragging') return;
    for (const number of document.numbers) {
      const { vary, body } = document.controls[number.control] ?? {}, track = motion.tracks[document.bodies.findIndex((one) => one.name === body)];
      const now = vary === 'velocity' && track ? velocityAt(track, 0)['xyz'.indexOf(number.component)] : undefined;
      if (now !== undefined) updates.get(key(number))?.({ ...number, now });
    }
  });
}

/** A list of bounds fits its components alone. @param {number | number[] | undefined} bound */
const single = (bound) => (Array.isArray(bound) ? undefined : bound);

/** What could vary besides of the selected body and its material. @param {DocumentState} document
 * @param {import('../types.js').BodyState | undefined} body @returns {Control[]} */
export function suggestions(document, body) {
  if (!body || body.kinematic) return [];
  /** @type {Control[]} */
  const all = body.fixed ? [] : [{ vary: 'velocity', body: body.name }, { vary: 'angular_velocity', body: body.name }];
  all.push({ vary: 'position', body: body.name });
  if (body.material) all.push({ vary: 'elasticity', material: body.material }, { vary: 'friction', material: body.material });
  return all.filter((one) => !document.controls.some((c) => controlName(c) === controlName(one)));
}
