// The panel's appearance controls for all spheres: lights, floor, lines between groups, and colours by an attribute.
import { element } from './dom';
import { HistogramView } from './histogram';
import type { Choices, ColouredBy, Facts, Histogram, Look } from './protocol';
import { is_typing_in } from './typing';
import { words } from './words';

const grey = '#808080';

/** The fields of ATTR:MAP:MIN,MAX:log, as `bihive render --colour-by` takes it. */
interface ColourBy {
  attribute: string;
  map: string;
  min: string;
  max: string;
  log: boolean;
}

export function parts_of(text: string): ColourBy {
  const [attribute = '', map = '', range = '', log = ''] = text.split(':');
  const [min = '', max = ''] = range.split(',');
  return { attribute, map, min, max, log: log === 'log' };
}

export function text_of({ attribute, map, min, max, log }: ColourBy): string {
  if (attribute === '') return '';
  const parts = [attribute, map, min !== '' && max !== '' ? `${min},${max}` : '', log ? 'log' : ''];
  while (parts.at(-1) === '') parts.pop();
  return parts.join(':');
}

// A list with a first entry of its own; a name that is not in it is added.
function fill(select: HTMLSelectElement, first: string, names: string[]): void {
  const option = (value: string, text: string) => Object.assign(document.createElement('option'), { value, textContent: text });
  select.replaceChildren(option('', first), ...names.map((name) => option(name, name)));
}

function choose(select: HTMLSelectElement, value: string): void {
  if (![...select.options].some((option) => option.value === value)) select.add(new Option(value, value));
  select.value = value;
}

export class ColourControls {
  private readonly lights = element<HTMLSelectElement>('lights');
  private readonly own_lights = element<HTMLInputElement>('own_lights');
  private readonly crease = element<HTMLSelectElement>('crease');
  private readonly floor = element<HTMLSelectElement>('floor');
  private readonly floor_colour = element<HTMLInputElement>('floor_colour');
  private readonly attribute = element<HTMLSelectElement>('colour_by');
  private readonly map = element<HTMLSelectElement>('colour_map');
  private readonly min = element<HTMLInputElement>('colour_min');
  private readonly max = element<HTMLInputElement>('colour_max');
  private readonly log = element<HTMLInputElement>('colour_log');
  private readonly nan_colour = element<HTMLInputElement>('nan_colour');
  private readonly histogram = new HistogramView(([min, max]) => {
    this.min.value = String(min);
    this.max.value = String(max);
    this.change_colours();
  });
  private presets: string[] = [];
  private asked = ''; // the attribute of the histogram

  /** `histogram_of`: take_histogram() gets the answer. */
  constructor(private readonly change: (changes: Partial<Look>) => void, private readonly histogram_of: (attribute: string) => void) {
    this.lights.addEventListener('change', () => this.change_lights());
    this.own_lights.addEventListener('change', () => this.change_lights());
    this.crease.addEventListener('change', () => change({ crease: this.crease.value }));
    for (const input of [this.floor, this.floor_colour])
      input.addEventListener('change', () => change({ floor: this.floor.value === 'colour' ? this.floor_colour.value : this.floor.value }));
    this.attribute.addEventListener('change', () => {
      // Another attribute has another range.
      this.min.value = this.max.value = '';
      this.change_colours();
    });
    for (const input of [this.map, this.min, this.max, this.log])
      input.addEventListener('change', () => this.change_colours());
    this.nan_colour.addEventListener('change', () => change({ nan_colour: this.nan_colour.value }));
  }

  /** The library's names. */
  build({ lights, maps }: Choices): void {
    this.presets = lights;
    const own = this.lights.querySelector('[value=own]')!;
    for (const name of lights) own.before(new Option(words.light_labels[name] ?? name, name));
    fill(this.map, 'automatic', maps.map(({ name }) => name));
    this.histogram.build(maps);
  }

  take_histogram(attribute: string, histogram: Histogram | null): void {
    if (attribute !== this.asked) return;
    this.histogram.take(histogram);
    this.draw_histogram();
  }

  private draw_histogram(): void {
    const ends = [this.min, this.max].map(({ value, placeholder }) => (value || placeholder) !== '' ? Number(value || placeholder) : NaN);
    this.histogram.draw(this.map.value, ends.every(Number.isFinite) ? [ends[0]!, ends[1]!] : undefined);
  }

  private change_lights(): void {
    const own = this.lights.value === 'own';
    this.show_own_lights(own);
    const texts = this.own_lights.value.split(/\s+/).filter(Boolean);
    if (own && texts.length === 0) return this.own_lights.focus();
    this.change({ lights: own ? texts : this.lights.value === '' ? [] : [this.lights.value] });
  }

  private show_own_lights(own: boolean): void {
    element('own_lights_row').hidden = !own;
    element('own_lights_help').hidden = !own;
  }

  private change_colours(): void {
    // One end of a range waits for the other.
    if ((this.min.value === '') !== (this.max.value === '')) return;
    const { value: attribute } = this.attribute;
    const parts = { attribute, map: this.map.value, min: this.min.value, max: this.max.value, log: this.log.checked };
    this.change({ colour_by: text_of(parts) });
  }

  show_facts(facts: Facts): void {
    const whose = facts.is_file_of_spheres ? words.whose.style : words.whose.file;
    this.asked = '';
    this.histogram.take(null);
    fill(this.attribute, `${whose} colours`, facts.attributes);
    fill(this.crease, facts.is_file_of_spheres ? words.whose.lines_of_style : words.whose.lines_of_file, facts.attributes);
    this.lights.options[0]!.textContent = whose;
  }

  show(look: Look): void {
    const own = look.lights.length > 1 || (look.lights.length === 1 && !this.presets.includes(look.lights[0]!));
    const waits = [this.lights, this.own_lights].includes(document.activeElement as HTMLInputElement);
    if (own || !waits) {
      this.lights.value = own ? 'own' : look.lights[0] ?? '';
      this.show_own_lights(own);
      if (own && !waits) this.own_lights.value = look.lights.join(' ');
    }
    choose(this.crease, look.crease);
    this.floor.value = ['', 'shadow'].includes(look.floor) ? look.floor : 'colour';
    this.floor_colour.hidden = this.floor.value !== 'colour';
    if (/^#[0-9a-f]{6}$/i.test(look.floor)) this.floor_colour.value = look.floor;
    const parts = parts_of(look.colour_by);
    choose(this.attribute, parts.attribute);
    choose(this.map, parts.map);
    if (![this.min, this.max].some(is_typing_in)) {
      this.min.value = parts.min;
      this.max.value = parts.max;
    }
    this.log.checked = parts.log;
    element<HTMLFieldSetElement>('colour_map_box').disabled = parts.attribute === '';
    this.nan_colour.value = /^#[0-9a-f]{6}$/i.test(look.nan_colour) ? look.nan_colour : grey;
    if (parts.attribute !== this.asked) {
      this.asked = parts.attribute;
      this.histogram.take(null);
      if (this.asked !== '') this.histogram_of(this.asked);
    }
    this.draw_histogram();
  }

  /** The empty fields show the range that the library chose. */
  show_ranges(coloured_by: ColouredBy[]): void {
    const range = coloured_by.find(({ attribute }) => attribute === this.attribute.value)?.range;
    this.min.placeholder = range ? String(+range[0].toPrecision(4)) : '';
    this.max.placeholder = range ? String(+range[1].toPrecision(4)) : '';
    this.draw_histogram();
  }
}
