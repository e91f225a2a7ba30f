// SPDX-License-Identifier: MIT
// The socket to the server: greeting, answers, reconnecting, and the sender of drags. Nothing else of the page knows
// that there is a socket.

import { decodeFrame } from './frames.js';
import { canProve, newNonce, proofOf } from './proof.js';

/** @typedef {{code: string, message: string, pointer?: string, file?: string}} ServerError */
/** @typedef {{status: (status: 'connecting' | 'open' | 'lost' | 'ended', why: string) => void,
 *    message: (message: any) => void, frame: (frame: import('./frames.js').Frame) => void}} Listener */

const protocol = 1;
const waits = [200, 500, 1000, 2000, 5000];
/** ms: a later proof does not count, as it may have been asked of a server that began meanwhile (Limits::no_proof). */
const longestProof = 1000;
const stranger = 'What answers at this address is not the server that this page knows: it was told nothing. If carom studio runs again, ' +
  'open the address that it printed.';

export class Connection {
  /** @param {{url: string, token: string, tab: string, listener: Listener, socket?: (url: string) => WebSocket,
   *    later?: (act: () => void, ms: number) => unknown, now?: () => number}} options */
  constructor({ url, token, tab, listener, socket = (u) => new WebSocket(u), later = (act, ms) => setTimeout(act, ms), now = () => performance.now() }) {
    this.url = url;
    this.token = token;
    this.tab = tab;
    this.listener = listener;
    this.makeSocket = socket;
    this.later = later;
    this.now = now;
    /** @type {WebSocket | null} */
    this.socket = null;
    this.id = 0;
    this.failures = 0;
    this.greeted = false;
    /** Greeted once: from then on another program may have the port. */
    this.known = false;
    /** @type {{nonce: string, began: number} | null} */
    this.proving = null;
    this.strange = false;
    this.received = 0;
    /** @type {Map<number, {resolve: (answer: any) => void, reject: (error: ServerError) => void}>} */
    this.asked = new Map();
  }

  connect() {
    this.listener.status('connecting', '');
    const socket = this.makeSocket(this.url);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    socket.onopen = () => (this.known ? this.prove(socket) : this.hello());
    socket.onmessage = (event) => {
      if (socket !== this.socket) return;
      if (this.proving) void this.proven(socket, event.data);
      else this.receive(event.data);
    };
    socket.onclose = (event) => {
      if (socket === this.socket) this.closed(event.code);
    };
  }

  hello() {
    this.send('hello', { protocol, token: this.token, tab: this.tab });
  }

  /** Who answers has to show that it knows the token before it is told. @param {WebSocket} socket */
  prove(socket) {
    if (!canProve()) return this.end('This browser cannot tell whether this is the server of before. Load the page again.');
    this.proving = { nonce: newNonce(), began: this.now() };
    this.send('prove', { nonce: this.proving.nonce });
    this.later(() => {
      if (socket === this.socket && this.proving) this.refuse(socket);
    }, 2 * longestProof);
  }

  /** @param {WebSocket} socket @param {string | ArrayBuffer} data that came in place of a welcome */
  async proven(socket, data) {
    const proving = /** @type {{nonce: string, began: number}} */ (this.proving), came = this.now();
    let given;
    try {
      given = typeof data === 'string' ? JSON.parse(data).proof : undefined;
    } catch {
      given = undefined;
    }
    const right = given === (await proofOf(this.token, proving.nonce)), late = came - proving.began > longestProof;
    if (socket !== this.socket || proving !== this.proving) return;
    if (!right) return this.refuse(socket);
    if (late) return socket.close();  // of a slow machine: asked again
    this.proving = null;
    this.hello();
  }

  /** @param {WebSocket} socket */
  refuse(socket) {
    this.strange = true;
    socket.close();
  }

  /** @param {string} why */
  end(why) {
    const { socket } = this;
    this.socket = null;
    socket?.close();
    this.listener.status('ended', why);
  }

  /** @param {string | ArrayBuffer} data */
  receive(data) {
    ++this.received;
    /** @type {any} */
    let message;
    try {
      if (typeof data === 'string') {
        message = JSON.parse(data);
        if (message.type === 'welcome') {
          this.greeted = this.known = true;
          this.failures = 0;
          this.listener.status('open', '');
        }
        this.listener.message(message);
      } else {
        const frame = decodeFrame(data);
        message = frame.header;
        if (message.type === 'exported') message.bytes = new Uint8Array(frame.bytes, frame.start, message.size);
        this.listener.frame(frame);
      }
    } catch (error) {
      console.error(error);
      this.listener.message({ type: 'error', code: 'internal', message: `The page did not understand an answer: ${error}` });
    }
    const re = message?.re, waiting = this.asked.get(re);
    if (!waiting || message.type === 'progress') return;  // the answer comes after it
    this.asked.delete(re);
    if (message.type === 'error') waiting.reject(message);
    else waiting.resolve(message);
  }

  /** @param {number} code of WebSocket */
  closed(code) {
    const why = this.strange ? stranger : '';
    this.socket = this.proving = null;
    this.greeted = this.strange = false;
    for (const { reject } of this.asked.values()) reject({ code: 'lost', message: 'The connection to the server was lost.' });
    this.asked.clear();
    if (code === 4401) return this.listener.status('ended', 'This address gives no access to this session. Open the one that carom studio printed.');
    if (code === 4400) return this.listener.status('ended', 'The server speaks another protocol than this page. Reload the page.');
    this.listener.status('lost', why);
    const wait = waits[Math.min(this.failures++, waits.length - 1)];
    this.later(() => this.connect(), wait);
  }

  /** @param {string} type @param {object} members @returns {number} the message's id; 0 where there is no connection */
  send(type, members = {}) {
    if (!this.socket || this.socket.readyState !== 1 || (!this.greeted && type !== 'hello' && type !== 'prove')) return 0;
    this.socket.send(JSON.stringify({ type, id: ++this.id, ...members }));
    return this.id;
  }

  /** The first answer to a message, but for how it is getting on; rejects with the server's error.
   * @param {string} type @param {object} members @returns {Promise<any>} */
  request(type, members = {}) {
    const id = this.send(type, members);
    if (!id) return Promise.reject({ code: 'lost', message: 'There is no connection to the server.' });
    return new Promise((resolve, reject) => this.asked.set(id, { resolve, reject }));
  }
}

/** @typedef {{place: import('./types.js').Vec3, orientation?: import('./types.js').Quat, components?: string[]}} DragTarget */

/** Targets of one gesture: one unanswered at a time, the newest of the others waits. */
export class TargetSender {
  /** @param {number} gesture */
  constructor(gesture) {
    this.gesture = gesture;
    this.seq = 0;
    this.unanswered = false;
    /** @type {DragTarget | null} */
    this.waiting = null;
    /** @type {DragTarget | null} */
    this.newest = null;
  }

  /** @param {DragTarget} target */
  offer(target) {
    this.waiting = this.newest = target;
    this.go();
  }

  go() {
    if (this.unanswered || !this.waiting) return;
    const target = this.waiting;
    this.waiting = null;
    this.unanswered = true;
    ++this.seq;
    this.sendTarget(target);
  }

  /** The newest target, whether it has been sent or not; none waits any more. */
  takeNewest() {
    this.waiting = null;
    return this.newest;
  }

  /** @param {DragTarget} target */
  sendTarget(target) {
    throw new Error(`nobody sends ${JSON.stringify(target)}`);
  }
}

/** Sends targets of a body that is held. */
export class DragSender extends TargetSender {
  /** @param {(members: object) => void} send @param {number} gesture */
  constructor(send, gesture) {
    super(gesture);
    this.send = send;
  }

  /** The answer to a drag came, or an error in its place. @param {number} seq */
  answered(seq) {
    if (seq < this.seq) return;
    this.unanswered = false;
    this.go();
  }

  /** @param {DragTarget} target */
  sendTarget(target) {
    this.send({ gesture: this.gesture, seq: this.seq, ...target });
  }

  /** What goes with the release: the newest target, whether it has been sent or not, so that none is lost. */
  last() {
    if (this.waiting) ++this.seq;
    return { gesture: this.gesture, seq: this.seq, ...this.takeNewest() };
  }
}
