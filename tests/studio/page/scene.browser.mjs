// SPDX-License-Identifier: MIT
// What belongs to the whole scene, targets on the grid, and mesh files, with the real mouse, server and solver.
import assert from 'node:assert/strict';
import { copyFileSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { closing, frame, openPage, until } from './browser.mjs';
import { answered, browser, letGo, picture, place, pull, screenOf, skip, state, undo, withStudio } from './hand.mjs';
import { RealStudio } from './real_studio.mjs';

const settled = '(s) => s.gesture.state === "idle" && s.motion.rev === s.document.rev';
/** Types into a field, and waits for the step. */
async function type(page, label, text) {
  const rev = await state(page, '(s) => s.document.rev');
  await page.fill(`input[aria-label="${label}"]`, text);
  await page.keyboard.press('Enter');
  await until(page, `(s) => s.document.rev > ${rev} && s.motion.rev === s.document.rev`);
}

test('duration, gravity and materials of a scene are typed, and a body gets another material', { skip }, () => withStudio('hat-on-coatrack.json', async (page) => {
  await page.click('#scene-section summary');
  await type(page, 'duration', '0.5');
  assert.equal(await state(page, '(s) => s.motion.end'), 0.5);
  assert.equal(await state(page, '(s) => s.document.undo'), 'duration');
  await page.uncheck('#scene label:has-text("gravity") input');
  await until(page, '(s) => s.motion.gravity.every((g) => g === 0)');
  assert.deepEqual(await state(page, '(s) => [...s.motion.tracks[2].arcs].slice(7, 10)'), [0, 0, 0], 'it flies straight on');
  await page.check('#scene label:has-text("gravity") input');
  await until(page, '(s) => s.motion.gravity[2] === -9.81');
  await type(page, 'gravity, x', '1');
  assert.deepEqual(await state(page, '(s) => s.motion.gravity'), [1, 0, -9.81]);
  await page.click('#scene button:has-text("Add a material")');
  await until(page, '(s) => s.document.materials.some((one) => one.name === "material")');
  await type(page, 'elasticity of material', '0.9');
  await page.click('#bodies li:nth-child(3) .name');
  await page.selectOption('#body select[aria-label="Material"]', 'material');
  await until(page, '(s) => s.document.bodies[2].material === "material" && s.motion.rev === s.document.rev');
  assert.equal(await state(page, '(s) => s.document.undo'), "material of 'hat'");
  await page.evaluate(() => document.getElementById('scene').scrollIntoView({ block: 'end' }));
  await picture(page, 'scene-section');
  await page.fill('input[aria-label="duration"]', '-1');
  await page.keyboard.press('Enter');
  await until(page, '(s) => s.notice?.kind === "red"');
  assert.equal(await state(page, '(s) => s.document.duration'), 0.5, 'what cannot be is refused');
  for (let k = 0; k < 7; ++k) await undo(page);
  assert.deepEqual(await state(page, '(s) => [s.document.undo, s.document.saved]'), [null, true]);
}));

test('a scene without materials gets its first one', { skip }, () => withStudio('hat-on-coatrack.json', async (page) => {
  await page.click('#scene-section summary');
  await page.click('#scene button:has-text("Add a material")');
  await until(page, '(s) => s.document.materials.length === 1 && s.motion.rev === s.document.rev');
}, { change: ({ materials, ...document }) => ({ ...document, controls: document.controls.filter((one) => !one.material), bodies: document.bodies.map(({ material, ...body }) => body) }) }));

test('the impacts are kept where they are to be', { skip }, () => withStudio('book-on-shelf.json', async (page) => {
  await page.check('#keep-sequence input');
  await until(page, '(s) => s.document.keep_sequence === true');
  assert.equal(await state(page, '(s) => s.document.undo'), null, 'it is no step');
  const shown = () => state(page, '(s) => s.motion.impacts.filter((one) => one.t < 0.85).map((one) => one.pairs.join())'), before = await shown();
  const [x, y] = await place(page, 'book', 0.85);
  await pull(page, [x, y], [x + 5, y - 160]);
  await letGo(page);
  assert.deepEqual(await shown(), before);
  await page.uncheck('#keep-sequence input');
  await until(page, '(s) => s.document.keep_sequence === false');
}));

test('with Ctrl a target goes in steps of the grid, and a turn in steps of 15 degrees', { skip }, () => closing(async (keep) => {
  const studio = keep(await RealStudio.start(null)), page = keep(await openPage(browser(), studio.url, { width: 1440, height: 900 }));
  await page.click('#empty button:text-is("New scene")');
  await until(page, '(s) => s.document?.open && s.motion');
  await page.click('#add');
  await page.click('#add-menu >> text=Box');
  await page.keyboard.press('Enter');
  await until(page, '(s) => s.document.bodies.length === 2 && s.motion.tracks.length === 2 && s.scene.shapes.length === 2');
  await frame(page);
  const handle = (axis, far) => page.evaluate(([a, f]) => {
    const { store, screenOf: on, perPixel } = globalThis.carom, at = store.state.document.bodies[1].position, s = f * perPixel(at);
    return on(at.map((c, i) => c + s * a[i]));
  }, [axis, far]);
  const up = await handle([0, 0, 1], 50);
  await page.mouse.move(...up);
  await page.mouse.down();
  await page.mouse.move(up[0], up[1] - 30);
  await page.keyboard.down('Control');
  await page.mouse.move(up[0], up[1] - 75, { steps: 3 });
  await answered(page);
  assert.match(await page.textContent('#readout'), /steps of/);
  await picture(page, 'snapping');
  await letGo(page);
  await page.keyboard.up('Control');
  const lifted = await state(page, '(s) => s.document.bodies[1].position[2]');
  assert.ok(lifted > 0.15 && Math.abs(lifted * 10 - Math.round(lifted * 10)) < 1e-9, `lifted to ${lifted}`);
  await page.click('#tool-turn');
  await frame(page);
  const ring = await page.evaluate(() => {
    const { store, screenOf: on, perPixel } = globalThis.carom, [x, y, z] = store.state.document.bodies[1].position, s = 64 * perPixel([x, y, z]) * Math.SQRT1_2;
    return on([x, y - s, z + s]);
  });
  await page.mouse.move(...ring);
  await page.mouse.down();
  await page.keyboard.down('Control');
  await page.mouse.move(ring[0], ring[1] + 40, { steps: 4 });
  await answered(page);
  await letGo(page);
  await page.keyboard.up('Control');
  const [w] = await state(page, '(s) => s.document.bodies[1].orientation'), degrees = (2 * Math.acos(Math.min(1, Math.abs(w))) * 180) / Math.PI;
  assert.ok(degrees > 10 && Math.abs(degrees / 15 - Math.round(degrees / 15)) < 1e-4, `turned by ${degrees} degrees`);
  assert.deepEqual(page.complaints.filter((text) => !/ReadPixels/.test(text)), []);
}));

test('a mesh file of the folder stands where it is put, and is simulated', { skip }, () => withStudio('hat-on-coatrack.json', async (page, studio) => {
  const scenes = join(studio.folder, 'scenes'), names = '(s) => s.document.bodies.map((body) => body.name)';
  mkdirSync(join(scenes, 'parts'));
  copyFileSync(join(studio.folder, 'assets', 'mug.obj'), join(scenes, 'parts', 'mug.obj'));
  writeFileSync(join(scenes, 'parts', 'wrong.obj'), 'v 0 0\n');
  const choose = async (file) => {
    await page.click('#add');
    await page.click('#add-menu >> text=Mesh file…');
    await page.click('dialog .files >> text=parts');
    await picture(page, 'mesh-dialog');
    await page.click(`dialog .files >> text=${file}`);
    await until(page, `(s) => s.adding >= 0 && s.mesh === "parts/${file}"`);
    const [x, y] = await screenOf(page, [0.6, 0.4, 0]);
    await page.mouse.click(x, y);
  };
  await choose('wrong.obj');
  await until(page, '(s) => s.notice?.kind === "red"');
  assert.match(await page.textContent('#notice'), /wrong\.obj/);
  await choose('mug.obj');
  await until(page, `(s) => s.document.bodies.length === 4 && s.scene.shapes.length === 4 && s.motion.rev === s.document.rev`);
  assert.deepEqual(await state(page, names), ['floor', 'coatrack', 'hat', 'mug']);
  await page.keyboard.press('f');
  await frame(page);
  await picture(page, 'mesh-added');
  await page.keyboard.press('Control+s');
  await until(page, '(s) => s.document.saved');
  const saved = JSON.parse(studio.bytes()).bodies[3];
  assert.equal(saved.shape.mesh.file, 'parts/mug.obj');
  assert.equal(studio.simulated(0.1).status, 'complete');
  await undo(page);
  assert.equal(await state(page, '(s) => s.document.bodies.length'), 3);
}));
