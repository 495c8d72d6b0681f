// "Save picture" and "Copy picture": their size, their progress, and the cancel button.
import { element } from './dom';
import { save } from './download';
import { busy, fail, note } from './messages';
import { words } from './words';

export interface SavingActions {
  /** Asks for the picture; returns the request's id. */
  draw(width_px: number, height_px: number): number;
  cancel(): void;
  /** Another size is chosen. */
  resized(): void;
}

const most_side = 16384; // as the library's

type Size = (screen: { width: number; height: number }) => { width: number; height: number };

const times = (factor: number): Size => ({ width, height }) => ({ width: factor * width, height: factor * height });
const fixed = (width: number, height: number): Size => () => ({ width, height });
// As wide as a journal's column, at 300 dots per inch, in the shape of the screen's picture.
const wide_cm = (cm: number): Size => ({ width, height }) => {
  const px = Math.round((cm / 2.54) * 300);
  return { width: px, height: Math.round((px * height) / width) };
};

const sizes: [label: string, size: Size | null][] = [
  [words.saving.sizes.screen, times(1)],
  [words.saving.sizes.twice, times(2)],
  [words.saving.sizes.four_times, times(4)],
  [words.saving.sizes.slide, fixed(1920, 1080)],
  [words.saving.sizes.square, fixed(2000, 2000)],
  [words.saving.sizes.one_column, wide_cm(8.5)],
  [words.saving.sizes.two_columns, wide_cm(17.8)],
  [words.saving.sizes.other, null],
];

// Where there is a clipboard for pictures: on a secure page alone.
const can_copy = () => 'clipboard' in navigator && 'ClipboardItem' in globalThis;

export class Saving {
  private readonly list = element<HTMLSelectElement>('save_size');
  private readonly width = element<HTMLInputElement>('save_width');
  private readonly height = element<HTMLInputElement>('save_height');
  private readonly start = element<HTMLButtonElement>('save');
  private readonly copy = element<HTMLButtonElement>('save_copy');
  private readonly cancel = element<HTMLButtonElement>('save_cancel');
  private screen = { width: 1, height: 1 };
  private most_pixels = Infinity;
  private id = 0; // of the awaited picture
  private to_clipboard: ((picture: Blob | null) => void) | null = null; // where the awaited one goes; null: into a file
  private forget_cancelled = () => {}; // the words about the last one

  constructor(private readonly actions: SavingActions) {
    this.list.append(...sizes.map(([label]) => Object.assign(document.createElement('option'), { textContent: label })));
    this.list.addEventListener('change', () => this.fit());
    for (const input of [this.width, this.height])
      input.addEventListener('input', () => {
        this.list.selectedIndex = sizes.length - 1;
        actions.resized();
      });
    this.start.addEventListener('click', () => this.begin());
    this.copy.addEventListener('click', () => this.begin_copy());
    this.cancel.addEventListener('click', () => actions.cancel());
    this.copy.hidden = !can_copy();
  }

  /** Of a picture that memory holds. */
  limit(most_pixels: number): void {
    this.most_pixels = most_pixels;
    this.fit();
  }

  /** The size of the picture on the screen. */
  propose(width: number, height: number): void {
    this.screen = { width, height };
    this.fit();
  }

  private fit(): void {
    for (const [i, [, size]] of sizes.entries()) {
      const { width, height } = size?.(this.screen) ?? { width: 0, height: 0 };
      this.list.options[i]!.disabled = width * height > this.most_pixels || Math.max(width, height) > most_side;
    }
    if (this.list.selectedOptions[0]?.disabled) this.list.selectedIndex = 0;
    const [, size] = sizes[this.list.selectedIndex]!;
    if (!size) return;
    const { width, height } = size(this.screen);
    this.width.value = String(width);
    this.height.value = String(height);
    this.actions.resized();
  }

  /** The wanted size; null: a field has none. */
  size(): { width: number; height: number } | null {
    if (!this.width.validity.valid || !this.height.validity.valid) return null;
    const [width, height] = [Number(this.width.value), Number(this.height.value)];
    return width > 0 && height > 0 ? { width, height } : null;
  }

  /** The same; the browser says what is wrong with a field. */
  chosen(): { width: number; height: number } | null {
    if (!this.width.reportValidity() || !this.height.reportValidity()) return null;
    return this.size();
  }

  private begin(): boolean {
    const size = this.chosen();
    if (!size) return false;
    this.forget_cancelled();
    this.to_clipboard = null;
    this.set_running(true);
    busy(words.saving.drawing);
    this.id = this.actions.draw(size.width, size.height);
    return true;
  }

  // A browser lets the page copy right after a click alone, so it gets the picture as a promise.
  private begin_copy(): void {
    if (!this.begin()) return;
    let came = true;
    const picture = new Promise<Blob>((resolve, reject) => {
      this.to_clipboard = (drawn) => {
        came = drawn !== null;
        if (drawn) resolve(drawn);
        else reject(new Error('there is none')); // done() or failed() says why
      };
    });
    picture.catch(() => {});
    navigator.clipboard.write([new ClipboardItem({ 'image/png': picture })]).then(
      () => note(words.saving.copied),
      (error: Error) => {
        if (came) fail(words.saving.not_copied(error.message));
      },
    );
  }

  /** A picture is being drawn to be saved. */
  get is_running(): boolean {
    return !this.cancel.hidden;
  }

  // The focus moves to the button that replaces the other.
  private set_running(running: boolean): void {
    const starts = [this.start, this.copy];
    const had_focus = [...starts, this.cancel].find((button) => button === document.activeElement);
    this.cancel.hidden = !running;
    this.start.hidden = running;
    this.copy.hidden = running || !can_copy();
    if (had_focus) (running ? this.cancel : this.start).focus();
  }

  progress(done: number): void {
    if (!this.cancel.hidden) busy(`${words.saving.drawing}: ${Math.floor(100 * done)} %`, done);
  }

  /** `picture` null: cancelled. */
  done(picture: Blob | null, scene: string): void {
    busy(null);
    this.set_running(false);
    const copied = this.to_clipboard;
    this.to_clipboard = null;
    if (copied) copied(picture);
    else if (picture) save(picture, `${scene.replace(/.*\//, '').replace(/\.[^.]*$/, '')}.png`);
    if (!picture) this.forget_cancelled = note(words.saving.cancelled);
  }

  failed(id: number | null): void {
    if (id !== this.id) return;
    this.set_running(false);
    this.to_clipboard?.(null);
    this.to_clipboard = null;
  }
}
