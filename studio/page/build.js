// SPDX-License-Identifier: MIT
// What is built: bodies to add, where on a surface the pointer is, and drags at time 0, which place, turn and throw a body by
// numbers of the document. What is shown meanwhile is the motion of these numbers.

import { TargetSender } from './connection.js';
import { rotate } from './motion.js';
import { along, axisOf, dot, minus } from './tools/move.js';

/** @typedef {import('./types.js').Vec3} Vec3 */
/** @typedef {import('./types.js').Quat} Quat */
/** @typedef {import('./types.js').State} State */
/** @typedef {import('./connection.js').DragTarget} DragTarget */
/** @typedef {{pointer: string, value: unknown}} Edit */
/** @typedef {{point: Vec3, normal: Vec3}} Surface */

/** What there is to add, in sizes of a table top: m, kg/m^3. @type {[string, object][]} */
export const additions = [
  ['Ball', { name: 'ball', shape: { sphere: { radius: 0.1 } }, density: 600 }], ['Box', { name: 'box', shape: { box: { size: [0.2, 0.2, 0.2] } }, density: 600 }],
  ['Cylinder', { name: 'cylinder', shape: { cylinder: { radius: 0.1, height: 0.2 } }, density: 600 }], ['Capsule', { name: 'capsule', shape: { capsule: { radius: 0.05, height: 0.2 } }, density: 600 }],
  ['Die', { name: 'die', shape: { box: { size: [0.06, 0.06, 0.06] } }, density: 1200 }], ['Cone', { name: 'cone', shape: { cone: { radius: 0.1, height: 0.2 } }, density: 600 }], ['Table', { name: 'table', shape: { box: { size: [1.2, 0.8, 0.04] } }, fixed: true }],
];

/** What the next press puts down. @param {Pick<State, 'adding' | 'mesh'>} state @returns {object} as in documents */
export const addedBody = ({ adding, mesh }) => (adding < additions.length ? additions[adding][1] : { name: nameOfFile(mesh), shape: { mesh: { file: mesh } }, density: 600 });

/** "mug" of "assets/mug.obj". @param {string} path */
export const nameOfFile = (path) => path.slice(path.lastIndexOf('/') + 1).replace(/\.[^.]*$/, '');

/** A file of the folder as a document beside or below it names it. @param {string} file @param {string | null} document */
export function fileFrom(file, document) {
  const from = (document ?? '').split('/').slice(0, -1), to = file.split('/');
  while (from.length && to.length > 1 && from[0] === to[0]) [from, to].forEach((parts) => parts.shift());
  return [...from.map(() => '..'), ...to].join('/');
}

/** s: an arrow of a throw is as long as the body would go in that time, and a ring of a spin is turned as far as the body would. */
export const arrowSeconds = 0.1;

/** The nearest surface below the pointer, with the side of it that is seen; planes as well.
 * @param {import('./view/view.js').View} view @param {State} state @param {number} x @param {number} y px @param {number} except a body that does not count
 * @returns {Surface | null} */
export function surfaceUnder(view, { scene, motion, time }, x, y, except = -1) {
  if (!scene || !motion) return null;
  const { origin, direction } = view.camera.ray(x, y), seen = view.bodies.surface(view.camera.cast(x, y), except);
  let best = seen, least = seen ? dot(minus(seen.point, origin), direction) : Infinity;
  for (const { plane, body } of scene.shapes) {
    if (!plane) continue;
    const { turn, place } = view.bodies.poseOf(motion.tracks[body], Math.min(time, motion.end)), normal = rotate(turn, plane.normal);
    const rate = dot(direction, normal), far = (plane.offset - dot(minus(origin, place), normal)) / rate;
    if (rate < -0.01 && far > 0 && far < least) [best, least] = [{ point: along(origin, direction, far), normal }, far];
  }
  return best;
}

/** The edits that a target of a drag means, where the drag is one of the document's numbers; else null: the throw follows.
 * @param {State} state @param {import('./types.js').Hit} hit @param {boolean | {swept: number}} turns by a tool that has swept an angle, rad
 * @returns {((target: DragTarget) => Edit[]) | null} */
export function placing({ document, motion }, hit, turns) {
  const controls = document?.controls ?? [], body = document?.bodies[hit.body], track = motion?.tracks[hit.body];
  if (!body?.position || !body.orientation || !track) return null;
  const { position, orientation } = body, at = `/bodies/${hit.body}`, { center } = track, { place: from } = hit;
  if (hit.handle === 'throw') return ({ place }) => [{ pointer: `${at}/velocity`, value: neat(along(body.velocity ?? [0, 0, 0], minus(place, from), 1 / arrowSeconds)) }];
  if (hit.handle?.startsWith('spin ') && typeof turns === 'object') {
    return () => [{ pointer: `${at}/angular_velocity`, value: neat(along(body.angular_velocity ?? [0, 0, 0], axisOf(hit.handle?.slice(5) ?? '', orientation) ?? [0, 0, 0], turns.swept / arrowSeconds)) }];
  }
  const own = hit.kind === 'body' || hit.kind === 'handle' || hit.kind === 'path';
  if (!own || !(hit.time === 0 || body.fixed) || controls.some((one) => one.body === body.name && one.vary === (turns ? 'orientation' : 'position'))) return null;
  if (!turns) return ({ place }) => [{ pointer: `${at}/position`, value: neat(along(position, minus(place, from), 1)) }];
  const centre = along(position, rotate(orientation, center), 1);
  return ({ orientation: turn = orientation }) => [
    { pointer: `${at}/orientation`, value: turn }, ...(center.some((c) => c !== 0) ? [{ pointer: `${at}/position`, value: minus(centre, rotate(turn, center)) }] : [])];
}

/** Numbers as a person would write them: to 0.01 mm, and mm/s. @param {Vec3} v @returns {Vec3} */
const neat = ([x, y, z]) => [Number(x.toFixed(5)), Number(y.toFixed(5)), Number(z.toFixed(5))];

/** Shows targets of one drag as numbers that are tried. */
export class PlaceSender extends TargetSender {
  /** @param {{request: (type: string, members: object) => Promise<any>, rev: number, gesture: number, edits: (target: DragTarget) => Edit[],
   *    failed: (error: any) => void}} parts `failed`: a target cannot be; what is shown stays */
  constructor({ request, rev, gesture, edits, failed }) {
    super(gesture);
    this.request = request;
    this.failed = failed;
    this.edits = edits;
    this.rev = rev;
  }

  /** That the motion came tells nothing: the answer does. */
  answered() {}

  /** @param {DragTarget} target */
  sendTarget(target) {
    const edits = this.edits(target);
    this.request('try', { rev: this.rev, gesture: this.gesture, seq: this.seq, edits }).catch(this.failed).finally(() => {
      this.unanswered = false;
      this.go();
    });
  }

  /** What the document is to have in the end; null: the hand did not move. */
  last() {
    const newest = this.takeNewest();
    return newest && { rev: this.rev, edits: this.edits(newest) };
  }
}
