// SPDX-License-Identifier: MIT
// Whole ways through the studio, with the real mouse, the real server and the real solver.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { pointAt } from '../../../studio/page/motion.js';
import { openPage, until } from './browser.mjs';
import { browser, idle, letGo, picture, place, pull, answered, screenOf, skip, state, withStudio } from './hand.mjs';

test('a hat is dragged to the peg and nailed, taken earlier and turned; saved, the nail holds; undone, the file is as it was', { skip }, () =>
  withStudio('hat-on-coatrack.json', async (page, studio) => {
    const opened = studio.bytes();
    await pull(page, await place(page, 'hat', 0.62), await screenOf(page, [-0.25, -0.02, 1.62]));
    await page.keyboard.down('i');
    await picture(page, 'coatrack-dragging');
    await letGo(page);
    await page.keyboard.up('i');
    await until(page, '(s) => s.document.nails.length === 3');
    assert.equal(await state(page, '(s) => s.document.nails[2].constraint.at'), 0.62);
    await picture(page, 'coatrack-nailed');
    await page.click('#tool-turn');
    const [x, y] = await place(page, 'hat', 0.3);
    await pull(page, [x, y], [x + 40, y - 20]);
    assert.equal(await state(page, '(s) => s.gesture.hit.time'), 0.3);
    await letGo(page);
    await picture(page, 'coatrack-turned');
    const [reached, turn, nail] = await state(page, '(s) => [s.motion.reached, s.motion.turn, s.document.nails[2]]');
    assert.ok(reached && turn <= 1e-6, `turned to within ${turn}`);
    assert.ok(nail.met && nail.error <= 1e-6, `the nail is off by ${nail.error} m`);
    await page.keyboard.press('Control+s');
    await until(page, '(s) => s.document.saved');
    const saved = JSON.parse(studio.bytes()), { point, position, orientation } = saved.constraints[2];
    const { position: p, orientation: q } = studio.simulated(0.62).states[0].bodies.hat;
    const track = { center: [0, 0, 0], arcs: new Float64Array([0, ...p, 0, 0, 0, 0, 0, 0]), turns: new Float32Array([0, ...q]) };
    assert.ok(point || position);
    const found = point ? pointAt(track, point.body_point, 0) : p, wanted = point ? point.world : position;
    // the turn of a track is float32: a body point of 0.1 m is good to 1e-8 m
    assert.ok(Math.hypot(...found.map((c, i) => c - wanted[i])) <= 1e-6, `${found} is not at the nail ${wanted}`);
    assert.equal(orientation, undefined);
    for (let steps = 0; (await state(page, '(s) => s.document.undo')) && steps < 20; ++steps) {
      const rev = await state(page, '(s) => s.document.rev');
      await page.keyboard.press('Control+z');
      await until(page, `(s) => s.document.rev !== ${rev}`);
    }
    await page.keyboard.press('Control+s');
    await until(page, '(s) => s.document.saved && !s.document.undo');
    await page.evaluate(() => undefined);
    assert.equal(studio.bytes(), opened);
  }));

test('the third impact of a mug is dragged along the table; the nail stays at the impact, whose time moves later', { skip }, () =>
  withStudio('mug-on-mark.json', async (page) => {
    const third = await state(page, '(s) => s.motion.impacts.filter((i) => i.pairs.some(([a, b]) => a === 1 && b === 2))[2]');
    const from = await screenOf(page, third.point), to = await screenOf(page, [third.point[0] - 0.05, third.point[1], third.point[2]]);
    await page.click('#nail-on-release');
    await pull(page, from, to);
    assert.deepEqual(await state(page, '(s) => s.gesture.hit.at'), { impact: 3, with: 'table' });
    const [shown, comes] = await state(page, '(s) => [s.time, s.motion.impacts.filter((i) => i.pairs.some(([a, b]) => a === 1 && b === 2))[2].t]');
    assert.equal(shown, comes, 'the play head goes with the impact');
    assert.notEqual(comes, third.t);
    await page.keyboard.press('Shift+Z');
    await answered(page);
    await letGo(page);
    await until(page, '(s) => s.document.nails.length === 2');
    assert.deepEqual(await state(page, '(s) => s.document.nails[1].constraint.at'), { impact: 3, with: 'table' });
    const time = await state(page, '(s) => s.document.nails[1].time');
    await page.click('#nail-on-release');
    const [x, y] = await place(page, 'mug', 0.2);
    await pull(page, [x, y], [x + 4, y - 22]);
    await letGo(page);
    await picture(page, 'mug-impact');
    const later = await state(page, '(s) => s.document.nails[1]');
    assert.ok(later.available && Math.abs(later.time - time) > 1e-4, `${later.time} after ${time}`);
  }));

test('a stone is dragged by where it stops and nailed there, whenever that is', { skip }, () =>
  withStudio('curling.json', async (page) => {
    const [x, y] = await place(page, 'stone', 20);
    await page.click('#nail-on-release');
    await pull(page, [x, y], [x - 30, y + 10]);
    assert.deepEqual(await state(page, '(s) => [s.gesture.hit.kind, s.gesture.hit.at]'), ['rest', { rest: true }]);
    await picture(page, 'curling-rest');
    await letGo(page);
    await until(page, '(s) => s.document.nails.length === 2');
    const nail = await state(page, '(s) => s.document.nails[1]');
    assert.deepEqual(nail.constraint.at, { rest: true });
    assert.ok(nail.met && nail.time < 20, nail.message);
    assert.match(await page.textContent('#nails .nail:nth-child(2)'), /stone, rest/);
    await page.click('#nail-on-release');
    const from = await place(page, 'stone', 1);
    await pull(page, from, [from[0] + 3, from[1] - 3]);
    await letGo(page);
    const after = await state(page, '(s) => s.document.nails[1]');
    assert.ok(after.available && after.met, after.message);
  }));

test('goals are off at opening and nothing moves; Meet them all meets them', { skip }, () =>
  withStudio('hat-on-coatrack.json', async (page) => {
    assert.deepEqual(await state(page, '(s) => [s.document.nails.map((n) => n.on), s.document.saved, s.document.undo]'), [[false, false], true, null]);
    await page.click('#meet');
    await until(page, '(s) => s.document.nails.every((n) => n.on && n.met)');
    await picture(page, 'coatrack-met');
    assert.ok(await page.isHidden('#meet'));
  }));

test('a nail that the motion lacks is shown as missing, and drags go on; out of reach is amber, and nailed where it got to', { skip }, () =>
  withStudio('hat-on-coatrack.json', async (page) => {
    assert.deepEqual(await state(page, '(s) => s.document.nails.map((n) => n.available)'), [true, true, false]);
    assert.match(await page.textContent('#nails .nail:nth-child(3)'), /does not come|missing/);
    const [x, y] = await place(page, 'hat', 0.5);
    await pull(page, [x, y], [x + 20, y - 20]);
    assert.ok(await state(page, '(s) => s.motion.reached'));
    await letGo(page);
    await page.click('#nail-on-release');
    const [x2, y2] = await place(page, 'hat', 0.02);
    await page.mouse.move(x2, y2);
    await pull(page, [x2, y2], [x2 + 250, y2 - 100], 3);
    await until(page, '(s) => !s.motion.reached && !s.motion.more');
    await picture(page, 'coatrack-cannot');
    await letGo(page);
    await until(page, '(s) => s.card !== null && s.document.nails.length === 4');
    const [nail, near] = await state(page, '(s) => [s.document.nails[3], s.motion.distance]');
    assert.ok(near > 1e-3 && nail.met, 'the nail is where the body is, not where the hand was');
  }, { change: (document) => ({ ...document, controls: [{ vary: 'velocity', body: 'hat', min: -5, max: 5 }], constraints: [...document.constraints, { body: 'hat', at: { impact: 9 }, position: [0, 0, 1] }] }) }));

test('a die that no control names can be dragged; one undo takes back the drag and the controls', { skip }, () =>
  withStudio('dice.json', async (page) => {
    const controls = await state(page, '(s) => JSON.stringify(s.document.controls)');
    const [x, y] = await place(page, 'die 2', 0.12);
    await pull(page, [x, y], [x + 25, y - 15]);
    const body = await state(page, '(s) => s.document.bodies[s.gesture.hit.body].name');
    assert.match(await page.textContent('#notice'), new RegExp(`throw of '${body}' may change`));
    assert.ok(await state(page, '(s) => s.motion.reached'));
    await picture(page, 'dice-dragging');
    await letGo(page);
    await until(page, `(s) => JSON.stringify(s.document.controls) !== ${JSON.stringify(controls)}`);
    await page.keyboard.press('Control+z');
    await until(page, `(s) => JSON.stringify(s.document.controls) === ${JSON.stringify(controls)} && s.document.undo === null`);
  }));

test('reloaded in a drag, a second tab, a tab that goes while it holds, and a server that is killed', { skip }, () =>
  withStudio('hat-on-coatrack.json', async (page, studio, keep) => {
    const [x, y] = await place(page, 'hat', 0.4);
    await pull(page, [x, y], [x + 20, y - 20]);
    await page.reload();
    await until(page, '(s) => s.connected === "open" && s.motion');
    assert.deepEqual(await state(page, '(s) => [s.document.undo, s.gesture.state, s.document.held_by]'), [null, 'idle', null]);
    await page.mouse.up();

    const other = keep(await openPage(browser(), studio.url, { width: 1024, height: 640 }));
    await until(other, '(s) => s.connected === "open" && s.motion');
    const at = await place(page, 'hat', 0.4);
    await pull(page, at, [at[0] + 20, at[1] - 20]);
    await other.mouse.move(...(await place(other, 'hat', 0.2)));
    await other.mouse.down();
    await other.mouse.move(400, 300, { steps: 3 });
    await until(other, '(s) => s.notice !== null && s.gesture.state === "idle"');
    await other.mouse.up();
    await letGo(page);
    await until(other, '(s) => s.document.undo !== null');
    assert.deepEqual(await state(other, '(s) => [...s.motion.tracks[2].arcs]'), await state(page, '(s) => [...s.motion.tracks[2].arcs]'));
    const from = await place(other, 'hat', 0.3);
    await pull(other, from, [from[0] + 10, from[1] - 10]);
    await other.close();
    await until(page, '(s) => s.document.held_by === null');
    const before_kill = await place(page, 'hat', 0.4);
    await pull(page, before_kill, [before_kill[0] - 10, before_kill[1]]);
    await letGo(page);

    const { port } = studio;
    await studio.kill();
    await until(page, '(s) => s.connected === "lost"');
    await studio.run(port);
    await until(page, '(s) => s.connected !== "lost"');
    assert.match(await page.textContent('#notice'), /started again|steps? recovered/);
  }, { complaints: /WebSocket|ERR_CONNECTION/ }));
