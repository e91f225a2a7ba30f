// SPDX-License-Identifier: MIT
// From an empty start to a film's scene with the real mouse: a table, three dice that are thrown, six up on one at a place, saved, exported as
// one page, which is opened from the disk. How long that takes is printed: it depends on what else the machine does.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { test } from 'node:test';
import { closing, frame, openPage, until } from './browser.mjs';
import { openExported, ownFolder } from './exported_page.mjs';
import { browser, idle, picture, screenOf, skip, state } from './hand.mjs';
import { command, RealStudio } from './real_studio.mjs';

const bodies = (count) => `(s) => s.document?.bodies.length === ${count} && s.motion?.tracks.length === ${count} && s.scene?.shapes.length === ${count} && s.gesture.state === "idle" && s.motion.rev === s.document.rev`;

async function add(page, what, point, count) {
  await page.click('#add');
  await page.click(`#add-menu >> text=${what}`);
  await page.mouse.click(...await screenOf(page, point));
  await until(page, bodies(count));
  await frame(page);
}

/** A number of the selected body, typed. */
async function type(page, label, value) {
  const rev = await state(page, '(s) => s.document.rev');
  await page.fill(`#body input[aria-label="${label}"]`, String(value));
  await page.keyboard.press('Enter');
  await until(page, `(s) => s.document.rev > ${rev} && s.motion.rev === s.document.rev`);
}

/** How a body lies in the end: its place, and how much of a side is up. */
const end = (page, body, n) => page.evaluate(([i, [a, b, c]]) => {
  const { store, poseAt } = globalThis.carom, { motion } = store.state, { place, turn: [w, x, y, z] } = poseAt(motion.tracks[i], motion.end);
  return { place, up: 2 * (a * (x * z - w * y) + b * (y * z + w * x)) + c * (1 - 2 * (x * x + y * y)) };
}, [body, n]);

test('a table, three dice, a throw, six up on one at a place, saved, exported, and opened from the disk', { skip }, () => closing(async (keep) => {
  const studio = keep(await RealStudio.start(null)), page = keep(await openPage(browser(), studio.url, { width: 1440, height: 900 })), began = Date.now();
  await page.click('#empty button:text-is("New scene")');
  await until(page, bodies(1));
  await add(page, 'Table', [0, 0, 0], 2);
  for (const [k, y] of [-0.2, 0, 0.2].entries()) {
    await add(page, 'Die', [-0.4, y, 0.04], 3 + k);
    await type(page, 'position, m, z', 0.25);
    await type(page, 'angular velocity, rad/s, y', 9 + 2 * k);
    await type(page, 'angular velocity, rad/s, x', 4 - 3 * k);
    await page.keyboard.press('v');
    await page.focus('#overlay');
    await page.keyboard.press('v');
    await frame(page);
    // its arrow, which is short while it is at rest
    const [x, up] = await page.evaluate((body) => {
      const { store, screenOf: at } = globalThis.carom, [px, py, pz] = store.state.document.bodies[body].position, a = at([px, py, pz]), b = at([px, py, pz + 0.03]);
      return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    }, 2 + k);
    await page.mouse.move(x, up);
    await page.mouse.down();
    await page.mouse.move(x + 30, up - 5, { steps: 3 });
    await page.mouse.move(x + 55 + 8 * k, up - 8, { steps: 3 });
    await page.mouse.up();
    await idle(page);
    const velocity = await state(page, `(s) => s.document.bodies[${2 + k}].velocity`);
    assert.ok(Math.hypot(...velocity) > 0.2, `it is thrown with ${velocity}`);
  }
  assert.deepEqual(await state(page, '(s) => s.document.bodies.map(({ name }) => name)'), ['floor', 'table', 'die', 'die 2', 'die 3']);
  assert.equal(await state(page, '(s) => s.motion.status'), 'complete', await state(page, '(s) => s.motion.message'));
  await picture(page, 'dice-thrown');
  await page.click('#bodies button:has-text("die 2")');
  await page.click('.body-faces button:text-is("6")');
  const to = await screenOf(page, [0.1, 0.05, 0.04]);
  await page.mouse.move(...to);
  await until(page, '(s) => s.facing?.place');
  const wanted = await state(page, '(s) => s.facing.place');
  await frame(page);
  await picture(page, 'dice-place');
  await page.mouse.click(...to);
  await until(page, '(s) => !s.facing && s.motion.rev === s.document.rev && /6 up/.test(s.notice?.message)', 120000);
  const lies = await end(page, 3, [-1, 0, 0]);
  assert.ok(lies.up > 1 - 1e-6, `${lies.up} of the six is up`);
  assert.ok(Math.hypot(lies.place[0] - wanted[0], lies.place[1] - wanted[1]) <= 1e-6, `it lies at ${lies.place}, ${wanted} was wanted`);
  await page.keyboard.press('End');
  await frame(page);
  await picture(page, 'dice-six');
  await page.keyboard.press('Control+s');
  await page.click('dialog button:text-is("Save")');
  await until(page, '(s) => s.document.saved && s.document.path === "scene.json"');
  await page.click('#file');
  await page.click('#menu >> text=Export…');
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('dialog button:has-text("Page for any browser")')]);
  const file = join(ownFolder(keep), 'dice.html');
  await download.saveAs(file);
  console.log(`# ${((Date.now() - began) / 1000).toFixed(0)} s of gestures`);
  const saved = join(studio.folder, 'scenes', 'scene.json'), answer = JSON.parse(execFileSync(command, ['simulate', saved, '--json'], { encoding: 'utf8' }));
  assert.equal(answer.status, 'complete');
  const opened = await openExported(keep, browser(), file, { width: 1440, height: 900 });
  await opened.evaluate(() => globalThis.carom.store.set({ time: globalThis.carom.store.state.motion.end }));
  await frame(opened);
  await picture(opened, 'dice-exported');
  const there = await opened.evaluate(() => globalThis.carom.poseAt(3, globalThis.carom.store.state.motion.end).place);
  assert.ok(there.every((c, i) => Math.abs(c - lies.place[i]) <= 1e-6), `${there} in the page, ${lies.place} in the studio`);
  assert.deepEqual([...page.complaints, ...opened.complaints].filter((text) => !/ReadPixels/.test(text)), []);
}));
