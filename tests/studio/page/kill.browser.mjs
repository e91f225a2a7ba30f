// SPDX-License-Identifier: MIT
// The command is killed at random moments of a session, in drags, in releases, while it saves: every step that a client was
// shown as done is there after a start, undo goes to the opened bytes, and the steps play again. CAROM_KILLS: how often.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { command, hasCommand, RealStudio } from './real_studio.mjs';
import { Client } from './socket_client.mjs';

const kills = Number(process.env.CAROM_KILLS ?? 8);

/** A way to the same numbers again. @param {number} seed */
function randomOf(seed) {
  let x = seed;
  return () => (x = (x * 48271) % 2147483647) / 2147483647;
}

/** 30 gestures, as quickly as they are answered; keeps the last state that was shown. */
async function work(client, random, shown) {
  let gesture = 0;
  client.heard = (message) => {
    if (message.type === 'state') shown.state = message;
  };
  for (let k = 0; k < 30; ++k) {
    const what = random();
    if (what < 0.1) await client.ask('undo');
    else if (what < 0.15) await client.ask('redo');
    else if (what < 0.2) await client.ask('save');
    else if (what < 0.3) await client.ask('nail', { body: 'hat', at: 0.2 });
    else {
      const seq = 1 + Math.floor(4 * random()), place = () => [-1 + 0.1 * random(), 0.05 * random(), 1.6 + 0.1 * random()];
      await client.ask('grab', { gesture: ++gesture, body: 'hat', at: 0.3 + 0.1 * random(), grip: {}, free: true });
      for (let i = 1; i <= seq; ++i) client.send('drag', { gesture, seq: i, place: place() });
      if (random() < 0.1) await client.ask('cancel', { gesture });
      else await client.ask('release', { gesture, seq, place: place() });
    }
  }
}

const content = ({ numbers, nails, controls }) => JSON.stringify([numbers, nails.map(({ id, constraint, on }) => [id, constraint, on]), controls]);

test('killed at any moment nothing that was shown is lost', { skip: hasCommand() ? false : 'CAROM_COMMAND names no carom' }, async () => {
  let recovered = 0;
  for (let seed = 1; seed <= kills; ++seed) {
    const random = randomOf(7919 * seed), studio = await RealStudio.start('hat-on-coatrack.json'), opened = studio.bytes(), shown = { state: null };
    try {
      const client = await Client.connect(studio.url), working = work(client, random, shown).catch(() => {});
      await Promise.race([working, new Promise((next) => setTimeout(next, 20 + 700 * random()))]);
      await studio.kill();
      await working;
      const steps = join(dirname(studio.path), '.hat-on-coatrack.json.steps');
      if (existsSync(steps)) execFileSync(command, ['replay', steps], { stdio: 'pipe' });  // ends with 4 where a bit differs
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
