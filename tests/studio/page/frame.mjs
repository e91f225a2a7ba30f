// SPDX-License-Identifier: MIT
// Makes binary frames as the server does, for tests of the page.

/** `build` gets `block(array, rows)`, which keeps numbers and gives [byte, rows], and returns the header. */
export function makeFrame(build) {
  const parts = [];
  let size = 0;
  const block = (array, rows) => {
    const bytes = Buffer.from(array.buffer, array.byteOffset, array.byteLength), at = size;
    const padding = (8 - (bytes.length % 8)) % 8;
    parts.push(bytes, Buffer.alloc(padding));
    size += bytes.length + padding;
    return [at, rows];
  };
  const header = build(block);
  let text = Buffer.from(JSON.stringify(header));
  text = Buffer.concat([text, Buffer.alloc((8 - (text.length % 8)) % 8, 0x20)]);
  const head = Buffer.alloc(8);
  head.write('CRM1', 'latin1');
  head.writeUInt32LE(text.length, 4);
  return Buffer.concat([head, text, ...parts]);
}

/** Of a Buffer, as a WebSocket gives it. */
export const bytesOf = (buffer) => buffer.buffer.slice(buffer.byteOffset, buffer.byteOffset + buffer.byteLength);
