// SPDX-License-Identifier: MIT
// Elements made by scripts. Children that are text become text nodes: nothing from a document is ever read as HTML.

import { icon } from './icons.js';

/** @param {string} id @returns {HTMLElement} of the page; throws where it has none */
export function byId(id) {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page lacks #${id}`);
  return element;
}

/** @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag @param {Record<string, unknown>} properties of the element; `class`, `role`, `for` and names with a dash are
 *    attributes @param {(Node | string | null | false)[]} children @returns {HTMLElementTagNameMap[K]} */
export function el(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name === 'class' || name === 'role' || name === 'for' || name.includes('-')) {
      if (value !== undefined && value !== false) element.setAttribute(name, String(value));
    } else {
      /** @type {any} */ (element)[name] = value;
    }
  }
  element.append(...children.filter((child) => child !== null && child !== false).map((child) => /** @type {Node | string} */ (child)));
  return element;
}

/** A button with a picture, and a name for those who do not see it. @param {string} picture see icons.js @param {string} name @param {() => void} act
 * @param {Record<string, unknown>} more */
export function iconButton(picture, name, act, more = {}) {
  return el('button', { type: 'button', class: 'icon', title: name, 'aria-label': name, onclick: act, ...more }, icon(picture));
}
