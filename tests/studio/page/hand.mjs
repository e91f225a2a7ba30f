// SPDX-License-Identifier: MIT
// A hand for tests: the real mouse in chromium, at the real `carom studio`. Pictures go to the folder that
// CAROM_STUDIO_PICTURES names.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { after, before } from 'node:test';
import { canRun, closing, launch, leftOut, openPage, until } from './browser.mjs';

export { place, state } from './browser.mjs';
import { hasCommand, RealStudio } from './real_studio.mjs';

export const skip = canRun() ? (hasCommand() ? false : 'CAROM_COMMAND names no carom') : leftOut;
let launched;
before(async () => {
  if (!skip) launched = await launch();
});
after(() => launched?.close());
export const browser = () => launched;

/** A page at a server with a copy of a scene; nothing may have been complained of. */
export const withStudio = (scene, act, { change, ...options } = {}) => closing(async (keep) => {
  const studio = keep(await RealStudio.start(scene, change)), page = keep(await openPage(launched, studio.url, { width: 1024, height: 640, ...options }));
  await until(page, '(s) => s.connected === "open" && s.motion');
  await act(page, studio, keep);
  assert.deepEqual(page.complaints.filter((text) => !/ReadPixels/.test(text) && !(options.complaints?.test(text))), []);
});

export const screenOf = (page, point) => page.evaluate((p) => globalThis.carom.screenOf(p), point);
export const answered = (page) => until(page, '(s) => s.gesture.state === "dragging" && s.gesture.seq > 0 && s.gesture.answered === s.gesture.seq');
/** Let go of, and told what that came to: the document comes after the motion. */
export const idle = (page) => until(page, '(s) => s.gesture.state === "idle" && s.document.held_by === null && s.document.rev === s.motion.rev', 90000);
export const picture = (page, name) => process.env.CAROM_STUDIO_PICTURES && page.screenshot({ path: join(process.env.CAROM_STUDIO_PICTURES, `${name}.png`) });

/** The same by a hand that waits for each answer: what comes of it does not depend on how quick the machine is. */
export async function pullSlowly(page, [x, y], [to_x, to_y], steps = 6) {
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 1; k <= steps; ++k) {
    await page.mouse.move(x + ((to_x - x) * k) / steps, y + ((to_y - y) * k) / steps);
    if (k * Math.hypot(to_x - x, to_y - y) > 5 * steps) await answered(page);
  }
}

/** With the mouse from one place of the page to another; the button stays down. */
export async function pull(page, [x, y], [to_x, to_y], steps = 6) {
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 1; k <= steps; ++k) await page.mouse.move(x + ((to_x - x) * k) / steps, y + ((to_y - y) * k) / steps);
  await answered(page);
}

export async function letGo(page) {
  await page.mouse.up();
  await idle(page);
}

/** Takes a step back, and waits for it: what is idle already says nothing. */
export async function undo(page) {
  const rev = await page.evaluate(() => globalThis.carom.store.state.document.rev);
  await page.keyboard.press('Control+z');
  await until(page, `(s) => s.document.rev > ${rev} && s.motion.rev === s.document.rev && s.document.held_by === null`, 90000);
}
