// SPDX-License-Identifier: MIT
// Checks the types of the page's modules, and that none has more than 300 lines.
import { spawnSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const page = fileURLToPath(new URL('../../../studio/page/', import.meta.url)), compiler = `${page}node_modules/typescript/bin/tsc`;
const modules = readdirSync(page, { recursive: true }).filter((name) => !name.startsWith('node_modules') && /\.(js|css|html)$/.test(name));
let failed = modules.length < 20;
for (const name of modules) {
  const lines = readFileSync(page + name, 'utf8').split('\n');
  if (lines.length - 1 > 300) console.error(`${name} has ${lines.length - 1} lines; the most is 300`, (failed = true));
  if (!lines.slice(0, 2).join().includes('SPDX-License-Identifier: MIT')) console.error(`${name} lacks its SPDX line`, (failed = true));
}
if (!existsSync(compiler) && process.env.CAROM_REQUIRE_STUDIO) {
  console.error('TypeScript is missing: scripts/setup studio-tests', (failed = true));
} else if (!existsSync(compiler)) {
  console.log('left out: scripts/setup studio-tests installs TypeScript');
} else {
  const { status, stdout, stderr } = spawnSync(process.execPath, [compiler, '-p', page], { encoding: 'utf8' });
  process.stdout.write(stdout + stderr);
  failed ||= status !== 0;
}
process.exit(failed ? 1 : 0);
