// SPDX-License-Identifier: MIT
// The command itself: `carom studio` on a copy of the example scenes, ended with the test.
import { execFileSync, spawn } from 'node:child_process';
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

const examples = fileURLToPath(new URL('../../../examples/', import.meta.url));
export const command = process.env.CAROM_COMMAND ?? '';
export const hasCommand = () => command !== '' && existsSync(command);

export class RealStudio {
  /** `scene`: null opens none. `change` may alter the document before it is opened. */
  static async start(scene, change = (document) => document) {
    const studio = new RealStudio();
    studio.folder = mkdtempSync(join(tmpdir(), 'carom-studio-'));
    cpSync(join(examples, 'scenes'), join(studio.folder, 'scenes'), { recursive: true });
    cpSync(join(examples, 'assets'), join(studio.folder, 'assets'), { recursive: true });
    studio.path = scene === null ? null : join(studio.folder, 'scenes', scene);
    if (scene === null) {
      await studio.run();
      return studio;
    }
    const text = readFileSync(studio.path, 'utf8'), document = change(JSON.parse(text));
    if (JSON.stringify(document) !== JSON.stringify(JSON.parse(text))) writeFileSync(studio.path, JSON.stringify(document, null, 2));
    await studio.run();
    return studio;
  }

  async run(port = 0) {
    const page = process.env.CAROM_STUDIO_PAGE ? ['--page', process.env.CAROM_STUDIO_PAGE] : [];
    this.process = spawn(command, ['studio', ...(this.path ? [this.path] : ['--folder', join(this.folder, 'scenes')]), '--no-open', ...(port ? ['--port', String(port)] : []), ...page], { stdio: ['ignore', 'pipe', 'inherit'] });
    this.ended = new Promise((done) => this.process.once('exit', (code, signal) => done(code ?? signal)));
    const lines = createInterface({ input: this.process.stdout });
    this.url = await Promise.race([new Promise((done) => lines.once('line', done)), this.ended.then((how) => Promise.reject(new Error(`carom studio ended with ${how}`)))]);
    this.port = Number(new URL(this.url).port);
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

  async kill(signal = 'SIGKILL') {
    this.process.kill(signal);
    return this.ended;
  }

  async close() {
    this.process.kill('SIGINT');
    const how = await this.ended;
    rmSync(this.folder, { recursive: true, force: true });
    return how;
  }
}
