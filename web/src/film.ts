// The film of the card "Save": once around, or all frames of the file.
import { add_options, element } from './dom';
import { save } from './download';
import { busy, note } from './messages';
import type { FilmRequest, TurnAxis } from './protocol';
import { words } from './words';

export interface FilmActions {
  /** Asks for the film; returns the request's id. */
  draw(request: Omit<FilmRequest, 'keep_in_view'>): number;
  cancel(): void;
  /** The size of a picture to be saved; null: the fields have none. */
  size(): { width: number; height: number } | null;
}

const frames_kind = 'frames';

export class Film {
  private readonly kind = element<HTMLSelectElement>('film_kind');
  private readonly seconds = element<HTMLInputElement>('film_seconds');
  private readonly speed = element<HTMLInputElement>('film_speed');
  private readonly start = element<HTMLButtonElement>('film_save');
  private readonly cancel = element<HTMLButtonElement>('film_cancel');
  private frames = 1;
  private id = 0; // of the awaited film

  constructor(private readonly actions: FilmActions) {
    add_options(this.kind, Object.entries(words.film.kinds).map(([name, label]) => ({ name, label })));
    this.kind.addEventListener('change', () => this.fit());
    this.start.addEventListener('click', () => this.begin());
    this.cancel.addEventListener('click', () => actions.cancel());
    const can = 'VideoEncoder' in globalThis;
    element('film_controls').hidden = !can;
    element('film_none').hidden = can;
  }

  /** Of the shown file. */
  show_frames(frames: number): void {
    this.frames = frames;
    const of_file = this.kind.querySelector<HTMLOptionElement>(`[value=${frames_kind}]`)!;
    of_file.hidden = of_file.disabled = frames < 2;
    if (frames < 2 && this.kind.value === frames_kind) this.kind.selectedIndex = 0;
    this.fit();
  }

  private fit(): void {
    element('film_seconds_row').hidden = this.kind.value === frames_kind;
  }

  private begin(): void {
    const size = this.actions.size();
    if (!size || !this.seconds.reportValidity() || !this.speed.reportValidity()) return;
    const even = (px: number) => Math.max(2, px - (px % 2)); // codecs halve the pixels of colours
    const frames_per_second = Number(this.speed.value);
    const of_file = this.kind.value === frames_kind;
    const frames = of_file ? this.frames : Math.max(2, Math.round(Number(this.seconds.value) * frames_per_second));
    const turn = of_file ? null : (this.kind.value as TurnAxis);
    this.set_running(true);
    busy(words.film.drawing, 0);
    this.id = this.actions.draw({ width_px: even(size.width), height_px: even(size.height), frames, frames_per_second, turn });
  }

  /** A film is being drawn. */
  get is_running(): boolean {
    return !this.cancel.hidden;
  }

  // The focus moves to the button that replaces the other.
  private set_running(running: boolean): void {
    const had_focus = [this.start, this.cancel].find((button) => button === document.activeElement);
    this.cancel.hidden = !running;
    this.start.hidden = running;
    if (had_focus) (running ? this.cancel : this.start).focus();
  }

  progress(done: number): void {
    busy(`${words.film.drawing}: ${Math.floor(100 * done)} %`, done);
  }

  /** `film` null: cancelled. */
  done(film: Blob | null, stem: string): void {
    busy(null);
    this.set_running(false);
    if (film) save(film, `${stem}.webm`);
    else note(words.film.cancelled);
  }

  failed(id: number | null): void {
    if (id === this.id) this.set_running(false);
  }
}
