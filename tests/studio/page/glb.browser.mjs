// SPDX-License-Identifier: MIT
// What File > Export writes as glTF, played by three's own loader and mixer, is where the simulation is.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { ownFolder } from './exported_page.mjs';
import { letGo, place, pull, skip, withStudio } from './hand.mjs';

const three = new URL('../../../studio/page/node_modules/three/', import.meta.url);

/** Places of the named nodes at times, m, in the axes of scenes: glTF has y up. */
async function played(path, times) {
  const THREE = await import(new URL('build/three.module.js', three)), { GLTFLoader } = await import(new URL('examples/jsm/loaders/GLTFLoader.js', three));
  const bytes = readFileSync(path), { scene, animations } = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), '');
  const mixer = new THREE.AnimationMixer(scene);
  for (const clip of animations) {
    const action = mixer.clipAction(clip);
    action.setLoop(THREE.LoopOnce);
    action.clampWhenFinished = true;
    action.play();
  }
  return times.map((time) => {
    mixer.setTime(time);
    scene.updateMatrixWorld(true);
    const places = {};
    scene.traverse((node) => {
      const { x, y, z } = new THREE.Vector3().setFromMatrixPosition(node.matrixWorld);
      if (node.userData.name) places[node.userData.name] = [x, -z, y];
    });
    return places;
  });
}

/** Numbers from 0 to 1, the same each time. */
function numbers(seed, count) {
  return Array.from({ length: count }, () => (seed = (1103515245 * seed + 12345) % 2147483648) / 2147483648);
}

for (const [scene, body, time] of [['hat-on-coatrack', 'hat', 0.4], ['book-on-shelf', 'book', 0.5], ['mug-on-mark', 'mug', 0.3]]) {
  test(`${scene} as glTF for the web plays where it was simulated`, { skip }, () => withStudio(`${scene}.json`, async (page, studio, keep) => {
    const [x, y] = await place(page, body, time);
    await pull(page, [x, y], [x + 12, y - 8]);
    await letGo(page);
    await page.keyboard.press('Control+s');
    await page.waitForFunction(() => globalThis.carom.store.state.document.saved);
    const seed = 7, end = await page.evaluate(() => globalThis.carom.store.state.motion.end), times = numbers(seed, 60).map((share) => share * end);
    const states = studio.simulated(...times).states, moving = JSON.parse(studio.bytes()).bodies.filter((one) => !one.fixed).map((one) => one.name);
    for (const [words, bound] of [['for the web', 1e-6], ['for Blender', 1.01e-4]]) {
      await page.click('#file');
      await page.click('#menu >> text=Export…');
      const [download] = await Promise.all([page.waitForEvent('download'), page.click(`dialog button:has-text("${words}")`)]);
      const path = join(ownFolder(keep), 'motion.glb');
      await download.saveAs(path);
      const places = await played(path, times);
      let worst = 0;
      states.forEach(({ time: at, bodies }) => {
        const k = times.indexOf(at);
        for (const name of moving) {
          const off = Math.hypot(...bodies[name].position.map((c, i) => c - places[k][name][i]));
          assert.ok(off <= bound, `${name} is ${off} m off at ${at} s in the file ${words} (seed ${seed})`);
          worst = Math.max(worst, off);
        }
      });
      console.log(`# ${scene} ${words}: at most ${worst.toExponential(2)} m off`);
    }
  }));
}
