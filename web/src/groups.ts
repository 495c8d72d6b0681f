// Groups of spheres that have a name: the list of the card "Show", and the legend over the picture. Each entry changes rows of
// the look, which stand in the same card.
import { element } from './dom';
import type { Contents, Group, LegendKey } from './protocol';
import { grouped, words } from './words';

/** The rows of the look by selection and action; a null value: there is none. */
export interface LookRows {
  value(select: string, action: string): string | null;
  set(select: string, action: string, value: string | null): void;
}

const most_in_legend = 8;
const actions = ['hide', 'colour', 'opacity', 'material'];
const unknown_colour = '#808080';
const only_of = (select: string) => `not (${select})`;

function made<Tag extends keyof HTMLElementTagNameMap>(tag: Tag, properties: Record<string, string>, ...inside: Node[]): HTMLElementTagNameMap[Tag] {
  const one = document.createElement(tag);
  Object.assign(one, properties);
  one.append(...inside);
  return one;
}

interface Entry {
  name: string;
  select: string;
  count: number | null; // null: in the legend
  colour: string; // in the legend; empty: it has none of its own
}

class EntryControls {
  readonly box: HTMLElement;
  private readonly eye: HTMLButtonElement;
  private readonly swatch = made('i', { className: 'swatch' });
  private readonly only = made('button', { type: 'button', textContent: words.entry.only });
  private readonly reset = made('button', { type: 'button', textContent: words.entry.reset });
  private readonly colour = made('input', { type: 'color' });
  private readonly opacity = made('input', { type: 'range', min: '0', max: '1', step: '0.05' });
  private readonly material: HTMLSelectElement;

  constructor(private readonly entry: Entry, materials: string[], private readonly rows: LookRows, only: (select: string | null) => void) {
    const { name, select, count } = entry;
    this.eye = made('button', { type: 'button', className: 'eye', title: words.entry.shown(name) });
    this.eye.setAttribute('aria-label', words.entry.shown(name));
    this.eye.addEventListener('click', () => rows.set(select, 'hide', this.is_hidden ? null : ''));
    this.swatch.setAttribute('aria-hidden', 'true');
    this.only.addEventListener('click', () => only(this.is_only ? null : select));
    this.colour.addEventListener('input', () => rows.set(select, 'colour', this.colour.value));
    this.opacity.addEventListener('input', () => rows.set(select, 'opacity', this.opacity.value === '1' ? null : this.opacity.value));
    const option = (value: string, text: string) => made('option', { value, textContent: text });
    this.material = made('select', {}, option('', words.entry.own_material), ...materials.map((one) => option(one, one)));
    this.material.addEventListener('change', () => rows.set(select, 'material', this.material.value || null));
    this.reset.addEventListener('click', () => {
      for (const action of actions) rows.set(select, action, null);
      if (this.is_only) only(null);
    });
    const labelled = (text: string, input: HTMLElement) => made('label', { className: 'row' }, made('span', { textContent: text }), input);
    const details = made(
      'details', {},
      made('summary', {}, this.swatch, made('span', { textContent: name }), made('span', { className: 'count', textContent: count === null ? '' : grouped(count) })),
      made('div', { className: 'buttons' }, this.only, this.reset),
      labelled(words.entry.colour, this.colour), labelled(words.entry.opacity, this.opacity), labelled(words.entry.material, this.material),
    );
    details.name = 'group'; // one at a time
    this.box = made('li', { className: 'group_entry' }, this.eye, details);
    this.show();
  }

  private get is_hidden(): boolean {
    return this.rows.value(this.entry.select, 'hide') !== null;
  }

  private get is_only(): boolean {
    return this.rows.value(only_of(this.entry.select), 'hide') !== null;
  }

  show(): void {
    const { select, colour } = this.entry;
    const value = (action: string) => this.rows.value(select, action);
    this.box.classList.toggle('gone', this.is_hidden);
    this.eye.setAttribute('aria-pressed', String(!this.is_hidden));
    this.only.setAttribute('aria-pressed', String(this.is_only));
    const own = value('colour') ?? colour;
    this.swatch.style.background = own;
    this.colour.value = /^#[0-9a-f]{6}$/i.test(own) ? own : unknown_colour;
    this.opacity.value = value('opacity') ?? '1';
    this.material.value = value('material') ?? '';
    this.reset.disabled = !this.is_only && actions.every((action) => value(action) === null);
  }
}

export class GroupLists {
  private readonly list = element('groups');
  private readonly legend = element('legend_box');
  private groups: Group[] = [];
  private in_list: EntryControls[] = [];
  private in_legend: EntryControls[] = [];
  private materials: string[] = [];

  /** `more`: the rest of a long legend is asked for. */
  constructor(private readonly rows: LookRows, private readonly more: () => void) {}

  build(materials: string[]): void {
    this.materials = materials;
  }

  /** Another scene: what it holds is not known yet. */
  begin(): void {
    this.groups = [];
    this.in_list = this.in_legend = [];
    this.list.replaceChildren(made('li', { className: 'help', textContent: words.entry.awaited }));
    this.legend.replaceChildren();
    this.legend.hidden = true;
  }

  /** `contents` null: those that are known. */
  take(contents: Contents | null, legend: LegendKey[]): void {
    if (contents) this.groups = contents.groups;
    const colours = new Map(legend.flatMap(({ entries }) => entries).map(({ select, colour }) => [select, colour]));
    // Controls in use are not taken away.
    const in_use = (box: HTMLElement) => !contents && (box.contains(document.activeElement) || box.querySelector('details[open]') !== null);
    if (!in_use(this.list)) this.show_list(colours);
    if (!in_use(this.legend)) this.show_legend(legend);
  }

  /** The rows of the look have changed. */
  show(): void {
    for (const entry of [...this.in_list, ...this.in_legend]) entry.show();
  }

  private controls(entry: Entry): EntryControls {
    return new EntryControls(entry, this.materials, this.rows, (select) => this.show_only(select));
  }

  // Of all groups at most one is alone.
  private show_only(select: string | null): void {
    for (const other of new Set(this.groups.map((group) => group.select)))
      if (other !== select && this.rows.value(only_of(other), 'hide') !== null) this.rows.set(only_of(other), 'hide', null);
    if (select === null) return;
    this.rows.set(select, 'hide', null);
    this.rows.set(only_of(select), 'hide', '');
  }

  private show_list(colours: Map<string, string>): void {
    const lists = [...new Set(this.groups.map((group) => group.of))].map((of) => {
      const mine = this.groups.filter((group) => group.of === of);
      return { of, mine: mine.map((group) => this.controls({ ...group, colour: colours.get(group.select) ?? '' })) };
    });
    this.in_list = lists.flatMap(({ mine }) => mine);
    this.list.replaceChildren(
      ...lists.map(({ of, mine }) =>
        made('li', {}, made('h3', { textContent: words.groups[of] ?? of }), made('ul', {}, ...mine.map(({ box }) => box))),
      ),
    );
  }

  private show_legend(keys: LegendKey[]): void {
    this.in_legend = [];
    const parts = keys.flatMap(({ scale, title, entries }) => {
      const heading = made('p', { textContent: title });
      if (scale) {
        const bar = made('div', { className: 'scale' });
        bar.style.background = `linear-gradient(to right, ${scale.colours.join(', ')})`;
        const [least, most] = [scale.least, scale.most].map((end) => made('span', { textContent: String(+end.toPrecision(3)) }));
        return [heading, bar, made('p', { className: 'ends' }, least!, most!)];
      }
      const known = entries.filter(({ select }) => select !== '');
      if (known.length === 0) return [];
      const shown = known.slice(0, known.length > most_in_legend + 1 ? most_in_legend : known.length);
      const controls = shown.map((entry) => this.controls({ ...entry, count: null }));
      this.in_legend.push(...controls);
      const list = made('ul', {}, ...controls.map(({ box }) => box));
      if (shown.length === known.length) return [heading, list];
      const more = made('button', { type: 'button', textContent: words.more_entries(known.length - shown.length) });
      more.addEventListener('click', this.more);
      return [heading, list, more];
    });
    this.legend.replaceChildren(...parts);
    this.legend.hidden = parts.length === 0;
  }
}
