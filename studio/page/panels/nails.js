// SPDX-License-Identifier: MIT
// The nails: what each holds, component by component, whether it is met, on, and in the motion.

import { byId, el, iconButton } from '../dom.js';
import { icon } from '../icons.js';
import { pointAt, turnAt } from '../motion.js';
import { forPeople, lengthText } from '../number_field_text.js';
import { atText, isDrawn, nailPlaces, placeHeld } from '../overlay/hoops.js';
import { curvesOf } from '../overlay/sketches.js';

/** @typedef {import('../types.js').Constraint} Constraint */
/** @typedef {import('../types.js').NailState} NailState */
/** @typedef {import('../types.js').State} State */

/** @param {import('../store.js').Store<State>} store @param {import('../commands.js').Commands} commands */
export function showNails(store, commands) {
  const list = byId('nails'), meet = /** @type {HTMLButtonElement} */ (byId('meet'));
  meet.onclick = () => void commands.meetNails();
  store.on(['document', 'selectedNail'], (state) => {
    const nails = state.document?.nails ?? [], focused = document.activeElement?.getAttribute('data-key');
    meet.hidden = !nails.some((nail) => !nail.on || (nail.available && !nail.met && !isDrawn(nail)));
    byId('nails-empty').hidden = nails.length > 0 || !state.document?.open;
    const curves = curvesOf(nails.map((nail) => ({ nail }))).map((curve) => curve.map(({ nail }) => nail));
    list.replaceChildren(...nails.filter((nail) => !isDrawn(nail)).map((nail) => row(nail, state)), ...curves.map((curve) => curveRow(curve)));
    const again = focused && /** @type {HTMLElement | null} */ (list.querySelector(`[data-key="${CSS.escape(focused)}"]`));
    if (again) again.focus();
  });

  /** All nails of a drawn curve. @param {NailState[]} curve */
  function curveRow(curve) {
    const { body, notes = '' } = curve[0].constraint, title = `${body}, ${notes}`, off = Math.max(...curve.map(({ error }) => error));
    const choose = el('button', { type: 'button', class: 'row name', title, 'data-key': `curve ${title}`, onclick: () => {
      store.set({ selectedNail: -1, selected: store.state.document?.bodies.findIndex((one) => one.name === body) ?? -1 });
      if (curve[0].time !== null) commands.seek(curve[0].time);
    } }, icon('pen'), el('span', { class: 'cut grow' }, title));
    const remove = iconButton('close', `Remove ${title}`, () => void commands.tell('unnail', { sketch: notes }), { 'data-key': `remove ${title}` });
    const words = curve.some(({ available }) => !available) ? 'beyond the end of the motion' : `at most ${lengthText(off)} off`;
    return el('li', { class: 'nail' }, el('div', { class: 'nail-head' }, choose, remove), el('div', { class: 'components' }, el('span', { class: 'standing dim', title: words }, words)));
  }

  /** @param {NailState} nail @param {State} state */
  function row(nail, state) {
    const { constraint, id } = nail, title = `${constraint.body}, ${atText(constraint.at)}`, standing = standingOf(nail);
    const choose = el('button', { type: 'button', class: 'row name', title, 'aria-pressed': id === state.selectedNail, 'data-key': `nail ${id}`, onclick: () => {
      const selected = state.document?.bodies.findIndex((body) => body.name === constraint.body) ?? -1;
      store.set({ selectedNail: id, selected });
      if (nail.time !== null) commands.seek(nail.time);
    } }, el('span', { class: `hoop ${standing[0]}`, 'aria-hidden': 'true' }), el('span', { class: 'cut grow' }, title));
    const eye = iconButton(nail.on ? 'on' : 'off', nail.on ? `Switch off the nail of ${title}` : `Switch on the nail of ${title}`, () => void commands.tell('nail_on', { nail: id, on: !nail.on }), { 'data-key': `eye ${id}` });
    const remove = iconButton('close', `Remove the nail of ${title}`, () => void commands.removeNail(id), { 'data-key': `remove ${id}` });
    return el('li', { class: 'nail' }, el('div', { class: 'nail-head' }, choose, eye, remove), components(nail, standing));
  }

  /** @param {NailState} nail @param {string[]} standing its class and words */
  function components(nail, [kind, words]) {
    const { constraint } = nail, place = placeHeld(constraint);
    const others = ['velocity', 'angular_velocity', 'speed', 'kinetic_energy', 'impulse', 'height', 'time', 'avoid', 'inside'].filter((word) => word in constraint).map((word) => word.replaceAll('_', ' '));
    const buttons = ['x', 'y', 'z'].map((name, i) => toggle(name, `${name} of the place`, place?.targets[i] != null, () => withComponent(nail, i), `${nail.id} ${name}`));
    const turn = toggle('turn', 'turn', !!constraint.orientation, () => withTurn(nail), `${nail.id} turn`);
    return el('div', { class: 'components' }, ...(constraint.at === undefined || constraint.relative_to ? [] : [...buttons, turn]), el('span', { class: 'dim cut grow' }, others.join(', ')), el('span', { class: `standing ${kind}`, title: words }, words));
  }

  /** @param {string} text @param {string} name @param {boolean} on @param {() => Constraint | null} next @param {string} key */
  function toggle(text, name, on, next, key) {
    return el('button', { type: 'button', class: 'toggle', 'aria-pressed': on, 'aria-label': `hold ${name}`, title: `hold ${name}`, 'data-key': key, onclick: () => {
      const constraint = next();
      if (constraint) void commands.setNail(Number(key.split(' ')[0]), constraint);
      else store.set({ notice: { message: 'A nail holds something; remove it instead.' } });
    } }, text.length === 1 ? text : icon(text));
  }

  /** The nail with one component of its place held, or free. @param {NailState} nail @param {number} i */
  function withComponent({ id, constraint, time }, i) {
    const { motion, document } = store.state, body = document?.bodies.findIndex((b) => b.name === constraint.body) ?? -1;
    const track = motion?.tracks[body], place = placeHeld(constraint);
    if (!track || time === null) return null;
    const targets = [...(place?.targets ?? [null, null, null])], { position, point, contact, ...rest } = constraint;
    const now = contact ? nailPlaces(store.state).find((one) => one.id === id)?.now : pointAt(track, place?.point ?? [0, 0, 0], time);
    if (!now) return null;
    targets[i] = targets[i] == null ? now[i] : null;
    if (targets.some((t) => t != null)) return contact ? { ...rest, contact: targets } : point ? { ...rest, point: { ...point, world: targets } } : { ...rest, position: targets };
    return Object.keys(rest).some((word) => !['body', 'at', 'notes'].includes(word)) ? rest : null;
  }

  /** The nail with the turn held as it is now, or free. @param {NailState} nail */
  function withTurn({ constraint, time }) {
    const { motion, document } = store.state, body = document?.bodies.findIndex((b) => b.name === constraint.body) ?? -1;
    const track = motion?.tracks[body], { orientation, ...rest } = constraint;
    if (!track || time === null) return null;
    if (!orientation) return { ...constraint, orientation: turnAt(track, time) };
    return Object.keys(rest).some((word) => !['body', 'at', 'notes'].includes(word)) ? rest : null;
  }
}

/** How a nail stands: a class, and words. @param {NailState} nail @returns {[string, string]} */
export function standingOf(nail) {
  if (!nail.available) return ['missing', forPeople(nail.message) || 'does not come'];
  if (!nail.on) return ['off', 'off'];
  return nail.met ? ['met', 'met'] : ['unmet', errorText(nail)];
}

/** @param {NailState} nail */
function errorText({ constraint, error }) {
  return placeHeld(constraint) ? lengthText(error) : `off by ${Number(error.toPrecision(2))}`;
}
