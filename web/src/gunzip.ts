// Unpacks files packed with gzip by the browser, before the module sees them.
import { BadInput } from './module';

async function is_packed(content: Blob): Promise<boolean> {
  const start = new Uint8Array(await content.slice(0, 2).arrayBuffer());
  return start[0] === 0x1f && start[1] === 0x8b;
}

/** The content itself if it is not packed. Throws BadInput if it is packed but broken, or cannot be read. */
export async function unpacked(content: Blob, name: string): Promise<Blob> {
  const packed = await is_packed(content).catch(() => {
    throw new BadInput(`${name} cannot be read: it may have been changed or moved since it was chosen`);
  });
  if (!packed) return content;
  if (typeof DecompressionStream === 'undefined')
    throw new BadInput(`${name}: this browser cannot undo gzip; unpack the file first`);
  try {
    return await new Response(content.stream().pipeThrough(new DecompressionStream('gzip'))).blob();
  } catch {
    throw new BadInput(`${name}: the gzip data is broken or cut`);
  }
}
