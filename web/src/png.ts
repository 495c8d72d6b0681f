// Writes PNG files. The canvas cannot: it multiplies colours by their opacity and so loses some of their bits.

const crc_table = Uint32Array.from({ length: 256 }, (_, byte) => {
  let crc = byte;
  for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xedb88320 ^ (crc >>> 1) : crc >>> 1;
  return crc;
});

export function crc_of(bytes: Uint8Array): number {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = crc_table[(crc ^ byte) & 0xff]! ^ (crc >>> 8);
  return ~crc >>> 0;
}

function chunk(type: string, data: Uint8Array): Uint8Array<ArrayBuffer> {
  const bytes = new Uint8Array(data.length + 12);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, data.length);
  for (let i = 0; i < 4; ++i) bytes[4 + i] = type.charCodeAt(i);
  bytes.set(data, 8);
  view.setUint32(data.length + 8, crc_of(bytes.subarray(4, data.length + 8)));
  return bytes;
}

function header(width: number, height: number, channels: 3 | 4): Uint8Array {
  const bytes = new Uint8Array(13);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, width);
  view.setUint32(4, height);
  bytes.set([8, channels === 4 ? 6 : 2], 8); // bits; colour with or without opacity
  return bytes;
}

// Each row after the number of its filter: the difference from the row above, which packs well.
function* filtered_rows(pixels: Uint8Array, row: number, height: number): Generator<Uint8Array<ArrayBuffer>> {
  for (let y = 0; y < height; ++y) {
    const bytes = new Uint8Array(row + 1);
    bytes[0] = 2;
    for (let i = 0, at = y * row; i < row; ++i, ++at) bytes[i + 1] = pixels[at]! - (y > 0 ? pixels[at - row]! : 0);
    yield bytes;
  }
}

/** A file of 8 bits per channel. `pixels`: row by row from the top; a colour is not multiplied by its opacity. */
export async function png_of(pixels: Uint8Array, width: number, height: number, channels: 3 | 4): Promise<Blob> {
  const packer = new CompressionStream('deflate');
  const packed = new Response(packer.readable).arrayBuffer();
  const writer = packer.writable.getWriter();
  for (const row of filtered_rows(pixels, width * channels, height)) await writer.write(row);
  await writer.close();
  const parts = [
    Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a),
    chunk('IHDR', header(width, height, channels)),
    chunk('IDAT', new Uint8Array(await packed)),
    chunk('IEND', new Uint8Array(0)),
  ];
  return new Blob(parts, { type: 'image/png' });
}
