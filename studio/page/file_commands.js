// SPDX-License-Identifier: MIT
// What a person can do with files: open, begin, import and save scenes.

import { importDialog, upload, warningsDialog } from './dialogs/import.js';
import { forPeople } from './number_field_text.js';
import { PlayHead } from './play_head.js';

/** @typedef {import('./types.js').State} State */

export class FileCommands extends PlayHead {
  /** @param {{store: import('./store.js').Store<State>, connection: import('./connection.js').Connection,
   *    choose: (question: string, choices: [string, string][]) => Promise<string>, askName: (suggested: string) => Promise<string | null>}} parts */
  constructor({ store, connection, choose, askName }) {
    super(store);
    this.connection = connection;
    this.choose = choose;
    this.askName = askName;
    this.savingWaits = false;
    /** A mesh file of the folder is to be put down. @type {(path: string) => void} */
    this.gotMesh = () => {};
  }

  /** Asks the server; says what went wrong. @param {string} type @param {object} members
   * @returns {Promise<any>} null where it went wrong */
  async tell(type, members = {}) {
    try {
      return await this.connection.request(type, members);
    } catch (error) {
      if (/** @type {any} */ (error).code === 'conflict') throw error;
      this.tellError(/** @type {any} */ (error));
      return null;
    }
  }

  /** @param {import('./connection.js').ServerError} error @param {{name: string, act: () => void}[]} [actions] */
  tellError({ code, message }, actions = []) {
    // that the server is gone has been said, with what that means
    if (code !== 'lost' || this.store.state.notice?.key !== 'lost') this.store.set({ notice: { message, kind: 'red', actions } });
  }

  /** Saves what is verified; in a gesture when that has ended. @param {string} [path] @param {boolean} [replace] @returns {Promise<boolean>} whether the file has it now */
  async save(path, replace = false) {
    const { document, gesture } = this.store.state;
    if (!document?.open) return false;
    if (gesture.state !== 'idle') {
      this.savingWaits = true;
      return false;
    }
    const where = path ?? document.path ?? (await this.askName(document.suggested ?? 'scene.json'));
    if (!where) return false;
    try {
      const answer = await this.tell('save', { ...(path || !document.path ? { path: where } : {}), ...(replace ? { replace } : {}) });
      if (answer) this.store.set({ notice: { message: `Saved ${answer.path}.` } });
      return !!answer;
    } catch (error) {
      const what = await this.choose(/** @type {any} */ (error).message, [['replace', 'Replace the file'], ...(document.path === where ? [/** @type {[string, string]} */ (['theirs', 'Open the file as it is'])] : []), ['other', 'Save as…']]);
      if (what === 'replace') return this.save(where, true);
      if (what === 'theirs') await this.open({ path: where }, true);
      return what === 'other' && this.saveAs();
    }
  }

  /** A save that waited for the end of a gesture. */
  saveIfWaiting() {
    if (!this.savingWaits) return;
    this.savingWaits = false;
    void this.save();
  }

  async saveAs() {
    const { document } = this.store.state, name = await this.askName(document?.path ?? document?.suggested ?? 'scene.json');
    return !!name && this.save(name);
  }

  /** @param {{path: string, gallery?: boolean}} what @param {boolean} [replace] @returns {Promise<void>} */
  async open(what, replace = false) {
    this.store.set({ progress: `Opening ${what.path}…` });
    try {
      await this.tell('open', { ...what, ...(replace ? { replace } : {}) });
    } catch (error) {
      this.store.set({ progress: '' });
      const how = await this.choose(/** @type {any} */ (error).message, [['lose', 'Open, and lose the steps'], ['save', 'Save, then open']]);
      if (how === 'lose') return this.open(what, true);
      if (how === 'save' && await this.save()) return this.open(what);
    }
    this.store.set({ progress: '' });
  }

  /** A scene with a floor and nothing else. @param {boolean} [replace] @returns {Promise<void>} */
  async newScene(replace = false) {
    try {
      await this.connection.request('new', replace ? { replace } : {});
    } catch (error) {
      if (/** @type {any} */ (error).code !== 'conflict') return this.tellError(/** @type {any} */ (error));
      const how = await this.choose(/** @type {any} */ (error).message, [['lose', 'New scene, and lose the steps'], ['save', 'Save, then a new scene']]);
      if (how === 'lose' || (how === 'save' && await this.save())) return this.newScene(how === 'lose');
    }
  }

  /** A file of another program: a scene is opened, a mesh put down by the next press. Where it fails, what is open stays.
   * @param {string} [as] that was chosen before */
  async importFile(as = '') {
    const chosen = await importDialog(this, as);
    if (chosen && (!chosen.file || await upload(this, chosen.file))) await this.importChosen(chosen);
  }

  /** @param {import('./dialogs/import.js').Chosen} chosen @param {boolean} [replace] @returns {Promise<void>} */
  async importChosen(chosen, replace = false) {
    const { path, as, file } = chosen, name = path ?? file?.name ?? '';
    this.store.set({ progress: `Importing ${name}…` });
    try {
      const answer = await this.connection.request('import', { ...(path ? { path } : {}), ...(as ? { as } : {}), ...(replace ? { replace } : {}) });
      this.store.set({ progress: '' });
      if (answer.warnings.length) await warningsDialog(answer.path, answer.warnings);
      if (answer.mesh && !this.store.state.document?.open) await this.newScene();
      if (answer.mesh) this.gotMesh(answer.path);
      else this.store.set({ notice: { message: `Imported as ${answer.path}.` } });
    } catch (error) {
      this.store.set({ progress: '' });
      if (/** @type {any} */ (error).code !== 'conflict') return this.tellImport(/** @type {any} */ (error), as);
      const how = await this.choose(/** @type {any} */ (error).message, [['lose', 'Import, and lose the steps'], ['save', 'Save, then import']]);
      if (how === 'lose' || (how === 'save' && await this.save())) return this.importChosen(chosen, how === 'lose');
    }
  }

  /** Why nothing was imported. @param {import('./connection.js').ServerError} error @param {string} as that was chosen */
  tellImport({ code, message }, as) {
    const words = forPeople(message).replace(/; --as .*$/, '; its meshes can be taken as hulls, meshes, boxes or balls');
    this.tellError({ code, message: words }, [{ name: 'Import another way', act: () => void this.importFile(as || 'hull') }]);
  }
}
