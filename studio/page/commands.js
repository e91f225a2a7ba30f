// SPDX-License-Identifier: MIT
// What a person can do besides dragging: called by keys, buttons and menus alike.

import { hitAt } from './take.js';
import { moves } from './motion.js';

/** @typedef {import('./types.js').State} State */
/** @typedef {import('./types.js').Constraint} Constraint */

export class Commands {
  /** @param {{store: import('./store.js').Store<State>, connection: import('./connection.js').Connection,
   *    gesture: import('./gesture.js').Gesture, view: {frame: (body: number) => void},
   *    ask: (question: string, yes: string) => Promise<boolean>,
   *    choose: (question: string, choices: [string, string][]) => Promise<string>, askName: (suggested: string) => Promise<string | null>}} parts */
  constructor({ store, connection, gesture, view, ask, choose, askName }) {
    this.store = store;
    this.connection = connection;
    this.gesture = gesture;
    this.view = view;
    this.ask = ask;
    this.choose = choose;
    this.askName = askName;
    this.savingWaits = false;
  }

  /** Asks the server; says what went wrong. @param {string} type @param {object} members
   * @returns {Promise<any>} null where it went wrong */
  async tell(type, members = {}) {
    try {
      return await this.connection.request(type, members);
    } catch (error) {
      if (/** @type {any} */ (error).code === 'conflict') throw error;
      this.store.set({ notice: { message: /** @type {any} */ (error).message, kind: 'red' } });
      return null;
    }
  }

  async undo() {
    if (this.gesture.cancel()) return;
    this.store.set({ card: null, changesShown: false, before: null, notice: this.withoutChanges() });
    await this.tell('undo');
  }

  /** Steps that had not been saved came back with the scene. @param {number} steps */
  tellRecovered(steps) {
    const close = () => this.store.set({ notice: null });
    this.store.set({ notice: {
      message: `${steps === 1 ? '1 step' : `${steps} steps`} recovered that had not been saved.`, kind: 'amber', key: 'recovered',
      actions: [{ name: 'Keep', act: close }, { name: 'Back', act: () => (close(), void this.undoAll()) }],
    } });
  }

  /** Back to the scene as it was opened; redo brings the steps again. */
  async undoAll() {
    while (this.store.state.document?.undo && await this.tell('undo')) await this.changed();
  }

  /** Until the document of the last answer is there. */
  changed() {
    const { rev } = this.store.state.motion ?? { rev: 0 };
    return new Promise((/** @type {(value?: unknown) => void} */ done) => {
      let end = () => {};
      end = this.store.on(['document'], ({ document }) => {
        if ((document?.rev ?? 0) < rev) return;
        done();
        setTimeout(() => end());
      });
    });
  }

  async redo() {
    this.store.set({ card: null, changesShown: false, before: null, notice: this.withoutChanges() });
    await this.tell('redo');
  }

  withoutChanges() {
    return this.store.state.notice?.key === 'changes' ? null : this.store.state.notice;
  }

  async meetNails() {
    this.store.set({ before: this.store.state.motion, changesShown: false, card: null });
    const answer = await this.tell('meet_nails');
    if (answer) this.gesture.ended('released', answer, false);
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

  /** Nails the selected body where it is. */
  async nailHere() {
    const { selected, document, motion, time } = this.store.state, body = document?.bodies[selected];
    if (!body || body.fixed || !motion) return this.store.set({ notice: { message: 'Select a moving body to nail it.' } });
    await this.tell('nail', { body: body.name, at: Math.min(time, motion.end) });
  }

  /** Removes the chosen nail. */
  async removeNail(id = this.store.state.selectedNail) {
    if (id >= 0) await this.tell('unnail', { nail: id });
  }

  /** @param {number} nail @param {Constraint} constraint */
  async setNail(nail, constraint) {
    this.store.set({ before: this.store.state.motion, card: null });
    const answer = await this.tell('set_nail', { nail, constraint });
    if (answer) this.gesture.ended('released', answer, false);
  }

  /** @param {import('./types.js').Control[]} controls all of them from now on */
  async setControls(controls) {
    await this.tell('controls', { rev: this.store.state.document?.rev ?? 0, controls });
  }

  /** @param {string} pointer @param {unknown} value */
  async setValue(pointer, value) {
    await this.tell('set', { rev: this.store.state.document?.rev ?? 0, edits: [{ pointer, value }] });
  }

  /** @param {'move' | 'turn'} tool takes the selected body, or shows its handles */
  hold(tool) {
    const { selected, motion, time, gesture } = this.store.state;
    this.store.set({ tool });
    if (selected < 0 || !motion || gesture.state !== 'idle') return;
    this.gesture.beginByKey(hitAt(motion, selected, Math.min(time, motion.end)), tool);
  }

  /** @param {number} step */
  selectNext(step) {
    const { motion, scene, selected } = this.store.state;
    const moving = motion?.tracks.filter((t) => !scene?.shapes[t.body]?.fixed && moves(t)).map((t) => t.body) ?? [];
    if (!moving.length) return;
    const i = moving.indexOf(selected);
    this.store.set({ selected: i < 0 ? moving[0] : moving[(i + step + moving.length) % moving.length], selectedNail: -1 });
  }

  /** @param {number} time s */
  seek(time) {
    const end = this.store.state.motion?.end ?? 0;
    this.store.set({ time: Math.max(0, Math.min(end, time)), playing: false });
  }

  /** @param {number} step in frames */
  stepFrame(step) {
    const { time, dots } = this.store.state, rate = dots || 24;
    this.seek((step > 0 ? Math.floor(time * rate + 1e-6) + step : Math.ceil(time * rate - 1e-6) + step) / rate);
  }

  /** @param {1 | -1} step */
  stepImpact(step) {
    const { motion, time, selected } = this.store.state;
    const times = motion?.impacts.filter((one) => selected < 0 || one.bodies.includes(selected)).map((one) => one.t) ?? [];
    const next = step > 0 ? times.find((t) => t > time + 1e-6) : times.findLast((t) => t < time - 1e-6);
    if (next !== undefined) this.seek(next);
  }

  togglePlay() {
    const { playing, motion, time } = this.store.state;
    if (!motion) return;
    this.store.set({ playing: !playing, ...(!playing && time >= motion.end - 1e-9 ? { time: 0 } : {}) });
  }
}
