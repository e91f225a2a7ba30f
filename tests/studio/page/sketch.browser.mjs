// SPDX-License-Identifier: MIT
// A path is drawn with the pen: the motion goes along it, one step; what cannot be met is shown; Escape drops it, drawn or looked for.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { frame, place, until } from './browser.mjs';
import { picture, screenOf, skip, state, undo, withStudio } from './hand.mjs';

/** Draws from a body's path at a time along places of the screen; the button stays down. */
async function draw(page, name, time, places) {
  await page.mouse.move(...(await place(page, name, time)));
  await page.mouse.down();
  for (const [x, y] of places) await page.mouse.move(x, y, { steps: 4 });
}
const done = '(s) => !s.sketch && s.notice?.key === "sketched" && s.motion.rev === s.document.rev && s.document.nails.some((nail) => nail.constraint.soft)';
const drawn = (page) => state(page, '(s) => s.document.nails.filter((nail) => nail.constraint.soft).map(({ error, constraint, time }) => ({ error, time, notes: constraint.notes }))');

/** The path at these times, moved by so much on the screen at its end. */
async function bent(page, name, from, to, [dx, dy]) {
  const places = [];
  for (let k = 1; k <= 12; ++k) {
    const [x, y] = await place(page, name, from + ((to - from) * k) / 12);
    places.push([x + (dx * k) / 12, y + (dy * k) / 12]);
  }
  return places;
}

test('a hat goes along a curve that is drawn from its path; undo, redo, removal', { skip }, () => withStudio('hat-on-coatrack.json', async (page) => {
  await page.click('#tool-pen');
  assert.match(await page.textContent('#notice'), /draw where it is to go/);
  await draw(page, 'hat', 0.1, await bent(page, 'hat', 0.1, 0.5, [-30, -25]));
  await frame(page);
  await picture(page, 'sketch-drawing');
  assert.ok(await state(page, '(s) => s.sketch.places.length > 10 && !s.sketch.searching'));
  await page.mouse.up();
  await until(page, done);
  const nails = await drawn(page), most = Math.max(...nails.map(({ error }) => error));
  assert.ok(nails.length === 10 && most < 0.04, `within ${most} m of the curve`);
  assert.ok(nails.every(({ time }, i) => time !== null && (i === 0 || time > nails[i - 1].time)), 'in order');
  await frame(page);
  await picture(page, 'sketch-done');
  assert.match(await page.textContent('#notice'), /'hat' goes along the curve, at most/);
  assert.equal(await state(page, '(s) => s.document.undo'), "sketch of 'hat'");
  await undo(page);
  assert.deepEqual([await drawn(page), await state(page, '(s) => s.document.undo')], [[], null]);
  await page.click('#redo');
  await until(page, '(s) => s.document.redo === null && s.document.nails.length > 10 && s.motion.rev === s.document.rev');
  assert.deepEqual(await drawn(page), nails);
  await page.click('#nails button[aria-label^="Remove hat, sketch 1"]');
  await until(page, '(s) => !s.document.nails.some((nail) => nail.constraint.soft)');
  assert.equal(await state(page, '(s) => s.document.undo'), "removal of 'sketch 1'");
}, { width: 1440, height: 900 }));

test('no hat flies straight: how far it is from the curve is shown, and a drag goes on', { skip }, () => withStudio('hat-on-coatrack.json', async (page) => {
  await page.keyboard.press('p');
  const from = await place(page, 'hat', 0.1), [x, y] = await place(page, 'hat', 0.55);
  await draw(page, 'hat', 0.1, [[(from[0] + x) / 2, (from[1] + y) / 2 + 60], [x, y]]);
  await page.mouse.up();
  await until(page, done);
  await frame(page);
  await picture(page, 'sketch-off');
  assert.ok(Math.max(...(await drawn(page)).map(({ error }) => error)) > 0.02);
  assert.match(await page.textContent('#nails'), /hat, sketch 1.*at most .* off/s);
}));

test('Escape drops a curve while it is drawn, and while a path is looked for', { skip }, () => withStudio('mug.json', async (page) => {
  const rev = await state(page, '(s) => s.document.rev'), [x, y] = await place(page, 'mug', 0.05);
  await page.click('#tool-pen');
  await draw(page, 'mug', 0.05, [[x + 20, y - 10], [x + 60, y + 10]]);
  await page.keyboard.press('Escape');
  await page.mouse.up();
  assert.deepEqual(await state(page, '(s) => [s.sketch, s.document.rev]'), [null, rev]);
  const before = await place(page, 'mug', 0.3);
  await draw(page, 'mug', 0.05, await bent(page, 'mug', 0.05, 0.25, [40, -20]));
  await page.mouse.up();
  await until(page, '(s) => s.sketch?.searching && s.motion.more');  // the first answer
  await picture(page, 'sketch-first');
  await page.keyboard.press('Escape');
  await until(page, '(s) => !s.sketch && !s.motion.more');
  assert.equal(await state(page, '(s) => s.document.rev'), rev);
  assert.deepEqual(await place(page, 'mug', 0.3), before, 'the motion is as it was');
  assert.equal(await state(page, '(s) => s.document.nails.some((nail) => nail.constraint.soft)'), false);
  assert.ok(await screenOf(page, [0, 0, 0]));
}));
