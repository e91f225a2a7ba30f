// SPDX-License-Identifier: MIT
// A die comes to rest with a chosen side up at a chosen place: from the list, by a press on the side, and ended by Escape.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { frame, until } from './browser.mjs';
import { picture, screenOf, skip, state, undo, withStudio } from './hand.mjs';

const free = (document) => ({ ...document, controls: [], constraints: [] });
const found = '(s) => !s.facing && s.document.rev === s.motion.rev && s.document.rev > 0 && /comes to rest/.test(s.notice?.message)';

/** Where the die is in the end, and how much of a side of it is up. */
const end = (page, side) => page.evaluate((n) => {
  const { store, poseAt } = globalThis.carom, { motion } = store.state, { place: at, turn: [w, x, y, z] } = poseAt(motion.tracks[1], motion.end);
  return { at, up: 2 * (n[0] * (x * z - w * y) + n[1] * (y * z + w * x)) + n[2] * (1 - 2 * (x * x + y * y)) };
}, side);

function isThere({ at, up }, [x, y]) {
  assert.ok(Math.hypot(at[0] - x, at[1] - y) <= 1e-6, `it lies at ${at}, ${x} ${y} was wanted`);
  assert.ok(up > 1 - 1e-6, `${up} of the side is up`);
}

test('six up from the list, at the place of the next press; then by a press on the side, and a drag from it', { skip }, () => withStudio('die-at-rest.json', async (page) => {
  await page.click('#bodies button:has-text("die")');
  assert.deepEqual(await page.locator('.body-faces button').allTextContents(), ['1', '2', '3', '4', '5', '6']);
  await page.click('.body-faces button:text-is("6")');
  assert.match(await page.textContent('#notice'), /6 up: press where 'die' is to lie/);
  const there = await screenOf(page, [-0.1, 0.1, 0]);
  await page.mouse.move(...there);
  await until(page, '(s) => s.facing?.place');
  await frame(page);
  await picture(page, 'faces-place');
  await page.mouse.click(...there);
  const [x, y] = await state(page, '(s) => s.facing?.place ?? [NaN, NaN]').catch(() => [NaN, NaN]);
  await until(page, found);
  const first = await end(page, [-1, 0, 0]);
  isThere(first, Number.isFinite(x) ? [x, y] : first.at);
  assert.ok(Math.hypot(first.at[0] + 0.1, first.at[1] - 0.1) < 5e-3, 'where it was pressed');
  assert.equal(await state(page, '(s) => s.document.undo'), 'a face up');
  await page.keyboard.press('End');
  await frame(page);
  await picture(page, 'faces-six');
  await page.keyboard.press('u');
  assert.equal(await page.getAttribute('#tool-face', 'aria-pressed'), 'true');
  const die = await screenOf(page, [first.at[0], first.at[1], 0.03]), to = await screenOf(page, [-0.2, -0.1, 0]);
  await page.mouse.move(...die);
  await page.mouse.down();
  assert.equal(await state(page, '(s) => s.facing.name'), '6', 'the side that is seen from above');
  await page.mouse.move(to[0] - 20, to[1], { steps: 3 });
  await page.mouse.move(...to);
  await until(page, '(s) => s.facing?.place');
  await page.mouse.up();
  await until(page, `(s) => (${found})(s) && s.document.rev > 2`);
  const second = await end(page, [-1, 0, 0]);
  isThere(second, second.at);
  assert.ok(Math.hypot(second.at[0] + 0.2, second.at[1] + 0.1) < 5e-3, `it lies at ${second.at}`);
  await undo(page);
  isThere(await end(page, [-1, 0, 0]), first.at);
}, { change: free }));

test('a search within the controls of a die tells how far it is, and Escape ends it', { skip }, () => withStudio('die-at-rest.json', async (page) => {
  const rev = await state(page, '(s) => s.document.rev');
  await page.click('#bodies button:has-text("die")');
  await page.click('.body-faces button:text-is("2")');
  await page.mouse.click(...await screenOf(page, [-0.1, 0.1, 0]));
  await until(page, '(s) => s.facing?.searching');
  assert.match(await page.textContent('#notice'), /Looking for a throw with 2 up.*Esc ends it/);
  await until(page, '(s) => s.facing.tried > 0');
  await page.focus('#overlay');
  await page.keyboard.press('Escape');
  await until(page, '(s) => !s.facing');
  assert.equal(await state(page, '(s) => s.document.rev'), rev);
  assert.ok(await page.isHidden('#notice'));
  await page.click('.body-faces button:text-is("2")');
  await page.keyboard.press('Escape');
  assert.equal(await state(page, '(s) => s.facing'), null, 'nothing was asked');
}));
