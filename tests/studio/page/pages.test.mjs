// SPDX-License-Identifier: MIT
// What docs/studio.md says of keys and docs/studio-protocol.md of messages is what there is.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync, statSync } from 'node:fs';
import { test } from 'node:test';
import { keyTable } from '../../../studio/page/keys.js';

const file = (name) => new URL(`../../../${name}`, import.meta.url);
const text = (name) => readFileSync(file(name), 'utf8');

/** Cells of the rows of the table whose head begins with these words. */
function table(page, head) {
  const lines = text(page).split('\n'), from = lines.findIndex((line) => line.startsWith(head));
  assert.ok(from >= 0, `${page} has no table ${head}`);
  const rows = lines.slice(from + 2), end = rows.findIndex((line) => !line.startsWith('|'));
  return rows.slice(0, end).map((line) => line.split('|').slice(1, -1).map((cell) => cell.trim()));
}

test('the page of the studio has all keys of both maps, in their order', () => {
  const rows = table('docs/studio.md', '| | like Blender');
  const named = { Escape: 'Esc', ArrowLeft: '←', ArrowRight: '→', ArrowUp: '↑', ArrowDown: '↓' };
  for (const [column, map] of [[1, 'blender'], [2, 'maya']]) {
    const said = rows.flatMap((row) => (row[column] === 'the same' ? row[1] : row[column]).split(', '));
    assert.deepEqual(said, keyTable.flatMap((row) => row[map].map((key) => named[key] ?? key)));
  }
});

test('the page of the protocol has every message with all its members', () => {
  const rows = new Map(table('docs/studio-protocol.md', '| `type` | members | what it does').flatMap(([types, members]) =>
    types.split(', ').map((type) => [type.replaceAll('`', ''), members])));
  const { definitions } = JSON.parse(text('studio/protocol.schema.json')), seen = [];
  for (const [name, definition] of Object.entries(definitions)) {
    const alone = definition.$ref === '#/definitions/alone';
    if (!alone && (name === 'alone' || !definition.properties?.type || !definition.properties.id)) continue;
    seen.push(name);
    const members = alone ? [] : Object.keys(definition.properties).filter((member) => !['type', 'id'].includes(member));
    assert.ok(rows.has(name), `${name} is not in the table`);
    for (const member of members) assert.ok(rows.get(name).includes(`\`${member}\``), `${member} of ${name} is not in the table`);
    const optional = members.filter((member) => !definition.required.includes(member) && !definition.oneOf && rows.get(name).includes(`\`${member}\``));
    for (const member of optional) assert.ok(rows.get(name).includes(`\`${member}\`?`), `${member} of ${name} is optional`);
  }
  assert.deepEqual([...rows.keys()].sort(), seen.sort());
});

test('pictures of the studio are those that its pages show, and small', () => {
  const shown = new Set(['docs/studio.md', 'README.md'].flatMap((page) => [...text(page).matchAll(/\((?:docs\/)?studio\/([\w-]+\.png)\)/g)].map((match) => match[1])));
  assert.deepEqual(readdirSync(file('docs/studio')).sort(), [...shown].sort());
  for (const name of shown) {
    assert.ok(existsSync(file(`docs/studio/${name}`)));
    assert.ok(statSync(file(`docs/studio/${name}`)).size <= 122880, `${name} is too large for a repository`);
  }
});
