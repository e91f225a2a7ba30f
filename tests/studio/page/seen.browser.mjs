// SPDX-License-Identifier: MIT
// What is drawn can be seen and told apart: paths on every ground of the examples, bodies that look alike, marks behind walls, and
// the tools at every size of a window.
import assert from 'node:assert/strict';
import { readdirSync } from 'node:fs';
import { dirname } from 'node:path';
import { test } from 'node:test';
import { inkOf } from '../../../studio/page/colours.js';
import { centreAt } from '../../../studio/page/motion.js';
import { frame, until } from './browser.mjs';
import { picture, screenOf, skip, state, withStudio } from './hand.mjs';
import { decodePng } from './png.mjs';

/** Relative luminance of a colour, contrast of two (WCAG 2). */
const luminance = (c) => c.map((b) => (b <= 10 ? b / 255 / 12.92 : ((b / 255 + 0.055) / 1.055) ** 2.4)).reduce((sum, s, i) => sum + s * [0.2126, 0.7152, 0.0722][i], 0);
const contrast = (a, b) => (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
const bytesOf = (hex) => [1, 3, 5].map((i) => Number.parseInt(hex.slice(i, i + 2), 16));

/** The contrast of a line there to the pixels about it; null where no pixel has its ink. */
function contrastAt(shot, x, y, ink) {
  const around = [];
  for (let v = Math.round(y) - 4; v <= Math.round(y) + 4; ++v) {
    for (let u = Math.round(x) - 4; u <= Math.round(x) + 4; ++u) {
      if (u < 0 || v < 0 || u >= shot.width || v >= shot.height) continue;
      const c = shot.at(u, v);
      around.push({ far: Math.hypot(u - x, v - y), off: Math.max(...c.map((b, i) => Math.abs(b - ink[i]))), light: luminance(c) });
    }
  }
  const line = around.filter(({ far }) => far <= 2).sort((a, b) => a.off - b.off)[0];
  if (!line || line.off > 60) return null;
  return Math.max(...around.map(({ light }) => contrast(light, line.light)));
}

test('every path is seen on every ground of the examples: a contrast of 3 at least', { skip }, () =>
  withStudio('hat-on-coatrack.json', async (page, studio) => {
    const scenes = readdirSync(dirname(studio.path)).filter((name) => name.endsWith('.json') && !name.startsWith('.')), least = [], low = [];
    assert.ok(scenes.length >= 25);
    await page.evaluate(() => (document.getElementById('overlay').style.opacity = '0'));
    for (const name of scenes) {
      await page.evaluate((path) => globalThis.carom.connection.request('open', { path, replace: true }), name);
      await until(page, `(s) => s.document?.path === ${JSON.stringify(name)} && s.motion && !s.progress && s.motion.tracks.length === s.document.bodies.length`);
      await frame(page);
      await frame(page);
      await page.evaluate(() => document.getElementById('view').querySelectorAll(':scope > :not(canvas)').forEach((one) => (one.style.opacity = '0')));
      const shot = decodePng(await page.screenshot());
      const { tracks, end, inks, radii, shown } = await state(page, `(s) => ({ end: s.motion.end, shown: globalThis.carom.shownBodies(), inks: s.scene.shapes.map((one) => one.colour), radii: s.scene.shapes.map((one) => one.radius),
        tracks: s.motion.tracks.map(({ arcs, stride, center }) => ({ arcs: [...arcs], stride, center })) })`);
      const samples = shown.flatMap((body) => [...Array(23)].map((_, k) => ({ body, point: centreAt(tracks[body], (end * (k + 1)) / 24) })));
      const places = await page.evaluate(([points, centres]) => points.map((point) => {
        const at = globalThis.carom.screenOf(point);
        const covered = globalThis.carom.hidden(point) || centres.some(([c, r]) => {
          const b = globalThis.carom.screenOf(c);
          return Math.hypot(at[0] - b[0], at[1] - b[1]) < 3 + r / globalThis.carom.perPixel(c);
        });
        return covered ? null : at;
      }), [samples.map(({ point }) => point), shown.map((body) => [centreAt(tracks[body], 0), radii[body]])]);
      let seen = 0, worst = Infinity;
      samples.forEach(({ body }, i) => {
        const [x, y] = places[i] ?? [0, 0];
        if (x < 5 || y < 45 || x > 770 || y > 555) return;
        const found = contrastAt(shot, x, y, bytesOf(inkOf(inks[body])));
        if (found === null) return;
        [seen, worst] = [seen + 1, Math.min(worst, found)];
        if (found < 3) low.push(`${name}: body ${body}, ${inkOf(inks[body])}, at ${x}, ${y}: ${found}`);
      });
      least.push(`${name} ${seen} ${worst.toFixed(1)}`);
    }
    if (process.env.CAROM_STUDIO_PICTURES) console.log(least.join('\n'));
    assert.deepEqual(low, []);
  }));

test('bodies that look alike are named at their paths; eight that do not are not', { skip }, () =>
  withStudio('rack-of-fifteen.json', async (page) => {
    const alike = await state(page, `(s) => {
      const shown = globalThis.carom.shownBodies(), colours = shown.map((body) => s.scene.shapes[body].colour);
      return shown.filter((_, i) => colours.filter((one) => one === colours[i]).length > 1).map((body) => s.document.bodies[body].name);
    }`);
    assert.ok(alike.length >= 12, 'there are more bodies than colours');
    const written = async () => page.evaluate(async () => {
      const pen = document.getElementById('overlay').getContext('2d'), draw = pen.fillText, words = new Set();
      pen.fillText = function (text, ...more) {
        words.add(text);
        draw.call(this, text, ...more);
      };
      globalThis.carom.invalidate();
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      pen.fillText = draw;
      return [...words];
    });
    const words = await written();
    await picture(page, 'alike');
    assert.ok(alike.filter((name) => words.includes(name)).length >= alike.length / 2, `${words} of ${alike}`);
    await page.evaluate((path) => globalThis.carom.connection.request('open', { path, replace: true }), 'two-balls.json');
    await until(page, '(s) => s.document?.path === "two-balls.json" && s.motion?.tracks.length === 2');
    assert.deepEqual(await written(), []);
  }));

/** The brightest red within so many px of a place. */
const brightest = (shot, [x, y], within) => {
  let most = 0;
  for (let v = -within; v <= within; ++v) for (let u = -within; u <= within; ++u) most = Math.max(most, shot.at(Math.round(x) + u, Math.round(y) + v)[0]);
  return most;
};

test('marks behind a wall are fainter, and those before it are not', { skip }, () =>
  withStudio('dice.json', async (page) => {
    await page.mouse.move(5, 400);
    await page.evaluate(() => (document.querySelector('#view > canvas').style.opacity = '0'));
    await frame(page);
    const shot = decodePng(await page.screenshot()), points = await state(page, '(s) => s.motion.impacts.filter((i) => i.mode === "stick").map((i) => i.point)');
    const marks = [];
    for (const point of points) marks.push({ at: await screenOf(page, point), hidden: await page.evaluate((p) => globalThis.carom.hidden(p), point) });
    const alone = marks.filter(({ at }) => marks.every(({ at: other }) => other === at || Math.hypot(at[0] - other[0], at[1] - other[1]) > 20));
    const behind = alone.filter(({ hidden }) => hidden), before = alone.filter(({ hidden }) => !hidden);
    assert.ok(behind.length >= 1 && before.length >= 3, `${behind.length} behind the wall of the tray, ${before.length} before it`);
    for (const { at } of behind) assert.ok(brightest(shot, at, 8) < 160, `${brightest(shot, at, 8)} at ${at}`);
    for (const { at } of before) assert.ok(brightest(shot, at, 8) > 220, `${brightest(shot, at, 8)} at ${at}`);
  }, { width: 1440, height: 900 }));

test('the tools grow with the window, are whole, and lie over nothing that is pressed', { skip }, async () => {
  const sizes = [];
  for (const [width, height] of [[1024, 640], [1440, 900], [2560, 1440]]) {
    await withStudio('dice.json', async (page) => {
      const boxes = await page.evaluate(() => [...document.querySelectorAll('#tools button, .player button, .player select, header button')].filter((one) => one.checkVisibility()).map((one) => {
        const { left, top, right, bottom } = one.getBoundingClientRect(), hit = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
        return { id: one.id, left, top, right, bottom, covered: !(hit && (hit === one || one.contains(hit))) };
      }));
      assert.ok(boxes.length >= 12);
      for (const box of boxes) {
        assert.ok(!box.covered, `${box.id} is covered at ${width} x ${height}`);
        assert.ok(box.left >= 0 && box.top >= 0 && box.right <= width && box.bottom <= height, `${box.id} is cut at ${width} x ${height}`);
        for (const other of boxes) assert.ok(other === box || box.right <= other.left || other.right <= box.left || box.bottom <= other.top || other.bottom <= box.top, `${box.id} and ${other.id}`);
      }
      sizes.push(boxes.find(({ id }) => id === 'tool-move'));
      await picture(page, `tools-${width}`);
    }, { width, height });
  }
  const wide = sizes.map(({ left, right }) => right - left);
  assert.ok(wide[0] >= 28 && wide[2] >= 36 && wide[0] <= wide[1] && wide[1] <= wide[2], `${wide}`);
});
