// How the numbers of an attribute are distributed, in the colours of the map, with the ends of the range as lines that can be
// dragged.
import { element } from './dom';
import type { Histogram, MapColours } from './protocol';

const width = 240, height = 56; // in units of its own
const ns = 'http://www.w3.org/2000/svg';

const made = (name: string, attributes: Record<string, number | string>): SVGElement => {
  const one = document.createElementNS(ns, name) as SVGElement;
  for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, String(value));
  return one;
};
const in_share = (share: number) => Math.min(1, Math.max(0, share));

export class HistogramView {
  private readonly box = element('histogram');
  private maps: MapColours[] = [];
  private shown: Histogram | null = null;
  private range: [number, number] = [0, 1];

  /** `drag`: the range is to have these ends. */
  constructor(drag: (range: [number, number]) => void) {
    let end: 0 | 1 | null = null;
    const move = ({ clientX }: PointerEvent) => {
      if (!this.shown || end === null) return;
      const { least, most } = this.shown;
      const { left, width: px } = this.box.getBoundingClientRect();
      const range: [number, number] = [...this.range];
      range[end] = +(least + in_share((clientX - left) / px) * (most - least)).toPrecision(4);
      if (range[0] < range[1]) drag(range);
    };
    this.box.addEventListener('pointerdown', (event) => {
      if (!this.shown) return;
      const { least, most } = this.shown;
      const { left, width: px } = this.box.getBoundingClientRect();
      const value = least + ((event.clientX - left) / px) * (most - least);
      end = Math.abs(value - this.range[0]) < Math.abs(value - this.range[1]) ? 0 : 1;
      this.box.setPointerCapture(event.pointerId);
      move(event);
    });
    this.box.addEventListener('pointermove', move);
    for (const last of ['pointerup', 'pointercancel'] as const) this.box.addEventListener(last, () => (end = null));
  }

  build(maps: MapColours[]): void {
    this.maps = maps;
  }

  /** Null: there is none. */
  take(histogram: Histogram | null): void {
    this.shown = histogram && histogram.most > histogram.least ? histogram : null;
    this.box.hidden = !this.shown;
  }

  /** `range` undefined: all of it. */
  draw(map: string, range: [number, number] | undefined): void {
    if (!this.shown) return;
    const { counts, least, most } = this.shown;
    this.range = range ?? [least, most];
    const [from, to] = this.range;
    const known = this.maps.find(({ name }) => name === map.replace(/_r$/, '')) ?? this.maps[0];
    const colours = known ? (map.endsWith('_r') ? [...known.colours].reverse() : known.colours) : [];
    const colour_at = (share: number) => colours[Math.round(in_share(share) * (colours.length - 1))] ?? 'currentColor';
    const largest = Math.max(...counts);
    const bars = counts.map((count, i) => {
      const middle = least + ((i + 0.5) / counts.length) * (most - least);
      // By square roots, so that a few spheres are seen beside thousands.
      const high = count === 0 ? 0 : Math.max(1, (height - 2) * Math.sqrt(count / largest));
      const fill = colour_at((middle - from) / (to - from || 1));
      return made('rect', { x: (i * width) / counts.length, y: height - high, width: width / counts.length - 0.5, height: high, fill });
    });
    const ends = this.range.map((end) => {
      const x = in_share((end - least) / (most - least)) * width;
      return made('line', { x1: x, x2: x, y1: 0, y2: height });
    });
    const svg = made('svg', { viewBox: `0 0 ${width} ${height}`, preserveAspectRatio: 'none' });
    svg.append(...bars, ...ends);
    this.box.replaceChildren(svg);
  }
}
