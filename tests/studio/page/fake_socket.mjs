// SPDX-License-Identifier: MIT
// As much of a WebSocket server as the page's tests need: text and binary messages below 64 kB a fragment, no extensions.
import { createHash } from 'node:crypto';

/** Takes over an upgraded connection. @returns {{send: (data: string | Buffer) => void, close: (code: number) => void}} */
export function accept(request, socket, { message, closed }) {
  const key = createHash('sha1').update(request.headers['sec-websocket-key'] + '258EAFA5-E914-47DA-95CA-C5AB0DC85B11').digest('base64');
  socket.write(`HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: ${key}\r\n\r\n`);
  let waiting = Buffer.alloc(0);
  const frame = (opcode, data) => {
    const long = data.length > 65535, head = Buffer.alloc(data.length < 126 ? 2 : long ? 10 : 4);
    head[0] = 0x80 | opcode;
    head[1] = data.length < 126 ? data.length : long ? 127 : 126;
    if (long) head.writeBigUInt64BE(BigInt(data.length), 2);
    else if (data.length >= 126) head.writeUInt16BE(data.length, 2);
    if (socket.writable) socket.write(Buffer.concat([head, data]));
  };
  socket.on('data', (bytes) => {
    waiting = Buffer.concat([waiting, bytes]);
    for (let taken = oneFrame(waiting); taken; taken = oneFrame(waiting)) {
      waiting = waiting.subarray(taken.size);
      if (taken.opcode === 8) socket.end();
      else if (taken.opcode === 9) frame(10, taken.data);
      else if (taken.opcode === 1) message(taken.data.toString('utf8'));
    }
  });
  socket.on('close', closed);
  socket.on('error', () => {});
  return {
    send: (data) => frame(typeof data === 'string' ? 1 : 2, Buffer.from(data)),
    close: (code) => {
      const data = Buffer.alloc(2);
      data.writeUInt16BE(code);
      frame(8, data);
      socket.end();
    },
  };
}

function oneFrame(bytes) {
  if (bytes.length < 6) return null;
  let length = bytes[1] & 127, at = 2;
  if (length === 126) [length, at] = [bytes.readUInt16BE(2), 4];
  else if (length === 127) [length, at] = bytes.length < 10 ? [Infinity, 10] : [Number(bytes.readBigUInt64BE(2)), 10];
  if (bytes.length < at + 4 + length) return null;
  const mask = bytes.subarray(at, at + 4), data = Buffer.from(bytes.subarray(at + 4, at + 4 + length));
  for (let i = 0; i < data.length; ++i) data[i] ^= mask[i % 4];
  return { opcode: bytes[0] & 15, data, size: at + 4 + length };
}
