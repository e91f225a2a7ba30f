// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Gesture } from '../../../studio/page/gesture.js';
import { hitAt } from '../../../studio/page/take.js';
import { initialState, Store } from '../../../studio/page/store.js';

// 100 px a metre, looking along +y
function harness(more = {}, touched = null) {
  const track = (body, center = [0, 0, 0]) => ({ body, center, turns: new Float32Array([0, 1, 0, 0, 0]), arcs: new Float64Array([0, 0, 0, 0, 2, 0, 5, 0, 0, -10]) });
  const motion = { end: 1, impacts: [], tracks: [track(0), track(1, [0, 0, 0.05]), track(2)], reached: true };
  const body = (name, fixed = false) => ({ name, fixed, mass: 1, material: 'felt' });
  const store = new Store({ ...initialState(), motion, document: { open: true, bodies: [body('floor', true), body('hat'), body('die')], controls: [{ vary: 'velocity', body: 'hat' }], nails: [], rev: 1 }, ...more });
  const sent = [], asked = [], ended = [], selected = [], later = [];
  const connection = {
    send: (type, members) => sent.push({ type, ...members }),
    request: (type, members) => new Promise((resolve, reject) => {
      sent.push({ type, ...members });
      asked.push({ type, resolve, reject });
    }),
  };
  const space = {
    touched: () => touched,
    ray: (x, y) => ({ origin: [x / 100, -10, -y / 100], direction: [0, 1, 0] }), project: ([x, , z]) => [100 * x, -100 * z],
    camera: () => ({ view: [0, 1, 0], right: [1, 0, 0], up: [0, 0, 1], perPixel: () => 0.01 }),
  };
  const gesture = new Gesture({ store, space, connection, select: (hit) => selected.push(hit), ended: (...a) => ended.push(a), later: (act) => later.push(act) });
  const hit = hitAt(motion, 1, 0.5);
  return { gesture, store, sent, asked, ended, selected, later, hit, state: () => store.state.gesture.state };
}
const turnOver = () => new Promise((done) => setImmediate(done));

test('a press that hardly moves selects', () => {
  const { gesture, sent, selected, hit, state } = harness();
  assert.ok(gesture.press(hit, 10, 10));
  gesture.move(13, 12);
  assert.equal(state(), 'pressed');
  gesture.up(13, 12);
  assert.deepEqual([state(), selected, sent], ['idle', [hit], []]);
  assert.ok(!gesture.press(null, 0, 0), 'beside everything the camera turns');
});

test('a drag takes hold, follows and lets go in one gesture', async () => {
  const { gesture, store, sent, asked, ended, hit, state } = harness();
  gesture.press(hit, 10, 10);
  gesture.move(20, 10);
  assert.equal(state(), 'dragging');
  assert.deepEqual([store.state.selected, store.state.time, store.state.before], [1, 0.5, store.state.motion]);
  assert.deepEqual(sent[0], { type: 'grab', gesture: 1, body: 'hat', at: 0.5, grip: { point: [0, 0, 0.05] }, free: true });
  const [x, , z] = hit.place;
  assert.deepEqual(sent[1].place.map((c) => Number(c.toFixed(9))), [x + 0.1, 0, z].map((c) => Number(c.toFixed(9))));
  gesture.move(30, 10);
  gesture.move(40, 0);
  assert.equal(sent.length, 2, 'the newest waits for the answer');
  gesture.answered({ gesture: 1, seq: 1 });
  assert.deepEqual([sent[2].seq, Number(sent[2].place[0].toFixed(9)), Number(sent[2].place[2].toFixed(9))], [2, Number((x + 0.3).toFixed(9)), Number((z + 0.1).toFixed(9))]);
  gesture.move(50, 0);
  gesture.up(50, 0);
  assert.equal(state(), 'settling');
  assert.deepEqual([sent[3].type, sent[3].gesture, sent[3].seq, Number(sent[3].place[0].toFixed(9))], ['release', 1, 3, Number((x + 0.4).toFixed(9))]);
  asked[1].resolve({ reached: true });
  await turnOver();
  assert.deepEqual([state(), ended], ['idle', [['released', { reached: true }, false]]]);
});

test('Escape leaves every state', async () => {
  const { gesture, sent, asked, hit, state } = harness();
  assert.ok(!gesture.cancel());
  gesture.press(hit, 0, 0);
  gesture.cancel();
  assert.deepEqual([state(), sent.length], ['idle', 0]);
  gesture.press(hit, 0, 0);
  gesture.move(10, 0);
  gesture.startTyping();
  assert.equal(state(), 'typing');
  gesture.cancel();
  assert.equal(state(), 'dragging');
  gesture.cancel();
  assert.deepEqual([state(), sent.at(-1)], ['idle', { type: 'cancel', gesture: 1 }]);
  gesture.press(hit, 0, 0);
  gesture.move(10, 0);
  gesture.up(10, 0);
  gesture.cancel();
  assert.deepEqual([state(), sent.at(-1).type], ['settling', 'stop']);
  asked.at(-1).resolve({ reached: false });
  await turnOver();
  assert.equal(state(), 'idle');
});

test('a press while a release settles stops it, and the late answer does not end the new gesture', async () => {
  const { gesture, sent, asked, hit, state, later, store } = harness();
  gesture.press(hit, 0, 0);
  gesture.move(10, 0);
  gesture.up(10, 0);
  const release = asked.at(-1);
  later[0]();
  assert.ok(store.state.gesture.settlingShown);
  gesture.press(hit, 0, 0);
  assert.deepEqual([sent.at(-1).type, state()], ['stop', 'pressed']);
  gesture.move(10, 0);
  release.resolve({ reached: true });
  await turnOver();
  assert.equal(state(), 'dragging');
});

test('axes, typed numbers and arrow keys', () => {
  const { gesture, sent, store, hit, state } = harness();
  gesture.beginByKey(hit, 'move');
  gesture.setAxis('x', false);
  assert.equal(store.state.gesture.axis, 'x');
  gesture.nudge(10, 0);
  assert.ok(Math.abs(store.state.gesture.target[0] - hit.place[0] - 0.4) < 1e-9);
  gesture.startTyping();
  assert.ok(!gesture.type('1 2'));
  assert.ok(gesture.type('0.4*2'));
  assert.equal(state(), 'settling');
  assert.deepEqual(sent.at(-1).place, [0.8, hit.place[1], hit.place[2]]);
});

test('an axis that leaves the rest free takes hold anew with its component alone', () => {
  const { gesture, sent, hit } = harness({ leaveRestFree: true });
  gesture.press(hit, 0, 0);
  gesture.move(10, 0);
  gesture.setAxis('x', false);
  const [cancel, grab] = sent.filter((one) => one.type !== 'drag').slice(1);
  assert.deepEqual([cancel.type, cancel.gesture, grab.gesture, grab.grip.components], ['cancel', 1, 2, ['x']]);
});

test('turning asks for an orientation alone, unless the hand holds the place as well', () => {
  const { gesture, sent, hit } = harness({ tool: 'turn' });
  gesture.press(hit, 100, -125);
  gesture.move(110, -125);
  assert.deepEqual([sent[0].grip, sent[1].place], [{ orientation: true, place: false }, hit.place]);
  assert.ok(Math.abs(Math.hypot(...sent[1].orientation) - 1) < 1e-12);
  const holding = harness({ tool: 'turn', turnLeavesPlace: false });
  holding.gesture.press(holding.hit, 100, -125);
  holding.gesture.move(110, -125);
  assert.deepEqual(holding.sent[0].grip, { orientation: true, point: [0, 0, 0.05] });
});

test('a release carries the newest target, and a quick hand needs no move before it', () => {
  const { gesture, sent, hit, state } = harness();
  gesture.press(hit, 10, 10);
  gesture.up(60, 10);
  assert.equal(state(), 'settling');
  assert.deepEqual(sent.map((one) => one.type), ['grab', 'drag', 'release']);
  assert.deepEqual([sent[2].seq, sent[2].place], [1, sent[1].place], 'though it was sent as a drag');
  assert.ok(Math.abs(sent[2].place[0] - hit.place[0] - 0.5) < 1e-9);
});

test('what is touched is slid on, its normal is free; L lifts it off', () => {
  const slope = { point: [1, 0, 2], normal: [0, 0.6, 0.8], cut: null };
  const { gesture, sent, hit } = harness({}, slope), impact = { t: 0.5, point: [1, 0, 2], bodies: [0, 1], pairs: [[0, 1]], nth: [0, 1], mode: 'stick' };
  gesture.press({ ...hit, kind: 'impact', at: { impact: 1, with: 'floor' }, impact }, 100, -200);
  gesture.move(100, -230);
  assert.deepEqual(sent[0].grip, { contact: true, components: ['x', 'y'] });
  const [x, y, z] = sent[1].place;
  assert.ok(Math.abs(x - 1) < 1e-12 && Math.abs(0.6 * y + 0.8 * (z - 2)) < 1e-12 && Math.abs(z - 2.3) < 1e-12, `${[x, y, z]} is off the slope`);
  gesture.lift();
  const [cancel, grab, drag] = sent.slice(2);
  assert.deepEqual([cancel.type, grab.gesture, grab.grip], ['cancel', 2, { contact: true }]);
  assert.ok(Math.abs(drag.place[1]) < 1e-12, 'in the plane of the camera');
  gesture.lift();
  assert.deepEqual(sent.at(-2).grip, { contact: true, components: ['x', 'y'] });
  gesture.setAxis('x', false);
  assert.equal(sent.at(-1).type, 'drag', 'along the surface it is held as before');
  gesture.setAxis('z', false);
  assert.deepEqual(sent.at(-2).grip, { contact: true }, 'a person who says z means it');
});

test('a body that nothing moves is freed, as the server says; fixed and locked ones cannot be held', async () => {
  const free = harness();
  free.gesture.press({ ...free.hit, body: 2 }, 0, 0);
  free.gesture.move(10, 0);
  assert.ok(free.sent[0].free && !free.store.state.notice);
  free.asked[0].resolve({ freed: true });
  await turnOver();
  assert.match(free.store.state.notice.message, /throw of 'die' may change/);
  for (const [body, options, words] of [[0, {}, /fixed/], [1, { locked: new Set(['hat']) }, /locked/]]) {
    const { gesture, sent, store, hit, state } = harness(options);
    gesture.press({ ...hit, body }, 0, 0);
    gesture.move(10, 0);
    assert.deepEqual([state(), sent], ['idle', []]);
    assert.match(store.state.notice.message, words);
  }
});

test('a refused grab and a lost server end the drag and say so', async () => {
  const busy = harness();
  busy.gesture.press(busy.hit, 0, 0);
  busy.gesture.move(10, 0);
  busy.asked[0].reject({ code: 'busy', message: 'Another tab holds it.' });
  await turnOver();
  assert.deepEqual([busy.state(), busy.store.state.notice.message], ['idle', 'Another tab holds it.']);
  const lost = harness();
  lost.gesture.press(lost.hit, 0, 0);
  lost.gesture.move(10, 0);
  assert.ok(lost.gesture.lost());
  assert.equal(lost.state(), 'idle');
  assert.ok(!lost.gesture.lost());
});

test('a nail is dragged by itself, and a drag can end nailed', () => {
  const { gesture, sent, hit } = harness({ nailOnRelease: true });
  gesture.press({ ...hit, kind: 'nail', nail: 3 }, 0, 0);
  gesture.move(10, 0);
  gesture.up(10, 0);
  assert.deepEqual([sent[0], sent.at(-1).nail], [{ type: 'grab_nail', gesture: 1, nail: 3 }, undefined]);
  const other = harness({ nailOnRelease: true });
  other.gesture.press(other.hit, 0, 0);
  other.gesture.move(10, 0);
  other.gesture.up(10, 0);
  assert.equal(other.sent.at(-1).nail, true);
});
