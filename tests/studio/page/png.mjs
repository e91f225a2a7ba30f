// SPDX-License-Identifier: MIT
// Colours of a picture that the browser took: PNG with 8 bits a channel, as screenshots are.
import { inflateSync } from 'node:zlib';

export function decodePng(bytes) {
  const width = bytes.readUInt32BE(16), height = bytes.readUInt32BE(20), channels = { 2: 3, 6: 4 }[bytes[25]];
  if (bytes[24] !== 8 || !channels || bytes[28] !== 0) throw new Error('a picture is no plain 8-bit PNG');
  const parts = [];
  for (let at = 8; at < bytes.length; at += 12 + bytes.readUInt32BE(at)) {
    if (bytes.toString('latin1', at + 4, at + 8) === 'IDAT') parts.push(bytes.subarray(at + 8, at + 8 + bytes.readUInt32BE(at)));
  }
  const lines = inflateSync(Buffer.concat(parts)), row = width * channels, pixels = Buffer.alloc(row * height);
  for (let y = 0; y < height; ++y) {
    const filter = lines[y * (row + 1)], from = y * (row + 1) + 1, to = y * row;
    for (let i = 0; i < row; ++i) {
      const a = i >= channels ? pixels[to + i - channels] : 0, b = y ? pixels[to + i - row] : 0, c = y && i >= channels ? pixels[to + i - row - channels] : 0;
      pixels[to + i] = lines[from + i] + [0, a, b, (a + b) >> 1, paeth(a, b, c)][filter];
    }
  }
  return { width, height, at: (x, y) => [...pixels.subarray(y * row + x * channels, y * row + x * channels + 3)] };
}

function paeth(a, b, c) {
  const p = a + b - c, [pa, pb, pc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)];
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/** How near a picture comes to a colour within so many px of a place: the largest difference of a channel. */
export function nearestInk(picture, [x, y], colour, within = 3) {
  const wanted = [1, 3, 5].map((i) => Number.parseInt(colour.slice(i, i + 2), 16));
  let best = 255;
  for (let v = Math.floor(y) - within; v <= Math.ceil(y) + within; ++v) {
    for (let u = Math.floor(x) - within; u <= Math.ceil(x) + within; ++u) {
      if (u < 0 || v < 0 || u >= picture.width || v >= picture.height) continue;
      best = Math.min(best, Math.max(...picture.at(u, v).map((c, i) => Math.abs(c - wanted[i]))));
    }
  }
  return best;
}
