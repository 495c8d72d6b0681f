// Area, volume and cavities of the spheres that are shown, or of some of them.
import { element } from './dom';
import { readable } from './field';
import { grouped, words } from './words';
import type { UnionNumbers } from './protocol';

export class UnionMeasures {
  private readonly selection = element<HTMLInputElement>('union_selection');
  private readonly probe = element<HTMLInputElement>('union_probe');
  private readonly button = element<HTMLButtonElement>('union_measure');
  private readonly result = element('union_result');
  private unit = '';

  constructor(measure: (selection: string, probe: number) => void) {
    const ask = () => {
      if (this.button.disabled || !this.probe.reportValidity()) return;
      this.button.disabled = true;
      this.result.textContent = words.union.measuring;
      measure(this.selection.value.trim(), this.probe.valueAsNumber || 0);
    };
    this.button.addEventListener('click', ask);
    for (const field of [this.selection, this.probe])
      field.addEventListener('keydown', ({ key }) => {
        if (key === 'Enter') ask();
      });
  }

  /** Another scene. */
  begin(unit: string): void {
    this.unit = unit;
    this.outdated();
  }

  /** Other spheres are shown, or in other places. */
  outdated(): void {
    this.result.replaceChildren();
  }

  done(numbers: UnionNumbers | null): void {
    this.button.disabled = false;
    this.outdated();
    if (!numbers) return;
    const unit = (power: string) => (this.unit ? ` ${this.unit}${power}` : '');
    const { area, volume, cavities, components, spheres } = numbers;
    const lines = [
      words.union.area(`${readable(area)}${unit('²')}`),
      words.union.volume(`${readable(volume)}${unit('³')}`),
      numbers.undecided_spheres > 0
        ? words.union.undecided
        : words.union.cavities(cavities.length, `${readable(cavities.reduce((sum, one) => sum + one, 0))}${unit('³')}`, components),
      words.union.of(grouped(spheres)),
    ];
    this.result.replaceChildren(...lines.map((textContent) => Object.assign(document.createElement('p'), { textContent })));
  }
}
