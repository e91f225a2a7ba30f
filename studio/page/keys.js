// SPDX-License-Identifier: MIT
// What keys do. None acts while a field has the focus.

/** @typedef {'move' | 'turn' | 'throw' | 'face' | 'pen' | 'nail' | 'remove' | 'axis x' | 'axis y' | 'axis z' | 'lift' | 'confirm' | 'cancel' | 'play' |
 *    'earlier' | 'later' | 'impact before' | 'impact after' | 'start' | 'end' | 'undo' | 'redo' | 'save' | 'open' |
 *    'frame' | 'frame all' | 'front' | 'side' | 'top' | 'before' | 'panel' | 'keys' | 'body before' | 'body after'} Action */

/** @type {{action: Action, name: string, blender: string[], maya: string[]}[]} */
export const keyTable = [
  { action: 'move', name: 'move', blender: ['G'], maya: ['W'] },
  { action: 'turn', name: 'turn', blender: ['R'], maya: ['E'] },
  { action: 'throw', name: 'throw: the velocity at the start', blender: ['V'], maya: ['T'] },
  { action: 'face', name: 'the face that is up at rest', blender: ['U'], maya: ['U'] },
  { action: 'pen', name: 'pen: draw the path', blender: ['P'], maya: ['P'] },
  { action: 'nail', name: 'nail where it is', blender: ['I'], maya: ['S'] },
  { action: 'remove', name: 'remove the nail', blender: ['X', 'Delete'], maya: ['Delete'] },
  { action: 'axis x', name: 'in a drag: along x, again: its own x', blender: ['X'], maya: ['X'] },
  { action: 'axis y', name: 'in a drag: along y', blender: ['Y'], maya: ['Y'] },
  { action: 'axis z', name: 'in a drag: along z', blender: ['Z'], maya: ['Z'] },
  { action: 'lift', name: 'in a drag: off the surface, back onto it', blender: ['L'], maya: ['L'] },
  { action: 'confirm', name: 'confirm', blender: ['Enter'], maya: ['Enter'] },
  { action: 'cancel', name: 'cancel', blender: ['Escape'], maya: ['Escape'] },
  { action: 'play', name: 'play', blender: ['Space'], maya: ['Space'] },
  { action: 'earlier', name: 'frame before', blender: ['ArrowLeft'], maya: ['ArrowLeft'] },
  { action: 'later', name: 'next frame', blender: ['ArrowRight'], maya: ['ArrowRight'] },
  { action: 'body before', name: 'body before', blender: ['ArrowUp'], maya: ['ArrowUp'] },
  { action: 'body after', name: 'next body', blender: ['ArrowDown'], maya: ['ArrowDown'] },
  { action: 'impact before', name: 'impact before', blender: ['['], maya: ['['] },
  { action: 'impact after', name: 'next impact', blender: [']'], maya: [']'] },
  { action: 'start', name: 'start', blender: ['Home'], maya: ['Home'] },
  { action: 'end', name: 'end', blender: ['End'], maya: ['End'] },
  { action: 'undo', name: 'undo', blender: ['Ctrl+Z'], maya: ['Ctrl+Z'] },
  { action: 'redo', name: 'redo', blender: ['Ctrl+Shift+Z'], maya: ['Ctrl+Shift+Z'] },
  { action: 'save', name: 'save', blender: ['Ctrl+S'], maya: ['Ctrl+S'] },
  { action: 'open', name: 'open', blender: ['Ctrl+O'], maya: ['Ctrl+O'] },
  { action: 'frame', name: 'frame the selected body', blender: ['F'], maya: ['F'] },
  { action: 'frame all', name: 'frame everything', blender: ['A'], maya: ['A'] },
  { action: 'front', name: 'from the front', blender: ['1'], maya: ['1'] },
  { action: 'side', name: 'from the right', blender: ['3'], maya: ['3'] },
  { action: 'top', name: 'from above', blender: ['7'], maya: ['7'] },
  { action: 'before', name: 'hold: the motion as opened', blender: ['B'], maya: ['B'] },
  { action: 'panel', name: 'fold the panel', blender: ['N'], maya: ['N'] },
  { action: 'keys', name: 'this sheet', blender: ['?'], maya: ['?'] },
];

/** Actions of a drag under way; all others wait for its end. @type {ReadonlySet<string>} */
const inDrag = new Set(['axis x', 'axis y', 'axis z', 'lift', 'confirm', 'cancel', 'nail', 'before', 'save']);

/** "Ctrl+Shift+Z" of a key event. @param {{key: string, ctrlKey: boolean, metaKey: boolean, shiftKey: boolean}} event */
export function chordOf({ key, ctrlKey, metaKey, shiftKey }) {
  const named = key === ' ' ? 'Space' : key.length === 1 ? key.toUpperCase() : key;
  const letter = /^[A-Z]$/.test(named) || named.length > 1;
  return `${ctrlKey || metaKey ? 'Ctrl+' : ''}${shiftKey && letter ? 'Shift+' : ''}${named}`;
}

/** What a chord does; Shift with an axis means the plane across it.
 * @param {string} chord @param {'blender' | 'maya'} map @param {boolean} dragging
 * @returns {{action: Action, shift: boolean} | null} */
export function actionOf(chord, map, dragging) {
  const plain = dragging && chord.startsWith('Shift+') ? chord.slice(6) : chord;
  for (const row of keyTable) {
    if (row.action.startsWith('axis') && !dragging) continue;
    if (dragging && !inDrag.has(row.action)) continue;
    if (row[map].includes(plain)) return { action: row.action, shift: plain !== chord };
  }
  return null;
}

/** Whether keys belong to what has the focus. @param {Element | null} element */
export function takesKeys(element) {
  if (!element) return false;
  const type = element.tagName === 'INPUT' ? (element.getAttribute('type') ?? 'text') : '';
  return ['TEXTAREA', 'SELECT'].includes(element.tagName) || (type !== '' && !['checkbox', 'radio', 'button'].includes(type));
}
