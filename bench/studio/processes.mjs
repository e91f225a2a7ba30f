// SPDX-License-Identifier: MIT
// What a browser's processes cost: their CPU time, from /proc.
import { readdirSync, readFileSync } from 'node:fs';

const ticks = 100;  // a second, of /proc on every Linux

/** Fields of /proc/PID/stat from the third on, the name in parentheses being left out. */
function statOf(pid) {
  const text = readFileSync(`/proc/${pid}/stat`, 'utf8');
  return text.slice(text.lastIndexOf(')') + 2).split(' ');
}

function allProcesses() {
  const all = [];
  for (const pid of readdirSync('/proc').filter((name) => /^\d+$/.test(name)).map(Number)) {
    try {
      all.push({ pid, parent: Number(statOf(pid)[1]), command: readFileSync(`/proc/${pid}/cmdline`, 'utf8').replaceAll('\0', ' ') });
    } catch {
      // ended meanwhile
    }
  }
  return all;
}

/** Processes that this one has started, and those that they have. */
export function descendants(root = process.pid) {
  const all = allProcesses(), found = new Set([root]);
  for (let more = true; more;) {
    more = false;
    for (const { pid, parent } of all) {
      if (found.has(parent) && !found.has(pid)) more = !!found.add(pid);
    }
  }
  return all.filter(({ pid }) => pid !== root && found.has(pid));
}

/** ms of CPU that a process has taken, threads that have ended included; counted in steps of 10 ms. */
export function cpuOf(pid) {
  const stat = statOf(pid);
  return ((Number(stat[11]) + Number(stat[12])) * 1000) / ticks;
}

/** The processes of chromium that matter: the one that draws, and the page's own. */
export function chromiumProcesses() {
  const all = descendants(), of = (kind) => all.filter(({ command }) => command.includes(`--type=${kind}`)).map(({ pid }) => pid);
  return { gpu: of('gpu-process')[0], pages: of('renderer') };
}
