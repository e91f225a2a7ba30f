// SPDX-License-Identifier: MIT
// Mouse and keys, taken to the gesture and the commands.

import { actionOf, chordOf, takesKeys } from './keys.js';
import { addedBody, surfaceUnder } from './build.js';
import { byId } from './dom.js';
import { keysDialog } from './dialogs/keys.js';
import { openDialog } from './dialogs/open.js';

/** @typedef {{store: import('./store.js').Store<import('./types.js').State>, gesture: import('./gesture.js').Gesture, facing: import('./facing.js').Facing, sketching: import('./sketching.js').Sketching,
 *    commands: import('./commands.js').Commands, overlay: import('./overlay/overlay.js').Overlay,
 *    view: import('./view/view.js').View, frame: (body: number, anew?: boolean, side?: 'front' | 'side' | 'top') => void}} Parts */

/** ms, between targets that are sent before the frame of their move: 1000 moves a second come from some mice. */
const earlySpacing = 7;

/** What is added stands on the surface below a place of the view. @param {Pick<Parts, 'store' | 'commands' | 'view'>} parts
 * @param {number} x @param {number} y px */
function putDown({ store, commands, view }, x, y) {
  const on = surfaceUnder(view, store.state, x, y), body = addedBody(store.state);
  if (!on) return store.set({ notice: { message: 'There is no surface: press a body, or the floor.', key: 'adding' } });
  store.set({ adding: -1 });
  void commands.addBody(body, on);
}

/** @param {Parts} parts */
export function listenToPointer({ store, gesture, facing, sketching, commands, overlay, view }) {
  const { canvas } = overlay, typing = /** @type {HTMLInputElement} */ (byId('typing'));
  let orbiting = false;
  /** Before the camera's own listener, so that a press on a thing does not turn it. @param {PointerEvent} event */
  const press = (event) => {
    canvas.focus();
    if (store.state.adding >= 0 && event.button === 0) return view.camera.enable(false), putDown({ store, commands, view }, event.offsetX, event.offsetY);
    if (event.button === 0 && store.state.connected === 'open' && (facing.press(event.offsetX, event.offsetY) || sketching.press(event.offsetX, event.offsetY))) {
      view.camera.enable(false);
      return canvas.setPointerCapture(event.pointerId);
    }
    const hit = event.button === 0 && !event.shiftKey && !event.ctrlKey && !event.metaKey ? overlay.under(event.offsetX, event.offsetY) : null;
    const taken = ['dragging', 'typing'].includes(store.state.gesture.state) && event.button !== 0
      || event.button === 0 && store.state.connected === 'open' && gesture.press(hit, event.offsetX, event.offsetY);
    view.camera.enable(!taken);
    orbiting = !taken;
    if (taken) canvas.setPointerCapture(event.pointerId);
    else store.set({ hover: null });
  };
  canvas.addEventListener('pointerdown', press, { capture: true });
  canvas.addEventListener('pointermove', (event) => {
    if (!orbiting && (facing.move(event.offsetX, event.offsetY) || sketching.move(event.offsetX, event.offsetY))) return;
    if (store.state.gesture.state === 'idle' || store.state.gesture.state === 'settling') {
      if (!orbiting && !store.state.playing && store.state.connected === 'open') hover(event);
      return;
    }
    if (store.state.gesture.state !== 'dragging' || event.offsetX !== heard.x || event.offsetY !== heard.y) follow(event);
  });
  const heard = { x: NaN, y: NaN, time: 0 };
  /** @param {PointerEvent} event */
  const follow = (event) => {
    gesture.snapTo(event.ctrlKey || event.metaKey, event.shiftKey, event.altKey);
    Object.assign(heard, { x: event.offsetX, y: event.offsetY, time: event.timeStamp });
    gesture.move(event.offsetX, event.offsetY);
  };
  // moves wait for the next frame, whose motion would then be that of the frame before: in a drag they are heard at once
  canvas.addEventListener('pointerrawupdate', (event) => {
    const move = /** @type {PointerEvent} */ (event);
    if (store.state.gesture.state === 'dragging' && move.timeStamp - heard.time >= earlySpacing) follow(move);
  });
  /** @param {PointerEvent} event */
  const hover = (event) => {
    const hit = overlay.under(event.offsetX, event.offsetY), was = store.state.hover;
    const same = hit && was && hit.kind === was.kind && hit.body === was.body && hit.time === was.time && hit.handle === was.handle && hit.nail === was.nail && hit.impact === was.impact;
    if (!same && (hit || was)) store.set({ hover: hit && store.state.scene?.shapes[hit.body]?.fixed ? null : hit });
    canvas.classList.toggle('open-hand', !!store.state.hover);
  };
  // a second button is a mousedown, but no pointerdown, while the first is held
  canvas.addEventListener('mousedown', (event) => {
    if (event.button !== 2 || !['dragging', 'typing'].includes(store.state.gesture.state)) return;
    gesture.stopTyping();
    gesture.cancel();
  });
  let down = /** @type {[number, number]} */ ([0, 0]);
  canvas.addEventListener('pointerdown', (event) => (down = [event.offsetX, event.offsetY]));
  canvas.addEventListener('pointerup', (event) => {
    const clicked = orbiting && event.button === 0 && Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) <= 4;
    orbiting = false;
    view.camera.enable(true);
    if (event.button === 0) facing.up(event.offsetX, event.offsetY), sketching.up(event.offsetX, event.offsetY);
    if (event.button === 0) gesture.up(event.offsetX, event.offsetY);
    if (clicked && !event.shiftKey) store.set({ selected: -1, selectedNail: -1 });
  });
  canvas.addEventListener('pointercancel', () => {
    orbiting = false;
    gesture.cancel(), sketching.cancel();
  });
  canvas.addEventListener('pointerleave', () => store.state.gesture.state === 'idle' && store.set({ hover: null }));
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  window.addEventListener('blur', () => gesture.snapTo(false, false, false));
  window.addEventListener('blur', () => store.state.gesture.nailing && gesture.put({ nailing: false }));
  store.on(['gesture'], ({ gesture: now }) => {
    canvas.classList.toggle('closed-hand', now.state === 'dragging' || now.state === 'pressed');
    const shown = now.state === 'typing';
    if (shown === !typing.hidden) return;
    typing.hidden = !shown;
    if (!shown) return canvas.focus();
    typing.style.left = `${Math.min(gesture.pointer[0] + 14, canvas.clientWidth - 170)}px`;
    typing.style.top = `${Math.max(8, gesture.pointer[1] - 34)}px`;
    typing.placeholder = store.state.tool === 'turn' ? 'degrees' : now.axis ? 'm' : 'x y z, m';
    typing.focus();
  });
  typing.addEventListener('keydown', (event) => {
    event.stopPropagation();
    if (event.key === 'Escape') gesture.stopTyping();
    if (event.key === 'Enter') typing.toggleAttribute('aria-invalid', !gesture.type(typing.value));
  });
}

/** @param {Parts} parts */
export function listenToKeys({ store, gesture, facing, sketching, commands, frame, overlay, view }) {
  const typing = /** @type {HTMLInputElement} */ (byId('typing'));
  for (const kind of /** @type {const} */ (['keydown', 'keyup'])) {
    window.addEventListener(kind, (event) => {
      const { key, ctrlKey, metaKey, shiftKey } = event;
      if (['Control', 'Meta', 'Shift'].includes(key)) gesture.snapTo(ctrlKey || metaKey, shiftKey);
      if (key !== 'Alt' || store.state.gesture.state !== 'dragging') return;
      gesture.snapTo(event.ctrlKey || event.metaKey, event.shiftKey, kind === 'keydown');
      event.preventDefault();  // no menu of the browser
    });
  }
  window.addEventListener('keydown', (event) => {
    if (takesKeys(document.activeElement) || document.querySelector('dialog[open]') || event.altKey) return;
    const dragging = store.state.gesture.state === 'dragging';
    if (dragging && /^[-.\d]$/.test(event.key) && !event.ctrlKey) {
      typing.value = event.key;
      gesture.startTyping();
      event.preventDefault();
      return;
    }
    if (dragging && event.key.startsWith('Arrow')) {
      const far = event.shiftKey ? 10 : 1, [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] ?? [0, 0];
      gesture.nudge(dx * far, dy * far);
      event.preventDefault();
      return;
    }
    if (event.key === 'Enter' && store.state.adding >= 0) {
      event.preventDefault();
      return putDown({ store, commands, view }, overlay.canvas.clientWidth / 2, overlay.canvas.clientHeight / 2);
    }
    if (event.key === 'Enter' && document.activeElement === overlay.canvas && facing.anywhere()) return event.preventDefault();
    // what has the focus is pressed by these keys
    const pressed_by_keys = document.activeElement?.matches('button, summary, input');
    if (pressed_by_keys && (event.key === ' ' || event.key === 'Enter')) return;
    const found = actionOf(chordOf(event), store.state.keymap, dragging);
    if (!found) return;
    event.preventDefault();
    act(found.action, found.shift, event.repeat);
  });
  window.addEventListener('keyup', (event) => {
    const found = actionOf(chordOf(event), store.state.keymap, store.state.gesture.state === 'dragging');
    if (found?.action === 'before') store.set({ showBefore: 'none' });
    if (found?.action === 'nail' && store.state.gesture.nailing) gesture.put({ nailing: false });
  });

  /** @param {import('./keys.js').Action} action @param {boolean} shift @param {boolean} repeat */
  function act(action, shift, repeat) {
    const { selected, selectedNail, gesture: now } = store.state;
    /** @type {Partial<Record<import('./keys.js').Action, () => void>>} */
    const acts = {
      'axis x': () => gesture.setAxis('x', shift), 'axis y': () => gesture.setAxis('y', shift), 'axis z': () => gesture.setAxis('z', shift),
      lift: () => gesture.lift(), confirm: () => gesture.release(), cancel: () => void (gesture.cancel() || facing.cancel() || sketching.cancel() || store.set(store.state.adding >= 0 ? { adding: -1 } : { selected: -1, selectedNail: -1 })),
      earlier: () => commands.stepFrame(-1), later: () => commands.stepFrame(1), 'impact before': () => commands.stepImpact(-1),
      'impact after': () => commands.stepImpact(1), 'body before': () => commands.selectNext(-1), 'body after': () => commands.selectNext(1),
      start: () => commands.seek(0), end: () => commands.seek(Infinity),
      frame: () => frame(selected), 'frame all': () => frame(-1), front: () => frame(-1, false, 'front'), side: () => frame(-1, false, 'side'), top: () => frame(-1, false, 'top'), before: () => store.set({ showBefore: 'opened' }),
    };
    /** @type {Partial<Record<import('./keys.js').Action, () => void>>} */
    const once = {
      move: () => commands.hold('move'), turn: () => commands.hold('turn'), throw: () => commands.aimThrow(), face: () => store.set({ tool: 'face' }), pen: () => store.set({ tool: 'pen' }),
      nail: () => (now.state === 'dragging' ? gesture.put({ nailing: true }) : void commands.nailHere()),
      remove: () => void (selectedNail >= 0 && commands.removeNail()), play: () => commands.togglePlay(),
      undo: () => void commands.undo(), redo: () => void commands.redo(), save: () => void commands.save(), open: () => void openDialog(commands),
      panel: () => store.set({ panel: !store.state.panel }), keys: () => void keysDialog(store),
    };
    if (acts[action]) acts[action]();
    else if (!repeat) once[action]?.();
    if (action === 'move' || action === 'turn') overlay.canvas.focus();
  }
}
