// SPDX-License-Identifier: MIT
// A stand-in for the studio's server: a ball that is thrown onto a floor and bounces, and a post. Enough physics for the
// page to be dragged, and states that are hard to bring about with the real one.
import { createHmac } from 'node:crypto';
import { createServer } from 'node:http';
import { existsSync, readFileSync } from 'node:fs';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { accept } from './fake_socket.mjs';
import { makeFrame } from './frame.mjs';

const page = fileURLToPath(new URL('../../../studio/page/', import.meta.url));
const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.css': 'text/css' };
const gravity = -9.81, radius = 0.1, elasticity = 0.7, start = [-1, 0, 1], fastest = 8;

function fly(velocity, end) {
  const arcs = [], impacts = [];
  let t = 0, x = [...start], v = [...velocity];
  for (let n = 0; n < 20 && t < end; ++n) {
    arcs.push([t, ...x, ...v, 0, 0, gravity]);
    const s = (v[2] + Math.sqrt(v[2] * v[2] - 2 * gravity * Math.max(0, x[2] - radius))) / -gravity;
    if (t + s >= end || s < 1e-3) break;
    x = [x[0] + s * v[0], x[1] + s * v[1], radius];
    v = [v[0], v[1], -elasticity * (v[2] + s * gravity)];
    t += s;
    impacts.push({ t, point: [x[0], x[1], 0], bodies: [0, 1], nth: [0, impacts.length + 1], pairs: [[0, 1]], mode: 'stick' });
  }
  return { arcs, impacts, end };
}

const cube = (x, y, z) => {
  const corners = [], triangles = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
  for (let k = 0; k < 8; ++k) corners.push((k & 4 ? 1 : -1) * x, (k & 2 ? 1 : -1) * y, (k & 1 ? 1 : -1) * z);
  return { vertices: new Float32Array(corners), triangles: new Uint32Array(triangles.flatMap(([a, b, c, d]) => [a, b, c, a, c, d])) };
};

export class FakeStudio {
  /** `deaf`: types of messages that it does not answer. */
  constructor({ open = true, locked = false, changedOnDisk = false, deaf = [] } = {}) {
    Object.assign(this, { open, locked, changedOnDisk, deaf, controls: [{ vary: 'velocity', body: 'ball <b>' }], velocity: [2, 0, 3], history: [], future: [], nails: [], rev: 1, scene: 1, heard: [], clients: new Set(), saved: true, session: `s${Math.random()}`, mute: false });
    this.server = createServer((request, response) => this.file(request, response));
    this.server.on('upgrade', (request, socket) => {
      const client = accept(request, socket, { message: (text) => this.hear(client, JSON.parse(text)), closed: () => this.clients.delete(client) });
      client.socket = socket;
      this.clients.add(client);
    });
  }

  async listen(port = 0) {
    await new Promise((done) => this.server.listen(port, '127.0.0.1', done));
    this.port = this.server.address().port;
    return `http://127.0.0.1:${this.port}/`;
  }

  async close() {
    for (const client of this.clients) client.socket.destroy();
    this.server.closeAllConnections();
    await new Promise((done) => this.server.close(done));
  }

  file(request, response) {
    const path = normalize(new URL(request.url, 'http://x').pathname), name = path === '/' ? '/index.html' : path;
    const at = name.startsWith('/three/') ? join(page, 'node_modules', name) : join(page, name);
    if (!existsSync(at) || !types[extname(at)]) return response.writeHead(404).end();
    response.writeHead(200, { 'Content-Type': types[extname(at)], 'Cache-Control': 'no-store',
      'Content-Security-Policy': "default-src 'none'; script-src 'self' 'nonce-abc'; style-src 'self'; connect-src 'self'; img-src 'self' data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'" });
    response.end(name === '/index.html' ? readFileSync(at, 'utf8').replaceAll('{{nonce}}', 'abc') : readFileSync(at));
  }

  motionFrame(members, velocity = this.velocity) {
    const { arcs, impacts, end } = fly(velocity, 1.5);
    return makeFrame((block) => {
      const still = (body, x) => ({ body, arcs: block(new Float64Array([0, ...x, 0, 0, 0, 0, 0, 0]), 1), turns: block(new Float32Array([0, 1, 0, 0, 0]), 1), center: [0, 0, 0] });
      const turns = Array.from({ length: 31 }, (_, k) => [k / 20, Math.cos(k / 10), 0, Math.sin(k / 10), 0]);
      const ball = { body: 1, arcs: block(new Float64Array(arcs.flat()), arcs.length), turns: block(new Float32Array(turns.flat()), turns.length), center: [0, 0, 0] };
      return { type: 'motion', scene: this.scene, rev: this.rev, stage: 'improved', reached: true, distance: 0, turn: 0, nail_error: 0, stopped: false, more: false,
        obstacle: { kind: 'none', numbers: [], sentence: '' }, changes: [], end, status: 'complete', message: '', gravity: [0, 0, gravity], impacts, ...members, tracks: [still(0, [0, 0, 0]), ball, still(2, [0.9, 0.5, 0.4])] };
    });
  }

  sceneFrame(members) {
    return makeFrame((block) => {
      const mesh = (shape) => ({ vertices: block(shape.vertices, 8), triangles: block(shape.triangles, 12) });
      return { type: 'scene', ...members, scene: this.scene, count: 3, extent: { min: [-1.1, -0.2, 0], max: [2, 0.6, 1.6] }, bodies: [
        { body: 0, name: 'floor', fixed: true, colour: '#b9bec4', center: [0, 0, 0], plane: { normal: [0, 0, 1], offset: 0 } },
        { body: 1, name: 'ball <b>', fixed: false, colour: '#2468b8', center: [0, 0, 0], radius, ...mesh(cube(0.07, 0.07, 0.07)) },
        { body: 2, name: 'post', fixed: true, colour: '#a7adb5', center: [0, 0, 0], radius: 0.42, ...mesh(cube(0.05, 0.05, 0.4)) }] };
    });
  }

  state(re) {
    const numbers = ['x', 'y', 'z'].map((component, i) => ({ control: 0, name: `velocity.${component} of 'ball <b>'`, component, opened: [2, 0, 3][i], now: this.velocity[i], min: null, max: null, scale: 1, at_bound: null, pointer: `/bodies/1/velocity/${i}` }));
    return JSON.stringify(this.open ? {
      type: 'state', re, rev: this.rev, open: true, path: 'throw.json', name: 'A throw', saved: this.saved, duration: 1.5, controls: this.controls, numbers: this.controls.length ? numbers : [],
      nails: this.nails, undo: this.history.length ? "drag of 'ball <b>'" : null, redo: this.future.length ? 'drag' : null, held_by: null,
      bodies: [{ name: 'floor', fixed: true, kinematic: false, mass: null, material: 'wood' }, { name: 'ball <b>', fixed: false, kinematic: false, mass: 1, material: 'felt' }, { name: 'post', fixed: true, kinematic: false, mass: null, material: 'wood' }],
      materials: [{ name: 'felt', elasticity: 0.7, friction: 0.3 }, { name: 'wood', elasticity: 0.5, friction: 0.3 }],
    } : { type: 'state', re, rev: 0, open: false });  // no more, as of the real one
  }

  everything(client, re) {
    if (this.open) {
      client.send(this.sceneFrame({ re }));
      client.send(this.motionFrame({ re }));
    }
    client.send(this.state(re));
  }

  step() {
    this.history.push([...this.velocity]);
    this.future = [];
    this.saved = false;
    ++this.rev;
  }

  /** Throws the ball so that it is at a place at a time; as far as it may be thrown. */
  aim(place, time) {
    const t = Math.max(time, 0.02), wanted = place.map((p, i) => (p - start[i] - (i === 2 ? 0.5 * gravity * t * t : 0)) / t);
    const speed = Math.hypot(...wanted), share = Math.min(1, fastest / speed);
    this.velocity = wanted.map((v) => v * share);
    const distance = (speed - speed * share) * t;
    return { reached: share === 1, distance, obstacle: share < 1 ? { kind: 'bounds', numbers: ["velocity of 'ball <b>'"], sentence: 'The ball cannot be thrown faster than 8 m/s.' } : { kind: 'none', numbers: [], sentence: '' } };
  }

  hear(client, message) {
    this.heard.push(message);
    if (this.mute || this.deaf.includes(message.type)) return;
    const { type, id, gesture, seq } = message, done = (members = {}) => {
      client.send(this.motionFrame({ re: id, ...members }));
      client.send(this.state(id));
    };
    if (type === 'prove') {
      client.send(JSON.stringify({ type: 'proof', re: id, proof: createHmac('sha256', this.token ?? '').update(message.nonce).digest('hex') }));
    } else if (type === 'hello') {
      this.token = message.token;
      client.send(JSON.stringify({ type: 'welcome', re: id, protocol: 1, version: 'test', session: this.session, folder: '/scenes', recovered: 0, limits: {} }));
      this.everything(client, id);
    } else if (type === 'grab' || type === 'grab_nail') {
      if (this.locked) return client.send(JSON.stringify({ type: 'error', re: id, code: 'busy', message: 'Another tab holds a body.' }));
      this.held = { at: this.timeOf(message.at ?? this.nails.find((nail) => nail.id === message.nail).constraint.at), velocity: [...this.velocity], body: message.body };
      client.send(this.motionFrame({ re: id, gesture }));
    } else if (!this.held && ['drag', 'release', 'cancel'].includes(type)) {
      client.send(JSON.stringify({ type: 'error', re: id, code: 'not_held', message: 'Nothing is held.' }));
    } else if (type === 'drag') {
      client.send(this.motionFrame({ gesture, seq, ...(this.last = this.aim(message.place, this.held.at)) }));
    } else if (type === 'release') {
      const last = message.place ? this.aim(message.place, this.held.at) : this.last;
      const now = this.velocity;
      this.velocity = this.held.velocity;
      this.step();
      this.velocity = now;
      if (message.nail) this.nails.push({ id: this.nails.length, constraint: { body: this.held.body, at: this.held.at, position: message.place ?? [0, 0, 1] }, on: true, available: true, met: true, time: this.held.at, error: 0, message: '' });
      done({ gesture, seq, ...last });
    } else if (type === 'cancel') {
      this.velocity = this.held.velocity;
      done({ gesture });
    } else if (type === 'undo' || type === 'redo') {
      const [from, to] = type === 'undo' ? [this.history, this.future] : [this.future, this.history];
      if (from.length) {
        to.push(this.velocity);
        this.velocity = from.pop();
        this.saved = this.history.length === 0;
        ++this.rev;
      }
      done();
    } else if (type === 'save') {
      if (this.changedOnDisk && !message.replace && !message.path) return client.send(JSON.stringify({ type: 'error', re: id, code: 'conflict', message: "'throw.json' has changed on disk since it was opened here" }));
      this.saved = true;
      client.send(JSON.stringify({ type: 'saved', re: id, path: 'throw.json', rev: this.rev }));
      client.send(this.state(id));
    } else if (type === 'set') {
      this.step();
      for (const { pointer, value } of message.edits) this.velocity[Number(pointer.at(-1))] = value;
      done();
    } else if (type === 'gallery') {
      client.send(JSON.stringify({ type: 'gallery', re: id, scenes: [{ path: 'throw.json', name: 'A throw', notes: '', picture: null }, { path: 'dice.json', name: 'Four dice', notes: '', picture: null }] }));
    } else if (type === 'why') {
      const remedies = this.remedies ?? [];
      client.send(JSON.stringify({ type: 'why', re: id, rev: message.rev, more: false, sentence: '', remedies }));
    } else if (type === 'list') {
      client.send(JSON.stringify({ type: 'files', re: id, path: '', files: [{ path: 'throw.json', name: 'throw.json', kind: 'scene' }, { path: 'more', name: 'more', kind: 'folder' }] }));
    } else if (type === 'open') {
      this.open = true;
      ++this.scene;
      this.everything(client, id);
    } else {
      if (type === 'nail_on') this.nails = this.nails.map((nail) => (nail.id === message.nail ? { ...nail, on: message.on } : nail));
      if (type === 'controls') this.controls = message.controls;
      if (type === 'set_nail') this.nails = this.nails.map((nail) => (nail.id === message.nail ? { ...nail, constraint: message.constraint, time: message.constraint.at } : nail));
      if (type === 'unnail') this.nails = this.nails.filter((nail) => nail.id !== message.nail);
      if (type === 'nail') this.nails = [...this.nails, { id: this.nails.length, constraint: { body: message.body, at: message.at, position: this.placeAt(message.at), orientation: [1, 0, 0, 0] }, on: true, available: true, met: true, time: message.at, error: 0, message: '' }];
      done();
    }
  }

  placeAt(time) {
    const [t, x, y, z, vx, vy, vz, ax, ay, az] = fly(this.velocity, 1.5).arcs.findLast((arc) => arc[0] <= time), s = time - t;
    return [x + s * vx + (s * s * ax) / 2, y + s * vy + (s * s * ay) / 2, z + s * vz + (s * s * az) / 2];
  }

  timeOf(at) {
    return typeof at === 'number' ? at : fly(this.velocity, 1.5).impacts[at.impact - 1].t;
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) console.log(await new FakeStudio().listen(8123));
