// SPDX-License-Identifier: MIT
// How the impacts of two motions differ, as people are told: who met whom how often, and which those are.

/** @typedef {import('./types.js').Motion} Motion */
/** @typedef {import('./types.js').Impact} Impact */

/** @param {Impact[]} impacts @returns {Map<string, Impact[]>} by who meets whom */
function byPair(impacts) {
  const map = new Map();
  for (const impact of impacts) {
    for (const [a, b] of impact.pairs) {
      const key = `${Math.min(a, b)} ${Math.max(a, b)}`;
      map.set(key, [...(map.get(key) ?? []), impact]);
    }
  }
  return map;
}

/** @param {Motion} before @param {Motion} now
 * @returns {{pair: [number, number], before: number, now: number}[]} pairs that meet more or less often than before */
export function countsThatChanged(before, now) {
  const were = byPair(before.impacts), are = byPair(now.impacts), found = [];
  for (const key of new Set([...were.keys(), ...are.keys()])) {
    const [a, b] = key.split(' ').map(Number), count_before = were.get(key)?.length ?? 0, count_now = are.get(key)?.length ?? 0;
    if (count_before !== count_now) found.push({ pair: /** @type {[number, number]} */ ([a, b]), before: count_before, now: count_now });
  }
  return found;
}

/** The impacts behind the counts: of each pair the last ones, as many as it has more or fewer. @param {Motion} before
 * @param {Motion} now @returns {{impact: Impact, pair: [number, number], came: boolean}[]} */
export function impactsThatChanged(before, now) {
  return countsThatChanged(before, now).flatMap(({ pair, before: were, now: are }) => {
    const all = (are > were ? now : before).impacts.filter((one) => one.pairs.some(([a, b]) => pair.includes(a) && pair.includes(b)));
    return all.slice(-Math.abs(are - were)).map((impact) => ({ impact, pair, came: are > were }));
  });
}

/** "Other impacts: hat and coatrack ×1 went". Empty where nothing changed. @param {Motion} before @param {Motion} now
 * @param {string[]} names @param {number} most pairs that are named */
export function changesText(before, now, names, most = 3) {
  const counts = countsThatChanged(before, now);
  if (!counts.length) return '';
  const words = counts.slice(0, most).map(({ pair: [a, b], before: were, now: are }) =>
    `${names[a]} and ${names[b]} ×${Math.abs(are - were)} ${are > were ? 'came' : 'went'}`);
  const rest = counts.length > most ? `, and ${counts.length - most} more` : '';
  return `Other impacts: ${words.join(', ')}${rest}`;
}
