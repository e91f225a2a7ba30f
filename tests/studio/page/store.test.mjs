// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Store } from '../../../studio/page/store.js';

test('subscribers hear of their members alone, once a change, in order', () => {
  const store = new Store({ a: 1, b: 2, c: 3 }), heard = [];
  store.on(['a', 'b'], ({ a, b }) => heard.push(`${a}${b}`));
  store.on(['c'], ({ c }) => heard.push(`c${c}`));
  store.set({ a: 5, b: 6 });
  store.set({ c: 4 });
  store.set({ c: 4 });
  assert.deepEqual(heard, ['12', 'c3', '56', 'c4']);
});

test('a change made by a subscriber is told after the one under way', () => {
  const store = new Store({ a: 0, b: 0 }), heard = [];
  store.on(['a'], ({ a }) => a && store.set({ b: a * 10 }));
  store.on(['a'], ({ a }) => heard.push(`a${a}`));
  store.on(['b'], ({ b }) => heard.push(`b${b}`));
  store.set({ a: 1 });
  assert.deepEqual(heard, ['a0', 'b0', 'a1', 'b10']);
});

test('a subscription ends, and one that throws does not stop the next change', () => {
  const store = new Store({ a: 0 });
  let calls = 0, broken = true;
  const end = store.on(['a'], () => void ++calls);
  store.on(['a'], ({ a }) => {
    if (a && broken) throw new Error('broken');
  });
  assert.throws(() => store.set({ a: 1 }), /broken/);
  broken = false;
  store.set({ a: 2 });
  end();
  store.set({ a: 3 });
  assert.equal(calls, 3);
});
