// SPDX-License-Identifier: MIT
// The surfaces that a hand slides on: a face, a curved side, an edge; and where it goes when it leaves them.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { along, dot, length, minus } from '../../../studio/page/tools/move.js';
import { Slide } from '../../../studio/page/tools/slide.js';
import { touchedAt } from '../../../studio/page/view/touched.js';

/** Quads as triangles, in the order of the corners. */
function shapeOf(body, vertices, quads) {
  const triangles = quads.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);
  return { body, name: `body ${body}`, fixed: true, plane: null, colour: '#888888', vertices: new Float32Array(vertices.flat()), normals: null,
    triangles: new Uint32Array(triangles), accent: null, center: [0, 0, 0], radius: 1 };
}
/** A table: 2 x 1 x 0.1 m, its top at z = 0. */
function box(body) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1 ? 1 : -1, i & 2 ? 0.5 : -0.5, i & 4 ? 0 : -0.1]);
  return shapeOf(body, corners, [[4, 5, 7, 6], [0, 2, 3, 1], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]);
}
/** A lying pole along y, radius 0.1, of 24 sides, its axis at z = -0.1. Its corners are rounded to floats. */
function pole(body) {
  const n = 24, rim = [...Array(n)].map((_, i) => [0.1 * Math.sin((2 * Math.PI * i) / n), 0.1 * Math.cos((2 * Math.PI * i) / n) - 0.1]);
  const corners = [-1, 1].flatMap((y) => rim.map(([x, z]) => [x, y, z]));
  return shapeOf(body, corners, rim.map((_, i) => [i, (i + 1) % n, n + ((i + 1) % n), n + i]));
}
const still = (body) => ({ body, arcs: new Float64Array([0, 0, 0, 0, 0, 0, 0, 0, 0, 0]), turns: new Float32Array([0, 1, 0, 0, 0]), center: [0, 0, 0] });
/** A hand that took the mark of an impact at `point`, of a body whose centre is at `centre`. The eye is above and before it. */
function taken(shape, point, centre) {
  const state = { scene: { shapes: [shape, { ...shape, body: 1, fixed: false }] }, motion: { tracks: [still(0), still(1)] } };
  const impact = { t: 0.5, point, bodies: [0, 1], nth: [0, 1], pairs: [[0, 1]], mode: 'slide' };
  const touched = touchedAt(state, { kind: 'impact', body: 1, time: 0.5, at: { impact: 1 }, place: centre, impact });
  const origin = [0, -3, 2], ray = (to) => ({ origin, direction: along([0, 0, 0], minus(to, origin), 1 / length(minus(to, origin))) });
  return { slide: new Slide({ turn: [1, 0, 0, 0], ray: ray(point), view: ray(point).direction, touched }), ray, origin };
}
/** How far p is from the line of sight of a ray, m. */
const beside = ({ origin, direction }, p) => length(minus(minus(p, origin), along([0, 0, 0], direction, dot(minus(p, origin), direction))));

test('on a face a hand stays in it: over its edge it goes to the nearest point of the edge, not on in the plane and not down the side', () => {
  const { slide, ray } = taken(box(0), [0.2, 0.1, 0], [0.2, 0.1, 0.3]);
  assert.equal(slide.across, 'z');
  assert.deepEqual(slide.held(false), ['x', 'y']);
  const on = slide.target(ray([-0.6, 0.3, 0])).place;
  assert.ok(length(minus(on, [-0.6, 0.3, 0])) < 1e-9, `${on}`);
  for (const over of [[1.4, 0, 0], [0, -0.5, -0.07], [0.3, -0.9, 0], [0, 0.9, 0]]) {
    const p = slide.target(ray(over)).place;
    assert.ok(Math.abs(p[2]) < 1e-9 && Math.abs(p[0]) <= 1 + 1e-9 && Math.abs(p[1]) <= 0.5 + 1e-9, `${p} is not on the table`);
    assert.ok(Math.abs(Math.abs(p[0]) - 1) < 1e-9 || Math.abs(Math.abs(p[1]) - 0.5) < 1e-9, `${p} is not on its edge`);
  }
});

test('on a curved side a hand goes round it, and beside it along its outline, however small it is seen', () => {
  const { slide, ray } = taken(pole(0), [0, 0.1, 0], [0, 0.1, 0.3]);
  const front = [0.1 * Math.sin(-1e-3), -0.4, -0.1 + 0.1 * Math.cos(1e-3)], onto = slide.target(ray(front)).place;
  assert.ok(beside(ray(front), onto) < 1e-9);
  for (const off of [0.15, 0.3, 1, -0.2, -1]) {
    const p = slide.target(ray([off, 0.1, 0])).place, far = Math.hypot(p[0], p[2] + 0.1);
    assert.ok(far < 0.1 + 1e-8 && far > 0.0985, `${p} is not on the pole`);
    assert.equal(Math.sign(p[0]), Math.sign(off));
    assert.ok(Math.abs(p[1]) <= 1 + 1e-9);
  }
});

test('on an edge a hand goes along it and on both of its sides', () => {
  const { slide, ray } = taken(box(0), [0.2, -0.5, 0], [0.2, -0.6, 0.2]);
  for (const to of [[0.7, -0.5, 0], [-0.5, -0.5, -0.05], [0, 0.2, 0]]) {
    const p = slide.target(ray(to)).place;
    assert.ok(length(minus(p, to)) < 1e-6, `${p} is not where the hand is, ${to}`);
  }
});

test('lifted, or along an axis, it is a drag as any other', () => {
  const { slide, ray } = taken(pole(0), [0, 0.1, 0], [0, 0.1, 0.3]);
  slide.lift();
  assert.equal(slide.held(false), null);
  assert.ok(slide.target(ray([0.5, 0.1, 0])).place[0] > 0.3);
  slide.lift();
  slide.setAxis('x');
  assert.ok(Math.abs(slide.target(ray([0.5, 0.1, 0])).place[1] - 0.1) < 1e-9);
});

test('the nail of a contact slides on what is touched there, and holds what it held', () => {
  const shape = box(0), point = [0.2, 0.1, 0];
  const impact = { t: 0, point, bodies: [0, 1], nth: [1, 1], pairs: [[0, 1]], mode: 'slide' };
  const above = { ...still(1), arcs: new Float64Array([0, 0.2, 0.1, 0.3, 0, 0, 0, 0, 0, 0]) };
  const nail = { id: 4, constraint: { body: 'die', at: { impact: 1 }, contact: [0.2, 0.1, null] } };
  const state = { scene: { shapes: [shape, { ...shape, body: 1, fixed: false }] }, motion: { gravity: [0, 0, -9.81], tracks: [still(0), above], impacts: [impact] },
    document: { nails: [nail], bodies: [{ name: 'table' }, { name: 'die' }] } };
  const hit = { kind: 'nail', nail: 4, body: 1, time: 0, at: 0, place: point }, touched = touchedAt(state, hit);
  assert.ok(touched && touched.normal[2] > 0.999);
  const origin = [0, -3, 2], ray = (to) => ({ origin, direction: along([0, 0, 0], minus(to, origin), 1 / length(minus(to, origin))) });
  const slide = new Slide({ turn: [1, 0, 0, 0], ray: ray(point), view: ray(point).direction, touched });
  const target = slide.target(ray([-0.5, 0.2, 0]));
  assert.ok(length(minus(target.place, [-0.5, 0.2, 0])) < 1e-9, `${target.place}`);
  assert.equal('components' in target, false);
  assert.equal(touchedAt({ ...state, document: { ...state.document, nails: [{ id: 4, constraint: { body: 'die', at: 0.1, position: [0, 0, 0] } }] } }, hit), null);
});

test('what is held of a contact is what lies in the surface where the hand is: round a pole that changes', () => {
  const { slide, ray } = taken(pole(0), [0, 0.1, 0], [0, 0.1, 0.3]);
  assert.deepEqual(slide.target(ray([0, -0.5, 0])).components, ['x', 'y']);
  assert.deepEqual(slide.target(ray([0.3, 0.1, -0.1])).components, ['y', 'z'], 'on its right side');
  slide.lift();
  assert.equal('components' in slide.target(ray([0, 0, 0])), false, 'off the surface all of the place is asked for, by the grip');
  slide.lift();
  slide.setAxis('y');
  assert.equal('components' in slide.target(ray([0, 0, 0])), false);
});
