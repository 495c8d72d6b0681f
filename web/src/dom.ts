// The page's elements by their ids.

/** Throws where index.html and the code disagree. */
export function element<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`index.html has no element "${id}"`);
  return found as T;
}

/** A new element with these attributes and this text. */
export function made<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  attributes: Record<string, string | number> = {},
  text = '',
): HTMLElementTagNameMap[Tag] {
  const one = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) one.setAttribute(name, String(value));
  one.textContent = text;
  return one;
}

/** Adds choices to a list: names of the library, each with the text that people read. */
export function add_options(list: HTMLElement, choices: { name: string; label?: string }[]): void {
  list.append(...choices.map(({ name, label = name }) => made('option', { value: name }, label)));
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
