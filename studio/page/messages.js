// SPDX-License-Identifier: MIT
// What the server says, taken into the store.

import { changesText } from './changes.js';
import { motionOf, shapesOf } from './frames.js';
import { timeOf } from './motion.js';
import { closedDocument, nothingOfAScene } from './store.js';

/** @typedef {import('./types.js').State} State */
/** @typedef {{store: import('./store.js').Store<State>, gesture: () => import('./gesture.js').Gesture | null,
 *    opened: () => void, drawn?: () => void, recovered: (steps: number, repairs: string[]) => void}} Parts `opened`: another scene is shown; `drawn`: a path goes along a drawn curve;
 *    `recovered`: it came with steps that had not been saved, or mesh files that were repaired */

/** @param {Parts} parts @returns {import('./connection.js').Listener} */
export function listener({ store, gesture, opened, recovered, drawn = () => {} }) {
  // whose scene is shown, and whether the motion that comes next is its first one
  let session = '', scene = NaN, first = false, told = '';

  /** @param {any} message */
  const welcome = (message) => {
    const restarted = session !== '' && session !== message.session, back = session === message.session;
    session = message.session;
    if (!back) scene = NaN;
    const notice = restarted ? { message: 'The server was started again.', kind: /** @type {const} */ ('amber') }
      : back && store.state.notice?.key === 'lost' ? null : store.state.notice;
    store.set({ connected: 'loading', folder: message.folder, notice });
  };

  /** Without a scene it has few members. @param {Partial<import('./types.js').DocumentState>} message */
  const state = (message) => {
    const was = store.state.document, was_saved = was?.saved, document = { ...closedDocument, ...message };
    if (!document.open) {
      scene = NaN;
      store.set({ ...nothingOfAScene(), document, connected: 'open', progress: '' });
      return;
    }
    store.set({ document, connected: 'open', progress: '', ...(was?.open && !sameBodies(was, document) ? ofOtherBodies(store.state, was, document) : {}) });
    if (document.saved && (!was_saved || !store.state.savedMotion)) store.set({ savedMotion: store.state.motion });
    if (told !== `${session} ${scene}` && (document.recovered || document.repairs?.length)) recovered(document.recovered ?? 0, document.repairs ?? []);
    told = `${session} ${scene}`;
    if (!document.nails.some((nail) => nail.id === store.state.selectedNail)) store.set({ selectedNail: -1 });
  };

  /** @param {any} message */
  const error = (message) => {
    gesture()?.failed(message.re);
    if (message.re === undefined) store.set({ notice: { message: message.message, kind: 'red' } });
  };

  /** What would help, as far as it is known. @param {any} message */
  const why = ({ rev, more, cancelled, sentence, remedies }) => {
    const { card, motion } = store.state;
    if (card?.key !== 'why' || rev !== motion?.rev) return;
    store.set({ card: cancelled ? { ...card, searching: false } : { ...card, message: card.message.includes(sentence) ? card.message : `${card.message} ${sentence}`, remedies, searching: more } });
  };

  /** How far the search for a face that is up has come. @param {any} message */
  const faceUp = ({ more, tried, found, cancelled, message }) => {
    const { facing, document } = store.state;
    if (!facing?.searching) return;
    if (more) return store.set({ facing: { ...facing, tried } });
    const name = document?.bodies[facing.body]?.name;
    store.set({ facing: null });
    if (!cancelled) store.set({ notice: found ? { message: `'${name}' comes to rest with ${facing.name} up.` } : { message, kind: 'amber' } });
  };

  /** How far a path has come along a drawn curve; the curve of the answer is drawn by its nails. @param {any} message */
  const sketch = ({ more, cancelled, message }) => {
    if (more || !store.state.sketch?.searching) return;
    store.set({ sketch: null, ...(cancelled ? { before: null } : {}) });
    if (cancelled) return;
    if (message) return store.set({ notice: { message, kind: 'amber' } });
    drawn();
  };

  /** Another motion that meets the same. @param {import('./frames.js').Frame} frame */
  const another = (frame) => {
    const { others } = store.state, { rev, index, size, other_impacts: impacts } = frame.header;
    if (others && others.rev === rev) store.set({ others: { ...others, list: [...others.list, { index, motion: motionOf(frame, null), size, impacts }] } });
  };

  return {
    status(status, why) {
      if (status === 'open') return;
      if (status === 'ended') return store.set({ connected: 'ended', notice: { message: why, kind: 'red' } });
      if (status === 'connecting') return store.state.connected === 'lost' ? undefined : store.set({ connected: 'connecting' });
      const held = gesture()?.lost();
      store.set({ connected: 'lost', playing: false });
      const saying = `The server is gone${held ? '; the drag was cancelled' : ''}. Every step that was shown as done is kept beside the scene: where the server was ended, ` +
        'start carom studio with the scene again. This page finds it by itself…';
      store.set({ notice: { message: why || saying, kind: 'amber', key: 'lost' } });
    },
    message(message) {
      if (message.type === 'welcome') welcome(message);
      else if (message.type === 'state') state(message);
      else if (message.type === 'error') error(message);
      else if (message.type === 'notice') store.set({ notice: { message: message.message } });
      else if (message.type === 'progress') store.set({ progress: message.message });
      else if (message.type === 'why') why(message);
      else if (message.type === 'face_up') faceUp(message);
      else if (message.type === 'sketch') sketch(message);
    },
    frame(frame) {
      if (frame.header.type === 'scene') {
        const other = frame.header.scene !== scene;
        const shapes = shapesOf(frame, other ? null : store.state.scene);
        if (other) first = true;
        scene = frame.header.scene;
        const { notice } = store.state, stays = notice && (notice.kind ?? 'plain') !== 'plain' ? notice : null;
        store.set({ ...(other ? { ...nothingOfAScene(), notice: stays } : {}), scene: shapes });
        return;
      }
      if (frame.header.type === 'alternative') return another(frame);
      if (frame.header.type !== 'motion') return;
      if (frame.header.scene !== scene) throw new Error(`a motion is of scene ${frame.header.scene}, and scene ${scene} is shown`);
      const motion = motionOf(frame, first ? null : store.state.motion), is_first = first;
      first = false;
      store.set({ motion, time: timeShown(store.state, motion), ...(is_first ? { opened: motion, savedMotion: motion } : {}) });
      gesture()?.answered(motion);
      if (is_first) opened();
    },
  };
}

/** @param {import('./types.js').DocumentState} a @param {import('./types.js').DocumentState} b */
const sameBodies = (a, b) => a.bodies.length === b.bodies.length && a.bodies.every((body, i) => body.name === b.bodies[i].name);

/** Bodies came, went or have other names: motions of before have other bodies, and the selected one is found by its name, or it
 * is the one that came. @param {State} state @param {import('./types.js').DocumentState} was @param {import('./types.js').DocumentState} now */
function ofOtherBodies({ motion, selected }, was, now) {
  const name = was.bodies[selected]?.name, came = now.bodies.findIndex((body) => !was.bodies.some((other) => other.name === body.name));
  const stayed = now.bodies.findIndex((body) => body.name === name);
  return { bodiesAsOpened: false, before: null, opened: motion, savedMotion: null, changesShown: false, hover: null, selected: came >= 0 ? came : stayed };
}

/** The play head stays, but goes with an impact or a rest that is held, whose time changes. @param {State} state
 * @param {import('./types.js').Motion} motion */
function timeShown({ document, gesture: { state, hit }, time }, motion) {
  const held = state !== 'idle' && document && (hit?.kind === 'impact' || hit?.kind === 'rest') ? timeOf(hit.at, hit.body, motion, document.bodies.map((body) => body.name)) : null;
  return Math.min(held ?? time, motion.end);
}

/** What a person is told when a gesture came to its end. @param {import('./store.js').Store<State>} store
 * @param {{undo: () => void, askWhy: (rev: number) => void}} commands @param {any} answer header of the motion */
export function tellEnding(store, commands, answer) {
  const { motion } = store.state;
  if (!motion || !store.state.document) return;
  const missed = answer.reached === false;
  store.set({ card: missed ? { message: whyNot(motion), kind: 'amber', key: 'why', searching: true } : null });
  if (missed) commands.askWhy(motion.rev);
  tellChanges(store, commands);
}

/** Who meets whom more or less often than before. @param {import('./store.js').Store<State>} store @param {{undo: () => void}} commands */
export function tellChanges(store, commands) {
  const { before, motion, document } = store.state, names = document?.bodies.map((body) => body.name) ?? [];
  const changed = before && motion ? changesText(before, motion, names) : '';
  if (!changed) return;
  store.set({
    notice: {
      message: changed, key: 'changes',
      actions: [
        { name: 'Show', act: () => store.set({ changesShown: !store.state.changesShown }) },
        { name: 'Undo', act: commands.undo },
      ],
    },
  });
}

/** One sentence. @param {import('./types.js').Motion} motion */
function whyNot({ obstacle, stopped }) {
  if (obstacle?.kind === 'nails') return `${obstacle.sentence} Switch one off, or one of its x, y, z.`;
  if (obstacle?.sentence) return obstacle.sentence;
  return stopped ? 'It was stopped before it reached its target.' : 'It did not reach its target.';
}
