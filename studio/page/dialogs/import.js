// SPDX-License-Identifier: MIT
// Files of other programs: an OBJ or glTF file of the folder, or one that the browser chooses; and what differs of it.

import { el } from '../dom.js';
import { forPeople } from '../number_field_text.js';
import { dialog } from './ask.js';
import { meshFiles } from './open.js';

/** @typedef {Pick<import('../file_commands.js').FileCommands, 'tell'>} Asking */
/** @typedef {{path?: string, file?: File, as: string}} Chosen  path: of the folder; as: colliders of a glTF file without physics; '': its physics */

/** How a glTF file without physics is taken. @type {[string, string][]} */
const ways = [['', 'bodies with the physics of the file'], ['hull', 'every mesh as its convex hull'], ['mesh', 'every mesh as it is'], ['box', 'every mesh as a box'], ['sphere', 'every mesh as a ball']];

/** What is to be imported; null: nothing. @param {Asking} commands @param {string} [as] that is chosen at first @returns {Promise<Chosen | null>} */
export async function importDialog(commands, as = '') {
  /** @type {Chosen | null} */
  let chosen = null;
  let close = () => {};
  const way = el('select', { 'aria-label': 'glTF files' }, ...ways.map(([, words]) => el('option', {}, words)));
  way.selectedIndex = Math.max(0, ways.findIndex(([word]) => word === as));
  const end = (/** @type {Omit<Chosen, 'as'>} */ what) => {
    chosen = { ...what, as: ways[way.selectedIndex][0] };
    close();
  };
  const input = el('input', { type: 'file', accept: '.obj,.gltf,.glb', 'aria-label': 'A file of this computer', onchange: () => input.files?.[0] && end({ file: input.files[0] }) });
  const files = await meshFiles(commands, (path) => end({ path }));
  await dialog('Import', [el('label', { class: 'choice' }, 'Of a glTF file', way), files, el('h3', {}, 'A file of this computer'), input], (shut) => {
    close = () => shut('');
    return [el('button', { type: 'button', onclick: close }, 'Cancel')];
  }, 'wide');
  return chosen;
}

/** What an import changed or left out. @param {string} name of what came of it @param {string[]} warnings */
export async function warningsDialog(name, warnings) {
  const title = `Imported ${name}: ${warnings.length === 1 ? 'one thing differs' : `${warnings.length} things differ`}`;
  await dialog(title, [el('ul', { class: 'warnings' }, ...warnings.map((warning) => el('li', {}, forPeople(warning))))], (close) => [
    el('button', { type: 'button', class: 'primary', autofocus: true, onclick: () => close('') }, 'Close')], 'wide');
}

/** Bytes of a part: with its base64 below the limit of a message. */
const partBytes = 600000;

/** Sends a file in parts. @param {Asking} commands @param {File} file @returns {Promise<boolean>} whether all of it is there */
export async function upload(commands, file) {
  for (let at = 0; at === 0 || at < file.size; at += partBytes) {
    const bytes = new Uint8Array(await file.slice(at, at + partBytes).arrayBuffer());
    let text = '';
    for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
    if (!await commands.tell('upload', { name: file.name, at, data: btoa(text) })) return false;
  }
  return true;
}
