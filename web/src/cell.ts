// The copies of the periodic cell along its vectors.
import { element } from './dom';
import type { Changes, Facts, Settings } from './protocol';

export class CellControls {
  private readonly copies = ['copies_a', 'copies_b', 'copies_c'].map((id) => element<HTMLInputElement>(id));

  constructor(change: (changes: Changes) => void) {
    for (const input of this.copies)
      input.addEventListener('change', () => {
        if (!this.copies.every((one) => one.reportValidity())) return;
        const [a, b, c] = this.copies.map((one) => (one.value === '' ? Number(one.placeholder) : Number(one.value)));
        change({ replicate: this.copies.every((one) => one.value === '') ? null : [a!, b!, c!] });
      });
  }

  /** An empty field is the input's own number. */
  show_facts({ has_cell, copies }: Facts): void {
    element('cell_group').hidden = !has_cell;
    for (const [i, input] of this.copies.entries()) input.placeholder = String(copies[i]);
  }

  /** Keeps what the user is typing. */
  show({ engine, replicate }: Settings): void {
    for (const input of this.copies) input.disabled = engine === 'gpu';
    if (this.copies.includes(document.activeElement as HTMLInputElement)) return;
    for (const [i, input] of this.copies.entries()) input.value = replicate ? String(replicate[i]) : '';
  }
}
