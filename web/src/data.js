// The data of a page: JSON in <script type="application/json" id="data">, its long columns packed.
// A packed column is whole numbers, second differences (less those of the earlier column `like`, times
// `sign`), zigzag, 7 bits a byte; all columns of a page are deflated together, in base64.

export function pageData() {
  return JSON.parse(document.getElementById("data").textContent);
}

async function inflated(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Columns by name as Float64Array of `count` values: whole number times step. */
export async function unpacked({ count, columns, packed }) {
  const bytes = await inflated(packed);
  const result = {};
  let at = 0;
  const next = () => {
    let value = 0, factor = 1;
    for (;;) {
      const byte = bytes[at++];
      value += (byte & 127) * factor;
      if (byte < 128) return value % 2 ? -(value + 1) / 2 : value / 2;
      factor *= 128;
    }
  };
  const whole = [];
  for (const { like, sign } of columns) {
    const values = new Float64Array(count), other = whole[like];
    let value = 0, slope = 0;
    for (let i = 0; i < count; ++i) {
      slope += next();
      if (other) slope += sign * (other[i] - 2 * (other[i - 1] ?? 0) + (other[i - 2] ?? 0));
      value += slope;
      values[i] = value;
    }
    whole.push(values);
  }
  columns.forEach(({ name, step }, k) => { result[name] = whole[k].map((value) => value * step); });
  return result;
}
