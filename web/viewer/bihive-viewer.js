// <bihive-viewer src="x.pdb" style="illustrative">: spheres in a page of your own, ray traced in the browser.
const here = new URL('.', import.meta.url);

// A style's name is no CSS, which browsers leave alone, so `style` may hold it; `look` says the same beside real CSS.
const style_of = (element) => {
  const name = element.getAttribute('look') ?? element.getAttribute('style') ?? '';
  return name.includes(':') ? '' : name.trim();
};

// Every member, so that one whose attribute is taken away goes back to the file's own.
const look_of = (element) => {
  const background = element.getAttribute('background') ?? '';
  return {
    style: style_of(element),
    background: background === 'transparent' ? 'none' : background,
    colour_by: element.getAttribute('colour-by') ?? '',
  };
};

// Throws a message for people.
const reading_of = (element) => {
  const reading = {};
  const radius = element.getAttribute('radius');
  if (radius !== null) {
    if (radius.trim() === '' || !(Number(radius) >= 0 && Number(radius) < Infinity))
      throw new Error(`radius="${radius}": expected a number from 0`);
    reading.radius = Number(radius);
  }
  const columns = element.getAttribute('columns');
  if (columns !== null) reading.columns = columns;
  return reading;
};

const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

// A File of what load() takes.
const file_of = (data, name) => {
  if (data instanceof File && name === undefined) return data;
  return new File([data], name ?? 'spheres');
};

// The C++ module, compiled once for all viewers of a page while there is one. A page that forbids it, by its Content
// Security Policy, leaves it to each viewer.
const compiled = new Map();
let viewers = 0;

const shared_module = (threads) => {
  const build = threads ? 'threads' : 'single';
  if (!compiled.has(build)) {
    const address = new URL(`page/wasm/${build}/bihive.wasm`, here);
    compiled.set(build, WebAssembly.compileStreaming(fetch(address)).catch(() => null));
  }
  return compiled.get(build);
};

export class BihiveViewer extends HTMLElement {
  static observedAttributes = ['src', 'look', 'style', 'background', 'colour-by', 'radius', 'columns', 'panel', 'badge', 'interactive'];

  #root;
  #frame = null;
  #takes = false; // the frame takes requests
  #waits = false;
  #given = null; // by load(): {file, trajectory}; it goes before src
  #shown = null; // what was asked of the frame last
  #opening = 0; // id of the load that is awaited
  #reads_again = false; // that load, the scene that is shown
  #refused = false; // the file that was opened last
  #camera = null;
  #wanted_camera = null; // until there is a scene
  #answers = new Map(); // requests by their ids: {resolve, reject}
  #last_id = 0;
  #active = false;
  #drawn = Promise.resolve(); // one picture after the other

  #hear = ({ source, origin, data }) => {
    if (!this.#frame || source !== this.#frame.contentWindow || origin !== here.origin || !data?.bihive) return;
    const { bihive, id, ...detail } = data;
    if (bihive === 'ready') void this.#begin(detail.threads);
    else if (bihive === 'started') {
      this.#takes = true;
      this.#update();
    } else if (bihive === 'loaded') this.#loaded(id, detail);
    else if (bihive === 'failed') this.#failed(id, detail.message);
    else if (bihive === 'answer') this.#settle(id)?.resolve(detail.value);
    else if (bihive === 'camera') {
      this.#camera = detail.camera;
      this.#tell('bihive-camera', this.camera);
    } else if (bihive === 'picked') this.#tell('bihive-pick', detail);
    else if (bihive === 'entered') this.active = true;
    else if (bihive === 'left') {
      if (detail.by_key) this.#frame.blur();
      this.active = false;
    }
  };

  constructor() {
    super();
    this.#root = this.attachShadow({ mode: 'open' });
    // Until it is active, pointers pass the frame by, so that wheel and swipe scroll the page. Its colour scheme is that of
    // the page in it: otherwise browsers draw an opaque ground below the frame.
    this.#root.innerHTML =
      '<style>:host { display: block; position: relative; aspect-ratio: 4 / 3; cursor: pointer; } :host([hidden]) { display: none; }' +
      ' iframe { position: absolute; inset: 0; width: 100%; height: 100%; border: 0; color-scheme: light dark; pointer-events: none; }' +
      ' :host([interactive]) iframe, iframe.active { pointer-events: auto; }' +
      ' iframe.active { outline: 2px solid Highlight; outline-offset: -2px; }</style>';
    this.addEventListener('click', () => (this.active = true));
  }

  connectedCallback() {
    ++viewers;
    addEventListener('message', this.#hear);
    const frame = document.createElement('iframe');
    frame.allow = 'cross-origin-isolated; clipboard-write';
    frame.src = new URL('page/index.html?embed=viewer', here).href;
    // A camera outlives a move of the element to another place of the page.
    this.#wanted_camera ??= this.#camera;
    this.#frame = this.#root.appendChild(frame);
    this.#name_frame();
    // It loads beside the frame.
    shared_module(globalThis.crossOriginIsolated === true);
  }

  disconnectedCallback() {
    if (--viewers === 0) compiled.clear();
    removeEventListener('message', this.#hear);
    // With the frame go its workers, their memory, and the addresses of its blobs.
    this.#frame?.remove();
    this.#frame = this.#shown = null;
    this.#takes = this.#active = false;
    this.#opening = 0;
    for (const { reject } of this.#answers.values()) reject(new Error('The viewer was taken out of the page'));
    this.#answers.clear();
  }

  attributeChangedCallback(name, before, now) {
    if (before === now) return;
    if (name === 'src') this.#given = null;
    this.#update();
  }

  async #begin(threads) {
    const frame = this.#frame;
    const wasm = await shared_module(threads);
    if (frame !== this.#frame) return;
    this.#post({ bihive: 'begin', wasm });
  }

  #post(asked) {
    this.#frame?.contentWindow?.postMessage(asked, here.origin);
  }

  #tell(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail, bubbles: true }));
  }

  #name_frame() {
    const name = this.#given?.file.name ?? this.getAttribute('src');
    if (this.#frame) this.#frame.title = name === null ? 'Spheres' : `Spheres of ${name}`;
  }

  // Several attributes that change together are one change.
  #update() {
    if (this.#waits || !this.#takes) return;
    this.#waits = true;
    queueMicrotask(() => {
      this.#waits = false;
      if (this.#takes) this.#show();
    });
  }

  #show() {
    const before = this.#shown;
    const now = {
      parts: { panel: this.hasAttribute('panel'), badge: this.hasAttribute('badge') },
      look: look_of(this),
      ...this.#asked_reading(before),
      place: this.#place(),
    };
    if (!same(now.parts, before?.parts)) this.#post({ bihive: 'parts', ...now.parts });
    if (now.place !== before?.place) {
      this.#shown = now;
      return this.#open();
    }
    // A scene on its way would take back what changes meanwhile; this is called again when it is there.
    if (this.#opening) return;
    if (!same(now.reading, before.reading)) {
      if (this.#refused) {
        this.#shown = now;
        return this.#open();
      }
      this.#shown = { ...now, look: before.look };
      this.#opening = ++this.#last_id;
      this.#reads_again = true;
      return this.#post({ bihive: 'reading', id: this.#opening, reading: now.reading });
    }
    this.#shown = now;
    const changes = Object.fromEntries(Object.entries(now.look).filter(([member, text]) => before.look[member] !== text));
    if (Object.keys(changes).length > 0) this.#post({ bihive: 'look', look: changes });
  }

  // A faulty attribute is told once, and changes nothing.
  #asked_reading(before) {
    try {
      return { reading: reading_of(this) };
    } catch ({ message }) {
      if (before?.fault !== message) this.#tell('bihive-error', { message });
      return { reading: before?.reading ?? {}, fault: message };
    }
  }

  // What load() was given, or an address as a text; null: the bundled molecule.
  #place() {
    if (this.#given) return this.#given;
    const src = this.getAttribute('src');
    try {
      return src && new URL(src, document.baseURI).href;
    } catch {
      return src; // the frame says that it is no address
    }
  }

  #open() {
    const { place, reading, look } = this.#shown;
    const { file = null, trajectory = null, waiting = null } = this.#given ?? {};
    const from = file ? { file: file.name } : place === null ? { built_in: 'demo' } : { url: place };
    if (trajectory) from.trajectory = trajectory.name;
    if (Object.keys(reading).length > 0) from.reading = reading;
    this.#settle(this.#opening)?.reject(new Error('Another file was opened meanwhile'));
    this.#opening = ++this.#last_id;
    this.#reads_again = false;
    if (waiting) this.#answers.set(this.#opening, waiting);
    if (waiting) this.#given.waiting = null;
    this.#name_frame();
    this.#post({ bihive: 'open', id: this.#opening, source: from, file, trajectory, look, camera: this.#wanted_camera });
    this.#wanted_camera = null;
  }

  #loaded(id, facts) {
    if (id === this.#opening) this.#opening = 0;
    this.#refused = false;
    if (this.#wanted_camera && !this.#opening) this.camera = this.#wanted_camera;
    this.#wanted_camera = this.#opening ? this.#wanted_camera : null;
    this.#settle(id)?.resolve(facts);
    this.#tell('bihive-load', facts);
    this.#update();
  }

  #failed(id, message) {
    if (id !== null && id === this.#opening) {
      this.#opening = 0;
      this.#refused = !this.#reads_again;
    }
    this.#settle(id)?.reject(new Error(message));
    this.#tell('bihive-error', { message });
    this.#update();
  }

  #settle(id) {
    const answer = this.#answers.get(id);
    this.#answers.delete(id);
    return answer;
  }

  #ask(asked) {
    if (!this.#takes) return Promise.reject(new Error('The viewer shows nothing yet'));
    const id = ++this.#last_id;
    return new Promise((resolve, reject) => {
      this.#answers.set(id, { resolve, reject });
      this.#post({ ...asked, id });
    });
  }

  load(data, { name, trajectory = null } = {}) {
    return new Promise((resolve, reject) => {
      this.#given?.waiting?.reject(new Error('Another file was opened meanwhile'));
      this.#given = {
        file: file_of(data, name),
        trajectory: trajectory && file_of(trajectory),
        waiting: { resolve, reject },
      };
      this.#update();
    });
  }

  pick(x, y) {
    return this.#ask({ bihive: 'pick', x, y });
  }

  toBlob({ width = null, height = null } = {}) {
    const picture = this.#drawn.then(() => this.#ask({ bihive: 'picture', width, height }));
    this.#drawn = picture.catch(() => {});
    return picture;
  }

  get camera() {
    const camera = this.#camera ?? this.#wanted_camera;
    return camera && structuredClone(camera);
  }
  set camera(camera) {
    if (this.#takes && this.#shown && this.#opening === 0) this.#post({ bihive: 'camera', camera });
    else this.#wanted_camera = { ...this.#wanted_camera, ...camera };
  }

  get active() {
    return this.#active;
  }
  set active(active) {
    if (!this.#frame || active === this.#active) return;
    this.#active = active;
    this.#frame.classList.toggle('active', active);
    if (active) this.#frame.contentWindow.focus();
    else if (this.#root.activeElement === this.#frame) this.#frame.blur();
  }

  get src() {
    return this.getAttribute('src');
  }
  set src(src) {
    if (src === null) this.removeAttribute('src');
    else this.setAttribute('src', src);
  }
  get look() {
    return style_of(this);
  }
  set look(name) {
    this.setAttribute('look', name);
  }
}

customElements.define('bihive-viewer', BihiveViewer);
