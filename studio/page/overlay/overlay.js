// SPDX-License-Identifier: MIT
// The canvas above the view: all marks that are no thing in the scene, and what can be pressed.

import { impactAt, moves, pathTimes, pointAt, velocityAt } from '../motion.js';
import { sagOf } from '../view/paths.js';
import { drawHandles, handleShapes, handleUnder, throwHandles } from './handles.js';
import { drawHoops, nailPlaces, placeHeld, singleNails } from './hoops.js';
import { drawChangedImpacts, drawDots, drawHeld, drawHover, drawImpacts, drawRests } from './marks.js';
import { drawNames } from './names.js';
import { onScreen, pick } from './pick.js';
import { drawSketches } from './sketches.js';

/** @typedef {import('../types.js').State} State */

export class Overlay {
  /** @param {HTMLCanvasElement} canvas @param {import('../store.js').Store<State>} store
   * @param {import('../view/view.js').View} view */
  constructor(canvas, store, view) {
    this.canvas = canvas;
    this.store = store;
    this.view = view;
    this.pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    this.width = 1;
    this.height = 1;
    this.project = (/** @type {import('../types.js').Vec3} */ p) => view.camera.project(p);
  }

  /** @param {number} width @param {number} height px */
  resize(width, height) {
    const ratio = Math.min(devicePixelRatio, 2);
    this.width = width;
    this.height = height;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  /** Marks grow a little on large screens. */
  get scale() {
    return this.width > 1900 ? 1.25 : 1;
  }

  draw() {
    const { pen, scale, project } = this, state = this.view.shown;
    pen.clearRect(0, 0, this.width, this.height);
    const { motion, gesture, hover } = state;
    if (!motion) return;
    pen.font = `${Math.round(12 * scale)}px system-ui, sans-serif`;
    const bodies = this.view.paths.shownBodies(state), dragging = gesture.state === 'dragging' || gesture.state === 'typing';
    drawDots(pen, state, bodies, project, scale);
    const hidden = (/** @type {import('../types.js').Vec3} */ point) => this.view.hidden.hides(state.scene, point);
    drawImpacts(pen, state, bodies, project, scale, hidden);
    drawRests(pen, state, bodies, project, scale, hidden);
    drawNames(pen, state, bodies, project);
    drawChangedImpacts(pen, state, project, scale);
    drawSketches(pen, nailPlaces(state), state.sketch?.places ?? [], project, scale);
    drawHoops(pen, singleNails(state), project, scale, state.selectedNail, hidden);
    if (!dragging) drawHandles(pen, this.handles(), hover?.handle ?? '');
    if (hover && gesture.state === 'idle') drawHover(pen, hover, bodies.length > 1 ? (state.document?.bodies[hover.body]?.name ?? '') : '', project, scale);
    if (gesture.hit && gesture.state !== 'idle') {
      const { body, at } = gesture.hit, track = motion.tracks[body];
      const contact = gesture.hit.kind === 'impact' && impactAt(at, body, motion, state.document?.bodies.map((one) => one.name) ?? []);
      drawHeld(pen, state, project(contact ? contact.point : pointAt(track, track.center, Math.min(state.time, motion.end))), project, scale);
    }
  }

  /** Handles that there are now. */
  handles() {
    const { motion, selected, time, tool, scene, gesture, looking } = this.store.state;
    const track = motion?.tracks[selected], fixed = scene?.shapes[selected]?.fixed;
    if (looking || !motion || !track || gesture.state === 'settling' || this.store.state.playing) return [];
    // at the start bodies are placed, and fixed ones at any time
    const placed = (time === 0 || fixed) && !!this.store.state.document?.bodies[selected]?.position && !scene?.shapes[selected]?.plane;
    if (fixed ? !placed : !placed && !moves(track)) return [];
    const place = pointAt(track, track.center, Math.min(time, motion.end));
    if (tool === 'throw') return fixed || time !== 0 ? [] : throwHandles(place, velocityAt(track, 0), this.scale * this.view.camera.axes().perPixel(place), this.project);
    return tool === 'face' || tool === 'pen' ? [] : handleShapes(tool, place, this.scale * this.view.camera.axes().perPixel(place), this.project);
  }

  /** @param {number} x @param {number} y px @returns {import('../types.js').Hit | null} */
  under(x, y) {
    const { state } = this.store, { motion, document, scene, selected } = state;
    if (!motion || !document) return null;
    const handles = this.handles(), sag = sagOf(scene);
    const paths = new Map(this.view.paths.shownBodies(state).map((body) => {
      const track = motion.tracks[body];
      return [body, onScreen(track, pathTimes(track, motion.end, sag), this.project)];
    }));
    return pick({
      motion, names: document.bodies.map((body) => body.name), paths, project: this.project, time: Math.min(state.time, motion.end),
      handle: (hx, hy) => {
        const handle = handleUnder(handles, hx, hy);
        return handle ? { handle, body: selected } : null;
      },
      nails: singleNails(state).filter(({ nail }) => placeHeld(nail.constraint)),
      bodyUnder: (bx, by) => this.view.bodies.pick(this.view.camera.cast(bx, by)),
    }, x, y);
  }
}
