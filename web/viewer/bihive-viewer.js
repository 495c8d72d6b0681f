// <bihive-viewer src="x.pdb" style="illustrative">: spheres in a page of your own, ray traced in the browser.
const here = new URL('.', import.meta.url);

// A style's name is no CSS, which browsers leave alone, so `style` may hold it; `look` says the same beside real CSS.
const style_of = (element) => {
  const name = element.getAttribute('look') ?? element.getAttribute('style') ?? '';
  return name.includes(':') ? '' : name.trim();
};

const encoded = (state) => {
  let binary = '';
  for (const byte of new TextEncoder().encode(JSON.stringify(state))) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
};

export class BihiveViewer extends HTMLElement {
  static observedAttributes = ['src', 'look', 'style', 'background', 'colour-by', 'radius', 'columns', 'panel'];

  #frame = null;
  #waits = false;
  #shown = '';
  #hear = ({ source, origin, data }) => {
    if (!this.#frame || source !== this.#frame.contentWindow || origin !== here.origin) return;
    if (data?.bihive === 'loaded') this.dispatchEvent(new CustomEvent('bihive-load', { detail: data, bubbles: true }));
    if (data?.bihive === 'failed') this.dispatchEvent(new CustomEvent('bihive-error', { detail: data, bubbles: true }));
  };

  constructor() {
    super();
    const root = this.attachShadow({ mode: 'open' });
    root.innerHTML =
      '<style>:host { display: block; position: relative; aspect-ratio: 4 / 3; } :host([hidden]) { display: none; }' +
      ' iframe { position: absolute; inset: 0; width: 100%; height: 100%; border: 0; }</style>';
  }

  connectedCallback() {
    addEventListener('message', this.#hear);
    this.#show();
  }

  disconnectedCallback() {
    removeEventListener('message', this.#hear);
    this.#frame?.remove();
    this.#frame = null;
    this.#shown = '';
  }

  attributeChangedCallback() {
    this.#show();
  }

  // Several attributes that change together make one picture.
  #show() {
    if (this.#waits || !this.isConnected) return;
    this.#waits = true;
    queueMicrotask(() => {
      this.#waits = false;
      if (this.isConnected) this.#load();
    });
  }

  #load() {
    const src = this.getAttribute('src');
    const source = src === null ? { built_in: 'demo' } : { url: new URL(src, document.baseURI).href };
    const reading = {};
    if (this.hasAttribute('radius')) reading.radius = Number(this.getAttribute('radius'));
    if (this.hasAttribute('columns')) reading.columns = this.getAttribute('columns');
    if (Object.keys(reading).length > 0) source.reading = reading;
    const look = {
      style: style_of(this),
      background: this.getAttribute('background') ?? '',
      colour_by: this.getAttribute('colour-by') ?? '',
    };
    for (const [key, text] of Object.entries(look)) if (text === '') delete look[key];
    const address = new URL(`page/index.html?embed${this.hasAttribute('panel') ? '=panel' : ''}`, here);
    address.hash = `state=${encoded({ source, settings: null, look })}`;
    if (address.href === this.#shown) return;
    this.#shown = address.href;
    // A frame of its own for each state: no step back in the history of the page around it.
    const frame = document.createElement('iframe');
    frame.title = src === null ? 'Spheres' : `Spheres of ${src}`;
    frame.allow = 'cross-origin-isolated';
    frame.src = address.href;
    this.#frame?.remove();
    this.#frame = this.shadowRoot.appendChild(frame);
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
