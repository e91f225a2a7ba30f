// SPDX-License-Identifier: MIT
// Pictures of buttons as lines: fonts differ from machine to machine in which pictographs they have.

/** Paths in a square of 16. @type {Record<string, string>} */
const paths = {
  move: 'M8 1v14M1 8h14M8 1l-2 2.2M8 1l2 2.2M8 15l-2-2.2M8 15l2-2.2M1 8l2.2-2M1 8l2.2 2M15 8l-2.2-2M15 8l-2.2 2',
  turn: 'M13.5 8a5.5 5.5 0 1 1-1.8-4.1M13.8 1.6v3h-3',
  throw: 'M2 14L13.5 2.5M13.5 2.5l-4.5 0.800M13.5 2.5l-0.800 4.5',
  face: 'M3 3h10v10H3zM5.6 5.6h.01M10.4 10.4h.01M8 8h.01M10.4 5.6h.01M5.6 10.4h.01',
  pen: 'M2.5 13.5l1-3.500L11 2.500l2.500 2.500L6 12.500zM9.500 4l2.500 2.500',
  hoop: 'M8 2.5a5.5 5.5 0 1 0 0 11a5.5 5.5 0 1 0 0-11',
  release: 'M8 1.5v7M5.4 6L8 8.6L10.6 6M3 11.5a5 2.2 0 1 0 10 0a5 2.2 0 1 0-10 0',
  free: 'M1.5 8c2-5 4-5 6.5 0s4.5 5 6.5 0',
  play: 'M4.5 2.5v11l9-5.5z', pause: 'M5 3v10M11 3v10', loop: 'M3 6.5A5 5 0 0 1 12 4.5M12.5 1.800v3h-3M13 9.5A5 5 0 0 1 4 11.5M3.5 14.200v-3h3',
  locked: 'M4 7.5h8v6H4zM5.5 7.5V5a2.5 2.5 0 0 1 5 0v2.5', unlocked: 'M4 7.5h8v6H4zM5.5 7.5V4.5a2.5 2.5 0 0 1 4.700-1.200',
  on: 'M1.5 8Q8 1.5 14.5 8Q8 14.5 1.5 8zM8 6a2 2 0 1 0 0 4a2 2 0 1 0 0-4', off: 'M1.5 8Q8 1.5 14.5 8Q8 14.5 1.5 8zM3 13L13 3',
  lanes: 'M2 3.5h12M2 8h12M2 12.5h12',
  close: 'M4 4l8 8M12 4l-8 8', undo: 'M3 6h6.5a3.5 3.5 0 0 1 0 7H6M5.5 3L2.5 6l3 3', redo: 'M13 6H6.5a3.5 3.5 0 0 0 0 7H10M10.5 3l3 3l-3 3',
  folded: 'M10 3L5 8l5 5', unfolded: 'M6 3l5 5l-5 5', right: 'M6 3.5l4.5 4.5L6 12.5', down: 'M3.5 6L8 10.5L12.5 6',
};

const space = 'http://www.w3.org/2000/svg';

/** @param {string} name @returns {SVGSVGElement} */
export function icon(name) {
  const svg = document.createElementNS(space, 'svg'), path = document.createElementNS(space, 'path');
  svg.setAttribute('viewBox', '0 0 16 16');
  svg.setAttribute('class', 'picture');
  svg.setAttribute('aria-hidden', 'true');
  path.setAttribute('d', paths[name] ?? '');
  svg.append(path);
  return svg;
}

/** Puts pictures into the elements of the page that name one. @param {ParentNode} root */
export function drawIcons(root) {
  for (const element of root.querySelectorAll('[data-icon]')) element.prepend(icon(element.getAttribute('data-icon') ?? ''));
}
