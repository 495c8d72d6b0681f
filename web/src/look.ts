// The panel's appearance controls: style, colours of elements, background, the rows of selections with actions, and
// controls for all spheres.
import { ColourControls } from './colours';
import { add_options, element, RadioGroup } from './dom';
import type { Action, Choices, ColouredBy, Facts, Histogram, Look, LookFault, LookRow } from './protocol';
import { label_of } from './language';
import type { LookRows } from './groups';
import { fail } from './messages';
import { build_style_tiles } from './style_tiles';
import { words } from './words';

// Lists of names for values.
const lists: Record<Action['names'], string> = { none: '', colours: 'colour_names', materials: 'material_names', attributes: 'colour_attributes' };
const actions = new Map<string, Action>();
const is_complete = ({ action, value }: LookRow) => !actions.get(action)?.value || value !== '';
const waiting = ({ action }: LookRow) => words.row_waits(actions.get(action)!.value, actions.get(action)!.example);
const in_list = (names: string[]) => names.map((name) => ({ name, label: '' }));

// One row of controls.
class RowControls {
  readonly box: HTMLElement;
  by_list = false; // made by an entry of a list: there its fault would not be seen
  private readonly select: HTMLInputElement;
  private readonly action: HTMLSelectElement;
  private readonly value: HTMLInputElement;
  private readonly words: HTMLElement;

  constructor(number: number, row: LookRow, on_change: () => void, on_remove: () => void) {
    const template = element<HTMLTemplateElement>('look_row').content.cloneNode(true) as DocumentFragment;
    this.box = template.querySelector<HTMLElement>('.look_row')!;
    this.select = this.box.querySelector<HTMLInputElement>('.select')!;
    this.action = this.box.querySelector<HTMLSelectElement>('.action')!;
    this.value = this.box.querySelector<HTMLInputElement>('.value')!;
    this.words = this.box.querySelector<HTMLElement>('.words')!;
    this.words.id = `look_words_${number}`;
    for (const input of [this.select, this.value]) input.setAttribute('aria-describedby', this.words.id);
    this.select.value = row.select;
    this.action.value = row.action;
    this.value.value = row.value;
    this.fit_value();
    for (const input of [this.select, this.value]) input.addEventListener('change', on_change);
    this.action.addEventListener('change', () => {
      this.value.value = '';
      this.fit_value();
      on_change();
    });
    this.box.querySelector('button')!.addEventListener('click', on_remove);
  }

  set row_value(value: string) {
    this.value.value = value;
  }

  get row(): LookRow {
    return { select: this.select.value.trim(), action: this.action.value, value: this.value.value.trim() };
  }

  focus(): void {
    this.select.focus();
  }

  /** The row's number of spheres, or its fault. */
  say(text: string, is_fault: boolean): void {
    this.words.textContent = text;
    this.words.classList.toggle('fault', is_fault);
    for (const input of [this.select, this.value]) input.setAttribute('aria-invalid', String(is_fault));
  }

  private fit_value(): void {
    const action = actions.get(this.action.value);
    this.value.hidden = !action?.value;
    if (!action?.value) return;
    this.value.placeholder = action.example;
    this.value.inputMode = action.is_number ? 'decimal' : 'text';
    this.value.setAttribute('list', lists[action.names]);
  }
}

export class LookControls implements LookRows {
  private readonly style = new RadioGroup('style', (style) => this.change({ style }));
  private readonly colours = element<HTMLSelectElement>('element_colours');
  private readonly background = element<HTMLSelectElement>('background');
  private readonly background_colour = element<HTMLInputElement>('background_colour');
  private readonly list = element('look_rows');
  private readonly of_all: ColourControls;
  private rows: RowControls[] = [];
  private sent: RowControls[] = []; // the rows of the last request, without incomplete ones
  private last_of_list: RowControls | null = null;
  private made = 0;
  private file_of_spheres = true;
  private clear = element<HTMLInputElement>('save_clear');

  constructor(private readonly change: (changes: Partial<Look>) => void, histogram_of: (attribute: string) => void) {
    this.of_all = new ColourControls(change, histogram_of);
    this.clear.addEventListener('change', () => change({ background: this.clear.checked ? 'none' : '' }));
    this.colours.addEventListener('change', () => change({ element_colours: this.colours.value }));
    this.background.addEventListener('change', () => this.change_background());
    this.background_colour.addEventListener('input', () => this.change_background());
    element('look_add').addEventListener('click', () => this.add({ select: '', action: 'colour', value: '' }).focus());
  }

  /** The library's names. */
  build(choices: Choices): void {
    build_style_tiles(choices.styles);
    this.of_all.build(choices);
    for (const action of choices.actions) actions.set(action.name, action);
    add_options(element<HTMLTemplateElement>('look_row').content.querySelector<HTMLElement>('.action')!, choices.actions.map(({ name, label }) => ({ name, label: label_of(`action.${name}`, label) })));
    add_options(element('material_names'), in_list(choices.materials));
    add_options(element('colour_names'), in_list(choices.colours));
    add_options(this.colours, choices.element_colours.map((name) => ({ name })));
  }

  /** What the scene has. */
  show_facts(facts: Facts): void {
    this.file_of_spheres = facts.is_file_of_spheres;
    this.of_all.show_facts(facts);
    element('style').hidden = !facts.takes_style;
    element('style_note').hidden = facts.takes_style;
    element('own_style').hidden = facts.is_file_of_spheres;
    element('element_colours_row').hidden = !facts.has_elements;
    const replace = (id: string, names: string[]) => {
      element(id).replaceChildren();
      add_options(element(id), in_list(names));
    };
    replace('colour_attributes', facts.attributes);
    replace('selection_words', ['all', ...facts.attributes.map((name) => `${name} `)]);
    element('look_names').textContent = facts.attributes.join(', ');
  }

  /** The look of a newly loaded scene, or one that is restored. `counts`: the rows' numbers of spheres, if known. */
  show(look: Look, counts: number[] | null, coloured_by: ColouredBy[]): void {
    this.show_choices(look);
    this.of_all.show_ranges(coloured_by);
    this.rows = [];
    this.last_of_list = null;
    this.list.replaceChildren();
    for (const row of look.rows) this.add(row);
    this.sent = [...this.rows];
    if (counts) this.show_counts(counts);
  }

  value(select: string, action: string): string | null {
    return this.rows.find(({ row }) => row.select === select && row.action === action)?.row.value ?? null;
  }

  set(select: string, action: string, value: string | null): void {
    const known = this.rows.find(({ row }) => row.select === select && row.action === action);
    if (value === null) {
      if (known) this.take_out(known);
    } else if (known) known.row_value = value;
    else {
      this.last_of_list = this.add({ select, action, value });
      this.last_of_list.by_list = true;
    }
    this.change_rows();
  }

  /** A new row for these spheres, which waits for its action. */
  begin_row(select: string): void {
    this.add({ select, action: 'colour', value: '' }).focus();
    this.change_rows();
  }

  histogram(attribute: string, histogram: Histogram | null): void {
    this.of_all.take_histogram(attribute, histogram);
  }

  private show_counts(counts: number[]): void {
    for (const [i, row] of this.sent.entries()) {
      const count = counts[i] ?? 0;
      row.say(count === 1 ? '1 sphere' : `${count.toLocaleString('en')} spheres`, false);
    }
  }

  private show_choices(look: Look): void {
    this.style.value = look.style === '' && this.file_of_spheres ? 'default' : look.style;
    this.colours.value = look.element_colours;
    this.of_all.show(look);
    this.clear.checked = look.background === 'none';
    const is_colour = look.background !== '' && look.background !== 'none';
    this.background.value = is_colour ? 'colour' : look.background;
    this.background_colour.hidden = !is_colour;
    if (is_colour && /^#[0-9a-f]{6}$/i.test(look.background)) this.background_colour.value = look.background;
  }

  /** The answer to the last request for a look. Rows keep what the user typed. */
  answer(look: Look, counts: number[], coloured_by: ColouredBy[] | null, fault: LookFault | null): void {
    this.show_choices(look);
    if (coloured_by) this.of_all.show_ranges(coloured_by);
    // Of all rows together, the last one is it.
    const faulty = fault && (this.sent[fault.row] ?? this.last_of_list);
    if (faulty?.by_list) {
      if (fault!.row >= 0) fail(fault!.message); // others are told
      this.take_out(faulty);
      this.change_rows();
    } else if (faulty) faulty.say(fault!.message, true);
    // The rows in the answer may be older than those with a fault.
    else if (!fault && JSON.stringify(this.sent.map(({ row }) => row)) === JSON.stringify(look.rows)) this.show_counts(counts);
  }

  private change_background(): void {
    const { value } = this.background;
    this.background_colour.hidden = value !== 'colour';
    this.change({ background: value === 'colour' ? this.background_colour.value : value });
  }

  private add(row: LookRow): RowControls {
    const controls: RowControls = new RowControls(
      ++this.made,
      row,
      () => this.change_rows(),
      () => this.remove(controls),
    );
    this.rows.push(controls);
    this.list.append(controls.box);
    return controls;
  }

  private take_out(controls: RowControls): number {
    const at = this.rows.indexOf(controls);
    this.rows.splice(at, 1);
    if (this.last_of_list === controls) this.last_of_list = null;
    controls.box.remove();
    return at;
  }

  private remove(controls: RowControls): void {
    const at = this.take_out(controls);
    (this.rows[Math.min(at, this.rows.length - 1)] ?? { focus: () => element('look_add').focus() }).focus();
    this.change_rows();
  }

  private change_rows(): void {
    for (const row of this.rows) row.say(is_complete(row.row) ? '' : waiting(row.row), false);
    this.sent = this.rows.filter(({ row }) => is_complete(row));
    this.change({ rows: this.sent.map(({ row }) => row) });
  }
}
