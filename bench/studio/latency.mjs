// SPDX-License-Identifier: MIT
// How quick the studio is under the hand: the real command and chromium with the real mouse.
//   node bench/studio/latency.mjs CAROM [CSV]     CAROM: the built command; CSV: docs/charts/studio.csv unless named
// Needs what scripts/setup studio-tests installs. Run it on a machine that does nothing else: times are of the clock.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { cpus, loadavg } from 'node:os';
import { performance } from 'node:perf_hooks';
import { resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { canRun, closing, countMessages, executable, launch, leftOut, openPage, place, state, until } from '../../tests/studio/page/browser.mjs';
import { chromiumProcesses, cpuOf } from './processes.mjs';

const [, , carom, csv = fileURLToPath(new URL('../../docs/charts/studio.csv', import.meta.url))] = process.argv;
if (!carom) throw new Error('usage: node bench/studio/latency.mjs CAROM [CSV]');
process.env.CAROM_COMMAND = resolve(carom);
const { RealStudio } = await import('../../tests/studio/page/real_studio.mjs');

const sizes = [[1024, 640], [1440, 900], [2560, 1440]], spacing = 16, patience = 120000;
const pause = (ms) => new Promise((done) => setTimeout(done, ms));
const now = (page) => page.evaluate(() => performance.now());
const sum = (values) => values.reduce((a, b) => a + b, 0);

/** The value that a share of all do not exceed. */
function quantile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted.length ? sorted[Math.min(sorted.length - 1, Math.ceil(share * sorted.length) - 1)] : NaN;
}

const rows = [];
function put(what, { scene, width = 1024, height = 640, quality = 'low', values, unit = 'ms', median_wanted = '', p95_wanted = '' }) {
  const [median, p95, most] = [0.5, 0.95, 1].map((share) => quantile(values, share));
  const row = [what, scene, `${width}x${height}`, quality, values.length, ...[median, p95, most].map((v) => Number(v.toPrecision(4))), unit, median_wanted, p95_wanted];
  rows.push(row);
  console.log(`${row.slice(0, 4).join(', ')}: ${values.length} values, median ${row[5]} p95 ${row[6]} most ${row[7]} ${unit}, load ${loadavg()[0].toFixed(1)}`);
}

const withStudio = (scene, options, act) => closing(async (keep) => {
  const studio = keep(await RealStudio.start(scene)), browser = keep(await launch());
  const page = await openPage(browser, studio.url, { width: 1024, height: 640, ...options });
  await until(page, '(s) => s.connected === "open" && s.motion');
  await act(page, studio);
});

/** The mouse goes round the place where it took hold, a move every `spacing` ms whether or not the last was heard. */
async function circle(page, [x, y], radius, seconds) {
  const began = performance.now(), heard = [];
  for (let k = 1; performance.now() - began < 1000 * seconds; ++k) {
    const angle = (k * 2 * Math.PI) / 120;
    heard.push(page.mouse.move(x + radius * Math.sin(angle), y - radius * (1 - Math.cos(angle))));
    await pause(Math.max(1, began + k * spacing - performance.now()));
  }
  await Promise.all(heard);
}

async function hold(page, name, time) {
  const at = await place(page, name, time);
  await page.mouse.move(...at);
  await page.mouse.down();
  await page.mouse.move(at[0] + 6, at[1]);
  await until(page, '(s) => s.gesture.state === "dragging" && s.gesture.seq > 0 && s.gesture.answered === s.gesture.seq');
  return at;
}

async function letGo(page) {
  await page.mouse.up();
  await until(page, '(s) => s.gesture.state === "idle"');
}

const still = (page) => page.evaluate(async () => {
  for (let last = -1; last !== globalThis.carom.frames();) {
    last = globalThis.carom.frames();
    await new Promise((next) => setTimeout(next, 250));
  }
});

async function mouse(scene, name, time, size) {
  await withStudio(scene, size, async (page, studio) => {
    const at = await hold(page, name, time);
    await circle(page, at, 25, 0.5);
    await page.evaluate(() => {
      globalThis.carom.latency.decoded.length = globalThis.carom.latency.drawn.length = globalThis.carom.log.frames.length = 0;
    });
    const { gpu, pages } = chromiumProcesses(), cpu = () => [cpuOf(gpu), sum(pages.map(cpuOf)), cpuOf(studio.process.pid)], began = cpu();
    await circle(page, at, 25, 8);
    const ended = cpu();
    const { decoded, drawn, frames } = await page.evaluate(() => ({ ...globalThis.carom.latency, frames: globalThis.carom.log.frames.length }));
    const about = { scene, ...size };
    put('mouse event to decoded motion', { ...about, values: decoded, median_wanted: 15 });
    put('mouse event to drawn frame', { ...about, values: drawn, median_wanted: 50, p95_wanted: 120 });
    const [of_gpu, of_page, of_server] = ended.map((ms, i) => (ms - began[i]) / frames);
    put('CPU of the GPU process a frame of a drag', { ...about, values: [of_gpu] });
    put('CPU of the page a frame of a drag', { ...about, values: [of_page] });
    put('CPU of the server a frame of a drag', { ...about, values: [of_server] });
    await letGo(page);
  });
}

/** Many frames in which nothing but the camera might have changed, by what they cost. */
async function redraws(scene, size) {
  await withStudio(scene, size, async (page) => {
    const { gpu, pages } = chromiumProcesses(), cpu = () => [cpuOf(gpu), sum(pages.map(cpuOf))];
    const draw = (count) => page.evaluate(async (frames) => {
      for (let i = 0; i < frames; ++i) {
        globalThis.carom.invalidate();
        await new Promise((drawn) => requestAnimationFrame(drawn));
      }
      globalThis.carom.redraw();
    }, count);
    await still(page);
    await draw(10);
    const gpus = [], own = [];
    for (let k = 0; k < 5; ++k) {
      const began = cpu();
      await draw(40);
      const ended = cpu();
      gpus.push((ended[0] - began[0]) / 41);
      own.push((ended[1] - began[1]) / 41);
    }
    const wanted = size.width === 1440 && size.quality === 'low' ? 30 : '';
    put('CPU of the GPU process a redraw', { scene, ...size, values: gpus, median_wanted: wanted });
    put('CPU of the page a redraw', { scene, ...size, values: own });
  });
}

async function rest(scene) {
  await withStudio(scene, {}, async (page, studio) => {
    const messages = countMessages(page);
    await page.reload();
    await until(page, '(s) => s.connected === "open" && s.motion');
    const heard = messages.count;
    if (!heard) throw new Error('no message was counted at all');
    await still(page);
    const { gpu } = chromiumProcesses(), at = messages.count, frames = await page.evaluate(() => globalThis.carom.frames());
    const began = [cpuOf(gpu), cpuOf(studio.process.pid)];
    await pause(2000);
    put('frames in 2 s at rest', { scene, values: [(await page.evaluate(() => globalThis.carom.frames())) - frames], unit: '', median_wanted: 0 });
    put('messages in 2 s at rest', { scene, values: [messages.count - at], unit: '', median_wanted: 0 });
    put('CPU of the GPU process in 2 s at rest', { scene, values: [cpuOf(gpu) - began[0]] });
    put('CPU of the server in 2 s at rest', { scene, values: [cpuOf(studio.process.pid) - began[1]] });
  });
}

/** A scene in which an update takes long: the page must go on drawing, and what was asked for last must come. `far` is what is
 * dragged out of reach, so that its release searches on. */
async function slow(scene, name, time, far) {
  await withStudio(scene, {}, async (page, studio) => {
    const simulations = [0, 1, 2].map(() => {
      const began = performance.now();
      studio.simulated(time);
      return performance.now() - began;
    });
    const about = { scene: `${scene} (${name})` };
    put('one simulation with the start of the command', { ...about, values: simulations });
    const at = await hold(page, name, time);
    await page.evaluate(() => (globalThis.carom.log.frames.length = globalThis.carom.log.motions.length = 0));
    await circle(page, at, 40, 10);
    const { frames, motions } = await page.evaluate(() => globalThis.carom.log);
    const steps = (times) => times.slice(1).map((t, i) => t - times[i]);
    const updates = motions.filter(({ seq }, i) => seq !== motions[i - 1]?.seq).map((one) => one.time);
    put('interval of updates of a drag', { ...about, values: steps(updates) });
    put('interval of frames in a drag', { ...about, values: steps(frames), p95_wanted: 100 });
    // those between which the server was at one update for 0.1 s and more
    const slow_ones = updates.slice(1).flatMap((to, i) => (to - updates[i] >= 100 ? [[updates[i], to]] : []));
    const meanwhile = steps(frames).filter((_, i) => slow_ones.some(([from, to]) => frames[i + 1] > from && frames[i] < to));
    put('interval of frames while an update takes 0.1 s and more', { ...about, values: meanwhile, p95_wanted: 100 });

    const arrivals = [];
    await page.keyboard.press('Escape');
    await until(page, '(s) => s.gesture.state === "idle" && s.document.held_by === null', patience);
    for (const [dx, dy] of [[20, -10], [-30, 15], [3, -2]]) {
      await hold(page, name, time);
      await page.mouse.move(at[0] + dx, at[1] + dy, { steps: 3 });
      const moved = await now(page);
      await until(page, '(s) => s.gesture.seq > 0 && s.gesture.answered === s.gesture.seq && (s.motion.reached || !s.motion.more)', patience);
      if (await state(page, '(s) => s.motion.reached')) arrivals.push((await now(page)) - moved);
      else console.log(`  rests: ${await state(page, '(s) => `${s.motion.distance} m, ${s.motion.obstacle?.sentence}`')}`);
      await page.keyboard.press('Escape');
      await until(page, '(s) => s.gesture.state === "idle" && s.document.held_by === null', patience);
      await page.mouse.up();
    }
    put('last move of the mouse to its target reached', { ...about, values: arrivals });

    const answers = [];
    for (const dx of [200, -150, 120]) {
      const [x, y] = await hold(page, far.name, far.time);
      await page.mouse.move(x + dx, y - 200, { steps: 3 });
      await page.mouse.up();
      await until(page, '(s) => s.gesture.state !== "dragging"');
      await pause(300);
      if ((await state(page, '(s) => s.gesture.state')) === 'settling') {
        const pressed = await now(page);
        await page.keyboard.press('Escape');
        await until(page, '(s) => s.gesture.state === "idle"');
        answers.push((await now(page)) - pressed);
      } else {
        console.log('  the release had ended before Escape');
      }
      await until(page, '(s) => s.document.held_by === null && s.document.undo !== null');
      await page.click('#undo');
      await until(page, '(s) => s.document.undo === null');
    }
    put('Escape in settling to its answer', { ...about, values: answers, median_wanted: Math.round(100 + quantile(simulations, 0.5)) });
  });
}

function heading(load) {
  const processor = /model name\s*: (.*)/.exec(readFileSync('/proc/cpuinfo', 'utf8'))?.[1] ?? 'unknown processor';
  const version = (command, ...options) => execFileSync(command, options, { encoding: 'utf8' }).trim().split('\n')[0];
  const chromium = /[\d.]+/.exec(version(executable, '--version'))[0];
  return [
    `# ${processor}; ${cpus().length} cores; ${version(process.env.CAROM_COMMAND, '--version')}; chromium ${chromium}, drawing in software; ${new Date().toISOString().slice(0, 10)}`,
    `# load of the machine: ${load.map((l) => l.toFixed(1)).join(' to ')}. Times are of the clock and grow with it; CPU is what /proc says of a process`,
    '# wanted: at most; empty: nothing is promised',
    'what,scene,size,quality,values,median,p95,most,unit,wanted_median,wanted_p95',
  ];
}

if (!canRun()) {
  console.log(leftOut);
  process.exit(1);
}
const only = process.env.CAROM_BENCH_ONLY, load = [loadavg()[0]];
const parts = {
  mouse: async () => {
    await mouse('hat-on-coatrack.json', 'hat', 0.62, { width: 1024, height: 640, quality: 'low' });
    await mouse('hat-on-coatrack.json', 'hat', 0.62, { width: 1440, height: 900, quality: 'low' });
  },
  redraws: async () => {
    for (const quality of ['low', 'high']) for (const [width, height] of sizes) await redraws('hat-on-coatrack.json', { width, height, quality });
  },
  rest: () => rest('hat-on-coatrack.json'),
  slow: () => slow('mug.json', 'mug', 0.15, { name: 'mug', time: 0.3 }),
};
for (const [name, act] of Object.entries(parts)) {
  if (!only || only.split(',').includes(name)) await act();
}
load.push(loadavg()[0]);
if (only) console.log('a part alone is not written to the file');
else writeFileSync(csv, [...heading(load), ...rows.map((row) => row.join(','))].join('\n') + '\n');
