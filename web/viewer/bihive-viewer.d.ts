/** What `bihive-load` brings: event.detail. */
export interface LoadedSpheres {
  name: string;
  format: string;
  spheres: number;
  frames: number;
}

/** What `bihive-error` brings: event.detail. */
export interface FailedLoad {
  message: string;
}

/**
 * Attributes: `src`, the address of a file of any format that bihive reads, or of a scene file (without it the bundled molecule);
 * `look`, a style's name (`style` may hold it too); `background`; `colour-by`, as --colour-by; `radius`, one for all spheres, in
 * world units; `columns`, as --columns; `panel`, which shows the page's controls.
 */
export class BihiveViewer extends HTMLElement {
  src: string | null;
  look: string;
  addEventListener(type: 'bihive-load', listener: (event: CustomEvent<LoadedSpheres>) => void): void;
  addEventListener(type: 'bihive-error', listener: (event: CustomEvent<FailedLoad>) => void): void;
  addEventListener<K extends keyof HTMLElementEventMap>(
    type: K,
    listener: (event: HTMLElementEventMap[K]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
}

declare global {
  interface HTMLElementTagNameMap {
    'bihive-viewer': BihiveViewer;
  }
}
