// SPDX-License-Identifier: MIT
// The pictures of docs/studio.md, from the command itself by the real mouse: node pictures.mjs FOLDER [PICTURE]. scripts/studio_pictures
// calls it.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { closing, frame, launch, openPage, place, state, until } from './browser.mjs';
import { exported, openExported, ownFolder, scenes } from './exported_page.mjs';
import { RealStudio } from './real_studio.mjs';

const [folder, only] = process.argv.slice(2);
// small files, and high enough that both long lists are open
const size = { width: 1024, height: 762, quality: 'low' };
const patience = 120000;  // drawing in software is slow, and nobody waits

const screenOf = (page, point) => page.evaluate((p) => globalThis.carom.screenOf(p), point);
const answered = (page) => until(page, '(s) => s.gesture.state === "dragging" && s.gesture.seq > 0 && s.gesture.answered === s.gesture.seq && !s.motion.more', patience);
const idle = (page) => until(page, '(s) => s.gesture.state === "idle"', patience);

async function pull(page, [x, y], [to_x, to_y], steps = 8) {
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 1; k <= steps; ++k) await page.mouse.move(x + ((to_x - x) * k) / steps, y + ((to_y - y) * k) / steps);
  await answered(page);
}
async function letGo(page) {
  await page.mouse.up();
  await idle(page);
}

async function closeNotice(page) {
  if (await page.isVisible('#notice')) await page.click('#notice button[aria-label="Close"]');
  await page.mouse.move(5, 500);
}

/** Once nothing moves any more. @param alone the id of the part of the page that is shown; none: all of it */
async function keep(page, name, alone = '') {
  await page.evaluate(async () => {
    for (let was = -1; was !== globalThis.carom.frames(); ) {
      was = globalThis.carom.frames();
      await new Promise((next) => setTimeout(next, 300));
    }
  });
  await (alone ? page.locator(`#${alone}`) : page).screenshot({ path: join(folder, `${name}.png`) });
}

const withStudio = (browser, scene, act, change) => closing(async (keep) => {
  const studio = keep(await RealStudio.start(scene, change)), page = keep(await openPage(browser, studio.url, size));
  await until(page, '(s) => s.connected === "open" && (s.motion || !s.document.open)', patience);
  await act(page);
  assert.deepEqual(page.complaints.filter((text) => !/ReadPixels/.test(text)), []);
});

/** A hat is dragged from one peg of a coatrack down to another. */
async function drag(page) {
  await pull(page, await place(page, 'hat', 0.62), await screenOf(page, [-0.3, -0.02, 1.3]), 16);
  await keep(page, 'drag');
}

/** It is nailed above the peg, and turned on its way there. */
async function nails(page) {
  await pull(page, await place(page, 'hat', 0.62), await screenOf(page, [-0.25, -0.02, 1.62]));
  await page.keyboard.down('i');
  await letGo(page);
  await page.keyboard.up('i');
  await until(page, '(s) => s.document.nails.length === 2');
  await page.click('#tool-turn');
  const [x, y] = await place(page, 'hat', 0.3);
  await pull(page, [x, y], [x + 45, y - 25]);
  await letGo(page);
  await closeNotice(page);
  await keep(page, 'nails');
}

/** The third impact of a mug is dragged along the table and nailed. */
async function impact(page) {
  const third = await state(page, '(s) => s.motion.impacts.filter((i) => i.pairs.some(([a, b]) => a === 1 && b === 2))[2]');
  await page.click('#nail-on-release');
  await pull(page, await screenOf(page, third.point), await screenOf(page, [third.point[0] - 0.05, third.point[1], third.point[2]]));
  await page.keyboard.press('Shift+Z');
  await answered(page);
  await letGo(page);
  await until(page, '(s) => s.document.nails.length === 2');
  await closeNotice(page);
  await page.click('#nails li:nth-child(2) .name');
  await keep(page, 'impact');
}

/** A target that a bounded throw does not reach; the hat misses the rack. */
async function cannot(page) {
  const [x, y] = await place(page, 'hat', 0.2);
  await pull(page, [x, y], [x + 60, y - 50]);
  await letGo(page);
  await until(page, '(s) => s.card?.searching === false && s.notice?.key === "changes"', patience);
  await page.click('#notice button:has-text("Show")');
  await page.mouse.move(5, 500);
  await keep(page, 'cannot', 'view');
}

/** The book on the shelf in other ways; one of them is pointed at. */
async function others(page) {
  await page.click('#meet');
  await until(page, '(s) => s.document.nails.every((n) => n.on && n.met) && s.motion.rev === s.document.rev', patience);
  await page.click('#find-others');
  await until(page, '(s) => s.others?.searching === false && [...document.querySelectorAll("#others canvas")].every((one) => one.dataset.drawn)', patience);
  await closeNotice(page);
  await page.hover('#others .strip button >> nth=2');
  await keep(page, 'others', 'view');
}

/** The goals of the scene, met: the hat lands on the peg in the pose that is asked for. */
async function meet(page) {
  await page.click('#bodies li:nth-child(3) .name');
  await page.click('#meet');
  await until(page, '(s) => s.document.nails.every((n) => n.on && n.met)', patience);
  await closeNotice(page);
  await page.click('#nails li:nth-child(1) .name');
  await keep(page, 'meet');
}

/** A curve that no hat can fly, drawn with the pen. */
async function sketched(page) {
  await page.click('#tool-pen');
  const [x, y] = await place(page, 'hat', 0.1), [to_x, to_y] = await place(page, 'hat', 0.5);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move((x + to_x) / 2, (y + to_y) / 2 + 30, { steps: 12 });
  await page.mouse.move(to_x, to_y, { steps: 12 });
  await page.mouse.up();
  await until(page, '(s) => s.notice?.key === "sketched" && s.document.nails.length > 9', patience);
  await keep(page, 'sketched', 'view');
}

const oneGoal = (document) => ({ ...document, constraints: document.constraints.slice(0, 1) });
const narrow = (document) => ({ ...document, controls: [{ vary: 'velocity', body: 'hat', min: -4.5, max: 4.5 }], constraints: [] });
/** A motion that is handed on, with the one before. */
async function handedOn(keep_open, browser) {
  const old = join(scenes, 'hat-on-coatrack.json'), document = JSON.parse(readFileSync(old, 'utf8')), hat = document.bodies.find((body) => body.name === 'hat');
  const scene = join(ownFolder(keep_open), 'scene.json');
  document.constraints = [];
  hat.velocity = [hat.velocity[0] - 0.1, hat.velocity[1], hat.velocity[2] + 0.1];
  writeFileSync(scene, JSON.stringify(document));
  const page = await openExported(keep_open, browser, exported(keep_open, scene, '--before', old).path, size);
  await page.evaluate(() => globalThis.carom.store.set({ selected: 2, time: 0.4 }));
  await frame(page);
  await page.screenshot({ path: join(folder, 'exported.png') });
}

await closing(async (keep) => {
  const browser = keep(await launch());
  const acts = [['hat-on-coatrack.json', drag], ['hat-on-coatrack.json', nails, oneGoal], ['mug-on-mark.json', impact], ['hat-on-coatrack.json', cannot, narrow],
    ['hat-on-coatrack.json', meet], ['book-on-shelf.json', others], ['hat-on-coatrack.json', sketched, (document) => ({ ...document, constraints: [] })]];
  for (const [scene, act, change] of acts) if (!only || act.name === only) await withStudio(browser, scene, act, change);
  if (!only || only === 'exported') await handedOn(keep, browser);
});
