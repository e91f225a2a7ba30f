// SPDX-License-Identifier: MIT
// The command is killed at random moments of a session, in drags, in releases, while it saves: every step that a client was
// shown as done is there after a start, undo goes to the opened bytes, and the steps play again. CAROM_KILLS: how often.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { command, hasCommand, RealStudio } from './real_studio.mjs';
import { Client } from './socket_client.mjs';

const kills = Number(process.env.CAROM_KILLS ?? 10), replayed = 3;  // one of so many is played again: that takes as long as its session

/** Of a process and of all its threads, ms of a processor. @param {number} pid */
const processorTime = (pid) => readFileSync(`/proc/${pid}/stat`, 'utf8').split(') ')[1].split(' ').slice(11, 13).reduce((sum, ticks) => sum + 10 * Number(ticks), 0);

/** A way to the same numbers again. @param {number} seed */
function randomOf(seed) {
  let x = seed;
  return () => (x = (x * 48271) % 2147483647) / 2147483647;
}

/** 30 gestures, as quickly as they are answered; keeps the last state that was shown. `begun` hears of each when it begins. */
async function work(client, random, shown, begun = () => {}) {
  let gesture = 0;
  client.heard = (message) => {
    if (message.type === 'state') shown.state = message;
  };
  for (let k = 0; k < 30; ++k) {
    begun(k);
    const what = random();
    if (what < 0.1) await client.ask('undo');
    else if (what < 0.15) await client.ask('redo');
    else if (what < 0.2) await client.ask('save');
    else if (what < 0.3) {
      await client.ask('nail', { body: 'hat', at: 0.2 });
      // it leaves nothing free, and each release would search for what there is not
      await client.ask('unnail', { nail: client.state.nails.at(-1).id });
    } else {
      const seq = 1 + Math.floor(4 * random()), place = () => [-1 + 0.1 * random(), 0.05 * random(), 1.6 + 0.1 * random()];
      await client.ask('grab', { gesture: ++gesture, body: 'hat', at: 0.3 + 0.1 * random(), grip: {}, free: true });
      for (let i = 1; i <= seq; ++i) client.send('drag', { gesture, seq: i, place: place() });
      if (random() < 0.1) await client.ask('cancel', { gesture });
      else await client.ask('release', { gesture, seq, place: place() });
    }
  }
}

test('where somebody else has the port of a server that died, its token is not used again', { skip: hasCommand() ? false : 'CAROM_COMMAND names no carom' }, async () => {
  const studio = await RealStudio.start('hat-on-coatrack.json'), token = () => studio.url.split('#')[1], first = token(), { port } = studio;
  const other = createServer();
  try {
    const client = await Client.connect(studio.url);
    await client.ask('nail', { body: 'hat', at: 0.2 });
    await studio.kill();
    await new Promise((done) => other.listen(port, '127.0.0.1', done));
    await studio.run();
    assert.notEqual(studio.port, port);
    assert.notEqual(token(), first);
    assert.equal((await Client.connect(studio.url)).state.recovered, 1);
    await studio.kill();
    const second = [studio.port, token()];
    await studio.run();
    assert.deepEqual([studio.port, token()], second, 'at the same port it is found again');
  } finally {
    other.close();
    await studio.close();
  }
});

const content = ({ numbers, nails, controls }) => JSON.stringify([numbers, nails.map(({ id, constraint, on }) => [id, constraint, on]), controls]);

test('a hundred gestures come back in a second and one simulation', { skip: hasCommand() ? false : 'CAROM_COMMAND names no carom' }, async () => {
  const studio = await RealStudio.start('hat-on-coatrack.json');
  try {
    const client = await Client.connect(studio.url), random = randomOf(12345);
    for (let gesture = 1; gesture <= 100; ++gesture) {
      await client.ask('grab', { gesture, body: 'hat', at: 0.2 + 0.2 * random(), grip: {}, free: true });
      for (let seq = 1; seq <= 20; ++seq) client.send('drag', { gesture, seq, place: [-1.2 + 0.2 * random(), 0.1 * random(), 1.5 + 0.2 * random()] });
      await client.ask('release', { gesture, seq: 21, place: [-1.2 + 0.2 * random(), 0.1 * random(), 1.5 + 0.2 * random()] });
    }
    const shown = content(client.state);
    await studio.kill();
    const began = performance.now();
    await studio.run();
    // by the processor, so that other work on the machine does not count; a simulation of this scene is a millisecond of it
    const again = await Client.connect(studio.url), milliseconds = processorTime(studio.process.pid);
    console.log(`${again.state.recovered} steps came back in ${milliseconds} ms of a processor, ${(performance.now() - began).toFixed(0)} ms by the clock`);
    assert.equal(content(again.state), shown);
    assert.ok(again.state.recovered >= 99, `${again.state.recovered}`);
    assert.ok(milliseconds <= 1000, `${milliseconds} ms`);
    again.close();
  } finally {
    await studio.close();
  }
});

test('killed at any moment nothing that was shown is lost', { skip: hasCommand() ? false : 'CAROM_COMMAND names no carom' }, async () => {
  let recovered = 0;
  for (let seed = 1; seed <= kills; ++seed) {
    const random = randomOf(7919 * seed), studio = await RealStudio.start('hat-on-coatrack.json'), opened = studio.bytes(), shown = { state: null };
    try {
      // a moment of any of the gestures: before its first byte is read, in it, and some time after it
      const client = await Client.connect(studio.url), last = Math.floor(30 * random()), later = 40 * random() ** 2;
      let reach = () => {};
      const reached = new Promise((done) => (reach = done));
      const working = work(client, random, shown, (k) => k === last && reach()).catch(() => {});
      await Promise.race([working, reached.then(() => new Promise((next) => setTimeout(next, later)))]);
      await studio.kill();
      await working;
      const steps = join(dirname(studio.path), '.hat-on-coatrack.json.steps');
      if (seed % replayed === 1 && existsSync(steps)) execFileSync(command, ['replay', steps], { stdio: 'pipe' });  // ends with 4 where a bit differs
      await studio.run();
      const again = await Client.connect(studio.url), now = again.state;
      // a step that was done, and not shown yet, may be there as well
      const isShown = () => !shown.state || content(again.state) === content(shown.state);
      if (!isShown()) await again.ask('undo');
      if (!isShown()) for (let k = 0; k < 2; ++k) await again.ask('redo');  // or it was an undo
      assert.ok(isShown(), `seed ${seed}: ${content(shown.state)}\n${content(now)}`);
      recovered += now.recovered;
      for (let k = 0; again.state.undo && k < 100; ++k) await again.ask('undo');
      await again.ask('save', { replace: true });
      assert.equal(readFileSync(studio.path, 'utf8'), opened, `seed ${seed}: undo goes to the opened bytes`);
      again.close();
    } finally {
      await studio.close();
    }
  }
  console.log(`${kills} kills, ${recovered} steps recovered`);
});
