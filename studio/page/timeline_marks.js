// SPDX-License-Identifier: MIT
// What the time line draws that knows nothing of it: diamonds, names of lanes, the part that a motion lacks.

import { colours } from './colours.js';

/** @typedef {CanvasRenderingContext2D} Pen */

/** @param {Pen} pen @param {number} x @param {number} y @param {number} size @param {string} colour @param {boolean} full */
export function diamond(pen, x, y, size, colour, full) {
  pen.beginPath();
  pen.moveTo(x - size, y);
  pen.lineTo(x, y - size);
  pen.lineTo(x + size, y);
  pen.lineTo(x, y + size);
  pen.closePath();
  pen.fillStyle = pen.strokeStyle = colour;
  pen.lineWidth = 1.2;
  if (full) pen.fill();
  else pen.stroke();
}

/** Whose lane it is, in the colour of the body. @param {Pen} pen @param {string} name @param {number} left @param {number} y
 * @param {number} height @param {boolean} strong */
export function drawName(pen, name, left, y, height, strong) {
  if (height < 9) return;
  const { font } = pen;
  pen.font = `${strong ? '600 ' : ''}${Math.min(11, height - 2)}px system-ui, sans-serif`;
  const ink = pen.fillStyle, wide = Math.min(160, pen.measureText(name).width);
  pen.fillStyle = strong ? '#39404a' : colours.lane;
  pen.fillRect(left + 2, y, wide + 5, height - 2);
  pen.fillStyle = ink;
  pen.fillText(name, left + 4, y + height / 2 + 3, 160);
  pen.font = font;
}

/** What the motion lacks is hatched, with the reason in it. @param {Pen} pen @param {number} from @param {number} to px
 * @param {number} top @param {number} height of the canvas @param {string} why */
export function drawEnd(pen, from, to, top, height, why) {
  if (from >= to) return;
  pen.save();
  pen.beginPath();
  pen.rect(from, top, to - from, height - top - 6);
  pen.clip();
  pen.strokeStyle = '#5a6068';
  pen.lineWidth = 1;
  for (let x = from - height; x < to; x += 8) {
    pen.beginPath();
    pen.moveTo(x, height);
    pen.lineTo(x + height, 0);
    pen.stroke();
  }
  const wide = Math.min(pen.measureText(why).width, to - from - 16);
  if (why && wide > 60) {
    pen.fillStyle = colours.panel;
    pen.fillRect(from + 4, top + 2, wide + 8, 16);
    pen.beginPath();
    pen.rect(from + 4, top + 2, wide + 8, 16);
    pen.clip();
    pen.fillStyle = colours.text;
    pen.fillText(why, from + 8, top + 14);
  }
  pen.restore();
}
