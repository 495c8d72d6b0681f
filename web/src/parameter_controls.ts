// The controls of a picture's parameters: one for each row of the table that has a label, in the element of its group,
// [data-parameters].
import { made } from './dom';
import { Field, readable } from './field';
import { help_of, label_of } from './language';
import { is_beyond, is_in_range, is_off, note_of, slider_words, type Id, type Parameter, type Value } from './parameter';
import type { Changes, Settings } from './protocol';
import { Slider } from './slider';

/** The control itself, without its label. */
interface Input {
  show(value: Value): void;
  disable(off: boolean): void;
}

type Attributes = Record<string, string | number>;

const largest = 3e38; // means any number

const typographic = (text: string) => text.replace(/\s+/g, ' ').replaceAll("'", '’');
const sentence = (text: string) => typographic(text.charAt(0).toUpperCase() + text.slice(1));

export class ParameterControls {
  private rows: Parameter[] = [];
  private controls: { row: Parameter; input: Input; note: HTMLElement | null }[] = [];

  constructor(private readonly change: (changes: Changes) => void) {}

  /** Makes the controls, once the table is known. */
  build(rows: Parameter[]): void {
    this.rows = rows;
    for (const box of document.querySelectorAll<HTMLElement>('[data-parameters]')) {
      const ours = rows.filter(({ group, in_window, label }) => group === box.dataset['parameters'] && in_window && label);
      ours.sort((a, b) => (a.place ?? 0) - (b.place ?? 0));
      for (const row of ours) this.add(row, box);
    }
  }

  show(settings: Settings): void {
    for (const { row, input, note } of this.controls) {
      input.show(settings[row.id]);
      input.disable(is_off(row, this.rows, settings));
      if (note) note.hidden = !is_beyond(row, settings);
    }
  }

  private add(row: Parameter, box: HTMLElement): void {
    const { id, kind, slider } = row;
    const why = note_of(row);
    const attributes = { id, title: sentence(help_of(id, row.help)), ...(why ? { 'aria-describedby': `${id}_note` } : {}) };
    const line = made('div', { class: kind === 'flag' ? 'row check' : 'row' });
    line.append(made('label', { for: id }, sentence(label_of(id, row.long_label ?? row.label!))));
    box.append(line);
    const make = kind === 'flag' ? this.flag : kind === 'choice' ? this.choice : slider ? this.slider : this.field;
    const input = make.call(this, row, attributes, line);
    const note = why ? made('p', { class: 'hint', id: `${id}_note`, hidden: '' }, `${typographic(label_of(`${id}.note`, why))}.`) : null;
    if (note) box.append(note);
    this.controls.push({ row, input, note });
  }

  private set(id: Id, value: Value): void {
    this.change({ [id]: value });
  }

  private flag({ id }: Parameter, attributes: Attributes, line: HTMLElement): Input {
    const input = made('input', { ...attributes, type: 'checkbox' });
    input.addEventListener('change', () => this.set(id, input.checked));
    line.append(input);
    return { show: (value) => (input.checked = value as boolean), disable: (off) => (input.disabled = off) };
  }

  private choice({ id, names = [], choice_labels = names }: Parameter, attributes: Attributes, line: HTMLElement): Input {
    const select = made('select', attributes);
    select.append(...names.map((value, i) => made('option', { value }, label_of(`${id}.${value}`, choice_labels[i]!))));
    select.addEventListener('change', () => this.set(id, select.value));
    line.append(select);
    return { show: (value) => (select.value = value as string), disable: (off) => (select.disabled = off) };
  }

  private slider(row: Parameter, attributes: Attributes, line: HTMLElement): Input {
    const { id, least = 0, or_zero } = row;
    const [min, max, step] = row.slider!;
    line.append(made('input', { ...attributes, type: 'range', min, max, step }), made('output', { for: id, 'aria-live': 'off' }));
    const in_range = (value: number) => (or_zero && value < least ? (value < least / 2 ? 0 : least) : value);
    const slider = new Slider(id, (value) => slider_words(row, value), (value) => this.set(id, in_range(value)));
    return { show: (value) => (slider.value = value as number), disable: (off) => (slider.disabled = off) };
  }

  // An empty one means the default.
  private field(row: Parameter, attributes: Attributes, line: HTMLElement): Input {
    const { id, kind, empty_means, least = 0, most = largest } = row;
    const is_number = kind === 'number' || kind === 'whole';
    const input = made('input', { ...attributes, type: is_number ? 'number' : 'text', autocomplete: 'off' });
    if (empty_means) input.placeholder = typographic(label_of(`${id}.empty`, empty_means));
    if (is_number) {
      input.step = kind === 'whole' ? '1' : 'any';
      input.inputMode = kind === 'whole' ? 'numeric' : 'decimal';
      if (least > -largest) input.min = String(row.or_zero ? 0 : least);
      if (most < largest) input.max = String(most);
    }
    line.append(input);
    const parsed = (text: string): Value | undefined => {
      if (text === '') return row.default;
      if (!is_number) return text;
      return is_in_range(row, Number(text)) ? Number(text) : undefined;
    };
    const words = (value: Value) => (typeof value === 'number' ? readable(value) : typeof value === 'string' ? value : '');
    const field = new Field<Value>(id, words, parsed, (value) => this.set(id, value));
    return { show: (value) => (field.value = value), disable: (off) => (field.disabled = off) };
  }
}
