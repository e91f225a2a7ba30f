// SPDX-License-Identifier: MIT
// What the hand and the play head do, in words: the readout below the view.

import { byId, el } from './dom.js';
import { centreAt, velocityAt } from './motion.js';
import { lengthText } from './number_field_text.js';

/** @typedef {import('./types.js').State} State */

/** @param {import('./store.js').Store<State>} store */
export function showReadout(store) {
  const readout = byId('readout');
  store.on(['time', 'motion', 'selected', 'gesture', 'document'], (state) => {
    const { motion, selected, document, gesture, time } = state, body = document?.bodies[selected], track = motion?.tracks[selected];
    readout.hidden = !motion || !body || !track;
    if (!motion || !body || !track) return;
    const at = Math.min(time, motion.end), [x, y, z] = centreAt(track, at).map((c) => c.toFixed(3).replace('-', '−'));
    const [words, kind] = standing(state);
    readout.replaceChildren(
      el('strong', { class: 'cut' }, body.name), el('span', { class: 'dim' }, `${at.toFixed(3)} s`), el('span', { class: 'dim' }, `${x} ${y} ${z} m`),
      ...(words ? [el('span', { class: kind }, words)] : []), ...(gesture.snap ? [el('span', { class: 'dim' }, gesture.turn ? `steps of ${Math.round((gesture.snap * 180) / Math.PI * 10) / 10}°` : `steps of ${lengthText(gesture.snap)}`)] : []), ...(gesture.snapOn ? [el('span', { class: 'dim' }, `to: ${gesture.snapOn}`)] : []), ...(gesture.axis ? [el('span', { class: 'dim' }, `along ${axisText(gesture.axis)}`)] : []));
  });
}

/** @param {string} axis */
export function axisText(axis) {
  return axis.replace('plane ', 'the plane across ').replace('own ', 'its own ');
}

/** Where the held body is beside its target, and the colour of that. @param {State} state @returns {[string, string]} */
function standing({ gesture, motion, card }) {
  if (gesture.state === 'settling') return [gesture.settlingShown ? 'settling…' : '', 'dim'];
  if ((gesture.state === 'dragging' || gesture.state === 'typing') && motion && gesture.target) {
    if (gesture.answered < 0) return ['', 'dim'];
    if (gesture.hit?.handle === 'throw') return [`thrown at ${Math.hypot(...velocityAt(motion.tracks[gesture.hit.body], 0)).toFixed(2)} m/s`, 'good'];
    if (motion.reached) return ['at its target', 'good'];
    return [offText(motion), 'amber'];
  }
  return card && motion && !motion.reached ? [offText(motion), 'amber'] : ['', 'dim'];
}

/** How far a body is from what was asked for: a turn asks for the orientation alone.
 * @param {Pick<import('./types.js').Motion, 'distance' | 'turn'>} motion */
export function offText({ distance, turn }) {
  const angle = `${((turn * 180) / Math.PI).toFixed(turn < 0.02 ? 2 : 1)}°`;
  const parts = [...(distance > 1e-7 || turn <= 1e-6 ? [lengthText(distance)] : []), ...(turn > 1e-6 ? [angle] : [])];
  return `${parts.join(', ')} from its target`;
}
