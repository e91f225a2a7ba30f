// SPDX-License-Identifier: MIT
// Mouse and keys where nothing can be changed: a press chooses a body and a time, everything else turns the camera.

import { dialog } from '../dialogs/ask.js';
import { el } from '../dom.js';
import { actionOf, chordOf, keyTable, takesKeys } from '../keys.js';

/** @typedef {{store: import('../store.js').Store<import('../types.js').State>, head: import('../play_head.js').PlayHead,
 *    overlay: import('../overlay/overlay.js').Overlay, view: import('../view/view.js').View, frame: (body: number) => void,
 *    compared: boolean}} Parts  compared: with a motion before */

const clickPixels = 4;
/** Actions that there are here. @type {ReadonlySet<import('../keys.js').Action>} */
const looking = new Set(['play', 'earlier', 'later', 'body before', 'body after', 'impact before', 'impact after', 'start', 'end', 'frame', 'frame all', 'before', 'panel', 'keys']);

/** @param {Parts} parts */
export function listen({ store, head, overlay, frame, compared }) {
  const { canvas } = overlay;
  let down = /** @type {[number, number] | null} */ (null);
  const under = (/** @type {PointerEvent} */ event) => overlay.under(event.offsetX, event.offsetY);
  canvas.addEventListener('pointerdown', (event) => {
    canvas.focus();
    down = event.button === 0 ? [event.offsetX, event.offsetY] : null;
    store.set({ hover: null });
  });
  canvas.addEventListener('pointermove', (event) => {
    if (event.buttons || store.state.playing) return;
    const hit = under(event), was = store.state.hover, seen = hit && !store.state.scene?.shapes[hit.body]?.fixed ? hit : null;
    if (seen?.kind !== was?.kind || seen?.body !== was?.body || seen?.time !== was?.time) store.set({ hover: seen });
  });
  canvas.addEventListener('pointerup', (event) => {
    const clicked = down && Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) <= clickPixels;
    down = null;
    if (!clicked || event.button !== 0) return;
    const hit = under(event);
    store.set({ selected: hit?.body ?? -1, selectedNail: hit?.kind === 'nail' ? (hit.nail ?? -1) : -1, ...(hit && hit.kind !== 'body' ? { time: hit.time, playing: false } : {}) });
  });
  canvas.addEventListener('pointerleave', () => store.set({ hover: null }));
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  window.addEventListener('keydown', (event) => {
    const focused = document.activeElement;
    if (takesKeys(focused) || document.querySelector('dialog[open]') || event.altKey) return;
    if (focused?.matches('button, summary, input') && (event.key === ' ' || event.key === 'Enter')) return;
    const action = event.key === 'Escape' ? 'cancel' : actionOf(chordOf(event), 'blender', false)?.action;
    if (!action || (action !== 'cancel' && !looking.has(action))) return;
    event.preventDefault();
    acts(store, head, frame, compared)[action]?.();
  });
  window.addEventListener('keyup', (event) => {
    if (compared && actionOf(chordOf(event), 'blender', false)?.action === 'before') store.set({ showBefore: 'opened' });
  });
}

/** @param {Parts['store']} store @param {Parts['head']} head @param {Parts['frame']} frame @param {boolean} compared
 * @returns {Partial<Record<import('../keys.js').Action, () => void>>} */
function acts(store, head, frame, compared) {
  return {
    play: () => head.togglePlay(), earlier: () => head.stepFrame(-1), later: () => head.stepFrame(1), 'impact before': () => head.stepImpact(-1),
    'impact after': () => head.stepImpact(1), 'body before': () => head.selectNext(-1), 'body after': () => head.selectNext(1),
    start: () => head.seek(0), end: () => head.seek(Infinity), frame: () => frame(store.state.selected), 'frame all': () => frame(-1),
    before: () => void (compared && store.set({ showBefore: 'none' })), panel: () => store.set({ panel: !store.state.panel }),
    keys: () => void keysDialog(compared), cancel: () => store.set({ selected: -1, selectedNail: -1 }),
  };
}

/** @param {boolean} compared with a motion before */
export async function keysDialog(compared) {
  const rows = keyTable.filter(({ action }) => looking.has(action) && (compared || action !== 'before')).map(({ action, name, blender }) =>
    el('tr', {}, el('th', { scope: 'row' }, action === 'before' ? 'hold: without the motion before' : name), el('td', {}, ...blender.flatMap((key, i) => [i ? ', ' : '', el('kbd', {}, key)]))));
  await dialog('Keys', [el('table', { class: 'keys' }, el('tbody', {}, ...rows)),
    el('p', { class: 'dim' }, 'Press a path to go to that time. Drag to turn the view, with the right button to move it; the wheel zooms.')],
  (close) => [el('button', { type: 'button', class: 'primary', onclick: () => close('') }, 'Close')]);
}
