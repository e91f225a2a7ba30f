// SPDX-License-Identifier: MIT
// The time line: a lane for each moving body, the play head, impacts now and before, nails, the end.

import { colours, impactColours, inkOf } from './colours.js';
import { impactsThatChanged } from './changes.js';
import { byId } from './dom.js';
import { nailColour, singleNails } from './overlay/hoops.js';
import { centreAt, moves } from './motion.js';
import { forPeople } from './number_field_text.js';
import { lanes, ticks, tOf, xOf, zoomed } from './timeline_layout.js';
import { diamond, drawEnd, drawName } from './timeline_marks.js';
import { beforeOf } from './view/paths.js';

/** @typedef {import('./types.js').State} State */
/** @typedef {import('./timeline_layout.js').Axis} Axis */

const ruler = 26, left = 16, right = 20, diamondSize = 5;

export class TimeLine {
  /** @param {HTMLCanvasElement} canvas @param {import('./store.js').Store<State>} store
   * @param {import('./play_head.js').PlayHead & Partial<Pick<import('./commands.js').Commands, 'setNail'>>} commands nails stay
   *    where they are without setNail */
  constructor(canvas, store, commands) {
    this.canvas = canvas;
    this.store = store;
    this.commands = commands;
    this.pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    /** @type {Axis} */
    this.axis = { from: 0, to: 1, left, width: 1 };
    this.zoom = /** @type {{from: number, to: number} | null} */ (null);
    this.scroll = 0;
    this.folded = false;  // to the lane of the selected body
    this.foldButton = byId('fold-lanes');
    this.foldButton.addEventListener('click', () => this.fold());
    /** @type {{body: number, y: number, height: number}[]} */
    this.seen = [];
    this.wanted = 0;
    this.dragged = /** @type {'' | 'head' | {nail: number, time: number} | {loop: number}} */ ('');
    new ResizeObserver(() => this.draw()).observe(canvas);
    store.on(['motion', 'time', 'document', 'selected', 'hover', 'before', 'changesShown', 'gesture', 'selectedNail', 'scene', 'showBefore', 'loop', 'loopRange'], () => this.invalidate());
    store.on(['scene'], () => (this.zoom = null));
    store.on(['selected'], ({ selected }) => this.scrollTo(selected));
    canvas.addEventListener('pointerdown', (event) => this.press(event));
    canvas.addEventListener('pointermove', (event) => this.point(event));
    canvas.addEventListener('pointerup', () => this.lift());
    canvas.addEventListener('pointerleave', () => this.dragged || this.store.set({ hover: null }));
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
  }

  invalidate() {
    this.wanted ||= requestAnimationFrame(() => this.draw());
  }

  draw() {
    this.wanted = 0;
    const { canvas, pen } = this, width = canvas.clientWidth, height = canvas.clientHeight, ratio = Math.min(devicePixelRatio, 2);
    if (!width || !height) return;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const { state } = this.store, { motion, document } = state;
    canvas.setAttribute('aria-valuenow', state.time.toFixed(3));
    if (!motion || !document?.open) return;
    const duration = Math.max(document.duration, motion.end);
    this.axis = { from: this.zoom?.from ?? 0, to: this.zoom?.to ?? duration, left, width: width - left - right };
    canvas.setAttribute('aria-valuemax', duration.toFixed(3));
    canvas.setAttribute('aria-valuetext', `${state.time.toFixed(3)} s`);
    pen.font = `${width > 1700 ? 13 : 11}px system-ui, sans-serif`;
    this.drawLoop(state);
    this.drawRuler(width);
    this.seen = this.lanes(height);
    for (const lane of this.seen) this.drawLane(lane, state, width);
    this.drawScroll(width, height);
    if (motion.end < duration - 1e-9) drawEnd(pen, Math.max(left, xOf(this.axis, motion.end)), left + this.axis.width, ruler + 2, height, forPeople(motion.message));
    this.drawHead(state, height);
  }

  /** Bodies that have a lane. */
  lanesOf() {
    const { motion, scene } = this.store.state;
    return motion?.tracks.filter((t) => !scene?.shapes[t.body]?.fixed && moves(t)).map((t) => t.body) ?? [];
  }

  /** Those that are seen: from the first that is scrolled to, or folded to the selected one. @param {number} height */
  lanes(height) {
    const bodies = this.lanesOf(), { selected } = this.store.state, room = height - ruler - 6;
    this.foldButton.hidden = bodies.length < 2;
    if (this.folded && bodies.length > 1) return lanes([bodies.includes(selected) ? selected : bodies[0]], ruler + 2, room, 0);
    const fit = lanes(bodies, ruler + 2, room, 0).length;
    this.scroll = Math.max(0, Math.min(this.scroll, bodies.length - fit));
    return lanes(bodies, ruler + 2, room, this.scroll);
  }

  /** Whose lane is out of sight comes into it. @param {number} body */
  scrollTo(body) {
    const at = this.lanesOf().indexOf(body), fit = this.seen.length;
    if (at >= 0 && !this.folded) this.scroll = Math.max(Math.min(this.scroll, at), at - fit + 1);
    this.invalidate();
  }

  fold() {
    this.folded = !this.folded;
    this.foldButton.setAttribute('aria-pressed', String(this.folded));
    this.scrollTo(this.store.state.selected);
  }

  /** Where among all lanes those are that are seen. @param {number} width @param {number} height */
  drawScroll(width, height) {
    const all = this.lanesOf().length, room = height - ruler - 6;
    if (this.folded || this.seen.length >= all) return;
    this.pen.fillStyle = '#4a5058';
    this.pen.fillRect(width - 9, ruler + 2 + (this.scroll / all) * room, 4, (this.seen.length / all) * room);
  }

  /** @param {State} state */
  drawLoop({ loop, loopRange }) {
    if (!loop || !loopRange) return;
    const { pen, axis } = this, [from, to] = loopRange.map((t) => Math.max(left, Math.min(left + axis.width, xOf(axis, t))));
    pen.fillStyle = colours.pressed;
    pen.fillRect(from, ruler - 8, to - from, 8);
  }

  /** @param {number} width */
  drawRuler(width) {
    const { pen, axis } = this;
    pen.fillStyle = colours.dim;
    pen.strokeStyle = '#4a5058';
    pen.lineWidth = 1;
    for (const { t, text } of ticks(axis)) {
      const x = Math.round(xOf(axis, t)) + 0.5;
      pen.beginPath();
      pen.moveTo(x, ruler - 8);
      pen.lineTo(x, ruler);
      pen.stroke();
      const wide = pen.measureText(text).width;
      pen.fillText(text, Math.max(2, Math.min(width - wide - 2, x - wide / 2)), ruler - 12);
    }
  }

  /** @param {{body: number, y: number, height: number}} lane @param {State} state @param {number} width */
  drawLane({ body, y, height }, state, width) {
    const { pen, axis } = this, { motion, scene, selected } = state, middle = y + height / 2;
    if (!motion) return;
    pen.save();
    pen.beginPath();
    pen.rect(left - 6, y, width - left + 6, height);
    pen.clip();
    pen.fillStyle = body === selected ? '#39404a' : colours.lane;
    pen.fillRect(left, y, axis.width, Math.max(2, height - 2));
    pen.fillStyle = inkOf(scene?.shapes[body]?.colour ?? colours.fixed);
    pen.fillRect(xOf(axis, 0), middle - 1, xOf(axis, motion.end) - xOf(axis, 0), body === selected ? 2 : 1);
    if (this.seen.length > 1 || !this.foldButton.hidden) drawName(pen, state.document?.bodies[body]?.name ?? '', left, y, height, body === selected);
    const before = beforeOf(state), size = Math.min(diamondSize, height / 2 - 1);
    for (const impact of before?.impacts ?? []) if (impact.bodies.includes(body)) diamond(pen, xOf(axis, impact.t), middle, size, colours.before, false);
    for (const impact of motion.impacts) {
      if (impact.bodies.includes(body)) diamond(pen, xOf(axis, impact.t), middle, size, impactColours[impact.mode] ?? impactColours.stick, true);
    }
    if (state.changesShown && state.before && height >= 10) this.drawChanges(state.before, motion, body, middle);
    for (const place of singleNails(state)) {
      if (place.body !== body) continue;
      const dragged = typeof this.dragged === 'object' && 'nail' in this.dragged && this.dragged.nail === place.id ? this.dragged.time : place.time;
      pen.strokeStyle = nailColour(place.nail);
      pen.lineWidth = place.id === state.selectedNail ? 3 : 2;
      pen.setLineDash(place.nail.available ? [] : [3, 3]);
      pen.beginPath();
      pen.arc(xOf(axis, dragged), middle, Math.min(6, height / 2 - 1), 0, 2 * Math.PI);
      pen.stroke();
      pen.setLineDash([]);
    }
    pen.restore();
  }

  /** Words at impacts that came and went. @param {import('./types.js').Motion} before
   * @param {import('./types.js').Motion} now @param {number} body @param {number} y */
  drawChanges(before, now, body, y) {
    const names = this.store.state.document?.bodies.map((one) => one.name) ?? [];
    this.pen.fillStyle = colours.text;
    for (const { impact: { t }, pair, came } of impactsThatChanged(before, now)) {
      if (!pair.includes(body)) continue;
      const text = `${names[pair[0] === body ? pair[1] : pair[0]]} ${came ? 'came' : 'went'}`, x = xOf(this.axis, t), wide = this.pen.measureText(text).width;
      this.pen.fillText(text, x + 9 + wide > left + this.axis.width ? x - 9 - wide : x + 9, y + 4);
    }
  }

  /** @param {State} state @param {number} height */
  drawHead({ time, hover, motion }, height) {
    const { pen, axis } = this;
    if (hover && motion) {
      pen.fillStyle = colours.dim;
      pen.fillRect(xOf(axis, hover.time) - 0.5, ruler, 1, height - ruler - 6);
    }
    const x = xOf(axis, time);
    if (x < left - 1 || x > left + axis.width + 1) return;
    pen.fillStyle = colours.accent;
    pen.fillRect(x - 1, ruler - 4, 2, height - ruler);
    pen.beginPath();
    pen.moveTo(x - 6, ruler - 10);
    pen.lineTo(x + 6, ruler - 10);
    pen.lineTo(x, ruler);
    pen.fill();
  }

  /** @param {PointerEvent} event */
  press(event) {
    if (event.button !== 0 || !this.store.state.motion) return;
    this.canvas.setPointerCapture(event.pointerId);
    if (event.shiftKey) {
      this.dragged = { loop: tOf(this.axis, event.offsetX) };
      return this.store.set({ loopRange: null });
    }
    const lane = this.seen.find(({ y, height }) => event.offsetY >= y && event.offsetY < y + height);
    const nail = lane && singleNails(this.store.state).find((place) => place.body === lane.body && Math.abs(xOf(this.axis, place.time) - event.offsetX) < 8);
    if (nail) {
      this.store.set({ selectedNail: nail.id, selected: nail.body });
      this.dragged = typeof nail.nail.constraint.at === 'number' && this.commands.setNail ? { nail: nail.id, time: nail.time } : '';
      return;
    }
    this.dragged = 'head';
    if (lane) this.store.set({ selected: lane.body });
    this.commands.seek(tOf(this.axis, event.offsetX));
  }

  /** @param {PointerEvent} event */
  point(event) {
    const { motion, selected } = this.store.state;
    if (!motion) return;
    const time = Math.max(0, Math.min(motion.end, tOf(this.axis, event.offsetX)));
    const over = this.seen.find(({ y, height }) => event.offsetY >= y && event.offsetY < y + height);
    this.canvas.title = over ? (this.store.state.document?.bodies[over.body]?.name ?? '') : '';
    if (this.dragged === 'head') {
      this.commands.seek(time);
    } else if (typeof this.dragged === 'object' && 'loop' in this.dragged) {
      const ends = /** @type {[number, number]} */ ([this.dragged.loop, time].map((t) => Math.max(0, Math.min(motion.end, t))).sort((a, b) => a - b));
      if (ends[1] - ends[0] > 1e-3) this.store.set({ loop: true, loopRange: ends });
    } else if (typeof this.dragged === 'object') {
      this.dragged = { nail: this.dragged.nail, time: Math.round(time * 1000) / 1000 };
      this.invalidate();
    } else if (this.store.state.gesture.state === 'idle') {
      const body = over?.body ?? selected;
      this.store.set({ hover: body >= 0 ? { kind: 'body', body, time, at: time, place: centreAt(motion.tracks[body], time) } : null });
    }
  }

  lift() {
    const dragged = this.dragged;
    this.dragged = '';
    if (typeof dragged !== 'object' || 'loop' in dragged) return;
    const nail = this.store.state.document?.nails.find((one) => one.id === dragged.nail);
    if (nail && nail.constraint.at !== dragged.time) void this.commands.setNail?.(nail.id, { ...nail.constraint, at: dragged.time });
  }

  /** @param {WheelEvent} event */
  wheel(event) {
    event.preventDefault();
    const { motion, document } = this.store.state;
    if (!motion || !document) return;
    if (event.shiftKey) {
      this.scroll = Math.max(0, this.scroll + Math.sign(event.deltaY || event.deltaX));
    } else {
      const duration = Math.max(document.duration, motion.end), span = zoomed(this.axis, event.offsetX, event.deltaY > 0 ? 1.25 : 0.8, duration);
      this.zoom = span.to - span.from >= duration - 1e-9 ? null : span;
    }
    this.invalidate();
  }
}
