// The panel's appearance controls: style, colours of elements, background, the rows of selections with actions, and
// controls for all spheres.
import { ColourControls } from './colours';
import { element, RadioGroup } from './dom';
import type { Choices, ColouredBy, Facts, Look, LookFault, LookRow } from './protocol';
import { build_style_tiles } from './style_tiles';

// Actions with a value: its name, and an example of it. `label`: of the action, where its name says too little.
interface ValueWords {
  value: string;
  hint: string;
  list: string;
  mode: string;
  label?: string;
}
const value_words: Record<string, ValueWords> = {
  colour: { value: 'a colour', hint: 'orange or #ff8800', list: 'colour_names', mode: 'text' },
  'colour-by': { value: 'an attribute', hint: 'chain or b_factor:magma', list: 'colour_attributes', mode: 'text' },
  opacity: { value: 'an opacity', hint: '0 to 1', list: '', mode: 'decimal' },
  material: { value: 'a material', hint: 'metal', list: 'material_names', mode: 'text' },
  'radius-scale': { value: 'a factor', hint: '0.5', list: '', mode: 'decimal', label: 'radius ×' },
  outline: { value: 'a width', hint: '0 to 16', list: '', mode: 'decimal', label: 'outline px' },
  crease: { value: 'an attribute', hint: 'chain', list: 'colour_attributes', mode: 'text' },
  'legend-name': { value: 'a name', hint: 'ligand', list: '', mode: 'text', label: 'name in legend' },
  clip: { value: 'a shape', hint: 'plane:0,0,1,0', list: '', mode: 'text' },
};
const is_complete = ({ action, value }: LookRow) => !(action in value_words) || value !== '';
const waiting = ({ action }: LookRow) => `It waits for ${value_words[action]!.value}: ${value_words[action]!.hint}`;
const option = (value: string, text: string) => Object.assign(document.createElement('option'), { value, textContent: text });

// One row of controls.
class RowControls {
  readonly box: HTMLElement;
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
    const words = value_words[this.action.value];
    this.value.hidden = !words;
    if (!words) return;
    this.value.placeholder = words.hint;
    this.value.inputMode = words.mode;
    if (words.list) this.value.setAttribute('list', words.list);
    else this.value.removeAttribute('list');
  }
}

export class LookControls {
  private readonly style = new RadioGroup('style', (style) => this.change({ style }));
  private readonly colours = element<HTMLSelectElement>('element_colours');
  private readonly background = element<HTMLSelectElement>('background');
  private readonly background_colour = element<HTMLInputElement>('background_colour');
  private readonly list = element('look_rows');
  private readonly of_all: ColourControls;
  private rows: RowControls[] = [];
  private sent: RowControls[] = []; // the rows of the last request, without incomplete ones
  private made = 0;
  private file_of_spheres = true;

  constructor(private readonly change: (changes: Partial<Look>) => void) {
    this.of_all = new ColourControls(change);
    this.colours.addEventListener('change', () => change({ element_colours: this.colours.value }));
    this.background.addEventListener('change', () => this.change_background());
    this.background_colour.addEventListener('input', () => this.change_background());
    element('look_add').addEventListener('click', () => this.add({ select: '', action: 'colour', value: '' }).focus());
  }

  /** The library's names. */
  build({ styles, actions, materials }: Choices): void {
    build_style_tiles(styles);
    const list = element<HTMLTemplateElement>('look_row').content.querySelector('.action')!;
    list.append(...actions.map((name) => option(name, value_words[name]?.label ?? name.replaceAll('-', ' '))));
    element('material_names').append(...materials.map((name) => option(name, '')));
  }

  /** What the scene has. */
  show_facts(facts: Facts): void {
    this.file_of_spheres = facts.is_file_of_spheres;
    this.of_all.show_facts(facts);
    element('style').hidden = !facts.takes_style;
    element('style_note').hidden = facts.takes_style;
    element('own_style').hidden = facts.is_file_of_spheres;
    element('element_colours_row').hidden = !facts.has_elements;
    const options = (names: string[]) => names.map((name) => option(name, ''));
    element('colour_attributes').replaceChildren(...options(facts.attributes));
    element('selection_words').replaceChildren(...options(['all', ...facts.attributes.map((name) => `${name} `)]));
    element('look_names').textContent = facts.attributes.join(', ');
  }

  /** The look of a newly loaded scene, or one that is restored. `counts`: the rows' numbers of spheres, if known. */
  show(look: Look, counts: number[] | null, coloured_by: ColouredBy[]): void {
    this.show_choices(look);
    this.of_all.show_ranges(coloured_by);
    this.rows = [];
    this.list.replaceChildren();
    for (const row of look.rows) this.add(row);
    this.sent = [...this.rows];
    if (counts) this.show_counts(counts);
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
    const is_colour = look.background !== '' && look.background !== 'none';
    this.background.value = is_colour ? 'colour' : look.background;
    this.background_colour.hidden = !is_colour;
    if (is_colour && /^#[0-9a-f]{6}$/i.test(look.background)) this.background_colour.value = look.background;
  }

  /** The answer to the last request for a look. Rows keep what the user typed. */
  answer(look: Look, counts: number[], coloured_by: ColouredBy[] | null, fault: LookFault | null): void {
    this.show_choices(look);
    if (coloured_by) this.of_all.show_ranges(coloured_by);
    if (fault) this.sent[fault.row]?.say(fault.message, true);
    // The rows in the answer may be older than those with a fault.
    else if (JSON.stringify(this.sent.map(({ row }) => row)) === JSON.stringify(look.rows)) this.show_counts(counts);
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

  private remove(controls: RowControls): void {
    const at = this.rows.indexOf(controls);
    this.rows.splice(at, 1);
    controls.box.remove();
    (this.rows[Math.min(at, this.rows.length - 1)] ?? { focus: () => element('look_add').focus() }).focus();
    this.change_rows();
  }

  private change_rows(): void {
    for (const row of this.rows) row.say(is_complete(row.row) ? '' : waiting(row.row), false);
    this.sent = this.rows.filter(({ row }) => is_complete(row));
    this.change({ rows: this.sent.map(({ row }) => row) });
  }
}
