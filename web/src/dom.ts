// The page's elements by their ids.

/** Throws where index.html and the code disagree. */
export function element<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`index.html has no element "${id}"`);
  return found as T;
}

/** The radio buttons of a group as one value. */
export class RadioGroup {
  private readonly buttons: HTMLInputElement[];

  constructor(fieldset: string, on_change: (value: string) => void) {
    this.buttons = [...element(fieldset).querySelectorAll<HTMLInputElement>('input[type=radio]')];
    for (const button of this.buttons)
      button.addEventListener('change', () => {
        if (button.checked) on_change(button.value);
      });
  }

  set value(value: string) {
    for (const button of this.buttons) button.checked = button.value === value;
  }
}

const whole = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });

/** 12345 as "12,345". */
export function grouped(value: number): string {
  return whole.format(value);
}
