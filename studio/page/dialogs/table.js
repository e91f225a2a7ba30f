// SPDX-License-Identifier: MIT
// The motion as a table, and moving a body by numbers: what the mouse does, without one.

import { el } from '../dom.js';
import { hitAt } from '../take.js';
import { centreAt, velocityAt } from '../motion.js';
import { dialog } from './ask.js';

/** @typedef {import('../store.js').Store<import('../types.js').State>} Store */

const cells = (/** @type {number[]} */ v) => v.map((c) => el('td', { class: 'figure' }, c.toFixed(3).replace('-', '−')));

/** @param {Store} store */
export async function tableDialog(store) {
  const { motion, document, selected } = store.state, names = document?.bodies.map((body) => body.name) ?? [];
  if (!motion) return;
  const body = Math.max(0, selected), rate = 10;
  const impacts = el('table', {}, el('caption', {}, 'Impacts'), el('tbody', {},
    el('tr', {}, ...['s', 'bodies', 'kind', 'x, m', 'y, m', 'z, m'].map((t) => el('th', { scope: 'col' }, t))),
    ...motion.impacts.map((one) => el('tr', {}, el('td', { class: 'figure' }, one.t.toFixed(4)), el('td', {}, one.bodies.map((b) => names[b]).join(', ')), el('td', {}, one.mode), ...cells(one.point)))));
  const track = motion.tracks[body];
  const times = Array.from({ length: Math.floor(motion.end * rate + 1e-9) + 1 }, (_, k) => k / rate);
  const states = el('table', {}, el('caption', {}, `States of ${names[body]}`), el('tbody', {},
    el('tr', {}, ...['s', 'x, m', 'y, m', 'z, m', 'vx, m/s', 'vy, m/s', 'vz, m/s'].map((t) => el('th', { scope: 'col' }, t))),
    ...times.map((t) => el('tr', {}, el('td', { class: 'figure' }, t.toFixed(2)), ...cells(centreAt(track, t)), ...cells(velocityAt(track, t))))));
  await dialog('Motion as a table', [el('div', { class: 'scrolls', tabIndex: 0, role: 'region', 'aria-label': 'Tables' }, impacts, states)],
    (close) => [el('button', { type: 'button', class: 'primary', onclick: () => close('') }, 'Close')], 'wide');
}

/** Moves the selected body at the time shown to a place that is typed. @param {Store} store
 * @param {import('../gesture.js').Gesture} gesture */
export async function moveDialog(store, gesture) {
  const { motion, selected, time, document } = store.state;
  if (!motion || selected < 0) return store.set({ notice: { message: 'Select a body to move it.' } });
  const hit = hitAt(motion, selected, Math.min(time, motion.end));
  const fields = hit.place.map((value, i) => el('input', { type: 'text', class: 'number', value: String(Number(value.toPrecision(6))), 'aria-label': `${'xyz'[i]}, m` }));
  const answer = await dialog(`Move ${document?.bodies[selected].name} at ${hit.time.toFixed(3)} s to`, [el('div', { class: 'switches' }, ...fields)], (close) => [
    el('button', { type: 'button', onclick: () => close('') }, 'Cancel'), el('button', { type: 'button', class: 'primary', onclick: () => close('yes') }, 'Move'),
  ], 'small');
  if (answer !== 'yes') return;
  gesture.beginByKey(hit, 'move');
  if (!gesture.type(fields.map((field) => field.value).join(' '))) gesture.cancel();
}
