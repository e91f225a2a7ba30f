// SPDX-License-Identifier: MIT
// The grid: how far the lines of the ground are apart, and targets that go to it.

/** m, between lines. @param {number} extent m */
export function spacingOf(extent) {
  return extent < 1.2 ? 0.1 : extent < 4 ? 0.25 : 1;
}

/** m, between lines of a scene. @param {import('./types.js').SceneShapes | null} scene */
export function gridOf(scene) {
  return scene ? spacingOf(Math.max(...scene.max.map((m, i) => m - scene.min[i]))) : 0.1;
}

/** rad, steps of a turn where a place goes in steps of the grid. */
export const turnStep = Math.PI / 12;

/** The nearest multiple of a step. @param {number} value @param {number} step */
export const toStep = (value, step) => Number((Math.round(value / step) * step).toPrecision(12));
