// SPDX-License-Identifier: MIT
// Eight states of the page at three sizes, in two launches of the browser each: the pictures are the same to the bit, show
// the expected ink where things are, cut and cover nothing, and keep nobody out. Pictures go to the folder that
// CAROM_STUDIO_PICTURES names.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { colours, impactColours, inkOf } from '../../../studio/page/colours.js';
import { axeSource, canRun, closing, frame, launch, leftOut, openPage, place as placeOf, until } from './browser.mjs';
import { FakeStudio } from './fake_studio.mjs';
import { decodePng, nearestInk } from './png.mjs';

const skip = canRun() ? false : leftOut, ball = 'ball <b>', ballInk = inkOf('#2468b8');
const place = (page, time) => placeOf(page, ball, time);

/** Moves the pointer to where it is over nothing. */
async function park(page) {
  await page.mouse.move(...(await page.evaluate(() => [innerWidth / 2, 20])));
  await until(page, '(s) => s.hover === null');
}
async function pull(page, time, dx, dy) {
  const [x, y] = await place(page, time);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 3 });
  await until(page, '(s) => s.gesture.state === "dragging" && s.gesture.answered === s.gesture.seq && s.gesture.seq > 0');
}
async function letGo(page) {
  await page.mouse.up();
  await until(page, '(s) => s.gesture.state === "idle"');
}

/** What brings each state about, one after another. */
const states = {
  opened: (page) => park(page),
  hover: async (page) => {
    await page.mouse.move(...(await place(page, 0.4)));
    await until(page, '(s) => s.hover?.kind === "path"');
  },
  dragging: (page) => pull(page, 0.4, 60, -60),
  nailed: async (page) => {
    await letGo(page);
    await page.keyboard.press('i');
    await until(page, '(s) => s.document.nails.length === 1');
    await page.keyboard.press('Home');
    await park(page);
  },
  'other impacts': async (page) => {
    await pull(page, 0.6, 0, 0.22 * page.viewportSize().height);
    await letGo(page);
    await page.click('#notice >> text=Show');
    await until(page, '(s) => s.changesShown');
    await park(page);
  },
  cannot: async (page) => {
    await page.click('#notice [aria-label="Close"]');
    await pull(page, 0.1, 200, -120);
    await letGo(page);
    await until(page, '(s) => s.card !== null');
    await park(page);
  },
  'lost server': async (page, studio) => {
    await studio.close();
    await until(page, '(s) => s.connected === "lost"');
  },
};

/** Goes through the states in a browser of its own; `look` sees the page in each. */
const walk = (width, height, look) => closing(async (keep) => {
  const studio = keep(new FakeStudio()), bare = keep(new FakeStudio({ open: false })), browser = keep(await launch()), pictures = {};
  const page = await openPage(browser, await studio.listen(), { width, height, reducedMotion: 'reduce' });
  await until(page, '(s) => s.connected === "open"');
  await page.evaluate(() => globalThis.carom.store.set({ noticesStay: true }));
  for (const [name, bring] of Object.entries(states)) {
    await bring(page, studio);
    await frame(page);
    pictures[name] = await page.screenshot();
    await look(page, name, pictures[name]);
  }
  const empty = await openPage(browser, await bare.listen(), { width, height, reducedMotion: 'reduce' });
  await empty.waitForSelector('#empty .scene');
  await frame(empty);
  pictures.empty = await empty.screenshot();
  await look(empty, 'empty', pictures.empty);
  const complaints = [...page.complaints, ...empty.complaints].filter((text) => !/ReadPixels|WebSocket|ERR_CONNECTION/.test(text));
  assert.deepEqual(complaints, []);
  return pictures;
});

/** What is cut, lies over something else, or scrolls. */
function faults() {
  const seen = (element) => element.checkVisibility() && element.getBoundingClientRect().width > 1;
  const named = (element) => element.id || `${element.className} ${element.textContent}`.trim();
  const found = [], inside = (e, b, o) => b.left >= o.left - 1 && b.right <= o.right + 1 && b.top >= o.top - 1 && b.bottom <= o.bottom + 1 || found.push(`${named(e)} reaches out`);
  const islands = [...document.querySelectorAll('#tools, #notice, #card, #readout, #ended, #loading, #fold')].filter(seen);
  const parts = [...document.querySelectorAll('header > *, .player > *, summary > *, #numbers *, #nails *, #bodies *, .card > *, #empty > *, .scene > *')].filter(seen);
  for (const element of islands) if (element.id !== 'fold') inside(element, element.getBoundingClientRect(), document.getElementById('view').getBoundingClientRect());
  for (const element of parts) {
    const holder = element.closest('header, footer, .card, #panel, #empty');
    inside(element, element.getBoundingClientRect(), holder.getBoundingClientRect());
    const text = [...element.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
    if (text && element.scrollWidth > element.clientWidth + 1 && getComputedStyle(element).display !== 'inline') found.push(`${named(element)} is cut`);
  }
  const over = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
  for (const group of [islands, [...document.querySelectorAll('header, #view, #panel, footer')], [...document.querySelectorAll('header > *, .player > *')].filter(seen),
    [...document.querySelectorAll('#panel summary, #panel li > *, #panel .control-head, #panel .number-row, #meet')].filter(seen)]) {
    group.forEach((a, i) => group.slice(i + 1).forEach((b) => {
      if (!a.contains(b) && !b.contains(a) && over(a.getBoundingClientRect(), b.getBoundingClientRect())) found.push(`${named(a)} and ${named(b)} overlap`);
    }));
  }
  for (const e of document.querySelectorAll('html, body, header, footer, #panel .content, #empty, .card')) {
    if (e.checkVisibility() && (e.scrollWidth > e.clientWidth || e.scrollHeight > e.clientHeight)) found.push(`${named(e)} scrolls`);
  }
  return found;
}

/** The ink that a state must show, as [what, where on the page, colour, px around]. */
async function expectedInk(page, name) {
  const scale = (await page.evaluate(() => document.getElementById('overlay').clientWidth)) > 1900 ? 1.25 : 1;
  const impacts = await page.evaluate(() => globalThis.carom.store.state.motion.impacts.map((one) => globalThis.carom.screenOf(one.point)));
  const inks = [];
  for (const time of [0.25, 0.55]) inks.push([`path at ${time} s`, await place(page, time), ballInk, 3]);
  for (const [x, y] of impacts) inks.push(['impact', [x + 6 * scale, y], impactColours.stick, 2], ['impact', [x - 6 * scale, y], impactColours.stick, 2]);
  if (name === 'hover') inks.push(['point under the hand', await place(page, 0.4), '#ffffff', 2]);
  if (name === 'dragging') {
    const [x, y] = await page.evaluate(() => globalThis.carom.screenOf(globalThis.carom.store.state.gesture.target));
    inks.push(['target', [x + 7 * scale, y], '#ffffff', 2]);
  }
  if (name === 'dragging' || name === 'other impacts') {
    const before = await page.evaluate(() => globalThis.carom.beforeOnScreen(1, 0.75));
    inks.push(['path before', before, colours.before, 9]);
  }
  if (['nailed', 'other impacts', 'cannot'].includes(name)) {
    const [x, y] = await page.evaluate(() => globalThis.carom.screenOf(globalThis.carom.store.state.document.nails[0].constraint.position));
    inks.push(['hoop', [x + 10 * scale, y], colours.nail, 2], ['hoop', [x, y - 10 * scale], colours.nail, 2]);
  }
  return inks;
}

/** The largest difference of a channel at which ink counts as that ink: lines are 1 px wide, and blended at their edges. */
const alike = 48;

async function inkIsThere(page, name, bytes) {
  if (name === 'empty' || name === 'lost server') return;
  const picture = decodePng(bytes), all = await expectedInk(page, name);
  const seen = await page.evaluate((places) => places.map(([x, y]) => document.elementFromPoint(x, y)?.id === 'overlay'), all.map(([, at]) => at));
  const inks = all.filter((_, i) => seen[i]);
  assert.ok(inks.length >= 3 && (name === 'cannot' || all.length - inks.length <= 4), `${name}: most of it is in the view`);
  for (const [what, at, colour, within] of inks) {
    const off = nearestInk(picture, at, colour, within);
    assert.ok(off <= alike, `${name}: ${what} at ${at.map(Math.round)} is off its ${colour} by ${off}`);
  }
}

async function keepsNobodyOut(page, name) {
  await page.evaluate(readFileSync(axeSource(), 'utf8'));  // not by a script element: the policy allows none
  const serious = await page.evaluate(async () => {
    const { violations } = await globalThis.axe.run(document, { resultTypes: ['violations'] });
    return violations.filter(({ impact }) => ['serious', 'critical'].includes(impact)).map(({ id, nodes }) => `${id}: ${nodes.map((n) => n.html).join(' ')}`);
  });
  assert.deepEqual(serious, [], name);
}

for (const [width, height] of [[1024, 640], [1440, 900], [2560, 1440]]) {
  test(`eight states at ${width} x ${height}`, { skip }, async () => {
    const folder = process.env.CAROM_STUDIO_PICTURES;
    const [first, second] = await Promise.allSettled([
      walk(width, height, async (page, name, bytes) => {
        if (folder) (await import('node:fs')).writeFileSync(join(folder, `${name.replace(' ', '-')}-${width}.png`), bytes);
        assert.deepEqual(await page.evaluate(faults), [], name);
        await inkIsThere(page, name, bytes);
      }),
      walk(width, height, keepsNobodyOut),
    ]);
    for (const { reason } of [first, second]) if (reason) throw reason;
    assert.equal(Object.keys(first.value).length, 8);
    for (const name of Object.keys(first.value)) assert.ok(first.value[name].equals(second.value[name]), `two launches draw '${name}' the same`);
  });
}
