// The picture of the card "Save": in small what "Save picture" draws, with its shape, its edges and its background.
import { element } from './dom';

export interface PreviewActions {
  /** All that the picture depends on, but the size. */
  state(): string;
  /** Of the picture to be saved; null: its fields have none. */
  size(): { width: number; height: number } | null;
  /** Whether the picture on the screen is complete: the preview does not delay it. */
  at_rest(): boolean;
  draw(width_px: number, height_px: number): void;
}

const most_width = 280, most_height = 160;
const pause_ms = 200;

export class Preview {
  private readonly image = element<HTMLImageElement>('save_preview');
  private open = false;
  private timer = 0;
  private made_of = ''; // what the last one was asked for
  private waits = false; // for it

  constructor(private readonly actions: PreviewActions) {}

  set_open(open: boolean): void {
    this.open = open;
    this.follow();
  }

  /** Another scene: the picture of the last one goes. */
  begin(): void {
    this.made_of = '';
    this.image.hidden = true;
  }

  /** Something may have changed. */
  follow(): void {
    clearTimeout(this.timer);
    if (this.open) this.timer = window.setTimeout(() => this.ask(), pause_ms);
  }

  /** null: it could not be drawn just now. */
  take(picture: Blob | null): void {
    this.waits = false;
    if (!picture) {
      this.made_of = '';
      return;
    }
    const before = this.image.src;
    this.image.src = URL.createObjectURL(picture);
    this.image.hidden = false;
    if (before) URL.revokeObjectURL(before);
    this.follow(); // what changed meanwhile
  }

  private ask(): void {
    const size = this.actions.size();
    if (!this.open || this.waits || !size || !this.actions.at_rest()) return;
    const made_of = `${size.width} ${size.height} ${this.actions.state()}`;
    if (made_of === this.made_of) return;
    this.made_of = made_of;
    this.waits = true;
    const scale = Math.min(most_width / size.width, most_height / size.height, 1);
    this.actions.draw(Math.max(1, Math.round(scale * size.width)), Math.max(1, Math.round(scale * size.height)));
  }
}
