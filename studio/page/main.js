// SPDX-License-Identifier: MIT
// Start-up: puts the parts of the page together.

import { Commands } from './commands.js';
import { Connection } from './connection.js';
import { ask, askName, choose } from './dialogs/ask.js';
import { showEmpty } from './dialogs/open.js';
import { byId } from './dom.js';
import { Facing } from './facing.js';
import { Gesture } from './gesture.js';
import { drawIcons, icon } from './icons.js';
import { showHeader } from './header.js';
import { showHint } from './hint.js';
import { listenToKeys, listenToPointer } from './input.js';
import { showReadout } from './live.js';
import { listener, tellEnding } from './messages.js';
import { showNotices } from './notice.js';
import { showBodies } from './panels/bodies.js';
import { showBody } from './panels/body.js';
import { showNails } from './panels/nails.js';
import { forPeople } from './number_field_text.js';
import { showNumbers } from './panels/numbers.js';
import { showOthers } from './panels/others.js';
import { showScene } from './panels/scene.js';
import { showPlayer } from './player.js';
import { snapped } from './snap.js';
import { Sketching } from './sketching.js';
import { makeStage } from './stage.js';
import { speak } from './speech.js';
import { initialState, Store } from './store.js';
import { addTestHooks } from './test_hooks.js';
import { TimeLine } from './timeline.js';
import { isHardware, qualityFor, rendererName } from './view/quality.js';
import { touchedAt } from './view/touched.js';

const query = new URLSearchParams(location.search);

/** The right to the session: behind # of the address, where no server sees it, then in this tab alone. */
function takeToken() {
  const given = location.hash.slice(1);
  if (given) {
    sessionStorage.setItem('token', given);
    history.replaceState(null, '', location.pathname + location.search);
  }
  return sessionStorage.getItem('token') ?? '';
}

function tabName() {
  const name = sessionStorage.getItem('tab') ?? [...crypto.getRandomValues(new Uint8Array(8))].map((b) => b.toString(16).padStart(2, '0')).join('');
  sessionStorage.setItem('tab', name);
  return name;
}

function start() {
  drawIcons(document);
  const renderer = rendererName();
  if (!renderer) {
    byId('blocked').hidden = false;
    byId('loading').hidden = true;
    return;
  }
  const store = new Store({ ...initialState(), tab: tabName(), quality: qualityFor(renderer, query.get('quality')) });
  remember(store);
  const { view, overlay, frame, picture, compose, small } = makeStage(store, isHardware(renderer) || query.get('shadows') === 'map');
  /** @type {Gesture | null} */
  let gesture = null;
  const connection = new Connection({
    url: `ws://${location.host}/socket`, token: takeToken(), tab: store.state.tab,
    listener: listener({ store, gesture: () => gesture, opened: () => frame(-1, true), recovered: (steps, repairs) => commands.tellRecovered(steps, repairs), drawn: () => commands.tellSketch() }),
  });
  gesture = new Gesture({
    store, connection, space: { touched: (hit) => touchedAt(store.state, hit), snapped: (hit, x, y) => snapped(view, store.state, hit, x, y), ray: (x, y) => view.camera.ray(x, y), project: (p) => [view.camera.project(p)[0], view.camera.project(p)[1]], camera: () => view.camera.axes() },
    select: (hit) => {
      if (!hit) return;
      store.set({ selected: hit.body, selectedNail: hit.kind === 'nail' ? (hit.nail ?? -1) : -1, ...(hit.kind === 'handle' || hit.kind === 'body' ? {} : { time: hit.time }) });
    },
    ended: (how, answer) => {
      if (how === 'released') tellEnding(store, { undo: () => void commands.undo(), askWhy: (rev) => void commands.askWhy(rev) }, answer);
      commands.saveIfWaiting();
    },
    refused: (error) => commands.tellOverlap(error),
  });
  const commands = new Commands({ store, connection, gesture, view: { frame }, ask, choose, askName });
  showHeader(store, commands, gesture, { picture, compose });
  showNotices(store, { takeRemedy: (name) => void commands.takeRemedy(name) });
  showReadout(store);
  speak(store);
  showBodies(store);
  const facing = new Facing({ store, view, commands });
  showBody(store, commands, facing);
  showNumbers(store, commands);
  showNails(store, commands);
  showOthers(store, commands, small);
  showScene(store, commands);
  showPlayer(store, commands);
  showEmpty(store, commands);
  showHint(store);
  showLayout(store);
  const timeline = new TimeLine(/** @type {HTMLCanvasElement} */ (byId('timeline')), store, commands);
  const sketching = new Sketching({ store, overlay, view, commands });
  const parts = { store, gesture, facing, sketching, commands, overlay, view, frame };
  listenToPointer(parts);
  listenToKeys(parts);
  if (query.has('test')) addTestHooks({ store, view, overlay, timeline, connection, gesture });
  connection.connect();
}

/** Choices of a person are kept from one time to the next. @param {Store<import('./types.js').State>} store */
function remember(store) {
  for (const key of /** @type {const} */ (['keymap', 'dots', 'panel'])) {
    const kept = localStorage.getItem(`carom ${key}`);
    try {
      if (kept !== null) store.set({ [key]: JSON.parse(kept) });
    } catch {
      localStorage.removeItem(`carom ${key}`);
    }
    store.on([key], (state) => localStorage.setItem(`carom ${key}`, JSON.stringify(state[key])));
  }
}

/** What covers the view, and the panel. @param {Store<import('./types.js').State>} store */
function showLayout(store) {
  const loading = byId('loading'), fold = byId('fold');
  store.on(['connected', 'progress', 'motion'], ({ connected, progress }) => {
    document.body.dataset.connected = connected;
    // what would ask the server waits until it is back; the view can still be turned
    for (const id of ['panel', 'tools']) byId(id).toggleAttribute('inert', connected === 'lost' || connected === 'ended');
    loading.hidden = !(connected === 'connecting' || connected === 'loading' || progress);
    loading.textContent = progress || (connected === 'loading' ? 'Loading…' : 'Connecting…');
  });
  store.on(['motion', 'document'], ({ motion, document: shown }) => {
    const early = motion && shown?.open && motion.end < shown.duration - 1e-9;
    byId('ended').hidden = !early;
    byId('ended').textContent = byId('ended').title = early ? forPeople(motion.message || `The motion ends at ${motion.end.toFixed(3)} s.`) : '';
  });
  store.on(['panel'], ({ panel }) => {
    document.body.classList.toggle('folded', !panel);
    fold.setAttribute('aria-expanded', String(panel));
    fold.setAttribute('aria-label', panel ? 'Fold the panel' : 'Unfold the panel');
    fold.replaceChildren(icon(panel ? 'unfolded' : 'folded'));
  });
  // where there is little height, one of the two long lists is open at a time
  const low = matchMedia('(max-height: 760px)'), long = [byId('numbers'), byId('nails')].flatMap((list) => list.closest('details') ?? []);
  const share = () => {
    for (const list of long) list.toggleAttribute('name', false);
    for (const list of low.matches ? long : []) list.setAttribute('name', 'long');
  };
  low.addEventListener('change', share);
  share();
  store.on(['selectedNail'], ({ selectedNail }) => selectedNail >= 0 && low.matches && long[1]?.setAttribute('open', ''));
  store.on(['document'], ({ document: shown }) => (byId('nail-count').textContent = shown?.nails.length ? String(shown.nails.length) : ''));
  fold.addEventListener('click', () => store.set({ panel: !store.state.panel }));
}

start();
