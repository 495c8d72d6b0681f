// What the page needs of a browser.

/** The first versions with WebAssembly's exceptions (Chrome, Edge) and OffscreenCanvas (Firefox, Safari). */
export const able_browsers = 'Chrome 95, Edge 95, Firefox 105, Safari 17';

/** The first feature that this browser lacks, or nothing. */
export function lacking(): string {
  if (typeof WebAssembly === 'undefined') return 'WebAssembly';
  if (!('Tag' in WebAssembly)) return 'WebAssembly exceptions';
  const has_canvas = typeof OffscreenCanvas !== 'undefined' && 'transferControlToOffscreen' in HTMLCanvasElement.prototype;
  return has_canvas ? '' : 'OffscreenCanvas';
}
