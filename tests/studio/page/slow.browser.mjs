// SPDX-License-Identifier: MIT
// What a hand waits for: updates that take long, a release that is stopped, and nothing at rest. Without limits of time:
// bench/studio/latency.mjs measures.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { countMessages, frame, until } from './browser.mjs';
import { answered, idle, letGo, place, pull, skip, state, undo, withStudio } from './hand.mjs';

test('Escape stops a release that searches on; what it got to is one step, and can be undone', { skip }, () =>
  withStudio('mug.json', async (page) => {
    const opened = await state(page, '(s) => [...s.motion.tracks[2].arcs]');
    // Whether a release has to search on depends on what the drag before it found, and so on how busy the machine is.
    let stopped = false;
    for (const [dx, dy] of [[200, -200], [-150, -200], [120, -200], [220, -160]]) {
      const [x, y] = await place(page, 'mug', 0.3);
      await pull(page, [x, y], [x + dx, y + dy]);
      await page.mouse.up();
      await until(page, '(s) => (s.gesture.state === "settling" && s.gesture.settlingShown) || (s.gesture.state === "idle" && s.document.held_by === null && s.document.undo !== null)', 120000);
      await page.keyboard.press('Escape');
      await idle(page);
      await until(page, '(s) => s.document.held_by === null && s.document.undo !== null', 120000);
      stopped = await state(page, '(s) => s.motion.stopped');
      if (stopped) break;
      await undo(page);
    }
    assert.equal(stopped, true);
    await page.keyboard.press('Control+z');
    await until(page, '(s) => s.document.undo === null', 120000);
    assert.deepEqual(await state(page, '(s) => [...s.motion.tracks[2].arcs]'), opened);
  }));

test('a hand that rests gets there: updates go on without another event of the mouse, and the page draws meanwhile', { skip }, () =>
  withStudio('mug.json', async (page) => {
    const [x, y] = await place(page, 'mug', 0.15), frames = () => page.evaluate(() => globalThis.carom.frames());
    const before = await frames();
    await pull(page, [x, y], [x + 20, y - 10]);
    await until(page, '(s) => s.motion.reached && s.gesture.answered === s.gesture.seq', 120000);
    assert.equal(await state(page, '(s) => s.gesture.state'), 'dragging');
    assert.ok(await state(page, '(s) => s.motion.distance') <= 1e-6);
    assert.ok((await frames()) > before);
    await letGo(page);
    assert.ok(await state(page, '(s) => s.motion.reached'));
  }));

test('no shader is compiled from one update of a drag to the next', { skip }, () =>
  withStudio('hat-on-coatrack.json', async (page) => {
    const [x, y] = await place(page, 'hat', 0.5), shaders = () => page.evaluate(() => globalThis.carom.shaders());
    await pull(page, [x, y], [x + 12, y - 12]);
    await frame(page);
    const before = await shaders();
    assert.ok(before.length > 0);
    for (let k = 1; k <= 5; ++k) {
      await page.mouse.move(x + 12 + k, y - 12);
      await answered(page);
      await frame(page);
    }
    assert.deepEqual(await shaders(), before);
    await letGo(page);
  }));

test('at rest, after a drag, nothing is drawn and nothing is said', { skip }, () =>
  withStudio('hat-on-coatrack.json', async (page) => {
    const messages = countMessages(page);
    await page.reload();
    await until(page, '(s) => s.connected === "open" && s.motion');
    const [x, y] = await place(page, 'hat', 0.5);
    await pull(page, [x, y], [x + 12, y - 12]);
    await letGo(page);
    assert.ok(messages.count > 4);
    await page.evaluate(async () => {
      for (let last = -1; last !== globalThis.carom.frames();) {
        last = globalThis.carom.frames();
        await new Promise((next) => setTimeout(next, 300));
      }
    });
    const [frames, heard] = [await page.evaluate(() => globalThis.carom.frames()), messages.count];
    await page.evaluate(() => new Promise((done) => setTimeout(done, 2000)));
    assert.deepEqual([await page.evaluate(() => globalThis.carom.frames()), messages.count], [frames, heard]);
  }));
