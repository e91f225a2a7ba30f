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

test('lanes fold to the one that is selected, and scroll to it', { skip }, () =>
  withStudio('rack-of-fifteen.json', async (page) => {
    const seen = () => page.evaluate(() => globalThis.carom.lanes());
    const all = await page.evaluate(() => globalThis.carom.shownBodies()), first = await seen();
    assert.ok(first.length < all.length && first[0] === all[0]);
    await page.locator('#bodies .name').filter({ hasText: /^ball 13$/ }).click();
    const chosen = await state(page, '(s) => s.selected');
    await until(page, `() => globalThis.carom.lanes().includes(${chosen})`);
    assert.equal((await seen()).length, first.length);
    await page.click('#fold-lanes');
    await until(page, `() => globalThis.carom.lanes().join() === "${chosen}"`);
    await picture(page, 'folded-lanes');
    await page.click('#fold-lanes');
    await page.keyboard.press('Escape');
    await page.mouse.move(500, 600);
    await page.keyboard.down('Shift');
    for (let k = 0; k < 20; ++k) await page.mouse.wheel(0, -100);
    await page.keyboard.up('Shift');
    await until(page, `() => globalThis.carom.lanes()[0] === ${all[0]}`);
  }));

test('five hundred bodies fold and are searched, and neither takes long', { skip }, () =>
  withStudio('pen_500.json', async (page) => {
    const count = await state(page, '(s) => s.document.bodies.length');
    assert.ok(count > 500);
    const list = () => page.evaluate(() => document.getElementById('bodies').getBoundingClientRect().height);
    assert.ok((await list()) < 300, 'it scrolls in itself, and what may change is seen below');
    assert.ok(await page.isVisible('summary:has-text("May change")'));
    const name = await state(page, '(s) => s.document.bodies.at(-1).name'), began = Date.now();
    await page.fill('#body-search', name);
    assert.ok((await page.locator('#bodies li').count()) < count / 10);
    assert.ok(Date.now() - began < 5000);
    await page.click('summary:has-text("Bodies")');
    const visible = () => page.evaluate(() => ['bodies', 'body-search'].some((id) => document.getElementById(id).checkVisibility({ contentVisibilityAuto: true })));
    assert.equal(await visible(), false);
    await page.click('summary:has-text("Bodies")');
    await page.click('#bodies .name >> nth=-1');
    assert.equal(await state(page, '(s) => s.document.bodies[s.selected].name'), name);
    await picture(page, 'five-hundred');
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
