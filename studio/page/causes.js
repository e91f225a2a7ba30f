// SPDX-License-Identifier: MIT
// Which bodies the controls can move, and what may vary besides when a person takes hold of one that they cannot.

/** @typedef {import('./types.js').Control} Control */

/** Whether some control has a say in where a body is at a time: it names the body, or one that met it before, directly
 * or by others.
 * @param {{bodies: {name: string, material?: string}[], controls: Control[]}} document
 * @param {import('./types.js').Impact[]} impacts in order of time @param {number} body @param {number} time s */
export function controlsMove({ bodies, controls }, impacts, body, time) {
  const moved = new Set(bodies.flatMap((one, i) => (controls.some((c) => c.body === one.name) ? [i] : [])));
  if (controls.some((control) => control.vary === 'gravity')) return true;
  const materials = new Set(controls.flatMap((control) => (control.material ? [control.material] : [])));
  for (const { t, bodies: met } of impacts) {
    if (t >= time) break;
    if (met.some((i) => moved.has(i) || materials.has(bodies[i]?.material ?? ''))) met.forEach((i) => moved.add(i));
  }
  return moved.has(body);
}

/** The throw of a body, at a weight that leaves other numbers dearer. @param {string} body @returns {Control[]} */
export function throwOf(body) {
  return [{ vary: 'velocity', body, weight: 0.2 }, { vary: 'angular_velocity', body, weight: 0.2 }];
}
