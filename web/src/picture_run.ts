// In the worker: draws a picture to be saved in steps. Messages are read between two steps, so a cancel takes effect.
import { png_of } from './png';
import { value_of, type BadInput, type Page } from './module';

const step_ms = 50;

export interface PictureSize {
  width_px: number;
  height_px: number;
  samples_per_pixel: number;
}

interface Drawn {
  width: number;
  height: number;
  channels: 3 | 4;
}

export class PictureRun {
  private ended = false;
  private reason: BadInput | null = null;

  constructor(
    private readonly page: Page,
    private readonly progress: (done: number) => void,
  ) {}

  /** The picture as a PNG file, or null if cancelled. Throws BadInput if it cannot be drawn. */
  async draw(size: PictureSize): Promise<Blob | null> {
    const drawn = await this.draw_pixels(size);
    return drawn && png_of(this.page.pixels(), drawn.width, drawn.height, drawn.channels);
  }

  /** The same; the module's pixels() are it. */
  async draw_pixels({ width_px, height_px, samples_per_pixel }: PictureSize): Promise<Drawn | null> {
    value_of(this.page.begin_picture(width_px, height_px, samples_per_pixel));
    for (let done = 0; done < 1; ) {
      done = value_of<{ done: number }>(this.page.step_picture(step_ms)).done;
      this.progress(done);
      await new Promise((resolve) => setTimeout(resolve));
      if (!this.ended) continue;
      this.page.drop_picture();
      if (this.reason) throw this.reason;
      return null;
    }
    return value_of<Drawn>(this.page.take_picture());
  }

  /** Ends it before the next step; with a reason it is an error. */
  cancel(reason: BadInput | null = null): void {
    this.ended = true;
    this.reason = reason;
  }
}
