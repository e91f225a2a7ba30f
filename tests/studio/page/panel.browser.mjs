// SPDX-License-Identifier: MIT
// Nails, numbers, the time line, dialogs and what the machine asks for (less motion, fewer colours), with the real mouse.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { canRun, closing, launch, leftOut, openFake, openPage, place as placeOf, state, until } from './browser.mjs';
import { FakeStudio } from './fake_studio.mjs';

const skip = canRun() ? false : leftOut, ball = 'ball <b>';
let browser;
before(async () => {
  if (!skip) browser = await launch();
});
after(() => browser?.close());

const place = (page, time) => placeOf(page, ball, time);
const idle = (page) => until(page, '(s) => s.gesture.state === "idle"');
const last = (studio, type) => studio.heard.findLast((one) => one.type === type);

async function drag(page, [x, y], dx, dy) {
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 4 });
  await until(page, '(s) => s.gesture.seq > 0 && s.gesture.answered === s.gesture.seq');
  await page.mouse.up();
  await idle(page);
}
async function nailAt(page, time) {
  await page.mouse.click(...(await place(page, time)));
  await until(page, '(s) => s.selected === 1 && s.time > 0');
  await page.keyboard.press('i');
  await until(page, '(s) => s.document.nails.length === 1');
}
/** Where a moment is in the time line, in the lane of the ball. */
async function inTimeLine(page, time) {
  const box = await page.locator('#timeline').boundingBox();
  const [from, to, x0, x1] = await page.evaluate(() => [0, globalThis.carom.store.state.document.duration, 16, document.getElementById('timeline').clientWidth - 20]);
  return [box.x + x0 + ((time - from) / (to - from)) * (x1 - x0), box.y + 40];
}

test('a nail: its components are switched, its hoop and its diamond are dragged, its eye shuts, it is removed', { skip }, () => openFake(browser, {}, async (page, studio) => {
  await nailAt(page, 0.4);
  await page.click('#nails [title="hold y of the place"]');
  await until(page, '(s) => s.document.nails[0].constraint.position[1] === null');
  await page.click('#nails [title="hold turn"]');
  await until(page, '(s) => !s.document.nails[0].constraint.orientation');
  await page.keyboard.press('Escape');
  assert.equal(await state(page, '(s) => s.document.nails.length'), 1);

  const hoop = await place(page, 0.4);
  await page.mouse.click(500, 120);  // let go of the body: its handles lie over the hoop
  await until(page, '(s) => s.selected === -1');
  await drag(page, hoop, 30, -20);
  assert.equal(last(studio, 'grab_nail').nail, 0);

  const [x, y] = await inTimeLine(page, 0.4), [to] = await inTimeLine(page, 0.6);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(to, y, { steps: 3 });
  await page.mouse.up();
  await until(page, '(s) => s.document.nails[0].constraint.at !== 0.4');
  assert.ok(Math.abs((await state(page, '(s) => s.document.nails[0].constraint.at')) - 0.6) < 3e-3);

  await page.click('#nails [aria-label^="Switch off"]');
  await until(page, '(s) => !s.document.nails[0].on');
  await page.click('#nails [aria-label^="Switch on"]');
  await until(page, '(s) => s.document.nails[0].on');
  await page.focus('#overlay');
  assert.equal(await state(page, '(s) => s.selectedNail'), 0);
  await page.keyboard.press('Delete');
  await until(page, '(s) => s.document.nails.length === 0');
}));

test('a number: arrows step, its label scrubs, its switch takes the control away; space and Enter press what has the focus', { skip }, () => openFake(browser, {}, async (page, studio) => {
  const field = page.getByLabel("velocity.z of 'ball <b>'");
  await field.press('ArrowUp');
  await until(page, '(s) => s.document.numbers[2].now > 3');
  await field.press('Escape');
  const box = await page.locator('#numbers .component').first().boundingBox();
  await page.mouse.move(box.x + 3, box.y + 8);
  await page.mouse.down();
  await page.mouse.move(box.x + 23, box.y + 8, { steps: 2 });
  await page.mouse.up();
  await until(page, '(s) => s.document.numbers[0].now > 2');
  await page.getByLabel('velocity of ball <b> may change').focus();
  await page.keyboard.press('Space');
  await until(page, '(s) => s.document.controls.length === 0');
  assert.equal(await state(page, '(s) => s.playing'), false);
  await page.locator('summary').first().focus();
  await page.keyboard.press('Enter');
  assert.ok(await page.locator('details').first().evaluate((one) => !one.open));
}));

test('the time line: the wheel zooms about the pointer, Shift and drag makes the range that loops', { skip }, () => openFake(browser, {}, async (page) => {
  const [x, y] = await inTimeLine(page, 0.5), [to] = await inTimeLine(page, 0.8);
  await page.keyboard.down('Shift');
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(to, y, { steps: 3 });
  await page.mouse.up();
  await page.keyboard.up('Shift');
  const [from, end] = await state(page, '(s) => s.loopRange');
  assert.ok(await state(page, '(s) => s.loop') && Math.abs(from - 0.5) < 3e-3 && Math.abs(end - 0.8) < 3e-3, `${from} to ${end}`);
  await page.focus('#overlay');
  await page.keyboard.press('Space');
  await until(page, '(s) => s.playing && s.time > 0.6');
  await until(page, '(s) => s.time >= 0.5 && s.time < 0.6');
  await page.keyboard.press('Space');
  await page.mouse.move(x, y);
  await page.mouse.wheel(0, -300);
  await page.mouse.click(x, y);
  assert.ok(Math.abs((await state(page, '(s) => s.time')) - 0.5) < 3e-3, 'what is under the pointer stays there');
}));

test('keys like Maya; the panel folds', { skip }, () => openFake(browser, {}, async (page) => {
  await page.keyboard.press('?');
  await page.getByLabel('Maya-like').check();
  await page.keyboard.press('Escape');
  await page.mouse.click(...(await place(page, 0.4)));
  await page.keyboard.press('e');
  await until(page, '(s) => s.gesture.state === "dragging" && s.tool === "turn"');
  await page.keyboard.press('Escape');
  await idle(page);
  await page.keyboard.press('s');
  await until(page, '(s) => s.document.nails.length === 1');
  await page.keyboard.press('n');
  assert.ok(await page.isHidden('#numbers'));
}));

test('a file that changed on disk: every choice does what it says', { skip }, () => openFake(browser, { studio: { changedOnDisk: true } }, async (page, studio) => {
  const save = async () => {
    await nailAt(page, 0.4).catch(() => {});
    await page.keyboard.press('Control+s');
    await page.waitForSelector('dialog');
  };
  await save();
  assert.match(await page.textContent('dialog h2'), /has changed on disk/);
  await page.click('dialog >> text=Cancel');
  await page.waitForSelector('dialog', { state: 'detached' });
  await page.keyboard.press('Control+s');
  await page.click('dialog >> text=Save as');
  await page.getByLabel('Name of the file').last().fill('mine');
  await page.keyboard.press('Enter');
  await until(page, '(s) => s.notice?.message.startsWith("Saved")');
  assert.equal(last(studio, 'save').path, 'mine.json');
  await page.keyboard.press('Control+s');
  await page.click('dialog >> text=Replace the file');
  await page.waitForSelector('dialog', { state: 'detached' });
  assert.equal(last(studio, 'save').replace, true);
  await page.keyboard.press('Control+s');
  await page.click('dialog >> text=Open the file as it is');
  await page.waitForSelector('dialog', { state: 'detached' });
  assert.deepEqual([last(studio, 'open').path, last(studio, 'open').replace], ['throw.json', true]);
}));

test('after a release the motion glides to where it is, unless a person wants no movement', { skip }, async () => {
  for (const reducedMotion of ['no-preference', 'reduce']) {
    await openFake(browser, { reducedMotion }, async (page) => {
      await page.click('#nail-on-release');
      await page.keyboard.press('Escape');
      const glided = await page.evaluate(() => new Promise((done) => {
        const { store, gliding } = globalThis.carom, { motion } = store.state;
        const arcs = motion.tracks[1].arcs.map((value, i) => (i === 4 ? value + 0.5 : value));
        store.set({ motion: { ...motion, tracks: motion.tracks.map((track) => (track.body === 1 ? { ...track, arcs } : track)) } });
        let seen = 0;
        const next = () => {
          if (gliding()) ++seen;
          else if (seen || performance.now() - began > 300) return done(seen);
          requestAnimationFrame(next);
        };
        const began = performance.now();
        requestAnimationFrame(next);
      }));
      assert.equal(glided > 0, reducedMotion === 'no-preference');
    });
  }
});

test('colours that the system forces; a browser without WebGL says what to switch on', { skip }, async () => {
  await openFake(browser, { forcedColors: 'active' }, async (page) => {
    const outline = await page.locator('#tool-move').evaluate((one) => getComputedStyle(one).outlineStyle);
    assert.equal(outline, 'solid', 'what is pressed is told by more than its colour');
  });
  await closing(async (keep) => {
    const studio = keep(new FakeStudio()), page = keep(await openPage(browser, await studio.listen(), { before: () => (HTMLCanvasElement.prototype.getContext = () => null) }));
    await page.waitForSelector('#blocked');
    assert.match(await page.textContent('#blocked'), /WebGL/);
    assert.ok(await page.isHidden('#loading'), 'one sentence');
  });
});
