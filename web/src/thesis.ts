// The dialog that runs Figure 4.4 of the thesis on this device.
import { chart_element, charts_as_png } from './chart';
import { element } from './dom';
import { save } from './download';
import { fail } from './messages';
import type { ThesisProgress } from './protocol';

export interface ThesisActions {
  run(quick: boolean): void;
  cancel(): void;
}

const png_width = 1200;

function time_left(seconds: number): string {
  return seconds < 90 ? `about ${Math.max(1, Math.round(seconds))} s left` : `about ${Math.round(seconds / 60)} min left`;
}

interface PictureSize {
  width_px: number;
  height_px: number;
}

// A quick run's frame rates are those of small pictures; a note beside them says so.
const pixels = ({ width_px, height_px }: PictureSize) => `pictures of ${width_px} × ${height_px}`;

export class ThesisDialog {
  private readonly dialog = element<HTMLDialogElement>('thesis');
  private readonly quick = element<HTMLInputElement>('thesis_quick');
  private readonly run = element<HTMLButtonElement>('thesis_run');
  private readonly cancel = element<HTMLButtonElement>('thesis_cancel');
  private readonly json = element<HTMLButtonElement>('thesis_json');
  private readonly png = element<HTMLButtonElement>('thesis_png');
  private readonly bar = element<HTMLProgressElement>('thesis_bar');
  private readonly text = element('thesis_text');
  private charts: SVGSVGElement[] = [];
  private result = '';

  constructor(private readonly actions: ThesisActions) {
    // "?quick" chooses the quick run, for a quick try.
    this.quick.checked = new URLSearchParams(location.search).has('quick');
    element('thesis_open').addEventListener('click', () => this.dialog.showModal());
    element('thesis_close').addEventListener('click', () => this.dialog.close());
    this.dialog.addEventListener('close', () => {
      if (!this.cancel.hidden) actions.cancel();
    });
    this.run.addEventListener('click', () => this.start());
    this.cancel.addEventListener('click', () => {
      this.cancel.disabled = true;
      this.text.textContent = 'Cancelling';
      actions.cancel();
    });
    this.json.addEventListener('click', () =>
      save(new Blob([this.result], { type: 'application/json' }), 'bihive-figure-4.4.json'),
    );
    this.png.addEventListener('click', () => void this.save_png());
  }

  private start(): void {
    this.set_running(true);
    this.text.textContent = 'Starting';
    this.bar.value = 0;
    element('thesis_charts').replaceChildren();
    element('thesis_progress').hidden = false;
    this.actions.run(this.quick.checked);
  }

  private set_running(running: boolean): void {
    this.run.hidden = running;
    this.cancel.hidden = !running;
    this.cancel.disabled = false;
    this.quick.disabled = running;
    this.json.hidden = this.png.hidden = true;
  }

  progress(progress: ThesisProgress): void {
    if (this.cancel.hidden || this.cancel.disabled) return;
    this.bar.value = progress.done;
    this.text.textContent =
      `${progress.configurations_done} of ${progress.configurations} configurations, ${time_left(progress.seconds_left)}: ` +
      `Scenario ${progress.scenario}, ${progress.spheres} spheres`;
  }

  done(cancelled: boolean, result: string, charts: string[]): void {
    this.set_running(false);
    this.result = result;
    this.charts = charts.map(chart_element);
    element('thesis_charts').replaceChildren(...this.charts);
    this.json.hidden = this.png.hidden = this.charts.length === 0;
    this.bar.value = cancelled ? this.bar.value : 1;
    this.text.textContent = !cancelled
      ? `All configurations are measured, ${pixels(JSON.parse(result) as PictureSize)}.`
      : this.charts.length > 0
        ? 'Cancelled; what was complete is below.'
        : 'Cancelled before a configuration was complete.';
  }

  failed(message: string): void {
    this.set_running(false);
    this.text.textContent = message;
  }

  private async save_png(): Promise<void> {
    try {
      const { engine, device, ...size } = JSON.parse(this.result) as { engine: string; device: string } & PictureSize;
      const heading = `bihive: Figure 4.4 by the ${engine.toUpperCase()} engine, ${pixels(size)}`;
      save(await charts_as_png(this.charts, heading, device, png_width), 'bihive-figure-4.4.png');
    } catch (error) {
      fail((error as Error).message);
    }
  }
}
