// SPDX-License-Identifier: MIT
// What `carom export -o motion.html` writes: a page in one file, opened from the disk with the network off. It has the
// positions that `carom simulate` says, draws what the studio draws, and asks for nothing.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { decodeFrame, motionOf } from '../../../studio/page/frames.js';
import { centreAt, rotate } from '../../../studio/page/motion.js';
import { axeSource, closing, frame, until } from './browser.mjs';
import { exported, openExported, ownFolder, scenes } from './exported_page.mjs';
import { browser, letGo, picture, place, pull, skip, withStudio } from './hand.mjs';
import { command, hasCommand } from './real_studio.mjs';

const farthestOff = 1e-9;  // m
const mostBytes = 1e6;

/** States as `carom simulate` says, at times of [0, end]. */
function simulated(scene, shares) {
  const { end } = JSON.parse(execFileSync(command, ['simulate', scene, '--json'], { encoding: 'utf8', maxBuffer: 1 << 28 }));
  const times = shares.map((share) => share * end), answer = execFileSync(command, ['simulate', scene, '--json', ...times.flatMap((t) => ['--at', String(t)])], { encoding: 'utf8', maxBuffer: 1 << 28 });
  return { end, states: JSON.parse(answer).states };
}

test('every example plays at the positions that carom simulate says', { skip: hasCommand() ? false : 'CAROM_COMMAND names no carom' }, () => closing(async (keep) => {
  const names = readdirSync(scenes).filter((name) => name.endsWith('.json'));
  assert.ok(names.length >= 25);
  for (const name of names) {
    const file = exported(keep, join(scenes, name)), bytes = file.packed('motion'), state = JSON.parse(file.packed('state'));
    const motion = motionOf(decodeFrame(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)), null);
    const { end, states } = simulated(join(scenes, name), [0, 0.123, 0.31, 0.5, 0.77, 0.95, 1]);
    assert.equal(motion.end, end);
    const own = ['scene', 'motion', 'state'].reduce((sum, part) => sum + file.base64(part).length, 0);
    assert.ok(file.text.length - own < mostBytes, `${name}: ${file.text.length} bytes, ${own} of them its own`);
    if (state.bodies.length <= 20) assert.ok(file.text.length < mostBytes, `${name}: ${file.text.length} bytes`);
    for (const { time, bodies } of states) {
      assert.deepEqual(Object.keys(bodies), state.bodies.map((body) => body.name));
      for (const [i, { position, orientation }] of Object.values(bodies).entries()) {
        const { center } = motion.tracks[i], centre = rotate(orientation, center).map((c, k) => c + position[k]);
        const error = Math.hypot(...centreAt(motion.tracks[i], time).map((c, k) => c - centre[k]));
        assert.ok(error <= farthestOff, `${name}, ${Object.keys(bodies)[i]} at ${time} s: off by ${error} m`);
      }
    }
  }
}));

const fine = (page) => assert.deepEqual(page.complaints.filter((text) => !/ReadPixels/.test(text)), []);

/** What the two layers of the view show. */
const drawn = (page) => page.evaluate(() => {
  globalThis.carom.view?.draw();
  globalThis.carom.redraw?.();  // in the studio
  return [...document.querySelectorAll('#view > canvas')].map((layer) => layer.toDataURL());
});

for (const [name, body, time] of [['hat-on-coatrack', 'hat', 0.4], ['mug-on-mark', 'mug', 0.3], ['rack-of-ten', 'ball 3', 0.5]]) {
  test(`${name} from the disk looks as in the studio, to the bit`, { skip }, () => closing(async (keep) => {
    const page = await openExported(keep, browser(), exported(keep, join(scenes, `${name}.json`)).path);
    const show = (at) => at.evaluate(([wanted, t]) => {
      const { store } = globalThis.carom, selected = store.state.document.bodies.findIndex((one) => one.name === wanted);
      // in the studio constraints that are not met are switched off when they are opened
      const nails = store.state.document.nails.map((nail) => ({ ...nail, on: true }));
      store.set({ selected, time: t, hover: null, looking: true, document: { ...store.state.document, nails }, motion: { ...store.state.motion } });
    }, [body, time]);
    await show(page);
    await frame(page);
    const here = await drawn(page);
    await picture(page, `exported-${name}`);
    fine(page);
    await withStudio(`${name}.json`, async (studio_page) => {
      await studio_page.mouse.move(5, 620);
      await show(studio_page);
      await frame(studio_page);
      const there = await drawn(studio_page);
      assert.equal(here.length, 2);
      assert.ok(here[0] === there[0], 'the scene');
      assert.ok(here[1] === there[1], 'the marks');
    });
  }));
}

test('a motion with one before: numbers, paths, playing, keys and the mouse; it keeps nobody out', { skip }, () => closing(async (keep) => {
  const old = join(scenes, 'hat-on-coatrack.json'), document = JSON.parse(readFileSync(old, 'utf8'));
  const hat = document.bodies.find((one) => one.name === 'hat'), scene = join(ownFolder(keep), 'changed.json');
  document.name = 'A <b>hat</b> & </script>';
  hat.velocity = [hat.velocity[0] - 0.2, ...hat.velocity.slice(1)];
  writeFileSync(scene, JSON.stringify(document));
  const file = exported(keep, scene, '--before', old);
  assert.ok(file.text.length < mostBytes, `${file.text.length} bytes`);
  const page = await openExported(keep, browser(), file.path), state = (test_text) => page.evaluate(`(${test_text})(globalThis.carom.store.state)`);
  assert.deepEqual([await page.textContent('h1'), await page.title()], [document.name, document.name]);
  const changed = await page.locator('.value.changed').allTextContents();
  assert.deepEqual([changed.length, Number(changed[0].replace('−', '-'))], [1, Number(hat.velocity[0].toFixed(3))]);
  const image = await page.screenshot();
  await page.click('#before');
  assert.equal(await state('(s) => s.showBefore'), 'none');
  await frame(page);
  assert.ok(!image.equals(await page.screenshot()), 'the path before is dashed');
  await page.click('#before');
  await page.click('#overlay', { position: { x: 5, y: 5 } });
  await page.keyboard.press('Space');
  await until(page, '(s) => s.playing && s.time > 0.1');
  await page.keyboard.press('Space');
  await page.keyboard.press('Home');
  assert.equal(await state('(s) => s.time'), 0);
  await page.keyboard.press(']');
  assert.equal(await state('(s) => s.time'), await state('(s) => s.motion.impacts[0].t'));
  const [x, y] = await page.evaluate(() => {
    const { view, poseAt } = globalThis.carom, { left, top } = document.getElementById('overlay').getBoundingClientRect(), [px, py] = view.camera.project(poseAt(2, 0.3).place);
    return [left + px, top + py];
  });
  await page.mouse.move(x, y);
  await until(page, '(s) => s.hover?.body === 2');
  await page.mouse.down();
  await page.mouse.up();
  assert.equal(await state('(s) => s.document.bodies[s.selected].name'), 'hat');
  assert.ok(await page.isVisible('#readout'));
  const before_turn = await drawn(page);
  await page.mouse.move(300, 500);
  await page.mouse.down();
  await page.mouse.move(380, 480, { steps: 4 });
  await page.mouse.up();
  assert.notEqual((await drawn(page))[0], before_turn[0], 'the view turns');
  await picture(page, 'exported-before');
  const axe = readFileSync(axeSource(), 'utf8');
  for (const open of [() => {}, () => page.click('#help'), () => page.keyboard.press('Escape').then(() => page.click('#table'))]) {
    await open();
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ['violations'] }));
    assert.deepEqual(violations.filter(({ impact }) => ['serious', 'critical'].includes(impact)).map(({ id, nodes }) => `${id}: ${nodes.map((n) => n.html).join(' ')}`), []);
  }
  fine(page);
}));

test('a motion before with other bodies is refused; what the format lacks is, too', { skip: hasCommand() ? false : 'CAROM_COMMAND names no carom' }, () => closing(async (keep) => {
  const out = join(ownFolder(keep), 'motion.html');
  const refused = (...options) => {
    try {
      execFileSync(command, ['export', join(scenes, 'coin.json'), '-o', out, ...options], { stdio: 'pipe' });
    } catch ({ stderr }) {
      return String(stderr);
    }
    return '';
  };
  assert.match(refused('--before', join(scenes, 'dice.json')), /found other bodies in the motion before/);
  assert.match(refused('--fps', '30'), /--fps is only for/);
  assert.match(refused('--camera'), /--camera is only for/);
}));
test('from the File menu the motion goes to files of other programs, beside the motion as it was opened', { skip }, () =>
  withStudio('hat-on-coatrack.json', async (page, studio, keep) => {
    const [x, y] = await place(page, 'hat', 0.4);
    await pull(page, [x, y], [x + 15, y - 10]);
    await letGo(page);
    const centre = await page.evaluate(() => [...globalThis.carom.store.state.motion.tracks[2].arcs]);
    const saved = async (words) => {
      await page.click('#file');
      await page.click('#menu >> text=Export…');
      const [download] = await Promise.all([page.waitForEvent('download'), page.click(`dialog button:has-text("${words}")`)]);
      const path = join(ownFolder(keep), download.suggestedFilename());
      await download.saveAs(path);
      return path;
    };
    const files = {};
    for (const words of ['.html', '.svg', '.glb', '.py', '.csv', '.png']) {
      const path = await saved(words);
      assert.ok(path.endsWith(`hat-on-coatrack${words}`), path);
      files[words] = readFileSync(path);
    }
    assert.equal(files['.glb'].subarray(0, 4).toString(), 'glTF');
    assert.equal(files['.png'].subarray(1, 4).toString(), 'PNG');
    assert.match(files['.svg'].toString(), /^<svg|<\?xml/);
    assert.match(files['.py'].toString(), /import bpy/);
    assert.match(files['.csv'].toString().split('\n')[0], /time/);
    const path = join(ownFolder(keep), 'motion.html');
    writeFileSync(path, files['.html']);
    const shown = await openExported(keep, browser(), path);
    assert.deepEqual(await shown.evaluate(() => [...globalThis.carom.store.state.motion.tracks[2].arcs]), centre, 'the motion that is shown, to the bit');
    assert.equal(await shown.evaluate(() => globalThis.carom.store.state.showBefore), 'opened');
    fine(shown);
  }));
