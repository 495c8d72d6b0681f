// The panel's group of the periodic cell: its edges, and copies along its vectors.
import { element } from './dom';
import type { Changes, Facts, Settings } from './protocol';

export class CellControls {
  private readonly edges = element<HTMLInputElement>('cell');
  private readonly copies = ['copies_a', 'copies_b', 'copies_c'].map((id) => element<HTMLInputElement>(id));

  constructor(change: (changes: Changes) => void) {
    this.edges.addEventListener('change', () => change({ cell: this.edges.checked }));
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

  /** What the user is writing stays. */
  show({ engine, cell, replicate }: Settings): void {
    this.edges.checked = cell;
    const gpu = engine === 'gpu';
    element('cell_note').hidden = !gpu;
    for (const input of [this.edges, ...this.copies]) input.disabled = gpu;
    if (this.copies.includes(document.activeElement as HTMLInputElement)) return;
    for (const [i, input] of this.copies.entries()) input.value = replicate ? String(replicate[i]) : '';
  }
}
