// "Save picture": its size, its progress, and its cancel button.
import { element } from './dom';
import { save } from './download';
import { busy, note } from './messages';

export interface SavingActions {
  /** Asks for the picture; returns the request's id. */
  draw(width_px: number, height_px: number): number;
  cancel(): void;
}

export class Saving {
  private readonly width = element<HTMLInputElement>('save_width');
  private readonly height = element<HTMLInputElement>('save_height');
  private readonly start = element<HTMLButtonElement>('save');
  private readonly cancel = element<HTMLButtonElement>('save_cancel');
  private id = 0; // of the awaited picture
  private forget_cancelled = () => {}; // the words about the last one

  constructor(private readonly actions: SavingActions) {
    this.start.addEventListener('click', () => this.begin());
    this.cancel.addEventListener('click', () => actions.cancel());
  }

  /** The size of the picture on the screen, as the default. */
  propose(width: number, height: number): void {
    this.width.value = String(width);
    this.height.value = String(height);
  }

  private begin(): void {
    if (!this.width.reportValidity() || !this.height.reportValidity()) return;
    this.forget_cancelled();
    this.set_running(true);
    busy('Drawing the picture');
    this.id = this.actions.draw(Number(this.width.value), Number(this.height.value));
  }

  // The focus moves to the button that replaces the other.
  private set_running(running: boolean): void {
    const [shown, hidden] = running ? [this.cancel, this.start] : [this.start, this.cancel];
    const has_focus = document.activeElement === hidden;
    shown.hidden = false;
    hidden.hidden = true;
    if (has_focus) shown.focus();
  }

  progress(done: number): void {
    if (!this.cancel.hidden) busy(`Drawing the picture: ${Math.floor(100 * done)} %`, done);
  }

  /** `picture` null: cancelled. */
  done(picture: Blob | null, scene: string): void {
    busy(null);
    this.set_running(false);
    if (picture) save(picture, `${scene.replace(/.*\//, '').replace(/\.[^.]*$/, '')}.png`);
    else this.forget_cancelled = note('The picture was cancelled.');
  }

  failed(id: number | null): void {
    if (id === this.id) this.set_running(false);
  }
}
