// Pixels as video encoders take them: BT.709 with limited range, as `bihive film` writes it. The browser's own conversion would
// take BT.601 without saying so, and players would show other colours than those of the pictures.

/** What the numbers of an I420 picture mean. */
export const film_colours = { primaries: 'bt709', transfer: 'bt709', matrix: 'bt709', fullRange: false } as const;

const red = 0.2126, green = 0.7152, blue = 0.0722;

/** Brightness of each pixel, then blue and red less brightness of every two by two; `width` and `height` are even. What is transparent becomes white. */
export function i420_of(pixels: Uint8Array, channels: 3 | 4, width: number, height: number): Uint8Array<ArrayBuffer> {
  const count = width * height;
  const made = new Uint8Array(count + count / 2);
  // Of the last two rows.
  const less = [0, 1].map(() => ({ blue: new Float32Array(width), red: new Float32Array(width) }));
  const brightness = 219 / 255, of_blue = 224 / 255 / (2 - 2 * blue), of_red = 224 / 255 / (2 - 2 * red);
  const [blues, reds] = [made.subarray(count, count + count / 4), made.subarray(count + count / 4)];
  for (let y = 0; y < height; ++y) {
    const row = less[y % 2]!;
    for (let x = 0; x < width; ++x) {
      const at = channels * (y * width + x);
      const opacity = channels === 4 ? pixels[at + 3]! / 255 : 1;
      const white = 255 * (1 - opacity);
      const [r, b] = [pixels[at]! * opacity + white, pixels[at + 2]! * opacity + white];
      const bright = red * r + green * (pixels[at + 1]! * opacity + white) + blue * b;
      made[y * width + x] = Math.round(16 + brightness * bright);
      row.blue[x] = of_blue * (b - bright);
      row.red[x] = of_red * (r - bright);
    }
    if (y % 2 === 0) continue;
    // The colours belong to the left pixels of each four, between the rows: players take them so.
    const colour = (kind: 'blue' | 'red', x: number) => {
      const sum = (one: Float32Array) => (x > 0 ? one[x - 1]! : one[x]!) + 2 * one[x]! + one[x + 1]!;
      return Math.round(128 + (sum(less[0]![kind]) + sum(less[1]![kind])) / 8);
    };
    for (let x = 0, at = ((y - 1) / 2) * (width / 2); x < width; x += 2, ++at) {
      blues[at] = colour('blue', x);
      reds[at] = colour('red', x);
    }
  }
  return made;
}
