// SPDX-License-Identifier: MIT
// Questions: yes or no, and a file's name.

import { byId, el } from '../dom.js';

/** Shows a dialog until it is closed. @param {string} title @param {(Node | string)[]} content
 * @param {(close: (value: string) => void) => Node[]} buttons @param {string} [kind] @returns {Promise<string>} the value it was closed with */
export function dialog(title, content, buttons, kind = '') {
  return new Promise((resolve) => {
    const heading = el('h2', {}, title), box = el('dialog', { class: kind, 'aria-label': title });
    box.append(heading, ...content, el('div', { class: 'buttons' }, ...buttons((value) => box.close(value))));
    box.addEventListener('keydown', (event) => event.stopPropagation());
    box.addEventListener('close', () => {
      box.remove();
      resolve(box.returnValue);
    });
    byId('dialogs').append(box);
    box.showModal();
  });
}

/** What the server says of a file, as the title of a question. @param {string} words */
const asSentence = (words) => words.slice(0, 1).toUpperCase() + words.slice(1);

/** @param {string} question @param {[string, string][]} choices value and words of each; the last one is what the person most likely
 * wants @returns {Promise<string>} '' for none of them */
export async function choose(question, choices) {
  return dialog(asSentence(question), [], (close) => [
    el('button', { type: 'button', onclick: () => close('') }, 'Cancel'),
    ...choices.map(([value, words], i) => el('button', { type: 'button', class: i === choices.length - 1 && 'primary', onclick: () => close(value) }, words)),
  ], 'small');
}

/** @param {string} question @param {string} yes what the button says @returns {Promise<boolean>} */
export async function ask(question, yes) {
  const answer = await dialog(asSentence(question), [], (close) => [
    el('button', { type: 'button', onclick: () => close('') }, 'Cancel'),
    el('button', { type: 'button', class: 'primary', onclick: () => close('yes') }, yes),
  ], 'small');
  return answer === 'yes';
}

/** @param {string} suggested @returns {Promise<string | null>} a path in the folder, that ends in .json */
export async function askName(suggested) {
  const field = el('input', { type: 'text', class: 'wide', value: suggested, 'aria-label': 'Name of the file', spellcheck: false });
  const answer = await dialog('Save as', [el('label', {}, 'Name of the file, in the folder that carom studio was started for', field)], (close) => {
    field.addEventListener('keydown', (event) => {
      if (event.key === 'Enter' && field.value.trim()) close('yes');
    });
    return [el('button', { type: 'button', onclick: () => close('') }, 'Cancel'), el('button', { type: 'button', class: 'primary', onclick: () => close('yes') }, 'Save')];
  }, 'small');
  const name = field.value.trim();
  if (answer !== 'yes' || !name) return null;
  return name.endsWith('.json') ? name : `${name}.json`;
}
