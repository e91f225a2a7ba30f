// SPDX-License-Identifier: MIT
// What a server that knows the token can say of a nonce, and no other: HMAC-SHA256 in hex.

/** @param {Uint8Array} bytes */
const hex = (bytes) => [...bytes].map((byte) => byte.toString(16).padStart(2, '0')).join('');

/** Whether this browser can tell; it can on every page from this machine. */
export const canProve = () => !!globalThis.crypto?.subtle;

/** 32 bytes that nobody knows before. */
export const newNonce = () => hex(globalThis.crypto.getRandomValues(new Uint8Array(32)));

/** @param {string} token @param {string} nonce @returns {Promise<string>} */
export async function proofOf(token, nonce) {
  const bytes = (/** @type {string} */ text) => new TextEncoder().encode(text);
  // a key ends with as many zeros as one likes
  const key = await crypto.subtle.importKey('raw', bytes(token || '\0'), { name: 'HMAC', hash: 'SHA-256' }, false, ['sign']);
  return hex(new Uint8Array(await crypto.subtle.sign('HMAC', key, bytes(nonce))));
}
