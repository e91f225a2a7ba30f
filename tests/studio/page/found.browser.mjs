// SPDX-License-Identifier: MIT
// What is there is seen and found: many bodies, their lanes, why a motion ends, and the one gesture to know.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { frame, until } from './browser.mjs';
import { letGo, picture, place, pull, skip, state, withStudio } from './hand.mjs';

/** How many pixels of the time line, in a box of it, are not of its most common colour. */
const marks = (page, x, y, width, height) => page.evaluate(([left, top, w, h]) => {
  const canvas = document.getElementById('timeline'), ratio = canvas.width / canvas.clientWidth, count = new Map();
  const { data } = canvas.getContext('2d').getImageData(left * ratio, top * ratio, w * ratio, h * ratio);
  for (let i = 0; i < data.length; i += 4) {
    const colour = data.slice(i, i + 3).join();
    count.set(colour, (count.get(colour) ?? 0) + 1);
  }
  return data.length / 4 - Math.max(...count.values());
}, [x, y, width, height]);

test('many bodies are searched, and their lanes have names', { skip }, () =>
  withStudio('rack-of-fifteen.json', async (page) => {
    const all = await page.locator('#bodies li').count(), name = await state(page, '(s) => s.document.bodies.find((body) => !body.fixed).name');
    assert.ok(all > 12 && await page.isVisible('#body-search'));
    await page.fill('#body-search', name.toUpperCase());
    const found = await page.locator('#bodies li').count();
    assert.ok(found >= 1 && found < all, `${found} of ${all} are called like ${name}`);
    await page.click('#bodies li .name');
    assert.ok((await state(page, '(s) => s.document.bodies[s.selected].name')).includes(name));
    await page.fill('#body-search', '');
    assert.equal(await page.locator('#bodies li').count(), all);
    await page.keyboard.press('Escape');
    await frame(page);
    // above the line of the path, before the first mark
    const named = await marks(page, 19, 29, 30, 4), beside = await marks(page, 100, 29, 30, 4);
    assert.ok(named > 8 && beside === 0, `${named} pixels of a name, ${beside} beside it`);
    await picture(page, 'many');
  }, { complaints: /willReadFrequently/ }));

test('the hint says the one gesture until that has been made', { skip }, () =>
  withStudio('hat-on-coatrack.json', async (page) => {
    assert.match(await page.textContent('#hint'), /Press a path and pull/);
    assert.ok(await page.isVisible('#hint'));
    const [x, y] = await place(page, 'hat', 0.4);
    await pull(page, [x, y], [x + 15, y - 10]);
    await letGo(page);
    assert.ok(await page.isHidden('#hint'));
    await page.reload();
    await until(page, '(s) => s.connected === "open" && s.motion');
    assert.ok(await page.isHidden('#hint'));
  }));
