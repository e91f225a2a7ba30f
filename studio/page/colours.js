// SPDX-License-Identifier: MIT
// Colours that scripts need; the rest stand in style.css. One meaning each.

export const colours = {
  view: '#202327', text: '#e8eaec', dim: '#a9b0b8', accent: '#5aa9ff', nail: '#58c56a', amber: '#e8b04a', red: '#ff7a6b',
  before: '#9aa1a9', preview: '#f2f4f6', casing: '#101215', fixed: '#8a9098', raised: '#30343a', pressed: '#1f5fae', panel: '#26292e', lane: '#2d3137',
  axes: { x: '#ff7a6b', y: '#58c56a', z: '#5aa9ff' },
};

/** Of impacts, by mode. @type {Record<string, string>} */
export const impactColours = { stick: '#ffd166', slide: '#ff9db0', frictionless: '#8fd3ff', joint: '#d7b4ff' };

/** A body's colour as lines show it on the dark view: 35 % lighter. @param {string} hex "#rrggbb" */
export function inkOf(hex) {
  const code = Number.parseInt(hex.slice(1), 16);
  const mixed = [code >> 16, (code >> 8) & 255, code & 255].map((c) => Math.round(c + 0.35 * (255 - c)));
  return `#${mixed.map((c) => c.toString(16).padStart(2, '0')).join('')}`;
}
