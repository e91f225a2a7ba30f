// SPDX-License-Identifier: MIT
// What a person can do with a motion that stays as it is: the time, and the body that is looked at.

import { moves } from './motion.js';

export class PlayHead {
  /** @param {import('./store.js').Store<import('./types.js').State>} store */
  constructor(store) {
    this.store = store;
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
