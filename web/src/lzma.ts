// Unpacks LZMA ("xz --format=lzma"), which packs the module a third smaller than gzip; browsers undo gzip alone.
// After the specification of the LZMA SDK: a range decoder of bits, each with the probability that its context has learnt.

const least_range = 2 ** 24;
const half = 1024; // of 2048: a probability

/** All bytes of a packed file. Throws where it is damaged. */
export function unpacked_lzma(packed: Uint8Array): Uint8Array<ArrayBuffer> {
  let at = 13;
  const view = new DataView(packed.buffer, packed.byteOffset, packed.byteLength);
  const properties = packed[0]!;
  const literal_bits = properties % 9;
  const place_bits = Math.floor(properties / 9) % 5;
  const align_bits = Math.floor(properties / 45);
  const known_size = view.getUint32(9, true) === 0;
  let out = new Uint8Array(known_size ? view.getUint32(5, true) : 4 * packed.length);
  let size = 0;

  // Bits.
  const numbers = new Uint32Array([0xffffffff, 0]); // range and code: in closures, numbers of 32 bits would be boxed
  const next_byte = () => {
    if (at >= packed.length) throw new Error('the packed data is cut');
    return packed[at++]!;
  };
  for (let i = 0; i < 5; ++i) numbers[1] = ((numbers[1]! << 8) | next_byte()) >>> 0;
  const learnt = (count: number) => new Uint16Array(count).fill(half);
  const refill = () => {
    if (numbers[0]! >= least_range) return;
    numbers[0] = (numbers[0]! << 8) >>> 0;
    numbers[1] = ((numbers[1]! << 8) | next_byte()) >>> 0;
  };
  const bit = (contexts: Uint16Array, context: number): number => {
    const probability = contexts[context]!;
    const bound = (numbers[0]! >>> 11) * probability;
    const one = numbers[1]! >= bound;
    if (one) {
      numbers[0]! -= bound;
      numbers[1]! -= bound;
      contexts[context] = probability - (probability >> 5);
    } else {
      numbers[0] = bound;
      contexts[context] = probability + ((2048 - probability) >> 5);
    }
    refill();
    return one ? 1 : 0;
  };
  const even_bits = (count: number): number => {
    let number = 0;
    for (let i = 0; i < count; ++i) {
      numbers[0]! >>>= 1;
      const one = numbers[1]! >= numbers[0]!;
      if (one) numbers[1]! -= numbers[0]!;
      number = number * 2 + (one ? 1 : 0);
      refill();
    }
    return number;
  };
  const number_of_bits = (contexts: Uint16Array, count: number, first = 0): number => {
    let number = 1;
    for (let i = 0; i < count; ++i) number = 2 * number + bit(contexts, first + number);
    return number - (1 << count);
  };
  const reversed_bits = (contexts: Uint16Array, count: number, first = 0): number => {
    let [number, context] = [0, 1];
    for (let i = 0; i < count; ++i) {
      const one = bit(contexts, first + context);
      context = 2 * context + one;
      number |= one << i;
    }
    return number;
  };

  // Lengths of copies.
  const lengths = () => ({ choice: learnt(2), low: learnt(16 << 3), middle: learnt(16 << 3), high: learnt(256) });
  type Lengths = ReturnType<typeof lengths>;
  const length_of = ({ choice, low, middle, high }: Lengths, place: number): number => {
    if (!bit(choice, 0)) return 2 + number_of_bits(low, 3, place << 3);
    if (!bit(choice, 1)) return 10 + number_of_bits(middle, 3, place << 3);
    return 18 + number_of_bits(high, 8);
  };

  const room = (more: number) => {
    if (size + more <= out.length) return;
    if (known_size) throw new Error('the packed data is damaged');
    const larger = new Uint8Array(Math.max(2 * out.length, size + more));
    larger.set(out);
    out = larger;
  };

  const literals = learnt(0x300 << (literal_bits + place_bits));
  const [is_match, is_repeat] = [learnt(12 << 4), learnt(12)];
  const [is_older, is_second, is_third, is_long] = [learnt(12), learnt(12), learnt(12), learnt(12 << 4)];
  const slots = learnt(4 << 6);
  const [middle_distances, low_distances] = [learnt(128), learnt(16)];
  const [new_lengths, repeated_lengths] = [lengths(), lengths()];
  const last = [0, 0, 0, 0]; // distances less one
  let state = 0; // of the last steps: literals below 7

  while (!known_size || size < out.length) {
    const place = size & ((1 << align_bits) - 1);
    if (!bit(is_match, (state << 4) + place)) {
      room(1);
      const before = size > 0 ? out[size - 1]! : 0;
      const context = ((size & ((1 << place_bits) - 1)) << literal_bits) + (before >> (8 - literal_bits));
      const first = 0x300 * context;
      let symbol = 1;
      if (state >= 7) {
        let other = out[size - last[0]! - 1]!;
        while (symbol < 0x100) {
          const other_bit = (other >> 7) & 1;
          other <<= 1;
          const one = bit(literals, first + ((1 + other_bit) << 8) + symbol);
          symbol = 2 * symbol + one;
          if (one !== other_bit) break;
        }
      }
      while (symbol < 0x100) symbol = 2 * symbol + bit(literals, first + symbol);
      out[size++] = symbol & 0xff;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let length: number;
    if (!bit(is_repeat, state)) {
      length = length_of(new_lengths, place);
      state = state < 7 ? 7 : 10;
      const slot = number_of_bits(slots, 6, Math.min(length - 2, 3) << 6);
      let distance = slot;
      if (slot >= 4) {
        const more = (slot >> 1) - 1;
        distance = (2 | (slot & 1)) * 2 ** more;
        distance += slot < 14
          ? reversed_bits(middle_distances, more, distance - slot)
          : even_bits(more - 4) * 16 + reversed_bits(low_distances, 4);
      }
      if (distance === 0xffffffff) return out.slice(0, size); // the mark of the end
      last.unshift(distance);
      last.pop();
    } else {
      if (!bit(is_older, state)) {
        if (!bit(is_long, (state << 4) + place)) {
          room(1);
          out[size] = out[size - last[0]! - 1]!;
          ++size;
          state = state < 7 ? 9 : 11;
          continue;
        }
      } else {
        const which = !bit(is_second, state) ? 1 : !bit(is_third, state) ? 2 : 3;
        last.unshift(...last.splice(which, 1));
      }
      length = length_of(repeated_lengths, place);
      state = state < 7 ? 8 : 11;
    }
    const from = size - last[0]! - 1;
    if (from < 0) throw new Error('the packed data is damaged');
    room(length);
    for (let i = 0; i < length; ++i) out[size + i] = out[from + i]!;
    size += length;
  }
  return out;
}
