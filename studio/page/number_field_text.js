// SPDX-License-Identifier: MIT
// What a number field understands: decimal numbers, + - * / and brackets.

/** @param {string} text @returns {number | null} none where it is no number; never NaN nor infinite */
export function evaluate(text) {
  const tokens = text.replaceAll('−', '-').match(/\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?|[-+*/()]|\S/g) ?? [];
  let i = 0;
  /** @returns {number} */
  const sum = () => {
    let value = product();
    while (tokens[i] === '+' || tokens[i] === '-') value = tokens[i++] === '+' ? value + product() : value - product();
    return value;
  };
  /** @returns {number} */
  const product = () => {
    let value = factor();
    while (tokens[i] === '*' || tokens[i] === '/') value = tokens[i++] === '*' ? value * factor() : value / factor();
    return value;
  };
  /** @returns {number} */
  const factor = () => {
    const token = tokens[i++];
    if (token === '-') return -factor();
    if (token === '+') return factor();
    if (token === '(') {
      const value = sum();
      return tokens[i++] === ')' ? value : NaN;
    }
    return token !== undefined && /^[\d.]/.test(token) ? Number(token) : NaN;
  };
  if (tokens.length > 200) return null;
  const value = sum();
  return i === tokens.length && Number.isFinite(value) ? value : null;
}

/** For people: as many digits as tell values of this natural scale apart, so that a column of them is even.
 * @param {number} value @param {number} scale */
export function shortNumber(value, scale = 1) {
  if (!Number.isFinite(value)) return '–';
  const size = Math.max(Math.abs(value), Math.abs(scale));
  if (value !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(3).replace(/^-/, '−');
  const digits = Math.max(0, Math.min(5, 3 - Math.floor(Math.log10(Math.max(Math.abs(scale), 1e-6)) + 1e-9)));
  return value.toFixed(digits).replace(/^-(?=0\.?0*$)/, '').replace('-', '−');
}

/** The step of an arrow key: a hundredth of the natural scale, rounded down to a power of ten.
 * @param {number} scale */
export function stepOf(scale) {
  return 10 ** Math.floor(Math.log10(Math.max(Math.abs(scale), 1e-9) / 10 + 1e-12));
}

/** A length with its unit. @param {number} metres */
export function lengthText(metres) {
  const size = Math.abs(metres);
  if (size < 5e-6) return 'less than 0.01 mm';
  if (size < 9.95e-4) return `${(metres * 1e3).toFixed(2)} mm`;
  if (size < 0.0995) return `${(metres * 1e3).toPrecision(size < 0.00995 ? 2 : 3)} mm`;
  return `${Number(metres.toPrecision(3))} m`;
}

/** A sentence for people: numbers with more decimals than anybody reads have three digits. What stands between quotes
 * is a name. @param {string} text */
export function forPeople(text) {
  const short = (/** @type {string} */ digits) => {
    const value = Number(digits), size = Math.abs(value);
    return size !== 0 && (size < 1e-3 || size >= 1e6) ? value.toPrecision(3) : String(Number(value.toPrecision(3)));
  };
  return text.split(/('[^']*')/).map((part, i) => (i % 2 ? part : part.replace(/-?\d+\.\d{4,}(?:e[-+]?\d+)?/g, short))).join('');
}
