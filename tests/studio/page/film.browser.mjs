// SPDX-License-Identifier: MIT
// A film of the view, by the browser's own encoder: it plays as long as the motion, and shows the body where it is.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { closing, until } from './browser.mjs';
import { ownFolder } from './exported_page.mjs';
import { browser, skip, state, withStudio } from './hand.mjs';

test('the motion is filmed, a frame for each dot; Cancel ends it', { skip }, () => closing((keep) => withStudio('bounce.json', async (page) => {
  const film = async () => {
    await page.click('#file');
    await page.click('#menu >> text=Export…');
    await page.click('dialog button:has-text("Film of the view")');
  };
  await page.evaluate(() => globalThis.carom.store.set({ time: 0.25 }));
  const [download] = await Promise.all([page.waitForEvent('download', { timeout: 120000 }), film()]);
  assert.equal(download.suggestedFilename(), 'bounce.webm');
  const path = join(ownFolder(keep), 'bounce.webm');
  await download.saveAs(path);
  const bytes = readFileSync(path), end = await state(page, '(s) => s.motion.end');
  assert.ok(bytes.length > 5000 && bytes.subarray(0, 4).equals(Buffer.from([0x1a, 0x45, 0xdf, 0xa3])), `${bytes.length} bytes of a film`);
  assert.equal(await state(page, '(s) => s.time'), 0.25, 'the time that is shown is as before');
  const player = keep(await browser().newPage()), played = await player.evaluate((data) => new Promise((done) => {
    const video = document.createElement('video');
    video.muted = true;
    video.onended = () => done({ seconds: video.currentTime, width: video.videoWidth, height: video.videoHeight });
    video.onerror = () => done({ error: video.error?.message });
    video.src = `data:video/webm;base64,${data}`;
    void video.play();
  }), bytes.toString('base64'));
  const view = await page.evaluate(() => [document.getElementById('view').clientWidth, document.getElementById('view').clientHeight]);
  assert.deepEqual([played.width, played.height], view);
  assert.ok(played.seconds > 0.8 * end && played.seconds < 1.6 * end, `${played.seconds} s of film, ${end} s of motion`);
  console.log(`# ${played.seconds.toFixed(2)} s of film for ${end.toFixed(2)} s of motion, ${bytes.length} bytes`);
  await film();
  await page.click('#notice button:text-is("Cancel")');
  await until(page, '(s) => s.notice === null');
  assert.equal(await state(page, '(s) => s.time'), 0.25);
})));
