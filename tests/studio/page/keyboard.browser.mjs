// SPDX-License-Identifier: MIT
// The main way by the keyboard alone, from an empty start to a saved and exported scene, and what is said on the way to those who do not see it; the
// same page in forced colours, at 200 %, and with reduced motion. No mouse is touched here.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { axeSource, closing, frame, openPage, until } from './browser.mjs';
import { browser, idle, picture, skip, state, withStudio } from './hand.mjs';
import { RealStudio } from './real_studio.mjs';

/** Tab, until what matches has the focus. */
async function tabTo(page, selector, key = 'Tab') {
  for (let k = 0; k < 120; ++k) {
    if (await page.evaluate((wanted) => !!document.activeElement?.matches(wanted), selector)) return;
    await page.keyboard.press(key);
  }
  assert.fail(`${selector} cannot be reached by ${key}`);
}
const named = (words) => `[aria-label="${words}"]`;
/** Until this was said. */
const hear = (page, words) => until(page, `() => ${words}.test(globalThis.heard?.join('\\n') ?? document.getElementById('live').textContent)`);
async function type(page, selector, text) {
  await tabTo(page, selector);
  await page.keyboard.press('Control+a');
  await page.keyboard.type(text);
  await page.keyboard.press('Enter');
}
async function menuRow(page, opener, words) {
  await tabTo(page, opener);
  await page.keyboard.press('Enter');
  for (let k = 0; k < 30; ++k) {
    if (await page.evaluate((text) => document.activeElement?.textContent === text, words)) return page.keyboard.press('Enter');
    await page.keyboard.press('ArrowDown');
  }
  assert.fail(`no row ${words}`);
}
const ready = (count) => `(s) => s.document?.bodies.length === ${count} && s.motion?.tracks.length === ${count} && s.motion.rev === s.document.rev && s.gesture.state === "idle"`;

/** `contrast`: false where colours are the system's, which styles do not tell. */
async function keepsNobodyOut(page, contrast = true) {
  await page.evaluate(readFileSync(axeSource(), 'utf8'));
  const serious = await page.evaluate(async (with_contrast) => {
    const { violations } = await globalThis.axe.run(document, { resultTypes: ['violations'], rules: { 'color-contrast': { enabled: with_contrast } } });
    return violations.filter(({ impact }) => ['serious', 'critical'].includes(impact)).map(({ id, nodes }) => `${id}: ${nodes.map((n) => n.html).join(' ')}`);
  }, contrast);
  assert.deepEqual(serious, []);
}

test('from an empty start: a die, its throw, a drag, a nail, undo, saved and exported, by keys', { skip }, () => closing(async (keep) => {
  const studio = keep(await RealStudio.start(null)), page = keep(await openPage(browser(), studio.url, { width: 1440, height: 900 }));
  await page.waitForSelector('#empty button');
  await page.evaluate(() => {
    globalThis.heard = [];
    new MutationObserver((changes) => changes.forEach(({ addedNodes }) => addedNodes.forEach((one) => globalThis.heard.push(one.textContent)))).observe(document.getElementById('live'), { childList: true });
    for (const kind of ['mousedown', 'pointerdown', 'pointermove']) addEventListener(kind, () => globalThis.heard.push('a mouse was used'), true);
  });
  await page.evaluate(() => [...document.querySelectorAll('#empty button')].forEach((one) => one.textContent === 'New scene' && (one.id = 'new')));
  await tabTo(page, '#new');
  await page.keyboard.press('Enter');
  await until(page, ready(1));
  await menuRow(page, '#add', 'Die');
  await until(page, '(s) => s.adding >= 0');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'overlay');
  await page.keyboard.press('Enter');
  await until(page, ready(2));
  await hear(page, '/Done: another body/');
  await hear(page, '/die, 0.000 s, at .* rests on floor/');
  await type(page, named('position, m, z'), '0.6');
  await until(page, '(s) => s.document.bodies[1].position[2] === 0.6 && s.motion.rev === s.document.rev');
  await type(page, named('velocity, m/s, x'), '1');
  await until(page, '(s) => s.document.bodies[1].velocity[0] === 1 && s.motion.rev === s.document.rev');
  await type(page, named('angular velocity, rad/s, y'), '2');
  await until(page, '(s) => s.document.bodies[1].angular_velocity[1] === 2 && s.motion.rev === s.document.rev');
  await tabTo(page, '#overlay', 'Shift+Tab');
  await page.keyboard.press(']');
  await hear(page, '/impact with floor/');
  await page.keyboard.press('Home');
  for (let k = 0; k < 6; ++k) await page.keyboard.press('ArrowRight');
  await hear(page, '/die, 0.250 s, at/');
  await page.keyboard.press('g');
  for (let k = 0; k < 5; ++k) await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowUp');
  await until(page, '(s) => s.gesture.seq > 0 && s.gesture.answered === s.gesture.seq');
  await hear(page, '/Holding die/');
  await hear(page, '/m: at its target/');
  await page.keyboard.press('Enter');
  await idle(page);
  await hear(page, "/Done: drag of 'die' at 0.25 s/");
  await page.keyboard.press('i');
  await until(page, '(s) => s.document.nails.length === 1');
  await page.keyboard.press('Control+z');
  await hear(page, '/Undone: nail/');
  await page.keyboard.press('Control+Shift+z');
  await hear(page, '/Done again: nail/');
  await until(page, '(s) => s.document.nails.length === 1 && s.document.nails[0].met');
  await page.keyboard.press(' ');
  await hear(page, '/Playing/');
  await page.keyboard.press(' ');
  await hear(page, '/Stopped at/');
  await frame(page);
  await picture(page, 'keyboard');
  await page.keyboard.press('Control+s');
  await page.waitForSelector('dialog[open] input');
  await page.keyboard.press('Enter');
  await until(page, '(s) => s.document.saved && s.document.path === "scene.json"');
  await hear(page, '/Saved scene.json/');
  await menuRow(page, '#file', 'Export…');
  await page.waitForSelector('dialog[open]');
  const [file] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Enter')]);  // the first one has the focus
  assert.equal(file.suggestedFilename(), 'scene.html');
  assert.ok(!(await page.evaluate(() => globalThis.heard)).includes('a mouse was used'));
  await keepsNobodyOut(page);
  assert.deepEqual(page.complaints.filter((text) => !/ReadPixels/.test(text)), []);
}));

test('what a drag that cannot be reached needs is said, and taken by keys', { skip }, () => withStudio('hat-on-coatrack.json', async (page) => {
  await tabTo(page, '#overlay');
  await page.keyboard.press('ArrowDown');
  await hear(page, '/hat, 0.000 s/');
  for (let k = 0; k < 5; ++k) await page.keyboard.press('ArrowRight');
  await page.keyboard.press('g');
  for (let k = 0; k < 6; ++k) await page.keyboard.press('Shift+ArrowRight');
  await until(page, '(s) => s.gesture.seq > 0 && s.gesture.answered === s.gesture.seq');
  await hear(page, '/from its target/');
  await page.keyboard.press('Enter');
  await idle(page);
  await until(page, '(s) => s.card && !s.card.searching');
  await hear(page, '/bound/');
  await tabTo(page, '.remedies button');
}, { change: (document) => ({ ...document, controls: [{ vary: 'velocity', body: 'hat', min: -4.5, max: 4.5 }], constraints: [] }) }));

for (const [name, options] of [['forced colours', { forcedColors: 'active' }], ['200 %', { width: 720, height: 450 }], ['reduced motion', { reducedMotion: 'reduce' }]]) {
  test(`the page in ${name}`, { skip }, () => withStudio('hat-on-coatrack.json', async (page) => {
    await tabTo(page, '#overlay');
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('g');
    await page.keyboard.press('ArrowRight');
    await until(page, '(s) => s.gesture.seq > 0 && s.gesture.answered === s.gesture.seq');
    await page.keyboard.press('Enter');
    await idle(page);
    await frame(page);
    await picture(page, `keyboard-${name.replace(/\W+/g, '-')}`);
    const out = await page.evaluate(() => [...document.querySelectorAll('header button, header span, #tools button, .player button, .player select, #readout, #fold')].filter((one) => one.checkVisibility() && one.getBoundingClientRect().width > 1)
      .filter((one) => { const box = one.getBoundingClientRect(); return box.right > innerWidth + 1 || box.bottom > innerHeight + 1 || box.left < -1 || box.top < -1; }).map((one) => one.id || one.className));
    assert.deepEqual(out, [], 'all of it can be seen');
    await keepsNobodyOut(page, name !== 'forced colours');
    if (name === 'reduced motion') assert.equal(await page.evaluate(() => getComputedStyle(document.getElementById('notice')).animationName), 'none');
    assert.ok(await state(page, '(s) => s.document.undo'));
  }, { width: 1440, height: 900, ...options }));
}
