// A slider with its value beside it.
import { element } from './dom';

export class Slider {
  private readonly input: HTMLInputElement;
  private readonly output: HTMLOutputElement;

  constructor(id: string, private readonly words: (value: number) => string, on_change: (value: number) => void) {
    this.input = element<HTMLInputElement>(id);
    this.output = document.querySelector<HTMLOutputElement>(`output[for=${id}]`)!;
    this.input.addEventListener('input', () => {
      this.show();
      on_change(Number(this.input.value));
    });
  }

  set value(value: number) {
    this.input.value = String(value);
    this.show(value);
  }

  set disabled(disabled: boolean) {
    this.input.disabled = disabled;
  }

  // A value beyond the slider's end is shown as it is. The page is not touched if it already shows it.
  private show(value = Number(this.input.value)): void {
    const words = this.words(value);
    if (this.output.textContent === words) return;
    this.output.textContent = words;
    this.input.setAttribute('aria-valuetext', words);
  }
}
