// SPDX-License-Identifier: MIT
// The socket to the server: greeting, answers, reconnecting, and the sender of drags. Nothing else of the page knows
// that there is a socket.

import { decodeFrame } from './frames.js';

/** @typedef {{code: string, message: string, pointer?: string, file?: string}} ServerError */
/** @typedef {{status: (status: 'connecting' | 'open' | 'lost' | 'ended', why: string) => void,
 *    message: (message: any) => void, frame: (frame: import('./frames.js').Frame) => void}} Listener */

const protocol = 1;
const waits = [200, 500, 1000, 2000, 5000];

export class Connection {
  /** @param {{url: string, token: string, tab: string, listener: Listener, socket?: (url: string) => WebSocket,
   *    later?: (act: () => void, ms: number) => unknown}} options */
  constructor({ url, token, tab, listener, socket = (u) => new WebSocket(u), later = (act, ms) => setTimeout(act, ms) }) {
    this.url = url;
    this.token = token;
    this.tab = tab;
    this.listener = listener;
    this.makeSocket = socket;
    this.later = later;
    /** @type {WebSocket | null} */
    this.socket = null;
    this.id = 0;
    this.failures = 0;
    this.greeted = false;
    this.received = 0;
    /** @type {Map<number, {resolve: (answer: any) => void, reject: (error: ServerError) => void}>} */
    this.asked = new Map();
  }

  connect() {
    this.listener.status('connecting', '');
    const socket = this.makeSocket(this.url);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    socket.onopen = () => void this.send('hello', { protocol, token: this.token, tab: this.tab });
    socket.onmessage = (event) => {
      if (socket === this.socket) this.receive(event.data);
    };
    socket.onclose = (event) => {
      if (socket === this.socket) this.closed(event.code);
    };
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
          this.greeted = true;
          this.failures = 0;
          this.listener.status('open', '');
        }
        this.listener.message(message);
      } else {
        const frame = decodeFrame(data);
        message = frame.header;
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
    this.socket = null;
    this.greeted = false;
    for (const { reject } of this.asked.values()) reject({ code: 'lost', message: 'The connection to the server was lost.' });
    this.asked.clear();
    if (code === 4401) return this.listener.status('ended', 'This address has no right to this session. Open the one that carom studio printed.');
    if (code === 4400) return this.listener.status('ended', 'The server speaks another protocol than this page. Reload the page.');
    this.listener.status('lost', '');
    const wait = waits[Math.min(this.failures++, waits.length - 1)];
    this.later(() => this.connect(), wait);
  }

  /** @param {string} type @param {object} members @returns {number} the message's id; 0 where there is no connection */
  send(type, members = {}) {
    if (!this.socket || this.socket.readyState !== 1 || (!this.greeted && type !== 'hello')) return 0;
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

/** @typedef {{place: import('./types.js').Vec3, orientation?: import('./types.js').Quat}} DragTarget */

/** Sends targets of one gesture: one unanswered at a time, the newest of the others waits. */
export class DragSender {
  /** @param {(members: object) => void} send @param {number} gesture */
  constructor(send, gesture) {
    this.send = send;
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

  /** The answer to a drag came, or an error in its place. @param {number} seq */
  answered(seq) {
    if (seq < this.seq) return;
    this.unanswered = false;
    this.go();
  }

  go() {
    if (this.unanswered || !this.waiting) return;
    const target = this.waiting;
    this.waiting = null;
    this.unanswered = true;
    this.send({ gesture: this.gesture, seq: ++this.seq, ...target });
  }

  /** What goes with the release: the newest target, whether it has been sent or not, so that none is lost. */
  last() {
    if (this.waiting) ++this.seq;
    this.waiting = null;
    return { gesture: this.gesture, seq: this.seq, ...this.newest };
  }
}
