// SPDX-License-Identifier: MIT
// Files of other programs, from the folder and chosen by the browser: a glTF file opens as a scene, its warnings are listed; an OBJ file is put
// down; what is refused is said by name, and what is open stays as it is.
import assert from 'node:assert/strict';
import { cpSync, existsSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { frame, until } from './browser.mjs';
import { picture, screenOf, skip, state, withStudio } from './hand.mjs';

const corpus = fileURLToPath(new URL('../../../fuzz/corpus/gltf/', import.meta.url)), assets = fileURLToPath(new URL('../../../examples/assets/', import.meta.url));

async function dialog(page) {
  await page.click('#file');
  await page.click('#menu >> text=Import…');
  await page.waitForSelector('dialog[open] input[type=file]');
}
const what = (page) => state(page, '(s) => [s.document.rev, s.document.path, s.document.undo, s.document.bodies.map((body) => body.name), s.document.saved]');

test('glTF of the folder, with its warnings; unsaved steps are asked for', { skip }, () => withStudio('hat-on-coatrack.json', async (page, studio) => {
  cpSync(join(corpus, 'bodies.gltf'), join(studio.folder, 'scenes', 'course.gltf'));
  await page.click('#bodies button:has-text("hat")');
  await page.fill('#body input[aria-label="Name"]', 'my hat');
  await page.keyboard.press('Enter');
  await until(page, '(s) => s.document.bodies[2].name === "my hat"');
  const before = await what(page);
  await dialog(page);
  await picture(page, 'import-dialog');
  await page.click('dialog button:has-text("course.gltf")');
  await page.waitForSelector('dialog[open] button:has-text("lose the steps")');
  await page.click('dialog button:text-is("Cancel")');
  assert.deepEqual(await what(page), before);
  await dialog(page);
  await page.click('dialog button:has-text("course.gltf")');
  await page.click('dialog button:text-is("Import, and lose the steps")');
  await page.waitForSelector('dialog[open] .warnings li');
  await picture(page, 'import-warnings');
  assert.match(await page.textContent('dialog .warnings'), /'rock'.*has no mass/);
  await page.click('dialog button:text-is("Close")');
  await until(page, '(s) => s.document?.path === "course.json" && s.motion?.tracks.length === s.document.bodies.length');
  assert.ok(existsSync(join(studio.folder, 'scenes', 'course.json')));
  assert.equal(await page.textContent('#notice span'), 'Imported as course.json.');
}));

test('files that the browser chooses: what is refused is said by name and nothing is lost; a mesh is put down', { skip }, () => withStudio('hat-on-coatrack.json', async (page, studio) => {
  await page.click('#bodies button:has-text("hat")');
  await page.fill('#body input[aria-label="Name"]', 'my hat');
  await page.keyboard.press('Enter');
  await until(page, '(s) => s.document.bodies[2].name === "my hat" && s.document.rev === s.motion.rev');
  await page.keyboard.press('Control+s');
  await until(page, '(s) => s.document.saved');
  const before = await what(page);
  for (const name of ['short.glb', 'no-accessor.gltf', 'strip.gltf']) {
    await dialog(page);
    await page.setInputFiles('dialog input[type=file]', join(corpus, name));
    await until(page, `(s) => s.notice?.kind === 'red' && s.notice.message.includes(${JSON.stringify(name)}) && !s.progress`);
    assert.deepEqual(await what(page), before);
  }
  await frame(page);
  await picture(page, 'import-refused');
  assert.match(await page.textContent('#notice'), /taken as hulls/);
  await page.click('#notice button:text-is("Import another way")');
  await page.waitForSelector('dialog[open] select');
  assert.equal(await page.inputValue('dialog select'), 'every mesh as its convex hull');
  await page.keyboard.press('Escape');
  await dialog(page);
  await page.setInputFiles('dialog input[type=file]', join(assets, 'mug.obj'));
  await until(page, '(s) => s.adding >= 0');
  assert.match(await page.textContent('#notice'), /Press where the mug is to stand/);
  assert.ok(existsSync(join(studio.folder, 'scenes', 'mug.obj')));
  await page.mouse.click(...(await screenOf(page, [-0.8, -0.4, 0])));
  await frame(page);
  await picture(page, 'import-mesh');
  await until(page, '(s) => s.document.bodies.length === 4 && s.motion.tracks.length === 4 && s.motion.rev === s.document.rev');
  assert.match(await state(page, '(s) => s.document.bodies[3].name'), /^mug/);
}));
