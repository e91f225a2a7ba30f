// SPDX-License-Identifier: MIT
// A browser for tests: Debian's chromium, driven by playwright-core of the page's dev packages.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { createRequire } from 'node:module';
import { FakeStudio } from './fake_studio.mjs';

const require = createRequire(new URL('../../../studio/page/package.json', import.meta.url));

export const executable = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);

export const leftOut = 'left out: scripts/setup studio-tests installs chromium and playwright-core';

/** Whether there is a browser and its driver; with CAROM_REQUIRE_STUDIO set there has to be. */
export function canRun() {
  const driver = require.resolve.paths('').some((folder) => existsSync(`${folder}/playwright-core`)), can = !!executable && driver;
  if (!can && process.env.CAROM_REQUIRE_STUDIO) throw new Error('chromium or playwright-core is missing: scripts/setup studio-tests');
  return can;
}

export async function launch() {
  const { chromium } = require('playwright-core');
  return chromium.launch({ executablePath: executable, args: process.getuid?.() === 0 ? ['--no-sandbox'] : [] });
}

export const axeSource = () => require.resolve('axe-core/axe.min.js');

/** ms: how long tests wait for what has to come. Machines that are shared stand still for seconds. */
export const patience = 30000;

/** Runs `act` with `keep`, which takes what has to be closed: that is done, the last first, whatever fails. What stays open
 * would keep node from ending.
 * @template T @param {(keep: <C extends {close: () => unknown}>(one: C) => C) => Promise<T>} act @returns {Promise<T>} */
export async function closing(act) {
  const kept = [], problems = [];
  let result;
  try {
    result = await act((one) => (kept.push(one), one));
  } catch (problem) {
    problems.push(problem);
  }
  for (const one of kept.reverse()) {
    try {
      await one.close();
    } catch (problem) {
      problems.push(problem);
    }
  }
  if (problems.length) throw problems[0];
  return result;
}

/** A tab at the studio's page, whose complaints are kept in `complaints`. */
export async function openPage(browser, url, { width = 1440, height = 900, quality = 'low', ...more } = {}) {
  const page = await browser.newPage({ viewport: { width, height }, ...(more.reducedMotion ? { reducedMotion: more.reducedMotion } : {}), ...(more.forcedColors ? { forcedColors: more.forcedColors } : {}) });
  page.setDefaultTimeout(patience);
  page.complaints = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && page.complaints.push(message.text()));
  page.on('pageerror', (error) => page.complaints.push(String(error.stack ?? error)));
  const stays = (to) => /^((http|ws):\/\/127\.0\.0\.1:\d+\/|data:|blob:)/.test(to) || page.complaints.push(`a request left this machine: ${to}`);
  page.on('request', (request) => stays(request.url()));
  page.on('websocket', (socket) => stays(socket.url()));
  if (more.before) await page.addInitScript(more.before);
  const [address, token] = url.split('#');
  try {
    await page.goto(`${address}?test&quality=${quality}#${token ?? 'x'}`);
  } catch (problem) {
    await page.close();
    throw problem;
  }
  return page;
}

/** Until a state of the store holds; `test` is the text of a function of it, which may fail where the state lacks what it
 * looks at, as between one scene and the next. Playwright's own waiting evaluates text in the page, which the page's
 * policy refuses. */
export async function until(page, test, within = patience) {
  let timer;
  const silent = new Promise((_, reject) => (timer = setTimeout(() => reject(new Error(`the page hung while ${test} was waited for`)), within + 10000)));
  const held = page.evaluate(`(async () => {
    const test = ${test}, end = performance.now() + ${within};
    for (let problem = ''; ; problem = '') {
      try {
        if (globalThis.carom && test(globalThis.carom.store.state)) return;
      } catch (error) {
        problem = ': ' + error;
      }
      if (performance.now() > end) throw new Error(${JSON.stringify(`${test} did not come true`)} + problem);
      await new Promise((next) => setTimeout(next, 10));
    }
  })()`);
  held.catch(() => {});
  try {
    await Promise.race([held, silent]);
  } finally {
    clearTimeout(timer);
  }
}

/** What a function, given as text, says of the page's state. */
export const state = (page, test) => page.evaluate(`(${test})(globalThis.carom.store.state)`);
/** Where a body is on the screen at a time. */
export const place = (page, name, time) => page.evaluate(([n, t]) => globalThis.carom.bodyOnScreen(n, t), [name, time]);
/** Until what was asked for has been drawn. */
export const frame = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/** Counts messages from the next socket on: `.count`. */
export function countMessages(page) {
  const messages = { count: 0 };
  page.on('websocket', (socket) => {
    for (const event of ['framesent', 'framereceived']) socket.on(event, () => ++messages.count);
  });
  return messages;
}

/** Runs `act` with a stand-in for the server and a page; nothing may have been complained of. */
export const openFake = (browser, options, act) => closing(async (keep) => {
  const studio = keep(new FakeStudio(options.studio)), page = keep(await openPage(browser, await studio.listen(), options));
  await until(page, '(s) => s.connected === "open"');
  await act(page, studio, keep);
  assert.deepEqual(page.complaints.filter((text) => !text.includes('ReadPixels') && !(options.complaints && options.complaints.test(text))), []);
});
