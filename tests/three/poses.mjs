// SPDX-License-Identifier: MIT
// Plays a glTF file with three.js and prints where every named node is: node poses.mjs FILE STEP COUNT
// The answer, as JSON: {"poses": {"<name>": [[x, y, z, qw, qx, qy, qz], ...]}}, world poses at 0, STEP, ... COUNT * STEP
// seconds, from three's own loader and mixer, in glTF's axes.
import { readFileSync } from 'node:fs';
import * as THREE from 'three';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

const [file, step, count] = [process.argv[2], Number(process.argv[3]), Number(process.argv[4])];
const bytes = readFileSync(file);
const data = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
const gltf = await new GLTFLoader().parseAsync(data, '');

const mixer = new THREE.AnimationMixer(gltf.scene);
for (const clip of gltf.animations) {
  const action = mixer.clipAction(clip);
  action.setLoop(THREE.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
}

const nodes = [];
gltf.scene.traverse((node) => {
  if (node.userData.name) nodes.push([node.userData.name, node, []]);
});
const x = new THREE.Vector3(), q = new THREE.Quaternion(), scale = new THREE.Vector3();
for (let k = 0; k <= count; ++k) {
  mixer.setTime(k * step);
  gltf.scene.updateMatrixWorld(true);
  for (const [, node, poses] of nodes) {
    node.matrixWorld.decompose(x, q, scale);
    poses.push([x.x, x.y, x.z, q.w, q.x, q.y, q.z]);
  }
}
console.log(JSON.stringify({ poses: Object.fromEntries(nodes.map(([name, , poses]) => [name, poses])) }));
