// SPDX-License-Identifier: MIT
// A page that `carom export` wrote, opened from the disk with the network off.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { inflateRawSync } from 'node:zlib';
import { patience, until } from './browser.mjs';
import { command } from './real_studio.mjs';

export const scenes = fileURLToPath(new URL('../../../examples/scenes/', import.meta.url));

/** A folder that goes with the test. */
export function ownFolder(keep) {
  const folder = mkdtempSync(join(tmpdir(), 'carom-exported-'));
  keep({ close: () => rmSync(folder, { recursive: true, force: true }) });
  return folder;
}

/** A file that is exported into a folder of its own, with what stands in it. */
export function exported(keep, scene, ...options) {
  const path = join(ownFolder(keep), 'motion.html');
  execFileSync(command, ['export', scene, '-o', path, ...options, '--quiet']);
  const text = readFileSync(path, 'utf8'), base64 = (name) => new RegExp(`id="packed-${name}">([^<]*)<`).exec(text)[1];
  return { path, text, base64, packed: (name) => inflateRawSync(Buffer.from(base64(name), 'base64')) };
}

/** Its page: what it asks for besides itself is a complaint. */
export async function openExported(keep, browser, path, { width = 1024, height = 640 } = {}) {
  const context = keep(await browser.newContext({ viewport: { width, height }, offline: true })), page = await context.newPage();
  page.setDefaultTimeout(patience);
  page.complaints = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && page.complaints.push(message.text()));
  page.on('pageerror', (error) => page.complaints.push(String(error.stack ?? error)));
  const address = `${pathToFileURL(path)}?test&quality=low`;
  page.on('request', (request) => request.url() === address || /^(data|blob):/.test(request.url()) || page.complaints.push(`a request: ${request.url()}`));
  await page.goto(address);
  await until(page, '(s) => s.motion');
  return page;
}
