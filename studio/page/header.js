// SPDX-License-Identifier: MIT
// The bar on top: file menu, what is open, undo and redo by name, save; and the tools beside the view.

import { additions } from './build.js';
import { byId, el } from './dom.js';
import { exportDialog } from './dialogs/export.js';
import { meshDialog, openDialog } from './dialogs/open.js';
import { keysDialog } from './dialogs/keys.js';
import { moveDialog, tableDialog } from './dialogs/table.js';

/** @typedef {import('./types.js').State} State */

/** @param {import('./store.js').Store<State>} store @param {import('./commands.js').Commands} commands
 * @param {import('./gesture.js').Gesture} gesture @param {import('./dialogs/export.js').Pictures} pictures of what is seen */
export function showHeader(store, commands, gesture, pictures) {
  const undo = button('undo', () => void commands.undo()), redo = button('redo', () => void commands.redo());
  const save = button('save', () => void commands.save());
  button('help', () => void keysDialog(store));
  button('file', () => undefined);
  showMenu(store, commands, gesture, pictures);
  showAdding(store, commands);
  store.on(['document', 'connected'], ({ document, connected }) => {
    const usable = connected === 'open' && !!document?.open;
    names(undo, 'Undo', document?.undo ?? null, usable);
    names(redo, 'Redo', document?.redo ?? null, usable);
    save.disabled = !usable;
    const name = document?.open ? (document.path ?? (document.name || document.suggested || 'not saved yet')) : '';
    byId('document').textContent = name.slice(name.lastIndexOf('/') + 1);
    byId('document').title = name;
    byId('unsaved').hidden = !document?.open || document.saved;
    globalThis.document.title = name ? `${document?.saved ? '' : '● '}${name} – carom` : 'carom';
  });
  showTools(store, commands);
}

/** @param {string} id @param {() => void} act */
function button(id, act) {
  const element = /** @type {HTMLButtonElement} */ (byId(id));
  element.addEventListener('click', act);
  return element;
}

/** @param {HTMLButtonElement} element @param {string} word @param {string | null} what @param {boolean} usable */
function names(element, word, what, usable) {
  element.disabled = !usable || what === null;
  const name = what ? `${word}: ${what}` : word;
  element.title = name;
  element.setAttribute('aria-label', name);
}

/** @param {import('./store.js').Store<State>} store @param {import('./commands.js').Commands} commands
 * @param {import('./gesture.js').Gesture} gesture @param {import('./dialogs/export.js').Pictures} pictures */
function showMenu(store, commands, gesture, pictures) {
  const menu = byId('menu');
  /** @type {[string, () => void][]} */
  const rows = [
    ['New scene', () => void commands.newScene()], ['Open…', () => void openDialog(commands)], ['Save', () => void commands.save()], ['Save as…', () => void commands.saveAs()], ['Import…', () => void commands.importFile()], ['Export…', () => void exportDialog(store, commands, pictures)],
    ['Move to…', () => void moveDialog(store, gesture)], ['Motion as a table', () => void tableDialog(store)], ['Keys', () => void keysDialog(store)],
  ];
  for (const [name, act] of rows) {
    menu.append(el('button', { type: 'button', class: 'row', onclick: () => {
      menu.hidePopover();
      act();
    } }, name));
  }
  goThrough(menu, byId('file'));
  menu.append(choice(store, 'Paths', 'showBefore', [['none', 'of now alone'], ['opened', 'and as opened'], ['saved', 'and as saved']]),
    choice(store, 'Dots a second', 'dots', [[24, '24'], [30, '30'], [60, '60'], [0, 'none']]),
    choice(store, 'Drawing', 'quality', [['high', 'fine'], ['low', 'fast']]),
    choice(store, 'Keys like', 'keymap', [['blender', 'Blender'], ['maya', 'Maya']]));
}

/** @template {keyof State} K @param {import('./store.js').Store<State>} store @param {string} name @param {K} key
 * @param {[State[K], string][]} options */
function choice(store, name, key, options) {
  const select = el('select', { onchange: () => store.set(/** @type {Partial<State>} */ ({ [key]: options[select.selectedIndex][0] })) },
    ...options.map(([, text]) => el('option', {}, text)));
  store.on([key], (state) => (select.selectedIndex = Math.max(0, options.findIndex(([value]) => value === state[key]))));
  return el('label', { class: 'choice' }, name, select);
}

/** Arrow keys go through a menu, Escape leaves it. @param {HTMLElement} menu @param {HTMLElement} opener */
function goThrough(menu, opener) {
  const rows = () => [...menu.querySelectorAll('button, select')].map((one) => /** @type {HTMLElement} */ (one));
  menu.addEventListener('toggle', (event) => {
    if (/** @type {ToggleEvent} */ (event).newState === 'open') rows()[0]?.focus();
  });
  menu.addEventListener('keydown', (event) => {
    const all = rows(), at = all.indexOf(/** @type {HTMLElement} */ (document.activeElement));
    const next = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: all.length - 1 }[event.key];
    if (event.key !== 'Tab') event.stopPropagation();  // no key of the view
    if (event.key === 'Escape') opener.focus();
    if (next === undefined || document.activeElement?.tagName === 'SELECT') return;
    event.preventDefault();
    all[(next + all.length) % all.length]?.focus();
  });
}

/** What can be added, by a press on a surface. @param {import('./store.js').Store<State>} store @param {import('./commands.js').Commands} commands */
function showAdding(store, commands) {
  const menu = byId('add-menu'), add = byId('add');
  const begin = (/** @type {number} */ adding, /** @type {string} */ name, mesh = '') => commands.beginAdding(adding, name, mesh);
  const row = (/** @type {string} */ name, /** @type {() => void} */ act) => el('button', { type: 'button', class: 'row', onclick: () => (menu.hidePopover(), act()) }, name);
  menu.append(...additions.map(([name], i) => row(name, () => begin(i, name.toLowerCase()))), row('Mesh file…', async () => {
    const file = await meshDialog(commands);
    if (file) commands.addMesh(file);
  }));
  goThrough(menu, add);
  store.on(['document', 'connected'], ({ document, connected }) => (add.hidden = connected !== 'open' || !document?.open));
  store.on(['adding'], ({ adding, notice }) => {
    if (adding >= 0) byId('overlay').focus();
    byId('overlay').classList.toggle('adding', adding >= 0);
    if (adding < 0 && notice?.key === 'adding') store.set({ notice: null });
  });
}

/** @param {import('./store.js').Store<State>} store @param {import('./commands.js').Commands} commands */
function showTools(store, commands) {
  const move = button('tool-move', () => store.set({ tool: 'move' })), throwing = button('tool-throw', () => commands.aimThrow()), turn = button('tool-turn', () => store.set({ tool: 'turn' })), face = button('tool-face', () => store.set({ tool: 'face' })), pen = button('tool-pen', () => store.set({ tool: 'pen' }));
  button('tool-nail', () => void commands.nailHere());
  const nailing = button('nail-on-release', () => store.set({ nailOnRelease: !store.state.nailOnRelease }));
  const free = button('leave-rest-free', () => store.set(store.state.tool === 'turn' ? { turnLeavesPlace: !store.state.turnLeavesPlace } : { leaveRestFree: !store.state.leaveRestFree }));
  store.on(['tool', 'nailOnRelease', 'leaveRestFree', 'turnLeavesPlace'], ({ tool, nailOnRelease, leaveRestFree, turnLeavesPlace }) => {
    move.setAttribute('aria-pressed', String(tool === 'move'));
    turn.setAttribute('aria-pressed', String(tool === 'turn'));
    throwing.setAttribute('aria-pressed', String(tool === 'throw'));
    face.setAttribute('aria-pressed', String(tool === 'face'));
    pen.setAttribute('aria-pressed', String(tool === 'pen'));
    byId('overlay').classList.toggle('pen', tool === 'pen');
    nailing.setAttribute('aria-pressed', String(nailOnRelease));
    free.setAttribute('aria-pressed', String(tool === 'turn' ? turnLeavesPlace : leaveRestFree));
    free.title = tool === 'turn' ? 'Turns leave the place free' : 'Drags along an axis leave the rest free';
  });
}
