// SPDX-License-Identifier: MIT
// What screen readers hear: what is selected, where the play head is, how a drag stands, what a step did, what was undone.

import { byId, el } from './dom.js';
import { centreAt, lyingOn } from './motion.js';
import { offText } from './live.js';
import { forPeople } from './number_field_text.js';

/** @typedef {import('./types.js').State} State */

const kept = 6;
/** ms: what goes on changing is said when it stops. */
const calm = 400;

/** Says a sentence; those before it that have not been read stay. @param {string} words */
export function say(words) {
  const live = byId('live');
  if (!words) return;
  live.append(el('p', {}, words));
  while (live.childElementCount > kept) live.firstElementChild?.remove();
}

/** @param {State['tool']} tool */
const toolName = (tool) => ({ move: 'Move', turn: 'Turn', throw: 'Throw', face: 'Face up', pen: 'Pen' })[tool];

/** Where a body is, and what it lies on. @param {State} state */
export function whereText({ motion, document, selected, time }) {
  const body = document?.bodies[selected], track = motion?.tracks[selected];
  if (!motion || !document || !body || !track) return '';
  const at = Math.min(time, motion.end), place = centreAt(track, at).map((c) => c.toFixed(3)).join(', ');
  const lies = lyingOn(motion, selected, at, document.bodies.map(({ name }) => name));
  const met = motion.impacts.find((one) => Math.abs(one.t - at) < 1e-9 && one.bodies.includes(selected));
  const whom = met?.pairs.flatMap(([a, b]) => (a === selected ? [b] : b === selected ? [a] : [])).map((i) => document.bodies[i].name) ?? [];
  return [body.name, `${at.toFixed(3)} s`, ...(whom.length ? [`impact with ${[...new Set(whom)].join(', ')}`] : []), `at ${place} m`, ...(lies ? [lies] : [])].join(', ');
}

/** What a step did. @param {import('./types.js').DocumentState} was @param {import('./types.js').DocumentState} now */
export function stepText(was, now) {
  if (!was.open || !now.open || now.rev === was.rev) return '';
  if (was.undo && now.redo === was.undo && now.redo !== was.redo) return `Undone: ${forPeople(was.undo)}.`;
  if (was.redo && now.undo === was.redo && now.redo !== was.redo) return `Done again: ${forPeople(was.redo)}.`;
  return now.undo ? `Done: ${forPeople(now.undo)}.` : '';
}

/** @param {import('./store.js').Store<State>} store */
export function speak(store) {
  /** @type {Map<string, ReturnType<typeof setTimeout>>} */
  const waiting = new Map();
  const later = (/** @type {string} */ what, /** @type {() => string} */ words) => {
    clearTimeout(waiting.get(what));
    waiting.set(what, setTimeout(() => say(words()), calm));
  };
  let was = store.state;
  /** @param {(keyof State)[]} keys @param {(now: State, was: State) => void} act */
  const on = (keys, act) => {
    let before = store.state;
    store.on(keys, (now) => {
      const last = before;
      before = now;
      if (last !== now) act(now, last);
    });
  };
  on(['selected', 'time'], (now, last) => {
    if (now.playing || now.gesture.state !== 'idle' || now.selected < 0) return;
    if (now.selected !== last.selected || now.time !== last.time) later('where', () => whereText(store.state));
  });
  on(['tool'], ({ tool }) => say(`${toolName(tool)}.`));
  on(['playing'], ({ playing, time }) => say(playing ? 'Playing.' : `Stopped at ${time.toFixed(3)} s.`));
  on(['document'], (now) => {
    if (was.document && now.document) say(stepText(was.document, now.document));
    was = now;
  });
  on(['gesture'], ({ gesture, document, selected }, last) => {
    const name = document?.bodies[selected]?.name ?? '';
    if (gesture.state === 'dragging' && last.gesture.state !== 'dragging' && last.gesture.state !== 'typing') say(`Holding ${name}. Arrow keys move it, Enter lets go, Escape puts it back.`);
    if (gesture.state === 'settling' && gesture.settlingShown && !last.gesture.settlingShown) say('Settling.');
    if (gesture.state === 'dragging' && gesture.answered >= 0 && gesture.answered === gesture.seq && gesture.answered !== last.gesture.answered) later('drag', () => dragText(store.state));
  });
}

/** How a drag stands. @param {State} state */
function dragText({ gesture, motion }) {
  if (gesture.state !== 'dragging' || !motion || !gesture.target) return '';
  return `${gesture.target.map((c) => c.toFixed(3)).join(', ')} m: ${motion.reached ? 'at its target' : offText(motion)}.`;
}
