// SPDX-License-Identifier: MIT
// A field for one number: takes arithmetic, arrow keys step, dragging its label scrubs.

import { el } from './dom.js';
import { evaluate, shortNumber, stepOf } from './number_field_text.js';

/** @typedef {{field: HTMLInputElement, show: (value: number) => void}} NumberField */

/** @param {{name: string, value: number, scale: number, act: (value: number) => void, disabled?: boolean}} options
 *    `act` gets each number that is entered @returns {NumberField} */
export function numberField({ name, value, scale, act, disabled = false }) {
  let now = value, cancelled = false;
  const field = el('input', { type: 'text', class: 'number', 'aria-label': name, autocomplete: 'off', spellcheck: false, disabled, inputMode: 'decimal' });
  const write = () => {
    field.value = shortNumber(now, scale);
    field.removeAttribute('aria-invalid');
  };
  /** @param {number} next */
  const enter = (next) => {
    if (next === now) return write();
    now = next;
    write();
    act(next);
  };
  field.addEventListener('focus', () => {
    cancelled = false;
    field.value = String(Number(now.toPrecision(12)));
    field.select();
  });
  field.addEventListener('blur', () => {
    const next = cancelled ? now : evaluate(field.value);
    if (next === null || next === Number(now.toPrecision(12))) write();
    else enter(next);
  });
  field.addEventListener('input', () => field.toggleAttribute('aria-invalid', evaluate(field.value) === null));
  field.addEventListener('keydown', (event) => {
    if (event.key === 'Enter') {
      if (evaluate(field.value) !== null) field.blur();
    } else if (event.key === 'Escape') {
      cancelled = true;
      field.blur();
    } else if (event.key === 'ArrowUp' || event.key === 'ArrowDown') {
      event.preventDefault();
      const from = evaluate(field.value) ?? now, step = stepOf(scale) * (event.shiftKey ? 10 : 1);
      enter(Number((from + (event.key === 'ArrowUp' ? step : -step)).toPrecision(12)));
      field.value = String(now);
    }
    event.stopPropagation();
  });
  write();
  return {
    field,
    show(next) {
      now = next;
      if (document.activeElement !== field) write();
    },
  };
}

/** Makes a label that is dragged change a field; the number is entered when the button comes up.
 * @param {HTMLElement} label @param {() => number} value @param {number} scale @param {(value: number, done: boolean) => void} act */
export function scrubs(label, value, scale, act) {
  let from = 0, start = 0, held = false;
  label.classList.add('scrubs');
  label.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    [from, start, held] = [event.clientX, value(), true];
    label.setPointerCapture(event.pointerId);
  });
  const at = (/** @type {PointerEvent} */ event) => Number((start + Math.round(event.clientX - from) * stepOf(scale)).toPrecision(9));
  label.addEventListener('pointermove', (event) => held && act(at(event), false));
  label.addEventListener('pointerup', (event) => {
    if (held && at(event) !== start) act(at(event), true);
    held = false;
  });
  label.addEventListener('pointercancel', () => (held = false));
}
