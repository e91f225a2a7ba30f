// SPDX-License-Identifier: MIT
// Opening: the example scenes with their pictures, and the scenes of the folder. The empty page shows the same.

import { byId, el } from '../dom.js';
import { dialog } from './ask.js';

/** @typedef {import('../commands.js').Commands} Commands */
/** @typedef {{path: string, name: string, title?: string, notes?: string, picture?: string | null}} GalleryScene */

/** @param {Commands} commands @param {() => void} opened @returns {Promise<HTMLElement | null>} null: nothing came */
async function galleryCards(commands, opened) {
  const answer = await commands.tell('gallery'), grid = el('div', { class: 'gallery' });
  if (!answer) return null;
  for (const scene of /** @type {GalleryScene[]} */ (answer.scenes)) {
    const picture = scene.picture ? el('img', { src: scene.picture, alt: '', loading: 'lazy' }) : el('span', { class: 'no-picture' });
    grid.append(el('button', { type: 'button', class: 'scene', title: scene.notes ?? scene.name, onclick: () => {
      opened();
      void commands.open({ path: scene.path, gallery: true });
    } }, picture, el('span', {}, scene.name)));
  }
  return grid;
}

/** @param {Commands} commands @param {string} path @param {(path: string) => void} enter a folder @param {() => void} opened
 * @returns {Promise<HTMLElement>} */
async function folderList(commands, path, enter, opened) {
  const answer = await commands.tell('list', path ? { path } : {}), list = el('ul', { class: 'files' });
  const above = path.includes('/') ? path.slice(0, path.lastIndexOf('/')) : '';
  if (path) list.append(el('li', {}, el('button', { type: 'button', class: 'row', autofocus: true, onclick: () => enter(above) }, '↑ ..')));
  for (const { path: at, name, kind } of /** @type {{path: string, name?: string, kind: string}[]} */ (answer?.files ?? [])) {
    const open = kind === 'folder' ? () => enter(at) : () => {
      opened();
      void commands.open({ path: at });
    };
    list.append(el('li', {}, el('button', { type: 'button', class: 'row', autofocus: !list.childElementCount, onclick: open }, kind === 'folder' ? '▸ ' : '', name ?? at)));
  }
  if (!answer?.files?.length) list.append(el('li', { class: 'dim' }, 'no scenes here'));
  return list;
}

/** The mesh files of the folder, and of those within it. @param {Pick<Commands, 'tell'>} commands @param {(path: string) => void} choose */
export async function meshFiles(commands, choose) {
  const files = el('div', {});
  /** @param {string} path @returns {Promise<void>} */
  const enter = async (path) => {
    const answer = await commands.tell('list', { meshes: true, ...(path ? { path } : {}) }), above = path.includes('/') ? path.slice(0, path.lastIndexOf('/')) : '';
    const rows = /** @type {{path: string, name: string, kind: string}[]} */ (answer?.files ?? []).map(({ path: at, name, kind }) =>
      el('li', {}, el('button', { type: 'button', class: 'row', onclick: () => (kind === 'folder' ? void enter(at) : choose(at)) }, kind === 'folder' ? '▸ ' : '', name)));
    files.replaceChildren(el('h3', {}, path || 'This folder'), el('ul', { class: 'files' }, ...(path ? [el('li', {}, el('button', { type: 'button', class: 'row', onclick: () => void enter(above) }, '↑ ..'))] : []),
      ...rows, rows.length ? null : el('li', { class: 'dim' }, 'no OBJ or glTF files here')));
  };
  await enter('');
  return files;
}

/** A mesh file of the folder, or of one within it; '' where none is chosen. @param {Commands} commands @returns {Promise<string>} */
export async function meshDialog(commands) {
  /** @type {(path: string) => void} */
  let choose = () => {};
  const files = await meshFiles(commands, (path) => choose(path));
  return dialog('Add a mesh', [files], (end) => {
    choose = end;
    return [el('button', { type: 'button', onclick: () => end('') }, 'Cancel')];
  }, 'wide');
}

/** The scenes of the folder that were opened last; none where there are none. @param {Commands} commands */
async function lastFiles(commands) {
  const answer = await commands.tell('list'), most = 6;
  const names = /** @type {string[]} */ (answer?.recent ?? []).slice(0, most);
  if (!names.length) return null;
  return el('ul', { class: 'files' }, ...names.map((path) => el('li', {}, el('button', { type: 'button', class: 'row', onclick: () => void commands.open({ path }) }, path))));
}

/** @param {Commands} commands */
export async function openDialog(commands) {
  let close = () => {};
  const files = el('div', {}), enter = async (/** @type {string} */ path) => {
    files.replaceChildren(el('h3', {}, path || 'This folder'), await folderList(commands, path, (next) => void enter(next), () => close()));
  };
  const [gallery] = await Promise.all([galleryCards(commands, () => close()), enter('')]);
  await dialog('Open', [files, ...(gallery ? [el('h3', {}, 'Examples'), gallery] : [])], (end) => {
    close = () => end('');
    return [el('button', { type: 'button', onclick: close }, 'Cancel')];
  }, 'wide');
}

/** What is shown where nothing is open: its heading at once, what the server tells of when it comes. What did not come is
 * asked for again when the page is empty the next time, as after a connection that broke.
 * @param {import('../store.js').Store<import('../types.js').State>} store @param {Commands} commands */
export function showEmpty(store, commands) {
  const place = byId('empty'), last = el('section', { hidden: true }), examples = el('section', {});
  const open = el('button', { type: 'button', class: 'primary', onclick: () => void openDialog(commands) }, 'Open a scene…'), make = el('button', { type: 'button', onclick: () => void commands.newScene() }, 'New scene');
  place.replaceChildren(el('h1', {}, 'Open a scene, or start from one of these'), el('div', { class: 'switches' }, open, make), last, examples);
  const fill = async () => {
    const files = await lastFiles(commands);
    last.hidden = !files;
    if (files) last.replaceChildren(el('h2', {}, 'Opened last'), files);
    if (examples.childElementCount) return;
    const gallery = await galleryCards(commands, () => {});
    if (gallery && !examples.childElementCount) examples.replaceChildren(el('h2', {}, 'Examples'), gallery);
  };
  let was_empty = false;
  store.on(['document', 'connected', 'progress'], ({ document, connected, progress }) => {
    const empty = connected === 'open' && document?.open === false && !progress;
    place.hidden = !empty;
    if (empty && !was_empty) void fill();
    was_empty = empty;
  });
}
