// SPDX-License-Identifier: MIT
// One object with everything that the page shows; whoever draws a part of it subscribes to that part.

/** @typedef {import('./types.js').State} State */

/** @type {import('./types.js').GestureState} */
export const idleGesture = {
  state: 'idle', number: 0, hit: null, target: null, turn: null, axis: '', seq: 0, answered: -1, settlingShown: false,
  nailing: false, snap: 0, snapOn: '',
};

/** What belongs to one scene, as it is before anything of the scene is there: nothing of another is kept.
 * @returns {Pick<State, 'document' | 'scene' | 'motion' | 'opened' | 'savedMotion' | 'before' | 'changesShown' | 'time' | 'playing' |
 *    'loopRange' | 'selected' | 'hover' | 'gesture' | 'locked' | 'card' | 'selectedNail' | 'adding' | 'mesh' | 'bodiesAsOpened' | 'facing' | 'sketch' | 'others' | 'preview'>} */
export function nothingOfAScene() {
  return {
    document: null, scene: null, motion: null, opened: null, savedMotion: null, before: null, changesShown: false, time: 0,
    playing: false, loopRange: null, selected: -1, hover: null, gesture: idleGesture, locked: new Set(), card: null, selectedNail: -1, adding: -1, mesh: '', bodiesAsOpened: true, facing: null, sketch: null, others: null, preview: null,
  };
}

/** @returns {State} as it is before the server has answered */
export function initialState() {
  return {
    ...nothingOfAScene(), connected: 'connecting', progress: '', folder: '', showBefore: 'none', speed: 1, loop: false, dots: 24,
    tool: 'move', nailOnRelease: false, leaveRestFree: false, turnLeavesPlace: true, keymap: 'blender', panel: true, quality: 'high', notice: null, noticesStay: false, tab: '', looking: false,
  };
}

/** A document where nothing is open, with all its members. @type {import('./types.js').DocumentState} */
export const closedDocument = {
  type: 'state', rev: 0, open: false, path: null, name: '', saved: true, duration: 0, controls: [], numbers: [], nails: [],
  undo: null, redo: null, held_by: null, bodies: [], materials: [],
};

/** Subscribers are called once a change, after all members of a patch are in place; a patch made by a subscriber is
 * told after the one under way, so that all see changes in the same order.
 * @template {object} T */
export class Store {
  /** @param {T} initial */
  constructor(initial) {
    this.state = initial;
    /** @type {{keys: (keyof T)[], act: (state: T) => void}[]} */
    this.subscribers = [];
    /** @type {Set<keyof T>[]} */
    this.untold = [];
    this.telling = false;
  }

  /** @param {Partial<T>} patch */
  set(patch) {
    /** @type {Set<keyof T>} */
    const changed = new Set();
    for (const key of /** @type {(keyof T)[]} */ (Object.keys(patch))) {
      if (!Object.is(this.state[key], patch[key])) changed.add(key);
    }
    if (!changed.size) return;
    this.state = { ...this.state, ...patch };
    this.untold.push(changed);
    if (this.telling) return;
    this.telling = true;
    try {
      for (let keys = this.untold.shift(); keys; keys = this.untold.shift()) {
        const told = keys;
        for (const one of [...this.subscribers]) if (one.keys.some((key) => told.has(key))) one.act(this.state);
      }
    } finally {
      this.untold.length = 0;
      this.telling = false;
    }
  }

  /** Calls `act` now and whenever one of the members named changes.
   * @param {(keyof T)[]} keys @param {(state: T) => void} act @returns {() => void} ends the subscription */
  on(keys, act) {
    const one = { keys, act };
    this.subscribers.push(one);
    act(this.state);
    return () => {
      this.subscribers = this.subscribers.filter((other) => other !== one);
    };
  }
}
