type Triple = [x: number, y: number, z: number];

/** What a scene is: event.detail of `bihive-load`, and the value of load(). */
export interface LoadedSpheres {
  name: string;
  format: string;
  spheres: number;
  frames: number;
}

/** event.detail of `bihive-error`. */
export interface FailedLoad {
  message: string;
}

/** As the camera of a scene file. Lengths are in world units, the angle in degrees. */
export interface ViewerCamera {
  eye: Triple;
  look_at: Triple;
  up: Triple;
  fov_deg: number;
  projection: 'perspective' | 'orthographic';
  /** Of an orthographic picture. */
  shorter_side: number;
  aperture: number;
  /** The distance that is sharp; 0: that of `look_at`. */
  focus: number;
}

/** The sphere at a place of the picture. */
export interface Picked {
  /** Its number in the shown set, from 0. */
  sphere: number;
  /** On its surface. */
  point: Triple;
  /** Of that point from the eye. */
  distance: number;
  centre: Triple;
  radius: number;
  /** All that the file says of it, by the names that --select knows; null: unknown. */
  attributes: Record<string, number | string | null>;
}

/** event.detail of `bihive-pick`: the place in CSS pixels from the upper left corner, and what is there. */
export interface PickedAt {
  x: number;
  y: number;
  picked: Picked | null;
}

export interface ViewerEventMap {
  'bihive-load': CustomEvent<LoadedSpheres>;
  'bihive-error': CustomEvent<FailedLoad>;
  'bihive-camera': CustomEvent<ViewerCamera>;
  'bihive-pick': CustomEvent<PickedAt>;
}

/**
 * Attributes: `src`, the address of a file of any format that bihive reads, or of a scene file (without it the bundled molecule);
 * `look`, a style's name (`style` may hold it too); `background`, a colour, or "transparent"; `colour-by`, as --colour-by; `radius`,
 * one for all spheres, in world units; `columns`, as --columns; `panel`, which shows the page's controls; `badge`, which shows the
 * name; `interactive`, which takes wheel and swipes without a click.
 */
export class BihiveViewer extends HTMLElement {
  src: string | null;
  look: string;
  /** Null before the first scene. Members that are left out stay; one that is set before a scene is there waits for it. */
  get camera(): ViewerCamera | null;
  set camera(camera: Partial<ViewerCamera>);
  /** Whether it takes wheel, swipes and keys. */
  active: boolean;
  /**
   * Shows spheres that the page has, instead of those of `src`. Formats are known by the end of `name` (a File has its own) or by the
   * content. Rejects if the data cannot be read; the shown scene stays.
   */
  load(data: BlobPart, options?: { name?: string; trajectory?: File | null }): Promise<LoadedSpheres>;
  /** The sphere at a place in CSS pixels from the upper left corner, by an exact ray. */
  pick(x: number, y: number): Promise<Picked | null>;
  /** A PNG of all samples, in pixels; by default of the size on the screen. A transparent background has opacity. */
  toBlob(size?: { width?: number; height?: number }): Promise<Blob>;
  addEventListener<K extends keyof ViewerEventMap>(
    type: K,
    listener: (event: ViewerEventMap[K]) => void,
    options?: boolean | AddEventListenerOptions,
  ): void;
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
