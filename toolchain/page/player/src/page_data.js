// Reads the data of the page: a compressed header with columns of numbers.

/** Returns the text of the element as bytes: base64 of a zlib stream. */
async function inflate(text) {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Returns the whole numbers of a column: four planes of bytes, of differences with the sign in the lowest bit. */
function wholeNumbers(bytes, { offset, count }) {
  const numbers = new Int32Array(count);
  let number = 0;
  for (let i = 0; i < count; ++i) {
    const at = offset + i;
    const folded =
      bytes[at] | (bytes[at + count] << 8) | (bytes[at + 2 * count] << 16) | (bytes[at + 3 * count] << 24);
    number = (number + ((folded >>> 1) ^ -(folded & 1))) | 0;
    numbers[i] = number;
  }
  return numbers;
}

/** Returns a copy of the header in which each column is an array of numbers. */
function withColumns(value, bytes) {
  if (Array.isArray(value)) return value.map((item) => withColumns(item, bytes));
  if (value === null || typeof value !== 'object') return value;
  if ('offset' in value && 'count' in value) {
    const whole = wholeNumbers(bytes, value);
    return value.step === 1 ? whole : Float64Array.from(whole, (n) => n * value.step);
  }
  return Object.fromEntries(Object.entries(value).map(([key, item]) => [key, withColumns(item, bytes)]));
}

/** Returns the data of the page. README.md lists the keys. */
export async function readPageData(element) {
  const all = await inflate(element.textContent);
  const length = new DataView(all.buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(all.subarray(4, 4 + length)));
  return withColumns(header, all.subarray(4 + length));
}
