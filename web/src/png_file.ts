// In the worker for figures: reads PNG files of bihive as they are, bit by bit. The browser's own pictures have 8 bits, and
// colours multiplied by opacity.
import { BadInput } from './module';
import { crc_of } from './png';

export interface PngFile {
  width: number;
  height: number;
  channels: 3 | 4;
  bits: 8 | 16;
  record: string; // the text `bihive`; empty if there is none
  pixels(): Promise<Uint8Array>; // row by row from the top; of 16 bits the higher byte comes first
}

const signature = [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a];
const keyword = 'bihive\0';

interface Chunk {
  type: string;
  data: Uint8Array<ArrayBuffer>;
}

// All of them, with their check sums compared.
function chunks_of(bytes: Uint8Array<ArrayBuffer>): Chunk[] {
  if (!signature.every((byte, i) => bytes[i] === byte)) throw new BadInput('is no PNG, whatever its name says');
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const chunks: Chunk[] = [];
  for (let at = signature.length; at + 12 <= bytes.length; ) {
    const length = view.getUint32(at);
    const end = at + 8 + length;
    if (end + 4 > bytes.length || view.getUint32(end) !== crc_of(bytes.subarray(at + 4, end))) break;
    const type = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    chunks.push({ type, data: bytes.subarray(at + 8, end) });
    if (type === 'IEND') return chunks;
    at = end + 4;
  }
  throw new BadInput('is damaged: the end of it is missing, or bytes of it were changed');
}

const latin1 = (bytes: Uint8Array) => new TextDecoder('latin1').decode(bytes);

// Undoes the filter of each row.
function unfiltered(packed: Uint8Array, row: number, height: number, pixel: number): Uint8Array {
  const bytes = new Uint8Array(row * height);
  for (let y = 0; y < height; ++y) {
    const filter = packed[y * (row + 1)]!;
    if (filter > 4) throw new BadInput('is damaged: its pixels cannot be unpacked');
    for (let i = 0, at = y * row, from = y * (row + 1) + 1; i < row; ++i, ++at, ++from) {
      const left = i < pixel ? 0 : bytes[at - pixel]!;
      const up = y === 0 ? 0 : bytes[at - row]!;
      let guess = 0;
      if (filter === 1) guess = left;
      else if (filter === 2) guess = up;
      else if (filter === 3) guess = (left + up) >> 1;
      else if (filter === 4) {
        const corner = i < pixel || y === 0 ? 0 : bytes[at - row - pixel]!;
        const [a, b, c] = [Math.abs(up - corner), Math.abs(left - corner), Math.abs(left + up - 2 * corner)];
        guess = a <= b && a <= c ? left : b <= c ? up : corner;
      }
      bytes[at] = packed[from]! + guess;
    }
  }
  return bytes;
}

/** Throws BadInput, without the file's name, if it is damaged, or has another form than bihive's pictures. */
export async function read_png(file: Blob): Promise<PngFile> {
  const chunks = chunks_of(new Uint8Array(await file.arrayBuffer()));
  const record = chunks.find(({ type, data }) => type === 'tEXt' && latin1(data.subarray(0, keyword.length)) === keyword);
  const header = chunks[0]!;
  if (header.type !== 'IHDR' || header.data.length !== 13) throw new BadInput('is damaged: it has no header');
  const view = new DataView(header.data.buffer, header.data.byteOffset);
  const [width, height] = [view.getUint32(0), view.getUint32(4)];
  const [bits, colour, interlace] = [header.data[8]!, header.data[9]!, header.data[12]!];
  const channels = colour === 6 ? 4 : 3;
  const is_ours = (bits === 8 || bits === 16) && (colour === 2 || colour === 6) && interlace === 0;
  const pixels = async () => {
    if (!is_ours) throw new BadInput('holds its pixels in a form that bihive does not write: another program saved it');
    const row = (width * channels * bits) / 8;
    const data = new Blob(chunks.filter(({ type }) => type === 'IDAT').map((chunk) => chunk.data));
    const packed = await new Response(data.stream().pipeThrough(new DecompressionStream('deflate')))
      .arrayBuffer()
      .catch(() => null);
    if (packed?.byteLength !== (row + 1) * height) throw new BadInput('is damaged: its pixels cannot be unpacked');
    return unfiltered(new Uint8Array(packed), row, height, (channels * bits) / 8);
  };
  return { width, height, channels, bits: bits as 8 | 16, record: record ? latin1(record.data.subarray(keyword.length)) : '', pixels };
}
