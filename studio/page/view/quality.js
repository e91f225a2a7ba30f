// SPDX-License-Identifier: MIT
// How much is drawn: software renderers get less, and so does a machine that shows to be slow.

const software = /swiftshader|llvmpipe|basic render|software/i;
const slowFrame = 40, slowFrames = 5;

/** The name of what draws, "" where there is no WebGL. */
export function rendererName() {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (!gl) return '';
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  const name = String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return name || 'unknown';
}

/** @param {string} name of the renderer */
export const isHardware = (name) => !software.test(name);

/** @param {string} name of the renderer @param {string | null} wanted by the address @returns {'low' | 'high'} */
export function qualityFor(name, wanted) {
  if (wanted === 'low' || wanted === 'high') return wanted;
  return software.test(name) ? 'low' : 'high';
}

/** Tells when frames that follow each other directly take too long. */
export class FrameWatch {
  constructor() {
    this.slow = 0;
    this.last = -Infinity;
  }

  /** @param {number} time ms, of a frame @param {boolean} followed that another was wanted at once
   * @returns {boolean} whether so many in a row were slow */
  frame(time, followed) {
    const took = time - this.last;
    this.last = followed ? time : -Infinity;
    this.slow = took > slowFrame && took < 1000 ? this.slow + 1 : 0;
    return this.slow >= slowFrames;
  }
}
