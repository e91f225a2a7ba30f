// SPDX-License-Identifier: MIT
// WebGL: draws a frame when something changed, and never otherwise.

import * as THREE from 'three';
import { colours } from '../colours.js';
import { Bodies } from './bodies.js';
import { Camera } from './camera.js';
import { Ghosts } from './ghosts.js';
import { Glide } from '../glide.js';
import { Ground } from './ground.js';
import { Hidden } from './hidden.js';
import { linesOn } from './lines.js';
import { Outline } from './outline.js';
import { Paths } from './paths.js';
import { FrameWatch } from './quality.js';
import { Shadows } from './shadows.js';
import { Lights } from './sun.js';
import { Walls } from './walls.js';

/** @typedef {import('../types.js').State} State */

export class View {
  /** Throws where there is no WebGL.
   * @param {{host: HTMLElement, input: HTMLElement, store: import('../store.js').Store<State>,
   *    shadowMap: boolean, drawn: () => void, resized: (width: number, height: number) => void}} parts `input`: what the pointer is over;
   *    `drawn` is called within each frame, after the scene;
   *    `shadowMap`: whether high quality may have one */
  constructor({ host, input, store, shadowMap, drawn, resized }) {
    this.host = host;
    this.shadowMap = shadowMap;
    this.store = store;
    this.drawn = drawn;
    this.frames = 0;
    this.wanted = 0;
    /** @type {{seq: number, frame: number}} the drag for whose answer a frame was put off, and the frames drawn by then */
    this.waited = { seq: 0, frame: -1 };
    this.watch = new FrameWatch();
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(colours.view);
    this.camera = new Camera(input, () => this.invalidate());
    this.bodies = new Bodies();
    this.hidden = new Hidden(this.bodies, this.camera.camera);
    this.walls = new Walls();
    this.ghosts = new Ghosts();
    this.paths = new Paths();
    this.ground = new Ground();
    this.lights = new Lights();
    this.shadows = new Shadows();
    this.outline = new Outline();
    this.glide = new Glide(() => matchMedia('(prefers-reduced-motion: reduce)').matches);
    this.shown = store.state;
    this.scene.add(this.ground.group, this.shadows.group, this.bodies.group, this.bodies.crowd.group, this.outline.mesh, this.paths.group, this.ghosts.group, ...this.lights.all);
    this.quality = store.state.quality;
    this.renderer = this.makeRenderer(this.quality);
    new ResizeObserver(() => this.resize(resized)).observe(host);
    this.resize(resized);
  }

  /** @param {'low' | 'high'} quality */
  makeRenderer(quality) {
    const renderer = new THREE.WebGLRenderer({ antialias: quality === 'high', powerPreference: 'high-performance' });
    renderer.setPixelRatio(quality === 'high' ? Math.min(devicePixelRatio, 2) : 1);
    renderer.shadowMap.enabled = quality === 'high' && this.shadowMap;
    renderer.domElement.setAttribute('aria-hidden', 'true');
    this.host.prepend(renderer.domElement);
    return renderer;
  }

  /** @param {(width: number, height: number) => void} resized */
  resize(resized) {
    const { clientWidth, clientHeight } = this.host;
    if (!clientWidth || !clientHeight) return;
    this.renderer.setSize(clientWidth, clientHeight);
    this.camera.resize(clientWidth, clientHeight);
    this.sizeLines();
    resized(clientWidth, clientHeight);
    this.draw();
  }

  sizeLines() {
    const { x, y } = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    linesOn(x, y);
  }

  invalidate() {
    if (!this.wanted) this.wanted = requestAnimationFrame((time) => this.frame(time));
  }

  /** @param {number} time ms */
  frame(time) {
    this.wanted = 0;
    if (this.waits()) return this.invalidate();
    this.draw();
    if (this.watch.frame(time, this.wanted !== 0 || this.store.state.playing || this.store.state.gesture.state === 'dragging') &&
      this.store.state.quality === 'high') {
      this.store.set({ quality: 'low' });
    }
  }

  /** Where drawing in software takes longer than most answers, a frame is put off for one that is on its way: it would
   * show what was before, and the page hears nothing while it is drawn. Once for an answer, and never two in a row. */
  waits() {
    const { quality, gesture: { state, seq, answered } } = this.store.state;
    if (quality !== 'low' || state !== 'dragging' || answered >= seq || this.waited.seq === seq || this.waited.frame === this.frames) return false;
    this.waited = { seq, frame: this.frames };
    return true;
  }

  draw() {
    const { state, gone, share } = this.glide.shown(this.store.state, performance.now());
    if (state.quality !== this.quality) this.changeQuality(state.quality);
    this.shown = state;
    this.render(state, gone, share);
    ++this.frames;
    this.drawn();
    if (this.glide.from) this.invalidate();
  }

  /** @param {State} state @param {State['motion']} gone @param {number} share */
  render(state, gone, share) {
    this.lights.update(state.scene, this.renderer.shadowMap.enabled);
    this.bodies.update(state);
    this.walls.update(state, this.bodies.meshes, this.camera.camera);
    this.ground.update(state);
    this.shadows.update(state, this.bodies.meshes);
    this.outline.update(state, this.bodies.meshes, this.camera.width, this.camera.height);
    this.paths.update(state, gone, share);
    this.ghosts.update(state, this.bodies.meshes);
    this.renderer.render(this.scene, this.camera.camera);
  }

  /** Draws another state into a canvas, as wide as that, from where one looks now; what is shown stays.
   * @param {State} state @param {HTMLCanvasElement} canvas */
  drawSmall(state, canvas) {
    const { width, height } = this.camera;
    canvas.height = Math.round((canvas.width * height) / width);
    this.renderer.setSize(canvas.width, canvas.height, false);
    this.sizeLines();
    this.render(state, null, 1);
    canvas.getContext('2d')?.drawImage(this.renderer.domElement, 0, 0, canvas.width, canvas.height);
    this.renderer.setSize(width, height, false);
    this.sizeLines();
    this.draw();
  }

  /** @param {'low' | 'high'} quality */
  changeQuality(quality) {
    this.quality = quality;
    this.renderer.domElement.remove();
    this.renderer.dispose();
    this.renderer = this.makeRenderer(quality);
    this.renderer.setSize(this.host.clientWidth, this.host.clientHeight);
    this.sizeLines();
  }
}
