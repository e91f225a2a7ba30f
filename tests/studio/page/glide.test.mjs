// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { between, Glide, glideTime } from '../../../studio/page/glide.js';

const track = (x, turn = [1, 0, 0, 0]) => ({ body: 0, center: [0, 0, 0], stride: 10, arcs: new Float64Array([0, x, 0, 0, 1, 0, 0, 0, 0, -10]), turns: new Float32Array([0, ...turn]) });
const motion = (x, impacts = []) => ({ end: 1 + x, impacts, tracks: [track(x)] });
const impact = (t, point) => ({ t, point, bodies: [0], nth: [1], pairs: [], mode: 'stick' });
const idle = (of, more) => ({ motion: of, opened: null, gesture: { state: 'idle' }, ...more });

test('half way lies half way, turns by the shorter arc', () => {
  const a = { ...motion(0, [impact(0.2, [0, 0, 0])]), tracks: [track(0, [1, 0, 0, 0])] }, b = { ...motion(2, [impact(0.4, [1, 2, 3])]), tracks: [track(2, [-Math.cos(0.2), 0, 0, -Math.sin(0.2)])] };
  const half = between(a, b, 0.5);
  assert.deepEqual([half.end, half.tracks[0].arcs[1], half.impacts[0].point.join(), half.impacts[0].t.toFixed(9)], [2, 1, '0.5,1,1.5', '0.300000000']);
  const [, w, , , z] = half.tracks[0].turns;
  assert.ok(Math.abs(Math.abs(w) - Math.cos(0.1)) < 1e-6 && Math.abs(Math.abs(z) - Math.sin(0.1)) < 1e-6);
  assert.deepEqual(between(a, b, 1).tracks[0].arcs, b.tracks[0].arcs);
});

test('another motion is glided to; one with other impacts fades; then what is drawn is what is', () => {
  const glide = new Glide(() => false), a = motion(0), b = motion(2), c = motion(3, [impact(0.5, [0, 0, 0])]);
  assert.equal(glide.shown(idle(a), 0).state.motion, a);
  assert.equal(glide.shown(idle(b), 1000).state.motion.tracks[0].arcs[1], 0);
  assert.equal(glide.shown(idle(b), 1000 + glideTime / 2).state.motion.tracks[0].arcs[1], 1);
  assert.equal(glide.shown(idle(b), 1000 + glideTime).state.motion, b);
  const fading = glide.shown(idle(c), 2000);
  assert.deepEqual([fading.state.motion, fading.gone, fading.share], [c, b, 0]);
  assert.deepEqual([glide.shown(idle(c), 2000 + glideTime).gone, glide.from], [null, null]);
});

test('a drag is followed at once, and so is everything where no movement is wanted, and what was opened', () => {
  for (const [still, more] of [[false, { gesture: { state: 'dragging' } }], [true, {}], [false, 'opened']]) {
    const glide = new Glide(() => still), a = motion(0), b = motion(2);
    glide.shown(idle(a), 0);
    assert.equal(glide.shown(idle(b, more === 'opened' ? { opened: b } : more), 10).state.motion, b);
  }
});
