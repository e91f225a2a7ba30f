// SPDX-License-Identifier: MIT
// Much to draw, and many who ask: 500 balls in a pen, pages that are compressed, clients that are slow, silent or half open. Frames a second are
// printed, not judged: how many there are depends on what else the machine does.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { get } from 'node:http';
import { connect } from 'node:net';
import { test } from 'node:test';
import { gunzipSync } from 'node:zlib';
import { closing, frame, until } from './browser.mjs';
import { picture, screenOf, skip, state, withStudio } from './hand.mjs';
import { hasCommand, RealStudio } from './real_studio.mjs';
import { Client } from './socket_client.mjs';

const large = { width: 1440, height: 900 };

/** Frames a second while it plays. */
const framesPerSecond = (page) => page.evaluate(async () => {
  const { store, frames } = globalThis.carom;
  store.set({ loop: true, playing: true });
  await new Promise((done) => setTimeout(done, 500));
  const before = frames(), began = performance.now();
  await new Promise((done) => setTimeout(done, 2000));
  const rate = ((frames() - before) * 1000) / (performance.now() - began);
  store.set({ playing: false, time: 0 });
  return rate;
});

test('500 balls in a pen are drawn at once, and seen through its walls; the selected one is drawn by itself', { skip }, () => withStudio('pen_500.json', async (page) => {
  await frame(page);
  const drawn = () => page.evaluate(() => {
    const { view } = globalThis.carom, { calls, triangles } = view.renderer.info.render;
    return { calls, triangles, before: view.walls.before.size };
  });
  const now = await drawn();
  assert.ok(now.calls < 40 && now.triangles < 60000, `${now.calls} calls, ${now.triangles} triangles`);
  assert.ok(now.before >= 1, 'a wall is before the balls');
  await picture(page, 'load-pen');
  const ball = await screenOf(page, await state(page, '(s) => [...s.motion.tracks[5].arcs.subarray(1, 4)]'));
  const ink = await page.evaluate(([x, y]) => globalThis.carom.inkAt(x, y), ball);
  assert.ok(Math.max(...ink) - Math.min(...ink) > 25, `a wall is grey, a ball has a colour: ${ink}`);
  console.log(`# pen_500: ${(await framesPerSecond(page)).toFixed(1)} frames a second`);
  await page.evaluate(() => globalThis.carom.store.set({ selected: 5 }));
  await frame(page);
  assert.deepEqual(await page.evaluate(() => globalThis.carom.view.bodies.meshes.flatMap((mesh, i) => (mesh?.visible && i >= 5 ? [i] : []))), [5]);
  await page.evaluate(() => globalThis.carom.store.set({ selected: -1, quality: 'high' }));
  await frame(page);
  assert.ok(await page.evaluate(() => globalThis.carom.view.bodies.meshes.every((mesh) => !mesh || mesh.visible)), 'where hardware draws, each is drawn by itself');
}, large));

test('a few bodies are drawn as they are, and nothing is seen through', { skip }, () => withStudio('bowling.json', async (page) => {
  await frame(page);
  assert.deepEqual(await page.evaluate(() => [globalThis.carom.view.bodies.crowd.bodies.length, globalThis.carom.view.walls.before.size]), [0, 0]);
  console.log(`# bowling: ${(await framesPerSecond(page)).toFixed(1)} frames a second`);
}, large));

/** @returns {Promise<{headers: any, body: Buffer}>} */
const fetched = (url, headers) => new Promise((done, fail) => get(url, { headers }, (answer) => {
  const parts = [];
  answer.on('data', (part) => parts.push(part)).on('end', () => done({ headers: answer.headers, body: Buffer.concat(parts) }));
}).on('error', fail));

test('the page is served compressed to those who take that, with the same bytes', { skip: !hasCommand() }, () => closing(async (keep) => {
  const studio = keep(await RealStudio.start('bounce.json')), address = new URL('/three/build/three.core.js', studio.url);
  const plain = await fetched(address, {});
  assert.equal(plain.headers['content-encoding'], undefined);
  let packed = await fetched(address, { 'accept-encoding': 'br, gzip;q=0.8' });
  while (packed.headers['content-encoding'] !== 'gzip') packed = await fetched(address, { 'accept-encoding': 'gzip' });  // a moment after the start
  assert.ok(packed.body.length < plain.body.length / 3, `${packed.body.length} of ${plain.body.length} bytes`);
  assert.ok(gunzipSync(packed.body).equals(plain.body));
  assert.equal(packed.headers.vary, 'Accept-Encoding');
  for (const none of ['br', 'gzip;q=0', 'identity']) assert.equal((await fetched(address, { 'accept-encoding': none })).headers['content-encoding'], undefined, none);
}));

/** kB of memory that a process has. */
const memory = (pid) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))[1]);
const median = (all) => all.sort((a, b) => a - b)[Math.floor(all.length / 2)];

/** ms that answers take. */
async function answers(client, count = 60) {
  const taken = [];
  for (let k = 0; k < count; ++k) {
    const began = performance.now();
    await client.ask('list');
    taken.push(performance.now() - began);
  }
  return median(taken);
}

/** 50 connections that behave badly. */
async function crowd(studio) {
  const { port, host } = new URL(studio.url), all = [];
  for (let k = 0; k < 50; ++k) {
    if (k % 3 === 0) {  // slow: greeted, and never reads again
      const client = await Client.connect(studio.url).catch(() => null);
      if (client) client.socket.pause(), all.push(client.socket);
      continue;
    }
    const socket = connect(Number(port), '127.0.0.1').on('error', () => {});
    if (k % 3 === 1) socket.write(`GET /socket HTTP/1.1\r\nHost: ${host}\r\nUpg`);  // half open
    all.push(socket);  // or silent
  }
  return () => all.forEach((socket) => socket.destroy());
}

test('50 slow, silent and half-open clients do not slow down the honest one, nor fill the memory', { skip: !hasCommand() }, () => closing(async (keep) => {
  const studio = keep(await RealStudio.start('hat.json')), client = keep(await Client.connect(studio.url)), { pid } = studio.process;
  await answers(client);
  const sizes = [], ratios = [];
  for (let round = 0; round < 3; ++round) {
    const alone = await answers(client), end = await crowd(studio);
    const among = await answers(client);
    for (let k = 0; k < 10; ++k) await client.ask('nail', { body: 'hat', at: 0.2 + 0.01 * k });  // each is told to all
    end();
    for (let k = 0; k < 10; ++k) await client.ask('undo');
    ratios.push(among / alone), sizes.push(memory(pid));
    console.log(`# ${alone.toFixed(2)} ms alone, ${among.toFixed(2)} ms among 50; ${sizes.at(-1)} kB`);
  }
  assert.ok(Math.min(...ratios) <= 2, `${ratios} times as long`);
  assert.ok(sizes[2] - sizes[1] <= 4096, `memory grows: ${sizes} kB`);
}));
