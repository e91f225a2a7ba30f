// SPDX-License-Identifier: MIT
// The command itself: `carom studio` on a copy of the example scenes, ended with the test.
import { execFileSync, spawn } from 'node:child_process';
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { patience } from './browser.mjs';

const examples = fileURLToPath(new URL('../../../examples/', import.meta.url));
export const command = process.env.CAROM_COMMAND ?? '';
export const hasCommand = () => command !== '' && existsSync(command);

export class RealStudio {
  /** `scene`: null opens none. `change` may alter the document before it is opened. */
  static async start(scene, change = (document) => document) {
    const studio = new RealStudio();
    studio.folder = mkdtempSync(join(tmpdir(), 'carom-studio-'));
    try {
      cpSync(join(examples, 'scenes'), join(studio.folder, 'scenes'), { recursive: true });
      cpSync(join(examples, 'assets'), join(studio.folder, 'assets'), { recursive: true });
      studio.path = scene === null ? null : join(studio.folder, 'scenes', scene);
      if (studio.path) studio.alter(change);
      await studio.run();
    } catch (problem) {
      rmSync(studio.folder, { recursive: true, force: true });
      throw problem;
    }
    return studio;
  }

  alter(change) {
    const text = this.bytes(), document = change(JSON.parse(text));
    if (JSON.stringify(document) !== JSON.stringify(JSON.parse(text))) writeFileSync(this.path, JSON.stringify(document, null, 2));
  }

  async run(port = 0) {
    const page = process.env.CAROM_STUDIO_PAGE ? ['--page', process.env.CAROM_STUDIO_PAGE] : [];
    this.process = spawn(command, ['studio', ...(this.path ? [this.path] : ['--folder', join(this.folder, 'scenes')]), '--no-open', ...(port ? ['--port', String(port)] : []), ...page], { stdio: ['ignore', 'pipe', 'inherit'], env: { ...process.env, XDG_STATE_HOME: join(this.folder, 'state') } });
    this.ended = new Promise((done) => this.process.once('exit', (code, signal) => done(code ?? signal)));
    const lines = createInterface({ input: this.process.stdout }), ended = this.ended.then((how) => ({ problem: `carom studio ended with ${how}` }));
    const { problem, url } = await inTime(Promise.race([new Promise((done) => lines.once('line', (line) => done({ url: line }))), ended]), { problem: 'carom studio printed no address' });
    if (problem) {
      this.process.kill('SIGKILL');
      throw new Error(problem);
    }
    this.url = url;
    this.port = Number(new URL(url).port);
  }

  /** The saved document. */
  bytes() {
    return readFileSync(this.path, 'utf8');
  }

  /** States of the saved document. */
  simulated(...times) {
    const answer = execFileSync(command, ['simulate', this.path, '--json', ...times.flatMap((t) => ['--at', String(t)])], { encoding: 'utf8' });
    return JSON.parse(answer);
  }

  /** How it ended; if it does not end by the signal, it is killed, which is an error. */
  async kill(signal = 'SIGKILL') {
    this.process.kill(signal);
    const how = await inTime(this.ended, null);
    if (how !== null) return how;
    this.process.kill('SIGKILL');
    throw new Error(`carom studio goes on after ${signal}`);
  }

  async close() {
    try {
      return await this.kill('SIGINT');
    } finally {
      await this.ended;
      rmSync(this.folder, { recursive: true, force: true });
    }
  }
}

/** What comes of a promise, or else `late`. */
async function inTime(promise, late) {
  let timer;
  const first = await Promise.race([promise, new Promise((done) => (timer = setTimeout(done, patience, late)))]);
  clearTimeout(timer);
  return first;
}
