// The page's elements by their ids.

/** Throws where index.html and the code disagree. */
export function element<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`index.html has no element "${id}"`);
  return found as T;
}

/** The radio buttons of a group as one value. */
export class RadioGroup {
  private readonly box: HTMLElement;

  constructor(fieldset: string, on_change: (value: string) => void) {
    this.box = element(fieldset);
    this.box.addEventListener('change', ({ target }) => {
      if (target instanceof HTMLInputElement && target.checked) on_change(target.value);
    });
  }

  set value(value: string) {
    for (const button of this.box.querySelectorAll<HTMLInputElement>('input[type=radio]')) button.checked = button.value === value;
  }
}

const whole = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });

/** 12345 as "12,345". */
export function grouped(value: number): string {
  return whole.format(value);
}
