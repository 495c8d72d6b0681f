// A field for a text or a number.
import { element } from './dom';
import { is_typing_in } from './typing';

export class Field<T> {
  private readonly input: HTMLInputElement;

  /** `words`: a value as text; `parse` gives undefined if a text is not a value. */
  constructor(
    id: string,
    private readonly words: (value: T) => string,
    parse: (text: string) => T | undefined,
    on_change: (value: T) => void,
  ) {
    this.input = element<HTMLInputElement>(id);
    this.input.addEventListener('change', () => {
      if (!this.input.reportValidity()) return;
      const value = parse(this.input.value.trim());
      if (value !== undefined) on_change(value);
    });
  }

  /** Keeps what the user is typing. */
  set value(value: T) {
    if (!is_typing_in(this.input)) this.input.value = this.words(value);
  }

  set disabled(disabled: boolean) {
    this.input.disabled = disabled;
  }
}

/** Formats a number with six digits. */
export const readable = (value: number) => String(+value.toPrecision(6));
