// SPDX-License-Identifier: MIT
// One object with everything that the page shows; whoever draws a part of it subscribes to that part.

/** @typedef {import('./types.js').State} State */

/** @type {import('./types.js').GestureState} */
export const idleGesture = {
  state: 'idle', number: 0, hit: null, target: null, turn: null, axis: '', seq: 0, answered: -1, settlingShown: false,
  nailing: false,
};

/** @returns {State} as it is before the server has answered */
export function initialState() {
  return {
    connected: 'connecting', progress: '', folder: '', document: null, scene: null, motion: null, opened: null,
    savedMotion: null, before: null, showBefore: 'none', changesShown: false, time: 0, playing: false, speed: 1,
    loop: false, loopRange: null, dots: 24, selected: -1, hover: null, tool: 'move', gesture: idleGesture, nailOnRelease: false,
    leaveRestFree: false, keymap: 'blender', locked: new Set(), panel: true, quality: 'high', notice: null, card: null,
    selectedNail: -1, tab: '',
  };
}

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
