// SPDX-License-Identifier: MIT
// With Alt a target goes to the surface below the pointer, which the body just touches there, and to marks near it, with the real mouse.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { closing, frame, openPage, until } from './browser.mjs';
import { answered, browser, letGo, picture, place, screenOf, skip, state, withStudio } from './hand.mjs';
import { RealStudio } from './real_studio.mjs';

const bodies = (count) => `(s) => s.document?.bodies.length === ${count} && s.motion?.tracks.length === ${count} && s.scene?.shapes.length === ${count} && s.gesture.state === "idle" && s.motion.rev === s.document.rev`;

test('a ball is put onto a table, and beside a wall of it', { skip }, () => closing(async (keep) => {
  const studio = keep(await RealStudio.start(null)), page = keep(await openPage(browser(), studio.url, { width: 1440, height: 900 }));
  await page.click('#empty button:text-is("New scene")');
  await until(page, bodies(1));
  for (const [what, at, count] of [['Table', [0, 0, 0], 2], ['Ball', [-1, 0, 0], 3]]) {
    await page.click('#add');
    await page.click(`#add-menu >> text=${what}`);
    await page.mouse.click(...(await screenOf(page, at)));
    await until(page, bodies(count));
    await frame(page);
  }
  await page.mouse.move(...(await place(page, 'ball', 0)));
  await page.mouse.down();
  await page.keyboard.down('Alt');
  const [x, y] = await screenOf(page, [0.2, 0.1, 0.04]);
  await page.mouse.move(x - 30, y);
  await page.mouse.move(x, y);
  await until(page, '(s) => s.gesture.snapOn === "surface" && s.gesture.target[2] > 0.13');
  await frame(page);
  await picture(page, 'snap-surface');
  assert.match(await page.textContent('#readout'), /to: surface/);
  await letGo(page);
  await page.keyboard.up('Alt');
  await until(page, bodies(3));
  const at = await state(page, '(s) => s.document.bodies[2].position');
  assert.ok(Math.abs(at[2] - 0.14) <= 1e-4, `it stands at ${at}`);
  assert.ok(Math.hypot(at[0] - 0.2, at[1] - 0.1) <= 5e-3, `it stands at ${at}`);
  assert.equal(await state(page, '(s) => s.notice?.kind ?? "plain"'), 'plain');
}));

test('the path of a hat goes to a mark; without Alt it goes where the hand is', { skip }, () => withStudio('hat-on-coatrack.json', async (page) => {
  const impact = await state(page, '(s) => s.motion.impacts[0].point'), [x, y] = await screenOf(page, impact), from = await place(page, 'hat', 0.5);
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(x - 20, y + 5, { steps: 3 });
  await page.mouse.move(x - 6, y + 5);
  await page.keyboard.down('Alt');
  await until(page, '(s) => s.gesture.snapOn === "impact"');
  assert.deepEqual(await state(page, '(s) => s.gesture.target'), impact);
  await answered(page);
  await frame(page);
  await picture(page, 'snap-mark');
  await page.keyboard.up('Alt');
  await until(page, '(s) => s.gesture.snapOn === ""');
  assert.notDeepEqual(await state(page, '(s) => s.gesture.target'), impact);
  await page.keyboard.press('Escape');
  await page.mouse.up();
}));
