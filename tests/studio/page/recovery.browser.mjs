// SPDX-License-Identifier: MIT
// A person whose server dies: what is said, and that all comes back, with Keep and Back.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { openPage, until } from './browser.mjs';
import { FakeStudio } from './fake_studio.mjs';
import { browser, letGo, picture, place, pull, skip, state, withStudio } from './hand.mjs';

test('the server is killed: the page says what is kept; after a start it is all there, and Back goes to what was opened', { skip }, () =>
  withStudio('hat-on-coatrack.json', async (page, studio, keep) => {
    for (const [time, dx, dy] of [[0.4, 20, -12], [0.5, -15, 8]]) {
      const [x, y] = await place(page, 'hat', time);
      await pull(page, [x, y], [x + dx, y + dy]);
      await letGo(page);
    }
    const numbers = await state(page, '(s) => JSON.stringify(s.document.numbers)'), arcs = await state(page, '(s) => [...s.motion.tracks[2].arcs]');
    await studio.kill();
    await until(page, '(s) => s.connected === "lost"');
    assert.match(await page.textContent('#notice'), /kept beside the scene.*start carom studio/);
    await picture(page, 'lost');
    const { url } = studio, { port, hash } = new URL(url), stranger = keep(new FakeStudio());
    await stranger.listen(Number(port));
    await until(page, '() => /not the server that this page knows/.test(document.querySelector("#notice").textContent)');
    assert.ok(stranger.heard.length > 0 && stranger.heard.every(({ type }) => type === 'prove'), 'a stranger at the port is asked for a proof');
    assert.ok(hash.length === 65 && !JSON.stringify(stranger.heard).includes(hash.slice(1)), 'and not told the token');
    await stranger.close();
    await studio.run();
    assert.equal(studio.url, url, 'it has the address of before');
    await until(page, '(s) => s.connected === "open" && s.motion && s.document.recovered === 2');
    assert.equal(await state(page, '(s) => JSON.stringify(s.document.numbers)'), numbers, 'the page finds it by itself');
    assert.match(await page.textContent('#notice'), /2 steps recovered/);
    const again = keep(await openPage(browser(), studio.url, { width: 1024, height: 640 }));
    await until(again, '(s) => s.connected === "open" && s.motion && s.notice');
    assert.match(await again.textContent('#notice'), /2 steps recovered/);
    assert.equal(await state(again, '(s) => JSON.stringify(s.document.numbers)'), numbers);
    assert.deepEqual(await state(again, '(s) => [...s.motion.tracks[2].arcs]'), arcs, 'to the same bits');
    await picture(again, 'recovered');
    await again.click('#notice button:has-text("Back")');
    await until(again, '(s) => s.document.undo === null && s.notice === null');
    assert.deepEqual(await state(again, '(s) => s.document.numbers.every((one) => one.opened === one.now)'), true);
    for (const left of [1, 0]) {
      await again.keyboard.press('Control+Shift+Z');
      await until(again, `(s) => (s.document.redo === null) === ${left === 0} && s.document.undo !== null`);
    }
    await until(again, '(s) => s.document.redo === null');
    assert.equal(await state(again, '(s) => JSON.stringify(s.document.numbers)'), numbers);
  }, { complaints: /WebSocket|ERR_CONNECTION/ }));
