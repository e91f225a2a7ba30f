// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { createHmac } from 'node:crypto';
import { test } from 'node:test';
import { Connection, DragSender } from '../../../studio/page/connection.js';
import { bytesOf, makeFrame } from './frame.mjs';

function harness() {
  const sockets = [], heard = [], waits = [], reasons = [], clock = { now: 0 };
  const connection = new Connection({
    url: 'ws://x/socket', token: 't', tab: 'a', later: (act, ms) => waits.push([act, ms]), now: () => clock.now,
    socket: () => {
      const socket = { readyState: 1, sent: [], send: (text) => socket.sent.push(JSON.parse(text)), close: () => socket.onclose({ code: 1005 }) };
      sockets.push(socket);
      return socket;
    },
    listener: { status: (status, why) => heard.push(status) && reasons.push(why), message: (message) => heard.push(message.type), frame: (frame) => heard.push(`frame ${frame.header.type}`) },
  });
  const say = (socket, message) => socket.onmessage({ data: JSON.stringify(message) });
  return { connection, sockets, heard, waits, say, reasons, clock };
}

/** A page whose server is gone, and the socket of the next one, which was asked for its proof. */
function lostOnce() {
  const all = harness(), { connection, sockets, waits, say } = all;
  connection.connect();
  sockets[0].onopen();
  say(sockets[0], { type: 'welcome', re: 1 });
  sockets[0].onclose({ code: 1006 });
  waits.shift()[0]();
  sockets[1].onopen();
  return { ...all, asked: sockets[1].sent };
}
const rightProof = (nonce) => createHmac('sha256', 't').update(nonce).digest('hex');
/** Proofs are computed beside: waits for what comes of one. */
async function settled(holds) {
  for (let k = 0; k < 1000 && !holds(); ++k) await new Promise((done) => setTimeout(done, 5));
}

test('who is at the port of before has to know the token: only then it is told', async () => {
  const { asked, sockets, say, connection, heard } = lostOnce();
  assert.equal(asked.length, 1);
  assert.equal(asked[0].type, 'prove');
  assert.match(asked[0].nonce, /^[0-9a-f]{64}$/);
  assert.equal(connection.send('undo'), 0);
  say(sockets[1], { type: 'proof', re: asked[0].id, proof: rightProof(asked[0].nonce) });
  await settled(() => asked.length > 1);
  assert.deepEqual(asked.slice(1).map(({ type, token }) => [type, token]), [['hello', 't']]);
  say(sockets[1], { type: 'welcome', re: asked[1].id });
  assert.equal(heard.at(-2), 'open');
  assert.notEqual(lostOnce().asked[0].nonce, asked[0].nonce);
});

test('a wrong server at the port gets no token, and the page says so: no proof, another, a late one, anything else', async () => {
  for (const answer of [
    () => ({ type: 'proof', proof: '00' }),
    () => ({ type: 'proof' }),
    () => ({ type: 'welcome', protocol: 1 }),
    ({ nonce }) => ({ type: 'proof', proof: createHmac('sha256', 'u').update(nonce).digest('hex') }),
    ({ nonce }, clock) => {
      clock.now = 1001;
      return { type: 'proof', proof: rightProof(nonce) };
    },
    () => null,  // says nothing
  ]) {
    const { asked, sockets, say, heard, waits, reasons, clock } = lostOnce(), said = answer(asked[0], clock), before = heard.length;
    if (said) say(sockets[1], said);
    else waits.find(([, ms]) => ms === 2000)[0]();
    await settled(() => heard.length > before);
    assert.deepEqual(asked.map(({ type }) => type), ['prove'], JSON.stringify(said));
    assert.ok(!JSON.stringify(asked).includes('"t"'));
    assert.deepEqual(heard.slice(before), ['lost']);
    if (clock.now > 1000) assert.equal(reasons.at(-1), '', 'that of a slow machine');
    else assert.match(reasons.at(-1), /not the server that this page knows.*told nothing/);
    assert.ok(waits.length > 1, 'it is tried again');
  }
});

test('greets with its token, and nothing is sent before the answer', () => {
  const { connection, sockets, heard, say } = harness();
  connection.connect();
  sockets[0].onopen();
  assert.equal(connection.send('undo'), 0);
  say(sockets[0], { type: 'welcome', re: 1 });
  assert.equal(connection.send('undo'), 2);
  assert.deepEqual(sockets[0].sent, [{ type: 'hello', id: 1, protocol: 1, token: 't', tab: 'a' }, { type: 'undo', id: 2 }]);
  assert.deepEqual(heard, ['connecting', 'open', 'welcome']);
});

test('answers, errors and frames find what asked', async () => {
  const { connection, sockets, say } = harness();
  connection.connect();
  sockets[0].onopen();
  say(sockets[0], { type: 'welcome', re: 1 });
  const [a, b] = [connection.request('undo'), connection.request('save')];
  say(sockets[0], { type: 'error', re: 3, code: 'conflict', message: 'changed' });
  sockets[0].onmessage({ data: bytesOf(makeFrame(() => ({ type: 'motion', re: 2, reached: true }))) });
  assert.equal((await a).reached, true);
  await assert.rejects(b, { code: 'conflict' });
});

test('how a command is getting on is no answer: what goes wrong after it is told', async () => {
  const { connection, sockets, say } = harness();
  connection.connect();
  sockets[0].onopen();
  say(sockets[0], { type: 'welcome', re: 1 });
  const asked = connection.request('open');
  say(sockets[0], { type: 'progress', re: 2, message: 'opening' });
  say(sockets[0], { type: 'error', re: 2, code: 'input', message: 'no scene' });
  await assert.rejects(asked, { code: 'input' });
});

test('a broken connection refuses what waits, and is tried again, later each time', async () => {
  const { connection, sockets, heard, waits, say } = harness();
  connection.connect();
  sockets[0].onopen();
  say(sockets[0], { type: 'welcome', re: 1 });
  const asked = connection.request('undo');
  sockets[0].onclose({ code: 1006 });
  await assert.rejects(asked, { code: 'lost' });
  for (let i = 0; i < 6; ++i) {
    waits[i][0]();
    sockets[i + 1].onclose({ code: 1006 });
  }
  assert.deepEqual(waits.map(([, ms]) => ms), [200, 500, 1000, 2000, 5000, 5000, 5000]);
  waits[6][0]();
  sockets[7].onopen();
  say(sockets[7], { type: 'proof', proof: rightProof(sockets[7].sent[0].nonce) });
  await settled(() => sockets[7].sent.length > 1);
  say(sockets[7], { type: 'welcome', re: connection.id });
  sockets[7].onclose({ code: 1006 });
  assert.equal(waits.at(-1)[1], 200, 'after a success from the start');
  assert.equal(heard.filter((one) => one === 'lost').length, 8);
});

test('a wrong token and another protocol are not tried again', () => {
  for (const code of [4401, 4400]) {
    const { connection, sockets, heard, waits } = harness();
    connection.connect();
    sockets[0].onclose({ code });
    assert.deepEqual([heard.at(-1), waits.length], ['ended', 0]);
  }
});

test('what the page does not understand is an error it tells', () => {
  const { connection, sockets, heard } = harness();
  const log = console.error;
  console.error = () => {};
  connection.connect();
  sockets[0].onmessage({ data: new ArrayBuffer(3) });
  sockets[0].onmessage({ data: '{' });
  console.error = log;
  assert.deepEqual(heard.slice(1), ['error', 'error']);
});

test('one drag is unanswered at a time; the newest of the others goes next, at the latest with the release', () => {
  const sent = [], sender = new DragSender((members) => sent.push(members), 4);
  for (const x of [1, 2, 3]) sender.offer({ place: [x, 0, 0] });
  assert.deepEqual(sent, [{ gesture: 4, seq: 1, place: [1, 0, 0] }]);
  sender.answered(0);
  assert.equal(sent.length, 1, 'an answer to an older one does not count');
  sender.answered(1);
  assert.deepEqual(sent[1], { gesture: 4, seq: 2, place: [3, 0, 0] });
  sender.offer({ place: [4, 0, 0] });
  assert.deepEqual(sender.last(), { gesture: 4, seq: 3, place: [4, 0, 0] });
  assert.deepEqual(sender.last(), { gesture: 4, seq: 3, place: [4, 0, 0] }, 'what has been sent goes with the release as well');
});
