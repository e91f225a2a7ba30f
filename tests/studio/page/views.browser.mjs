// SPDX-License-Identifier: MIT
// From the front, the right and above, by a key; and the number of the frame beside the time.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { frame, until } from './browser.mjs';
import { picture, skip, state, withStudio } from './hand.mjs';

test('1, 3 and 7 look from the front, the right and above, at everything; the time has its frame', { skip }, () => withStudio('bounce.json', async (page) => {
  await page.focus('#overlay');
  for (const [key, view, right] of [['1', [0, 1, 0], [1, 0, 0]], ['3', [-1, 0, 0], [0, 1, 0]], ['7', [0, 0, -1], [1, 0, 0]]]) {
    await page.keyboard.press(key);
    await frame(page);
    const axes = await page.evaluate(() => globalThis.carom.view.camera.axes());
    for (const [name, wanted] of [['view', view], ['right', right]]) assert.ok(axes[name].every((c, i) => Math.abs(c - wanted[i]) <= 1e-3), `${key}: ${name} is ${axes[name]}`);
    const out = await page.evaluate(() => {
      const { store, screenOf } = globalThis.carom, { motion } = store.state, view = document.getElementById('view').getBoundingClientRect();
      return motion.tracks.filter(({ arcs }) => arcs.length > 10).map(({ arcs }) => screenOf([arcs[1], arcs[2], arcs[3]])).filter(([x, y]) => x < view.left || x > view.right || y < view.top || y > view.bottom);
    });
    assert.deepEqual(out, [], 'all of it is in the view');
    await picture(page, `views-${key}`);
  }
  await page.evaluate(() => globalThis.carom.store.set({ time: 0.5 }));
  assert.equal(await page.textContent('#time'), '0.500 s · 12');
  await page.keyboard.press('ArrowRight');
  assert.equal(await page.textContent('#time'), '0.542 s · 13');
  await page.evaluate(() => globalThis.carom.store.set({ dots: 0 }));
  assert.equal(await page.textContent('#time'), `${(await state(page, '(s) => s.time')).toFixed(3)} s`);
  await until(page, '(s) => !s.playing');
}));
