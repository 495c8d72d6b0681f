// The page around the frame: the component <bihive-viewer> (web/viewer/bihive-viewer.js), which speaks for it. Messages go
// to and come from a page of the same origin alone: names of files are private. A page that is one file may be the text of
// a frame (srcdoc), as in a notebook: who gave that text knows all of it, and may hand in a port for the same messages.
import { element } from './dom';
import { has_host, show_parts } from './embedded';
import type { Camera, Facts, Look, Picked, Reading, Settings, Source } from './protocol';

/** To the page around. `id`: of the request that it answers, if any. Places are in pixels of the page, from the picture's
 * upper left corner. */
type Told =
  | { bihive: 'ready'; threads: boolean } // to begin
  | { bihive: 'started' } // it takes requests
  | { bihive: 'loaded'; id: number | null; name: string; format: string; spheres: number; frames: number }
  | { bihive: 'failed'; id: number | null; message: string }
  | { bihive: 'answer'; id: number; value: unknown }
  | { bihive: 'camera'; camera: Camera }
  | { bihive: 'picked'; x: number; y: number; picked: Picked | null }
  | { bihive: 'pins'; pins: Picked[] } // through a port
  | { bihive: 'entered' | 'left'; by_key?: boolean };

/** From the page around. */
type Asked =
  | { bihive: 'begin'; wasm: WebAssembly.Module | null }
  | { bihive: 'parts'; panel: boolean; badge: boolean }
  | { bihive: 'open'; id: number; source: Source; file: File | null; trajectory: File | null; look: AskedLook; camera: Partial<Camera> | null }
  | { bihive: 'look'; look: AskedLook }
  | { bihive: 'reading'; id: number; reading: Reading }
  | { bihive: 'camera'; camera: Partial<Camera> }
  | { bihive: 'pick'; id: number; x: number; y: number }
  | { bihive: 'picture'; id: number; width: number | null; height: number | null };

type AskedLook = Partial<Pick<Look, 'style' | 'background' | 'colour_by'>>;

/** What the page does for the page around it. */
export interface HostActions {
  /** Both return the id of the load. */
  open(wanted: Omit<Asked & { bihive: 'open' }, 'bihive' | 'id'>): number;
  read_again(reading: Reading | undefined): number;
  look(changes: AskedLook): void;
  camera(changes: Partial<Camera>): void;
  /** Both return the id of the request; `x` and `y` in pixels of the page. */
  pick(x: number, y: number): number;
  draw(width: number | null, height: number | null): number;
}

const most_click_px = 4; // the pointer moves while a button is clicked

export class Host {
  private actions: HostActions | null = null;
  private readonly ids = new Map<number, number>(); // of the engine's requests: the host's
  private readonly clicks = new Map<number, { x: number; y: number }>(); // the engine's requests: where
  private readonly drawn: number[] = []; // the engine's requests of pictures
  private readonly looks: AskedLook[] = []; // to be asked for, one member each
  private waiting: Asked | null = null; // until these looks are taken
  private asked_look: AskedLook = {}; // with the last scene
  private last_camera = '';
  private last_pins = '[]';
  private shown = false;
  private port: MessagePort | null = null;
  private begun = (_: WebAssembly.Module | null): void => {};

  constructor() {
    if (parent === window || location.href !== 'about:srcdoc') return;
    addEventListener('message', ({ source, data, ports }: MessageEvent<{ bihive?: string }>) => {
      if (source !== parent || data?.bihive !== 'port' || !ports[0]) return;
      this.port = ports[0];
      if (this.shown) this.use_port();
    });
  }

  /** Resolves to the compiled module, or null, when the host begins; at once if there is none. */
  begin(threads: boolean): Promise<WebAssembly.Module | null> {
    if (!has_host) return Promise.resolve(null);
    addEventListener('message', ({ source, origin, data }: MessageEvent<Asked>) => {
      if (source === parent && origin === location.origin && data?.bihive) this.take(data);
    });
    const begun = new Promise<WebAssembly.Module | null>((resolve) => (this.begun = resolve));
    this.tell({ bihive: 'ready', threads });
    return begun;
  }

  /** The worker takes requests from now on. */
  start(actions: HostActions): void {
    this.actions = actions;
    if (!has_host) return;
    addEventListener('focus', () => this.tell({ bihive: 'entered' }));
    addEventListener('blur', () => this.tell({ bihive: 'left' }));
    addEventListener('keydown', (event) => {
      if (event.key !== 'Escape' || event.defaultPrevented || document.querySelector('dialog[open]')) return;
      this.tell({ bihive: 'left', by_key: true });
    });
    this.listen_for_clicks(element('picture'));
    this.tell({ bihive: 'started' });
  }

  // What was asked meanwhile waits in the port until there is a scene.
  private use_port(): void {
    this.port!.onmessage = ({ data }: MessageEvent<Asked>) => data?.bihive && this.take(data);
    this.port!.postMessage({ bihive: 'camera', camera: JSON.parse(this.last_camera) } satisfies Told);
  }

  private tell(told: Told): void {
    if (this.port) return this.port.postMessage(told);
    // A frame without an origin, as in a notebook, has nobody to speak to.
    if (parent !== window && location.origin !== 'null') parent.postMessage(told, location.origin);
  }

  private take(asked: Asked): void {
    switch (asked.bihive) {
      case 'begin':
        return this.begun(asked.wasm);
      case 'parts':
        return show_parts(asked);
      case 'open':
        this.looks.length = 0;
        this.waiting = null;
        this.asked_look = asked.look;
        return void this.ids.set(this.actions!.open(asked), asked.id);
      case 'look': {
        const waits = this.looks.length > 0;
        this.looks.push(...Object.entries(asked.look).map(([member, text]) => ({ [member]: text })));
        if (!waits) this.next_look();
        return;
      }
      case 'reading': {
        if (this.looks.length > 0) return void (this.waiting = asked);
        const reading = Object.keys(asked.reading).length > 0 ? asked.reading : undefined;
        return void this.ids.set(this.actions!.read_again(reading), asked.id);
      }
      case 'camera':
        return this.actions!.camera(asked.camera);
      case 'pick':
        return void this.ids.set(this.actions!.pick(asked.x, asked.y), asked.id);
      case 'picture': {
        const id = this.actions!.draw(asked.width, asked.height);
        this.drawn.push(id);
        return void this.ids.set(id, asked.id);
      }
    }
  }

  private taken(id: number | null): number | null {
    const of_host = id === null ? undefined : this.ids.get(id);
    if (id !== null) this.ids.delete(id);
    return of_host ?? null;
  }

  // What the worker answers.

  loaded(id: number, { name, format, spheres, frames }: Facts, settings: Settings, look: Look): void {
    const is_first = !this.shown;
    this.shown = true;
    this.tell({ bihive: 'loaded', id: this.taken(id), name, format, spheres, frames });
    this.settings(settings);
    if (is_first && this.port) this.use_port();
    // What did not fit was left out, with the rest. Asked for one by one, the right ones are taken, and the fault is told.
    const refused = Object.entries(this.asked_look).some(([member, text]) => look[member as keyof AskedLook] !== text);
    const asked = this.asked_look;
    this.asked_look = {};
    if (refused) this.take({ bihive: 'look', look: asked });
  }

  failed(id: number | null, message: string): void {
    if (id !== null) this.clicks.delete(id);
    this.drawn.splice(0, this.drawn.length, ...this.drawn.filter((one) => one !== id));
    this.tell({ bihive: 'failed', id: this.taken(id), message });
  }

  settings({ camera }: Settings): void {
    if (!this.shown) return;
    const text = JSON.stringify(camera);
    if (text === this.last_camera) return;
    this.last_camera = text;
    this.tell({ bihive: 'camera', camera });
  }

  /** A look has been taken, or refused, which failed() tells: the next one. */
  look_answered(): void {
    if (this.looks.length === 0) return;
    this.looks.shift();
    this.next_look();
  }

  private next_look(): void {
    if (this.looks.length > 0) return this.actions!.look(this.looks[0]!);
    const waiting = this.waiting;
    this.waiting = null;
    if (waiting) this.take(waiting);
  }

  picked(id: number, picked: Picked | null): void {
    const place = this.clicks.get(id);
    this.clicks.delete(id);
    if (place) return this.tell({ bihive: 'picked', ...place, picked });
    const of_host = this.taken(id);
    if (of_host !== null) this.tell({ bihive: 'answer', id: of_host, value: picked });
  }

  pinned(pins: Picked[]): void {
    const ids = JSON.stringify(pins.map(({ sphere }) => sphere));
    if (ids === this.last_pins) return;
    this.last_pins = ids;
    if (this.port) this.tell({ bihive: 'pins', pins });
  }

  /** False: the user has asked for the picture. */
  picture(file: Blob | null): boolean {
    const of_host = this.taken(this.drawn.shift() ?? null);
    if (of_host === null) return false;
    if (file) this.tell({ bihive: 'answer', id: of_host, value: file });
    else this.tell({ bihive: 'failed', id: of_host, message: 'The picture was not finished: another scene was opened meanwhile' });
    return true;
  }

  private listen_for_clicks(picture: HTMLElement): void {
    let down: { x: number; y: number } | null = null;
    picture.addEventListener('pointerdown', ({ clientX, clientY, isPrimary, button }) => {
      down = isPrimary && button === 0 ? { x: clientX, y: clientY } : null;
    });
    picture.addEventListener('pointerup', ({ clientX, clientY, isPrimary }) => {
      const from = down;
      down = null;
      if (!from || !isPrimary || !this.shown || Math.hypot(clientX - from.x, clientY - from.y) > most_click_px) return;
      const box = picture.getBoundingClientRect();
      const place = { x: clientX - box.left, y: clientY - box.top };
      this.clicks.set(this.actions!.pick(place.x, place.y), place);
    });
  }
}
