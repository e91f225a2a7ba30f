// SPDX-License-Identifier: MIT
// Playing: the play head follows the page's own clock, never the server.

import { byId } from './dom.js';
import { icon } from './icons.js';

/** @param {import('./store.js').Store<import('./types.js').State>} store @param {import('./play_head.js').PlayHead} commands */
export function showPlayer(store, commands) {
  const play = byId('play'), loop = byId('loop'), speed = /** @type {HTMLSelectElement} */ (byId('speed')), shown = byId('time');
  play.addEventListener('click', () => commands.togglePlay());
  loop.addEventListener('click', () => store.set({ loop: !store.state.loop }));
  speed.addEventListener('change', () => store.set({ speed: Number(speed.value) }));
  shown.title = 'time, and the frame';
  store.on(['time', 'dots'], ({ time, dots }) => (shown.textContent = `${time.toFixed(3)} s${dots ? ` · ${Math.floor(time * dots + 1e-6)}` : ''}`));
  store.on(['loop'], (state) => loop.setAttribute('aria-pressed', String(state.loop)));
  let last = 0, wanted = 0;
  /** @param {number} now ms */
  const frame = (now) => {
    wanted = 0;
    const { playing, time, motion, speed: rate, loop: again, loopRange } = store.state;
    if (!playing || !motion) return;
    const next = time + (last ? (Math.min(now - last, 100) / 1000) * rate : 0);
    last = now;
    const [start, end] = again && loopRange && loopRange[0] < motion.end ? [loopRange[0], Math.min(loopRange[1], motion.end)] : [0, motion.end];
    if (next < end) store.set({ time: Math.max(start, next) });
    else store.set(again ? { time: start } : { time: end, playing: false });
    if (store.state.playing) wanted = requestAnimationFrame(frame);
  };
  store.on(['playing'], ({ playing }) => {
    play.replaceChildren(icon(playing ? 'pause' : 'play'));
    play.setAttribute('aria-label', playing ? 'Pause' : 'Play');
    last = 0;
    if (playing && !wanted) wanted = requestAnimationFrame(frame);
  });
}
