// SPDX-License-Identifier: MIT
// A client of the studio without a browser: as much of a WebSocket as that needs.
import { randomBytes } from 'node:crypto';
import { connect } from 'node:net';

export class Client {
  /** @param {string} url as carom studio printed it */
  static async connect(url) {
    const { hostname, port, hash, host } = new URL(url), client = new Client(), key = randomBytes(16).toString('base64');
    Object.assign(client, { id: 0, state: null, waiting: new Map(), rest: Buffer.alloc(0), parts: [], opcode: 0, heard: () => {}, gone: false });
    client.socket = connect(Number(port), hostname);
    client.socket.write(`GET /socket HTTP/1.1\r\nHost: ${host}\r\nOrigin: http://${host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: ${key}\r\nSec-WebSocket-Version: 13\r\n\r\n`);
    await new Promise((done, fail) => {
      const head = (bytes) => {
        client.rest = Buffer.concat([client.rest, bytes]);
        const end = client.rest.indexOf('\r\n\r\n');
        if (end < 0) return;
        client.socket.off('data', head);
        client.rest = client.rest.subarray(end + 4);
        client.socket.on('data', (more) => client.take(more));
        done();
      };
      client.socket.on('data', head);
      client.socket.once('error', fail);
    });
    client.socket.on('error', () => {});
    client.socket.on('close', () => client.lost());
    await client.ask('hello', { protocol: 1, token: hash.slice(1), tab: 'killed' });
    while (!client.state) await new Promise((next) => setTimeout(next, 5));
    return client;
  }

  lost() {
    this.gone = true;
    for (const { fail } of this.waiting.values()) fail(new Error('the server is gone'));
    this.waiting.clear();
  }

  take(bytes) {
    this.rest = Buffer.concat([this.rest, bytes]);
    for (;;) {
      if (this.rest.length < 2) return;
      let length = this.rest[1] & 127, at = 2;
      if (length === 126) [length, at] = [this.rest.length < 4 ? Infinity : this.rest.readUInt16BE(2), 4];
      else if (length === 127) [length, at] = [this.rest.length < 10 ? Infinity : Number(this.rest.readBigUInt64BE(2)), 10];
      if (this.rest.length < at + length) return;
      const last = this.rest[0] & 128, opcode = (this.rest[0] & 15) || this.opcode;
      this.parts.push(this.rest.subarray(at, at + length));
      this.rest = this.rest.subarray(at + length);
      this.opcode = opcode;
      if (!last) continue;
      const data = Buffer.concat(this.parts);
      this.parts = [];
      const message = opcode === 1 ? JSON.parse(data.toString()) : opcode === 2 ? JSON.parse(data.subarray(8, 8 + data.readUInt32LE(4)).toString()) : null;
      if (message) this.hear(message);
      if (opcode === 9) this.socket.write(Buffer.from([0x8a, 0x80, 0, 0, 0, 0]));  // a ping: or it is taken for dead after half a minute
    }
  }

  /** A command is answered by its state, or by an error. */
  hear(message) {
    if (message.type === 'state') this.state = message;
    this.heard(message);
    const waiting = this.waiting.get(message.re);
    if (!waiting || !['state', 'error', 'files', 'gallery'].includes(message.type)) return;
    this.waiting.delete(message.re);
    waiting.done(message);
  }

  send(type, members = {}) {
    const data = Buffer.from(JSON.stringify({ type, id: ++this.id, ...members })), mask = randomBytes(4), long = data.length > 125;
    const head = Buffer.alloc(long ? 4 : 2);
    head[0] = 0x81;
    head[1] = 0x80 | (long ? 126 : data.length);
    if (long) head.writeUInt16BE(data.length, 2);
    this.socket.write(Buffer.concat([head, mask, data.map((byte, i) => byte ^ mask[i % 4])]));
    return this.id;
  }

  ask(type, members = {}) {
    if (this.gone) return Promise.reject(new Error('the server is gone'));
    return new Promise((done, fail) => this.waiting.set(this.send(type, members), { done, fail }));
  }

  close() {
    this.socket.destroy();
  }
}
