// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { offText } from '../../../studio/page/live.js';
import { evaluate, forPeople, lengthText, shortNumber, stepOf } from '../../../studio/page/number_field_text.js';

test('fields take arithmetic', () => {
  const values = { '1': 1, ' 2.5 ': 2.5, '1+2*3': 7, '(1+2)*3': 9, '-4/8': -0.5, '2-3-4': -5, '1e-3': 0.001, '.5*2': 1, '−3': -3, '--2': 2, '8/2/2': 2, '1.5E2': 150 };
  for (const [text, value] of Object.entries(values)) assert.equal(evaluate(text), value, text);
  for (const text of ['', 'x', '1+', '1/0', '(1', '1)', '2 3', 'alert(1)', '1e999', '1..2', '0/0', 'NaN', '1'.repeat(5) + '+'.repeat(300)]) assert.equal(evaluate(text), null, text);
});

test('numbers for people', () => {
  assert.equal(shortNumber(2.32, 1), '2.320');
  assert.equal(shortNumber(-0.0000001, 1), '0.000');
  assert.equal(shortNumber(-12.345, 1), '−12.345');
  assert.equal(shortNumber(2.5e-7, 1e-6), '2.500e-7');
  assert.equal(shortNumber(NaN), '–');
  assert.equal(lengthText(0.0123), '12.3 mm');
  assert.equal(lengthText(1.23456), '1.23 m');
  assert.equal(lengthText(2.5e-5), '0.03 mm');
  assert.equal(lengthText(8.16e-4), '0.82 mm');
  assert.equal(lengthText(1e-7), 'less than 0.01 mm');
  assert.equal(lengthText(9.96e-4), '1.0 mm');
  assert.equal(lengthText(0.0042), '4.2 mm');
});

test('a step is a hundredth to a tenth of the natural scale', () => {
  for (const scale of [1e-3, 0.02, 0.7, 1, 3, 80]) assert.ok(stepOf(scale) <= scale / 10 * 1.001 && stepOf(scale) >= scale / 101, String(scale));
});

test('sentences for people have three digits, names have all of theirs', () => {
  assert.equal(forPeople("The motion of 'run 1.23456789' ends at 0.4312345678 s, 1.5 m away: 123456.7891."), "The motion of 'run 1.23456789' ends at 0.431 s, 1.5 m away: 123000.");
  assert.equal(forPeople('off by 0.00001234 or 3.2109876e-9 of 12 and 2.0004'), 'off by 0.0000123 or 3.21e-9 of 12 and 2');
});

test('how far off: a length, an angle, or both, whatever was asked for', () => {
  assert.equal(offText({ distance: 0.0049, turn: 0 }), '4.9 mm from its target');
  assert.equal(offText({ distance: 1e-17, turn: 0.31 }), '17.8° from its target');
  assert.equal(offText({ distance: 0.0049, turn: 0.31 }), '4.9 mm, 17.8° from its target');
  assert.equal(offText({ distance: 0, turn: 0.001 }), '0.06° from its target');
});
