// SPDX-License-Identifier: MIT
// Where the page's own modules draw the bodies of motion frames: node page_motion.mjs PAGE FOLDER
// PAGE has frames.js and motion.js. For every NAME.frame of FOLDER, with the times of NAME.times (a JSON list), writes
// NAME.poses: a JSON list a body of [x, y, z, qw, qx, qy, qz, ox, oy, oz] a time: centre of mass, turn and origin of the
// shape.
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [page, folder] = process.argv.slice(2);
const moduleOf = (name) => import(pathToFileURL(`${page}/${name}`).href);
const { decodeFrame, motionOf } = await moduleOf('frames.js');
const { centreAt, turnAt, poseAt } = await moduleOf('motion.js');

for (const file of readdirSync(folder).filter((name) => name.endsWith('.frame'))) {
  const stem = `${folder}/${file.slice(0, -'.frame'.length)}`;
  const bytes = readFileSync(`${stem}.frame`), times = JSON.parse(readFileSync(`${stem}.times`, 'utf8'));
  const frame = decodeFrame(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
  const poses = motionOf(frame, null).tracks.map((track) =>
    times.map((t) => [...centreAt(track, t), ...turnAt(track, t), ...poseAt(track, t).place]));
  writeFileSync(`${stem}.poses`, JSON.stringify(poses));
}
