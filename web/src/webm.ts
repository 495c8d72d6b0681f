// Writes encoded frames of a film as a WebM file (Matroska's elements, https://www.matroska.org/technical/elements.html).

export interface EncodedFrame {
  bytes: Uint8Array<ArrayBuffer>;
  time_ms: number;
  is_key: boolean;
}

export interface FilmFormat {
  codec: 'V_VP8' | 'V_VP9';
  width: number;
  height: number;
  duration_ms: number;
}

type Bytes = Uint8Array<ArrayBuffer>;

const longest_cluster_ms = 30_000; // a block's time is 16 bits relative to its cluster's

const text = (value: string): Bytes => new TextEncoder().encode(value);

function whole(value: number): Bytes {
  const bytes: number[] = [];
  for (let left = value; left > 0 || bytes.length === 0; left = Math.floor(left / 256)) bytes.unshift(left % 256);
  return Uint8Array.from(bytes);
}

function real(value: number): Bytes {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, value);
  return new Uint8Array(view.buffer);
}

// Eight bytes, the first of which says so.
function size_of(length: number): Bytes {
  const view = new DataView(new ArrayBuffer(8));
  view.setUint32(0, 0x01000000 + Math.floor(length / 2 ** 32));
  view.setUint32(4, length >>> 0);
  return new Uint8Array(view.buffer);
}

function element(id: number, ...parts: Bytes[]): Bytes {
  const length = parts.reduce((sum, part) => sum + part.length, 0);
  const made = [whole(id), size_of(length), ...parts];
  const bytes = new Uint8Array(made.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of made) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

const header = () =>
  element(
    0x1a45dfa3,
    element(0x4286, whole(1)), element(0x42f7, whole(1)), // versions of EBML
    element(0x42f2, whole(4)), element(0x42f3, whole(8)), // longest id, longest size
    element(0x4282, text('webm')), element(0x4287, whole(4)), element(0x4285, whole(2)),
  );

const information = (duration_ms: number) =>
  element(
    0x1549a966,
    element(0x2ad7b1, whole(1_000_000)), // times are in milliseconds
    element(0x4489, real(duration_ms)), element(0x4d80, text('bihive')), element(0x5741, text('bihive')),
  );

// BT.709 with limited range (film_pixels.ts): matrix, range, transfer, primaries, and where the colours of four pixels belong.
const colours = () =>
  element(
    0x55b0,
    element(0x55b1, whole(1)), element(0x55b9, whole(1)), element(0x55ba, whole(1)), element(0x55bb, whole(1)),
    element(0x55b7, whole(1)), element(0x55b8, whole(2)),
  );

const track = ({ codec, width, height }: FilmFormat) =>
  element(
    0x1654ae6b,
    element(
      0xae,
      element(0xd7, whole(1)), element(0x73c5, whole(1)), element(0x83, whole(1)), // number, id, video
      element(0x9c, whole(0)), element(0x86, text(codec)), // no lacing
      element(0xe0, element(0xb0, whole(width)), element(0xba, whole(height)), colours()),
    ),
  );

function block({ bytes, time_ms, is_key }: EncodedFrame, cluster_ms: number): Bytes {
  const head = new DataView(new ArrayBuffer(4));
  head.setUint8(0, 0x81); // track 1
  head.setInt16(1, time_ms - cluster_ms);
  head.setUint8(3, is_key ? 0x80 : 0);
  return element(0xa3, new Uint8Array(head.buffer), bytes);
}

/** The frames are in the order of their times, which are whole milliseconds; the first one is a key frame. */
export function webm_of(frames: EncodedFrame[], format: FilmFormat): Blob {
  // A cluster begins at a key frame, so that players can begin there.
  const clusters: EncodedFrame[][] = [];
  for (const frame of frames) {
    const last = clusters.at(-1);
    if (!last || frame.is_key || frame.time_ms - last[0]!.time_ms > longest_cluster_ms) clusters.push([frame]);
    else last.push(frame);
  }
  const parts = clusters.map((cluster) => {
    const begin = cluster[0]!.time_ms;
    return element(0x1f43b675, element(0xe7, whole(begin)), ...cluster.map((frame) => block(frame, begin)));
  });
  return new Blob([header(), element(0x18538067, information(format.duration_ms), track(format), ...parts)], { type: 'video/webm' });
}
