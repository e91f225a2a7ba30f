// SPDX-License-Identifier: MIT
// A domino run, as a page builds it: one tile, duplicated, the first one pushed, the last one dragged to a mark while they fall. The push follows,
// through tiles that lean and slide on each other; an update takes some seconds, so that it is done by messages, without a mouse.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { closing } from './browser.mjs';
import { skip } from './hand.mjs';
import { RealStudio } from './real_studio.mjs';
import { Client } from './socket_client.mjs';

test('three tiles by duplicating, the first one pushed, the last one dragged to a mark', { skip }, () => closing(async (keep) => {
  const studio = keep(await RealStudio.start(null)), client = keep(await Client.connect(studio.url));
  let motion = null;
  client.heard = (message) => message.type === 'motion' && (motion = message);
  const ask = async (type, members) => {
    const answer = await client.ask(type, members);
    assert.equal(answer.type, 'state', answer.message);
    return answer;
  };
  const about = (type, members) => ask(type, { rev: client.state.rev, ...members });
  const set = (...edits) => about('set', { edits: edits.map(([pointer, value]) => ({ pointer, value })) });
  await ask('new');
  await set(['/materials/wood/elasticity', 0], ['/materials/wood/friction', 0.6], ['/duration', 0.5]);
  await about('add_body', { body: { name: 'tile', shape: { box: { size: [0.02, 0.1, 0.2] } }, density: 600, material: 'wood' }, on: { point: [0, 0, 0], normal: [0, 0, 1] } });
  for (const k of [2, 3]) {
    await about('copy_body', { body: 'tile' });
    await set([`/bodies/${k}/position`, [0.1 * (k - 1), 0, 0.1]]);
  }
  await set(['/bodies/1/velocity', [0.2, 0, 0]], ['/bodies/1/angular_velocity', [0, 2, 0]]);
  assert.deepEqual(client.state.bodies.map(({ name }) => name), ['floor', 'tile', 'tile 2', 'tile 3']);
  assert.equal(motion.status, 'complete', motion.message);
  await about('controls', { controls: [{ vary: 'velocity', body: 'tile' }, { vary: 'angular_velocity', body: 'tile' }] });
  await ask('grab', { gesture: 1, body: 'tile 3', at: 0.48, grip: { components: ['x'] } });
  const end = await ask('release', { gesture: 1, seq: 1, place: [0.255, 0, 0.09] });
  assert.ok(motion.reached && motion.distance <= 1e-9, `${motion.distance} m off: ${motion.obstacle?.sentence}`);
  assert.equal(end.undo, "drag of 'tile 3' at 0.48 s");
  const [, tile, second, third] = end.bodies;
  assert.ok(tile.velocity[0] > 0.21 && [second, third].every(({ velocity }) => velocity.every((v) => v === 0)), `the push follows: ${tile.velocity}`);
  await ask('undo');
  assert.deepEqual(client.state.bodies[1].velocity, [0.2, 0, 0]);
}));
