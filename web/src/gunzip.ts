// Unpacks files packed with gzip by the browser, before the module sees them.
import { BadInput } from './module';

export function is_packed(bytes: Uint8Array): boolean {
  return bytes[0] === 0x1f && bytes[1] === 0x8b;
}

/** The bytes themselves where they are not packed. Throws BadInput where they are, and broken. */
export async function unpacked(bytes: Uint8Array<ArrayBuffer>, name: string): Promise<Uint8Array> {
  if (!is_packed(bytes)) return bytes;
  if (typeof DecompressionStream === 'undefined')
    throw new BadInput(`${name}: this browser cannot undo gzip; unpack the file first`);
  try {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  } catch {
    throw new BadInput(`${name}: the gzip data is broken or cut`);
  }
}
