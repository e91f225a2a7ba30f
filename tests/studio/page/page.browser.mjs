// SPDX-License-Identifier: MIT
// The page in chromium with the real mouse, against the stand-in for its server. Pictures go to the folder that
// CAROM_STUDIO_PICTURES names.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { axeSource, canRun, frame, launch, leftOut, openFake, place as placeOf, state, until } from './browser.mjs';
import { FakeStudio } from './fake_studio.mjs';

const ball = 'ball <b>', skip = canRun() ? false : leftOut;
let browser;
before(async () => {
  if (!skip) browser = await launch();
  else console.log(leftOut);
});
after(() => browser?.close());

const withPage = (options, act) => openFake(browser, options, act);
const place = (page, time) => placeOf(page, ball, time);

async function picture(page, name) {
  await page.mouse.move(...(await page.evaluate(() => [innerWidth / 2, 20])));
  await frame(page);
  return keep(page, name);
}
async function keep(page, name) {
  const folder = process.env.CAROM_STUDIO_PICTURES;
  return page.screenshot(folder ? { path: join(folder, `${name}.png`) } : {});
}

async function drag(page, time, dx, dy, { up = true } = {}) {
  const [x, y] = await place(page, time);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx / 2, y + dy / 2);
  await page.mouse.move(x + dx, y + dy, { steps: 3 });
  await until(page, '(s) => s.gesture.state === "dragging" && s.gesture.answered === s.gesture.seq && s.gesture.seq > 0');
  if (!up) return [x + dx, y + dy];
  await page.mouse.up();
  await until(page, '(s) => s.gesture.state === "idle"');
  return [x + dx, y + dy];
}

test('a path is hovered, pressed and dragged with the mouse; undo brings it back', { skip }, () => withPage({}, async (page, studio) => {
  const [x, y] = await place(page, 0.4);
  await page.mouse.move(x, y);
  await until(page, '(s) => s.hover?.kind === "path"');
  assert.equal(await state(page, '(s) => s.hover.time'), 0.4);
  const end = await drag(page, 0.4, 60, -60);
  const now = await place(page, 0.4);
  assert.ok(Math.hypot(now[0] - end[0], now[1] - end[1]) < 2, `the body is ${now}, the hand ${end}`);
  assert.equal(studio.heard.find((one) => one.type === 'grab').at, 0.4);
  assert.equal(await state(page, '(s) => s.document.undo'), "drag of 'ball <b>'");
  await page.keyboard.press('Control+z');
  await until(page, '(s) => s.document.undo === null');
  const back = await place(page, 0.4);
  assert.ok(Math.hypot(back[0] - x, back[1] - y) < 1e-6);
}));

test('Escape and the right button cancel; a digit types; letters keep to an axis', { skip }, () => withPage({}, async (page, studio) => {
  await drag(page, 0.4, 40, -40, { up: false });
  await page.keyboard.press('Escape');
  await until(page, '(s) => s.gesture.state === "idle"');
  await page.mouse.up();
  assert.equal(studio.heard.at(-1).type, 'cancel');
  await drag(page, 0.4, 40, -40, { up: false });
  await page.keyboard.press('z');
  assert.equal(await state(page, '(s) => s.gesture.axis'), 'z');
  await page.keyboard.type('1.6');
  assert.equal(await state(page, '(s) => s.gesture.state'), 'typing');
  await page.keyboard.press('Enter');
  await until(page, '(s) => s.gesture.state === "idle"');
  await page.mouse.up();
  assert.equal(studio.heard.findLast((one) => one.place).place[2], 1.6);
  assert.equal(studio.heard.at(-1).type, 'release');
  await drag(page, 0.4, 10, -40, { up: false });
  await page.mouse.down({ button: 'right' });
  await page.mouse.up({ button: 'right' });
  await until(page, '(s) => s.gesture.state === "idle"');
  assert.equal(studio.heard.at(-1).type, 'cancel');
  await page.mouse.up();
}));

test('an impact that is pressed is held at whatever time it comes', { skip }, () => withPage({}, async (page, studio) => {
  const [x, y] = await page.evaluate(() => globalThis.carom.screenOf(globalThis.carom.store.state.motion.impacts[0].point));
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 20, y, { steps: 4 });
  await page.mouse.up();
  await until(page, '(s) => s.gesture.state === "idle"');
  assert.deepEqual(studio.heard.find((one) => one.type === 'grab').at, { impact: 1, with: 'floor' });
}));

test('pressing beside everything turns the camera, and a click there lets go of the selection', { skip }, () => withPage({}, async (page, studio) => {
  const before_turn = await place(page, 0.4);
  await page.mouse.move(500, 120);
  await page.mouse.down();
  await page.mouse.move(560, 160, { steps: 3 });
  await page.mouse.up();
  const turned = await place(page, 0.4);
  assert.ok(Math.hypot(turned[0] - before_turn[0], turned[1] - before_turn[1]) > 5);
  assert.ok(!studio.heard.some((one) => one.type === 'grab'));
  await page.mouse.click(...(await place(page, 0.2)));
  assert.equal(await state(page, '(s) => s.selected'), 1);
  await page.mouse.click(500, 120);
  assert.equal(await state(page, '(s) => s.selected'), -1);
}));

test('without a mouse: choose, take, move, confirm; fields keep their keys', { skip }, () => withPage({}, async (page, studio) => {
  await page.focus('#overlay');
  await page.keyboard.press('ArrowDown');
  for (let i = 0; i < 5; ++i) await page.keyboard.press('ArrowRight');
  await page.keyboard.press('g');
  await page.keyboard.press('Shift+ArrowUp');
  await until(page, '(s) => s.gesture.answered === s.gesture.seq && s.gesture.seq > 0');
  await page.keyboard.press('Enter');
  await until(page, '(s) => s.gesture.state === "idle"');
  assert.deepEqual(studio.heard.map((one) => one.type), ['hello', 'grab', 'drag', 'release']);
  const field = page.getByLabel("velocity.x of 'ball <b>'");
  await field.fill('1+1.5');
  await field.press('g');
  await field.fill('1+1.5');
  await field.press('Enter');
  await until(page, '(s) => s.document.numbers[0].now === 2.5');
  assert.deepEqual(studio.heard.at(-1).edits, [{ pointer: '/bodies/1/velocity/0', value: 2.5 }]);
}));

test('out of reach: amber, a sentence, and one notice; nails are listed with their components', { skip }, () => withPage({}, async (page) => {
  await page.click('#nail-on-release');
  await drag(page, 0.1, 300, -200, { up: false });
  assert.match(await page.textContent('#readout'), /from its target/);
  await keep(page, 'cannot');
  await page.mouse.up();
  await until(page, '(s) => s.card !== null');
  assert.match(await page.textContent('#card'), /cannot be thrown faster/);
  assert.equal(await page.locator('#nails .nail').count(), 1);
  assert.equal(await page.locator('#nails .toggle[aria-pressed="true"]').count(), 3);
  assert.equal(await page.locator('#bodies b').count(), 0, 'names are text, never HTML');
}));

test('at rest nothing is drawn and nothing is said', { skip }, () => withPage({}, async (page, studio) => {
  await frame(page);
  const count = () => page.evaluate(() => [globalThis.carom.frames(), globalThis.carom.received()]);
  const [before_rest, heard] = [await count(), studio.heard.length];
  await page.evaluate(() => new Promise((done) => {
    let frames = 0;
    const next = () => (++frames < 30 ? requestAnimationFrame(next) : done());
    next();
  }));
  assert.deepEqual(await count(), before_rest);
  assert.equal(studio.heard.length, heard);
}));

test('a server that goes is said, cancels the drag, and is found again', { skip }, () => withPage({ complaints: /WebSocket|ERR_CONNECTION/ }, async (page, studio, keep) => {
  await drag(page, 0.4, 40, -40, { up: false });
  const { port } = studio;
  await studio.close();
  await until(page, '(s) => s.connected === "lost"');
  assert.equal(await state(page, '(s) => s.gesture.state'), 'idle');
  assert.match(await page.textContent('#notice'), /server is gone; the drag was cancelled/);
  await page.mouse.up();
  await picture(page, 'lost-server');
  const again = keep(new FakeStudio());
  again.token = studio.token;  // as a server that starts again keeps it
  await again.listen(port);
  await until(page, '(s) => s.connected === "open"');
  assert.match(await page.textContent('#notice'), /started again/);
  await drag(page, 0.4, 30, -30);
}));

test('another tab that holds a body is an error that is told', { skip }, () => withPage({ studio: { locked: true } }, async (page) => {
  const [x, y] = await place(page, 0.4);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 20, y);
  await until(page, '(s) => s.notice !== null');
  assert.match(await page.textContent('#notice'), /Another tab/);
  assert.equal(await state(page, '(s) => s.gesture.state'), 'idle');
  await page.mouse.up();
}));

test('where nothing is open there are scenes to start from', { skip }, () => withPage({ studio: { open: false } }, async (page) => {
  await page.waitForSelector('#empty .scene');
  await picture(page, 'empty');
  await page.click('#empty .scene >> nth=0');
  await until(page, '(s) => s.motion !== null');
  assert.ok(await page.isHidden('#empty'));
}));

test('the empty page greets before the scenes are told of; those that a connection that broke did not bring come with the next', { skip }, () => withPage({ studio: { open: false, deaf: ['gallery', 'list'] }, complaints: /WebSocket|ERR_CONNECTION/ }, async (page, studio, keep) => {
  assert.ok(await page.isVisible('#empty h1') && await page.isVisible('#empty button.primary') && await page.isHidden('#loading'));
  assert.equal(await page.locator('#empty .scene').count(), 0);
  const { port } = studio;
  await studio.close();
  await until(page, '(s) => s.connected === "lost"');
  await frame(page);
  assert.match(await page.textContent('#notice'), /server is gone/, 'what was asked for says nothing beside it');
  const again = keep(new FakeStudio({ open: false }));
  again.token = studio.token;
  await again.listen(port);
  await page.waitForSelector('#empty .scene');
  assert.match(await page.textContent('#notice'), /started again/);
}));

test('nothing that keeps people out: axe-core on menus and dialogs', { skip }, async () => {
  const axe = readFileSync(axeSource(), 'utf8');
  const check = async (page, what) => {
    await page.evaluate(axe);  // not by a script element: the policy allows none
    const { violations } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ['violations'] }));
    const serious = violations.filter(({ impact }) => ['serious', 'critical'].includes(impact)).map(({ id, nodes }) => `${id}: ${nodes.map((n) => n.html).join(' ')}`);
    assert.deepEqual(serious, [], what);
  };
  await withPage({}, async (page) => {
    await page.click('#help');
    await check(page, 'keys');
    await page.keyboard.press('Escape');
    await page.keyboard.press('Control+o');
    await page.waitForSelector('dialog .scene');
    await check(page, 'open dialog');
    await page.keyboard.press('Escape');
    await page.click('#file');
    await check(page, 'menu');
    await page.click('#menu >> text=Motion as a table');
    await page.waitForSelector('dialog table');
    await check(page, 'table');
  });
});
