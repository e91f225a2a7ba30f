// SPDX-License-Identifier: MIT
// Prints where the page's own modules draw every body of a motion frame: node page_motion.mjs PAGE FRAME TIMES
// PAGE is the folder of frames.js and motion.js, TIMES a JSON list. The answer, as JSON: a list a body of
// [x, y, z, qw, qx, qy, qz, ox, oy, oz] a time: centre of mass, turn of the shape, origin of the shape.
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [page, file, times] = process.argv.slice(2);
const moduleOf = (name) => import(pathToFileURL(`${page}/${name}`).href);
const { decodeFrame, motionOf } = await moduleOf('frames.js');
const { centreAt, turnAt, poseAt } = await moduleOf('motion.js');

const bytes = readFileSync(file);
const frame = decodeFrame(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
const at = JSON.parse(readFileSync(times, 'utf8'));
const poses = motionOf(frame, null).tracks.map((track) =>
  at.map((t) => [...centreAt(track, t), ...turnAt(track, t), ...poseAt(track, t).place]));
process.stdout.write(JSON.stringify(poses));
