// The picture answers: what is under the pointer, spheres that are pinned, and the measures between them.
import { element } from './dom';
import { has_host } from './embedded';
import { readable } from './field';
import { speak } from './messages';
import { minus, seen_at, type Vec3 } from './projection';
import type { Camera, Measure, Picked } from './protocol';
import { words } from './words';

export interface InspectActions {
  /** Asks for the sphere there, in pixels of the page; picked() gets the answer under the id that is returned. */
  pick(x: number, y: number): number;
  /** A click or a tap there, or Enter for the middle. */
  clicked(x: number, y: number): void;
  /** Asks for these spheres by their ids, and for the measure of them; described() gets the answer. */
  describe(spheres: number[]): void;
  camera(): Camera | null;
  look_at(eye: Vec3, look_at: Vec3): void;
  /** A click on the picture: true if it meant something else. */
  dismiss(): boolean;
  /** These spheres are pinned now. */
  pinned(pins: Picked[]): void;
  /** Begins a row of the look for these spheres. */
  select(selection: string): void;
  /** Asks for the measure of these spheres in all frames. */
  measure_frames(spheres: number[], name: string): void;
}

interface Place {
  x: number;
  y: number;
}

const rest_ms = 120; // of the pointer before its place is asked for
const long_press_ms = 500;
const most_click_px = 4;
const most_pins = 4;
const kinds = ['', '', 'distance', 'angle', 'dihedral']; // in files
const closer = 0.5; // of the distance that is left after a double click

// A text or a number as a value of a selection.
const quoted = (value: number | string) => (typeof value === 'number' ? String(value) : `"${value.replaceAll('"', '""')}"`);

/** Selections of more and more spheres around this one: itself, its residue, its chain, all of its kind. */
export function selections_of({ sphere, attributes }: Picked): { label: string; selection: string }[] {
  const test = (name: string) => {
    const value = attributes[name];
    return value === undefined || value === null || value === '' ? '' : `${name} ${quoted(value)}`;
  };
  const chain = test('chain');
  const residue = attributes['resid'] === undefined ? '' : [chain, test('resid'), test('insertion')].filter(Boolean).join(' and ');
  const kind = test('resname') || test('type') || test('element');
  const all = [
    { label: words.select.sphere, selection: `index ${sphere}` },
    { label: words.select.residue, selection: residue },
    { label: words.select.chain, selection: chain },
    { label: words.select.kind, selection: kind },
  ];
  return all.filter(({ selection }) => selection !== '');
}

/** What it is, in a few words: "CA, ALA 28, chain A". */
export function title_of({ sphere, attributes }: Picked): string {
  const text = (name: string) => (attributes[name] === undefined || attributes[name] === null ? '' : String(attributes[name]).trim());
  const atom = text('name') || text('element') || text('type');
  const residue = [text('resname'), text('resid')].filter(Boolean).join(' ');
  const parts = [atom, residue, text('chain') && `chain ${text('chain')}`].filter(Boolean);
  return parts.length > 0 ? parts.join(', ') : `sphere ${sphere}`;
}

const in_title = ['name', 'resname', 'resid', 'chain'];

/** The rest of what is known. */
function details_of({ sphere, attributes, centre, radius }: Picked): string[] {
  const known = Object.entries(attributes)
    .filter(([name, value]) => !in_title.includes(name) && name !== 'id' && name !== 'index' && value !== null && value !== '')
    .map(([name, value]) => `${name} ${typeof value === 'number' ? readable(value) : value}`);
  return [`index ${sphere}`, ...known, `radius ${readable(radius)}`, `at ${centre.map(readable).join(', ')}`];
}

export class Inspector {
  private readonly picture = element('picture');
  private readonly tip = element('tip');
  private readonly box = element('pins');
  private readonly list = element('pin_list');
  private readonly csv = element<HTMLButtonElement>('pins_csv');
  private readonly select = element('pins_select');
  private readonly marks = document.getElementById('marks') as unknown as SVGSVGElement;
  private readonly asked = new Map<number, { why: 'name' | 'pin' | 'centre'; place: Place }>();
  private pins: Picked[] = [];
  private recalled: number[] | null = null; // ids that are to be pinned again, once they are described
  private news = ''; // for those who hear the page, once the measure is known
  private unit = '';
  private timer = 0;
  private has_frames = false;

  constructor(private readonly actions: InspectActions) {
    if (!has_host) this.listen(); // the page around the frame has events of its own
    element('pins_clear').addEventListener('click', () => {
      this.set_pins([]);
      this.picture.focus();
    });
    this.csv.addEventListener('click', () => {
      const ids = this.pins.map(({ sphere }) => sphere);
      actions.measure_frames(ids, `${kinds[ids.length]!}_${ids.join('_')}`);
    });
  }

  /** Another scene. */
  begin(unit: string, has_frames: boolean): void {
    this.unit = unit;
    this.has_frames = has_frames;
    this.hide_tip();
    this.recalled = null;
    this.set_pins([]);
  }

  /** Pins these spheres of the new scene, as before a reload. */
  recall(spheres: number[]): void {
    if (spheres.length === 0) return;
    this.recalled = spheres;
    this.actions.describe(spheres);
  }

  /** Another frame of it, or another look: what is pinned has moved, or is hidden. */
  moved(): void {
    this.hide_tip();
    if (this.pins.length > 0) this.actions.describe(this.pins.map(({ sphere }) => sphere));
  }

  described(spheres: (Picked | null)[], measure: Measure): void {
    if (this.recalled) {
      const known = spheres.filter((one) => one !== null);
      const all = spheres.length === this.recalled.length && known.length === spheres.length;
      this.recalled = null;
      this.set_pins(known);
      if (all) this.set_pins(known, this.words_of(measure));
      else this.moved();
      return;
    }
    if (spheres.length !== this.pins.length) return; // others were pinned meanwhile
    const known = spheres.filter((one) => one !== null);
    if (!known.every(({ sphere }) => this.pins.some((pin) => pin.sphere === sphere))) return;
    // A pinned sphere that is hidden now is pinned no longer.
    if (known.length < this.pins.length) {
      this.set_pins(known);
      return void (known.length > 0 && this.moved());
    }
    const measured = this.words_of(measure);
    this.set_pins(known, measured);
    if (this.news) speak([this.news, measured].filter(Boolean).join('. '));
    this.news = '';
  }

  /** The answer to a request of this class; false: of another one. */
  picked(id: number, picked: Picked | null): boolean {
    const asked = this.asked.get(id);
    if (!asked) return false;
    this.asked.delete(id);
    if (asked.why === 'name') this.show_tip(picked, asked.place);
    else if (picked && asked.why === 'pin') this.pin(picked);
    else if (picked) this.centre_on(picked.centre);
    return true;
  }

  // For those who have keys alone.
  private pin_middle(): void {
    this.click('pin', { x: this.picture.clientWidth / 2, y: this.picture.clientHeight / 2 });
  }

  /** The marks follow the camera. */
  draw(): void {
    const camera = this.actions.camera();
    const { clientWidth: width, clientHeight: height } = this.picture;
    const places = camera ? this.pins.map(({ centre }) => seen_at(camera, width, height, centre)) : [];
    const made = (name: string, attributes: Record<string, number | string>, text = '') => {
      const mark = document.createElementNS('http://www.w3.org/2000/svg', name);
      for (const [key, value] of Object.entries(attributes)) mark.setAttribute(key, String(value));
      mark.textContent = text;
      return mark;
    };
    const lines = places.slice(1).flatMap((to, i) => {
      const from = places[i];
      const ends = from && to && { x1: from.x, y1: from.y, x2: to.x, y2: to.y };
      return ends ? [made('line', { ...ends, class: 'ground' }), made('line', ends)] : [];
    });
    const points = places.flatMap((place, i) =>
      place ? [made('circle', { cx: place.x, cy: place.y, r: 9 }), made('text', { x: place.x, y: place.y }, String(i + 1))] : [],
    );
    this.marks.replaceChildren(...lines, ...points);
  }

  private ask(why: 'name' | 'pin' | 'centre', place: Place): void {
    this.asked.set(this.actions.pick(place.x, place.y), { why, place });
  }

  private click(why: 'name' | 'pin', place: Place): void {
    this.ask(why, place);
    this.actions.clicked(place.x, place.y);
  }

  // A click pins, a finger's tap names, its long press pins; twice is to come closer.
  private listen(): void {
    const { picture } = this;
    const place = ({ clientX, clientY }: MouseEvent): Place => {
      const box = picture.getBoundingClientRect();
      return { x: clientX - box.left, y: clientY - box.top };
    };
    const apart = (a: Place, b: Place) => Math.hypot(a.x - b.x, a.y - b.y);
    let down: Place | null = null;
    let pressing = 0;
    picture.addEventListener('pointerdown', (event) => {
      this.hide_tip();
      clearTimeout(pressing);
      down = event.isPrimary && event.button === 0 && !event.shiftKey ? place(event) : null;
      if (down && event.pointerType === 'touch')
        pressing = window.setTimeout(() => {
          if (down) this.ask('pin', down);
          down = null;
        }, long_press_ms);
    });
    picture.addEventListener('pointermove', (event) => {
      const now = place(event);
      if (down && apart(down, now) > most_click_px) down = null;
      if (event.buttons !== 0 || event.pointerType === 'touch') return;
      this.hide_tip();
      this.timer = window.setTimeout(() => this.ask('name', now), rest_ms);
    });
    picture.addEventListener('pointerup', (event) => {
      clearTimeout(pressing);
      if (!down || !event.isPrimary) return;
      // The second click of two takes the pin of the first one away.
      if (!this.actions.dismiss()) this.click(event.pointerType === 'touch' ? 'name' : 'pin', down);
      down = null;
    });
    for (const end of ['pointercancel', 'pointerleave'] as const)
      picture.addEventListener(end, ({ pointerType }) => {
        clearTimeout(pressing);
        down = null;
        if (pointerType !== 'touch') this.hide_tip(); // a finger leaves after each tap
      });
    picture.addEventListener('wheel', () => this.hide_tip(), { passive: true });
    picture.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.key === 'Enter') this.pin_middle();
      else if (event.key === 'Escape' && this.pins.length > 0) this.set_pins([]);
      else return;
      event.preventDefault();
    });
    picture.addEventListener('dblclick', (event) => this.ask('centre', place(event)));
  }

  // The camera turns to the point, and comes closer.
  private centre_on(point: Vec3): void {
    const camera = this.actions.camera();
    if (!camera) return;
    const away = minus(camera.eye, camera.look_at).map((one) => closer * one) as unknown as Vec3;
    this.actions.look_at([point[0] + away[0], point[1] + away[1], point[2] + away[2]], point);
  }

  private hide_tip(): void {
    clearTimeout(this.timer);
    for (const [id, { why }] of this.asked) if (why === 'name') this.asked.set(id, { why, place: { x: NaN, y: NaN } });
    this.tip.hidden = true;
  }

  private show_tip(picked: Picked | null, { x, y }: Place): void {
    if (!picked || Number.isNaN(x)) return; // the pointer is elsewhere by now
    element('tip_title').textContent = title_of(picked);
    element('tip_rest').textContent = details_of(picked).join(' · ');
    this.tip.hidden = false;
    const [right, below] = [x < this.picture.clientWidth / 2, y < this.picture.clientHeight / 2];
    Object.assign(this.tip.style, {
      left: right ? `${x + 14}px` : 'auto',
      right: right ? 'auto' : `${this.picture.clientWidth - x + 14}px`,
      top: below ? `${y + 14}px` : 'auto',
      bottom: below ? 'auto' : `${this.picture.clientHeight - y + 14}px`,
    });
  }

  private pin(picked: Picked): void {
    const others = this.pins.filter(({ sphere }) => sphere !== picked.sphere);
    const is_new = others.length === this.pins.length;
    this.set_pins(!is_new ? others : others.length < most_pins ? [...others, picked] : [picked]);
    this.news = is_new ? words.pins.pinned(title_of(picked)) : words.pins.no_longer(title_of(picked));
    this.actions.describe(this.pins.map(({ sphere }) => sphere));
  }

  private words_of({ value, nearest_images }: Measure): string {
    const name = words.pins.measures[this.pins.length]!;
    if (value === null || name === '') return '';
    const unit = this.pins.length !== 2 ? '°' : this.unit && ` ${this.unit}`;
    return `${name} ${readable(value)}${unit}${nearest_images ? words.pins.of_nearest_images : ''}`;
  }

  // Of the sphere that was pinned last.
  private show_selections(picked: Picked | undefined): void {
    const buttons = picked ? selections_of(picked) : [];
    const label = Object.assign(document.createElement('span'), { textContent: words.select.label });
    this.select.replaceChildren(
      label,
      ...buttons.map(({ label: text, selection }) => {
        const button = Object.assign(document.createElement('button'), { type: 'button', textContent: text, title: selection });
        button.addEventListener('click', () => this.actions.select(selection));
        return button;
      }),
    );
  }

  private set_pins(pins: Picked[], measure = ''): void {
    this.pins = pins;
    this.actions.pinned(pins);
    this.box.hidden = pins.length === 0;
    this.list.replaceChildren(
      ...pins.map((picked) => {
        const item = document.createElement('li');
        const more = document.createElement('details');
        more.append(
          Object.assign(document.createElement('summary'), { textContent: title_of(picked) }),
          details_of(picked).join(' · '),
        );
        item.append(more);
        return item;
      }),
    );
    element('pins_measure').textContent = measure;
    this.csv.hidden = !this.has_frames || pins.length < 2;
    this.show_selections(pins.at(-1));
    this.draw();
  }
}
