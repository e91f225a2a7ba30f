// SPDX-License-Identifier: MIT
// What a person can do besides dragging: called by keys, buttons and menus alike.

import { FileCommands } from './file_commands.js';
import { additions, fileFrom, nameOfFile } from './build.js';
import { tellChanges } from './messages.js';
import { lengthText } from './number_field_text.js';
import { curvesOf } from './overlay/sketches.js';
import { hitAt } from './take.js';

/** @typedef {import('./types.js').State} State */
/** @typedef {import('./types.js').Constraint} Constraint */

export class Commands extends FileCommands {
  /** @param {{store: import('./store.js').Store<State>, connection: import('./connection.js').Connection,
   *    gesture: import('./gesture.js').Gesture, view: {frame: (body: number) => void},
   *    ask: (question: string, yes: string) => Promise<boolean>,
   *    choose: (question: string, choices: [string, string][]) => Promise<string>, askName: (suggested: string) => Promise<string | null>}} parts */
  constructor({ store, connection, gesture, view, ask, choose, askName }) {
    super({ store, connection, choose, askName });
    this.gesture = gesture;
    this.view = view;
    this.ask = ask;
    this.gotMesh = (/** @type {string} */ path) => this.addMesh(path);
  }

  async undo() {
    if (this.gesture.cancel()) return;
    this.store.set({ card: null, changesShown: false, before: null, notice: this.withoutChanges() });
    await this.tell('undo');
  }

  /** Steps that had not been saved came back with the scene, or mesh files of it were repaired.
   * @param {number} steps @param {string[]} repairs sentences */
  tellRecovered(steps, repairs) {
    const close = () => this.store.set({ notice: null }), others = repairs.length - 1;
    const repaired = repairs.length ? `${repairs[0]}${others > 0 ? `, and ${others} more` : ''}.` : '';
    if (!steps) return this.store.set({ notice: { message: repaired, kind: 'amber', key: 'repaired' } });
    this.store.set({ notice: {
      message: `${steps === 1 ? '1 step' : `${steps} steps`} recovered that had not been saved. ${repaired}`.trim(), kind: 'amber', key: 'recovered',
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

  /** What would help where the last gesture did not reach its target; the answers come into the card. @param {number} rev */
  async askWhy(rev) {
    await this.connection.request('why', { rev }).catch(() => this.store.state.card?.key === 'why' && this.store.set({ card: { ...this.store.state.card, searching: false } }));
  }

  /** @param {string} name of a remedy */
  async takeRemedy(name) {
    const { motion } = this.store.state;
    this.store.set({ before: motion, changesShown: false, card: null });
    if (await this.tell('remedy', { rev: motion?.rev ?? 0, name })) tellChanges(this.store, { undo: () => void this.undo() });
  }

  /** Looks for a throw with which the face that was chosen is up, where that is to be; the answers come into `facing`. */
  async faceUp() {
    const { facing, document, motion, nailOnRelease } = this.store.state;
    if (!facing || !document) return;
    this.store.set({ facing: { ...facing, searching: true }, before: motion, changesShown: false });
    const { up, place } = facing, nail = nailOnRelease ? { nail: true } : {};
    const members = { body: document.bodies[facing.body].name, up, ...(place ? { place: place.slice(0, 2) } : {}), ...nail };
    if (!await this.build('face_up', members)) this.store.set({ facing: null });
  }

  /** Looks for a path along the curve that was drawn. */
  async sketchPath() {
    const { sketch, document, motion } = this.store.state;
    if (!sketch || !document) return;
    this.store.set({ sketch: { ...sketch, searching: true }, before: motion, changesShown: false });
    const members = { body: document.bodies[sketch.body].name, from: sketch.from, places: sketch.places };
    if (!await this.build('sketch', members)) this.store.set({ sketch: null, before: null });
  }

  /** What came of a sketch. */
  tellSketch() {
    const { document } = this.store.state, curve = curvesOf((document?.nails ?? []).map((nail) => ({ nail }))).at(-1);
    if (!curve) return;
    const off = Math.max(...curve.map(({ nail }) => nail.error)), { body } = curve[0].nail.constraint;
    this.store.set({ notice: { message: `'${body}' goes along the curve, at most ${lengthText(off)} off it.`, key: 'sketched', actions: [{ name: 'Undo', act: () => void this.undo() }] } });
  }

  /** Looks for other motions that meet the same. */
  async findOthers() {
    const rev = this.store.state.motion?.rev ?? 0, { gesture } = this.store.state;
    if (gesture.state !== 'idle') return;
    this.store.set({ others: { rev, list: [], searching: true, message: '', taken: -1, taking: false }, preview: null, card: null });
    const answer = await this.tell('alternatives', { rev, count: 6 }), { others } = this.store.state;
    if (others?.rev !== rev || !others.searching) return;
    this.store.set({ others: answer && !answer.cancelled ? { ...others, searching: false, message: answer.message } : null });
  }

  /** @param {number} index of another motion */
  async takeOther(index) {
    const { others, motion } = this.store.state;
    if (!others || others.taking) return;
    this.store.set({ others: { ...others, taking: true }, before: motion, changesShown: false, preview: null });
    const answer = await this.tell('adopt', { rev: others.rev, index });
    this.store.set({ others: answer ? { ...others, rev: answer.rev, taken: index, taking: false } : null });
    if (answer) tellChanges(this.store, { undo: () => void this.undo() });
  }

  /** @param {import('./types.js').Control[]} controls all of them from now on */
  async setControls(controls) {
    await this.tell('controls', { rev: this.store.state.document?.rev ?? 0, controls });
  }

  /** @param {string} pointer @param {unknown} value */
  async setValue(pointer, value) {
    await this.build('set', { edits: [{ pointer, value }] });
  }

  /** Asks for a change of the scene; where bodies would overlap, offers the nearest free place. @param {string} type @param {object} members
   * @returns {Promise<any>} null where it went wrong */
  async build(type, members = {}) {
    try {
      return await this.connection.request(type, { rev: this.store.state.document?.rev ?? 0, ...members });
    } catch (error) {
      this.tellOverlap(/** @type {any} */ (error));
      return null;
    }
  }

  /** @param {import('./connection.js').ServerError & {body?: string, place?: import('./types.js').Vec3}} error */
  tellOverlap(error) {
    const { body, place } = error;
    const { bodies } = this.store.state.document ?? { bodies: [] }, i = bodies.findIndex((one) => one.name === body);
    const there = { name: 'Put it where there is room', act: () => {
      this.store.set({ notice: null });
      void this.setValue(`/bodies/${i}/position`, place);
    } };
    this.tellError(error, place && i >= 0 ? [there] : []);
  }

  /** The arrow of the selected body's velocity, where that is: at the start. */
  aimThrow() {
    this.store.set({ tool: 'throw' });
    this.seek(0);
    if (this.store.state.selected < 0) this.store.set({ notice: { message: 'Select a body: the arrow at its start is its velocity.' } });
  }

  /** @param {object} body as in documents @param {import('./build.js').Surface | null} on */
  async addBody(body, on) {
    const material = this.store.state.document?.materials?.[0]?.name;
    await this.build('add_body', { body: { ...body, ...(material ? { material } : {}) }, ...(on ? { on } : {}) });
  }

  /** The next press puts this down. @param {number} adding @param {string} name @param {string} [mesh] its file, as the document names it */
  beginAdding(adding, name, mesh = '') {
    this.store.set({ adding, mesh, selected: -1, notice: { message: `Press where the ${name} is to stand; Enter: in the middle; Esc: nowhere.`, key: 'adding' } });
  }

  /** @param {string} file of the folder */
  addMesh(file) {
    this.beginAdding(additions.length, nameOfFile(file), fileFrom(file, this.store.state.document?.path ?? null));
  }

  /** @param {string} name */
  removeBody = (name) => this.build('remove_body', { body: name });
  /** @param {string} name */
  copyBody = (name) => this.build('copy_body', { body: name });
  /** @param {string} body @param {string} name */
  renameBody = (body, name) => this.build('rename_body', { body, name });

  /** A fixed body has no throw. @param {number} i @param {boolean} fixed */
  fixBody(i, fixed) {
    const at = `/bodies/${i}`, still = [0, 0, 0], { mass } = this.store.state.document?.bodies[i] ?? {};
    return this.build('set', { edits: [{ pointer: `${at}/fixed`, value: fixed },
      ...(fixed ? [{ pointer: `${at}/velocity`, value: still }, { pointer: `${at}/angular_velocity`, value: still }] : mass ? [] : [{ pointer: `${at}/density`, value: 600 }])] });
  }

  /** @param {'move' | 'turn'} tool takes the selected body, or shows its handles */
  hold(tool) {
    const { selected, motion, time, gesture } = this.store.state;
    this.store.set({ tool });
    if (selected < 0 || !motion || gesture.state !== 'idle') return;
    this.gesture.beginByKey(hitAt(motion, selected, Math.min(time, motion.end)), tool);
  }
}
