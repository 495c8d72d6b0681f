// The controls of how a file is read: one for each row of the library's table (src/bihive/io/reading_settings.h).
import { element, made } from './dom';
import { help_of, label_of } from './language';
import type { BuiltIn, Facts, Reading, Source } from './protocol';
import type { ReadingId } from './settings';

export interface ReadingRow {
  id: ReadingId;
  label: string;
  help: string;
  empty_means: string;
  kind: 'flag' | 'number' | 'text';
  excludes: ReadingId[];
  shown_for: 'scenarios_and_files' | 'files' | 'molecules' | 'frames' | 'cells';
  inputs: string;
}

interface Control {
  row: ReadingRow;
  box: HTMLElement;
  input: HTMLInputElement;
}

const value_of = ({ row, input }: Control) =>
  row.kind === 'flag' ? (input.checked ? 'true' : '') : row.kind === 'number' && input.value !== '' ? Number(input.value) : input.value.trim();

function has_input({ shown_for, inputs }: ReadingRow, kind: BuiltIn['kind'], facts: Facts | null): boolean {
  if (shown_for === 'scenarios_and_files') return kind !== 'fixed';
  if (kind !== 'file') return false;
  if (shown_for === 'molecules') return facts !== null && inputs.includes(facts.format);
  if (shown_for === 'frames') return facts !== null && facts.frames > 1;
  return shown_for === 'files' || (facts?.has_cell ?? false);
}

export class ReadingControls {
  private controls: Control[] = [];
  private shown: Source | null = null;

  /** Calls `read` with all that the controls ask for, and whether the columns are what has changed. */
  constructor(private readonly read: (reading: Reading | undefined, columns_changed: boolean) => void) {}

  build(rows: ReadingRow[]): void {
    this.controls = rows.map((row) => {
      const { id, kind } = row;
      const input = made('input', { id, title: help_of(`reading.${id}`, row.help), type: kind === 'flag' ? 'checkbox' : kind });
      Object.assign(input, kind === 'number' ? { min: '0', step: 'any', inputMode: 'decimal' } : { spellcheck: false, autocomplete: 'off' });
      input.placeholder = label_of(`reading.${id}.empty`, row.empty_means);
      const box = made('div', { class: kind === 'flag' ? 'row check' : 'row' });
      box.append(made('label', { for: id }, label_of(`reading.${id}`, row.label)), input);
      input.addEventListener('change', () => this.change(row));
      return { row, box, input };
    });
    element('reading').replaceChildren(...this.controls.map(({ box }) => box));
  }

  /** How the source was read; what its input does not have is left out. */
  show(source: Source, kind: BuiltIn['kind'], facts: Facts | null): void {
    this.shown = source;
    for (const { row, box, input } of this.controls) {
      const value = source.reading?.[row.id];
      if (row.kind === 'flag') input.checked = value !== undefined;
      else input.value = String(value ?? '');
      box.hidden = !has_input(row, kind, facts);
    }
  }

  /** Of an input that could not be read: what was asked for stays. */
  keep_columns(columns: string): void {
    for (const { row, input } of this.controls) if (row.id === 'columns') input.value = columns;
  }

  private change({ id, excludes }: ReadingRow): void {
    if (!this.controls.every(({ input }) => input.reportValidity())) return;
    const flag_on = this.controls.some(({ row, input }) => row.id === id && input.checked);
    for (const { row, input } of this.controls)
      if (flag_on && (excludes.includes(row.id) || row.excludes.includes(id))) input.checked = false;
    // What the address asks for, and has no control, stays.
    const reading: Reading = { ...this.shown?.reading };
    for (const control of this.controls) {
      const value = value_of(control);
      if (value === '') delete reading[control.row.id];
      else reading[control.row.id] = value;
    }
    this.read(Object.keys(reading).length > 0 ? reading : undefined, id === 'columns');
  }
}
