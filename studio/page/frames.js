// SPDX-License-Identifier: MIT
// Binary frames: "CRM1", the length of the header as uint32, the header (JSON), then blocks of numbers. Little-endian.

/** @typedef {import('./types.js').Shape} Shape */
/** @typedef {import('./types.js').SceneShapes} SceneShapes */
/** @typedef {import('./types.js').Motion} Motion */
/** @typedef {import('./types.js').Track} Track */

const parabolaNumbers = 10, turnNumbers = 5;

/** @typedef {{header: any, bytes: ArrayBuffer, start: number}} Frame */

/** Throws an Error that says what is wrong with a frame that is none.
 * @param {ArrayBuffer} bytes @returns {Frame} */
export function decodeFrame(bytes) {
  const view = new DataView(bytes);
  if (bytes.byteLength < 8 || view.getUint32(0, false) !== 0x43524d31) throw new Error('a frame does not begin with CRM1');
  const length = view.getUint32(4, true);
  if (length % 8 !== 0 || 8 + length > bytes.byteLength) throw new Error(`a frame of ${bytes.byteLength} bytes has a header of ${length}`);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 8, length)));
  return { header, bytes, start: 8 + length };
}

/** The numbers of a block: [byte, rows] of the header, with so many numbers a row.
 * @template {Float64Array | Float32Array | Uint32Array} A
 * @param {Frame} frame @param {[number, number]} block @param {number} width
 * @param {new (bytes: ArrayBuffer, start: number, count: number) => A} kind @returns {A} */
function numbersOf(frame, [byte, rows], width, kind) {
  const count = rows * width, size = kind === /** @type {any} */ (Float64Array) ? 8 : 4;
  if (!(byte >= 0 && byte % 8 === 0 && rows >= 0 && frame.start + byte + count * size <= frame.bytes.byteLength)) {
    throw new Error(`a block of ${count} numbers at ${byte} does not lie in its frame`);
  }
  return new kind(frame.bytes, frame.start + byte, count);
}

/** @param {Frame} frame @returns {Track[]} those that the frame brings */
export function tracksOf(frame) {
  return (frame.header.tracks ?? []).map((/** @type {any} */ track) => ({
    body: track.body,
    stride: track.stride ?? parabolaNumbers,
    arcs: numbersOf(frame, track.arcs, track.stride ?? parabolaNumbers, Float64Array),
    turns: numbersOf(frame, track.turns, turnNumbers, Float32Array),
    center: track.center ?? [0, 0, 0],
  }));
}

/** A motion; tracks that the frame leaves out are those of the motion before it.
 * @param {Frame} frame @param {Motion | null} before @returns {Motion} */
export function motionOf(frame, before) {
  const header = frame.header;
  const tracks = before ? before.tracks.slice(0, header.count) : [];
  for (const track of tracksOf(frame)) tracks[track.body] = track;
  for (let i = 0; i < tracks.length; ++i) if (!tracks[i]) throw new Error(`a motion lacks the track of body ${i}`);
  return {
    rev: header.rev ?? 0, stage: header.stage ?? 'kept', reached: header.reached ?? true,
    distance: header.distance ?? 0, turn: header.turn ?? 0, nailError: header.nail_error ?? 0,
    stopped: header.stopped ?? false, more: header.more ?? false, obstacle: obstacleOf(header.obstacle),
    changes: header.changes ?? [], end: header.end, status: header.status ?? '', message: header.message ?? '',
    gravity: header.gravity ?? [0, 0, 0], impacts: header.impacts ?? [], contacts: header.contacts ?? [], tracks, gesture: header.gesture, seq: header.seq, re: header.re,
  };
}

/** @param {any} obstacle @returns {import('./types.js').Obstacle | null} null without an obstacle */
function obstacleOf(obstacle) {
  return obstacle && obstacle.kind && obstacle.kind !== 'none' ? obstacle : null;
}

/** All shapes of a scene; those that the frame leaves out are taken from the one before.
 * @param {Frame} frame @param {SceneShapes | null} before @returns {SceneShapes} */
export function shapesOf(frame, before) {
  const header = frame.header;
  const shapes = before ? before.shapes.slice(0, header.count) : [];
  for (const body of header.bodies) {
    shapes[body.body] = {
      body: body.body, name: body.name, fixed: !!body.fixed, plane: body.plane ?? null, colour: body.colour,
      vertices: body.vertices ? numbersOf(frame, body.vertices, 3, Float32Array) : new Float32Array(),
      normals: body.normals ? numbersOf(frame, body.normals, 3, Float32Array) : null,
      triangles: body.triangles ? numbersOf(frame, body.triangles, 3, Uint32Array) : null,
      accent: body.accent ? numbersOf(frame, body.accent, 3, Uint32Array) : null,
      center: body.center ?? [0, 0, 0], radius: body.radius ?? 0,
    };
  }
  for (let i = 0; i < header.count; ++i) if (!shapes[i]) throw new Error(`a scene lacks the shape of body ${i}`);
  const extent = header.extent ?? { min: [-1, -1, 0], max: [1, 1, 1] };
  return { shapes, min: extent.min, max: extent.max };
}
