// The dialog that runs Figure 4.4 of the thesis on this device, and counts the frames that its screen shows. A run is
// saved in the browser after every six configurations, so that a page that was closed, or ended by the system,
// continues.
import { chart_element, charts_as_png } from './chart';
import { element } from './dom';
import { save } from './download';
import { fail } from './messages';
import type { ShownProgress, ThesisProgress } from './protocol';
import { costs_in_words, type Costs, type Rate } from './thesis_result';
import { words } from './words';

export interface ThesisActions {
  /** `saved`: the result of a run to be continued, or ''. */
  run(quick: boolean, saved: string): void;
  show_frames(seconds: number): void;
  cancel(): void;
  /** Whether a run with the chosen engine could continue from this result. */
  goes_on_from(result: Record<string, unknown>): boolean;
}

const texts = words.thesis;
const png_width = 1200;
const key = 'bihive-thesis';

// If the browser forbids storage, runs cannot be continued.
function storage<T>(work: (store: Storage) => T): T | null {
  try {
    return work(localStorage);
  } catch {
    return null;
  }
}

// The rates as text: a line for each scenario and number of spheres.
function rate_lines(rates: Rate[]): string[] {
  const lines: string[] = [];
  for (const { scenario, spheres, max_prims, fps } of rates) {
    if (max_prims === null) lines.push(texts.rates(texts.scene(scenario, spheres)) + texts.brute_force(fps.toPrecision(3)));
    else lines[lines.length - 1] += `, BIH ${max_prims} ${fps.toPrecision(3)}`;
  }
  return lines;
}

function time_left(seconds: number): string {
  return seconds < 90 ? texts.seconds_left(Math.max(1, Math.round(seconds))) : texts.minutes_left(Math.round(seconds / 60));
}

interface PictureSize {
  width_px: number;
  height_px: number;
}

// A quick run's frame rates are those of small pictures; a note beside them says so.
const pixels = ({ width_px, height_px }: PictureSize) => texts.pictures(width_px, height_px);

// The costs of a ray's steps on this device, and the winner at these costs; '' if unknown.
function verdict(result: string): string {
  const { costs } = JSON.parse(result) as { costs?: Costs };
  if (!costs) return '';
  return texts.here(costs_in_words(costs, texts.costs));
}

export class ThesisDialog {
  private readonly dialog = element<HTMLDialogElement>('thesis');
  private readonly quick = element<HTMLInputElement>('thesis_quick');
  private readonly run = element<HTMLButtonElement>('thesis_run');
  private readonly anew = element<HTMLButtonElement>('thesis_anew');
  private readonly shown = element<HTMLButtonElement>('thesis_shown');
  private readonly cancel = element<HTMLButtonElement>('thesis_cancel');
  private readonly json = element<HTMLButtonElement>('thesis_json');
  private readonly png = element<HTMLButtonElement>('thesis_png');
  private readonly bar = element<HTMLProgressElement>('thesis_bar');
  private readonly text = element('thesis_text');
  private charts: SVGSVGElement[] = [];
  private result = '';
  private file = 'bihive-figure-4.4';

  constructor(private readonly actions: ThesisActions) {
    // "?quick" chooses the quick run.
    this.quick.checked = new URLSearchParams(location.search).has('quick');
    element('thesis_open').addEventListener('click', () => {
      this.show_saved();
      this.dialog.showModal();
    });
    this.quick.addEventListener('change', () => this.show_saved());
    element('thesis_close').addEventListener('click', () => this.dialog.close());
    this.dialog.addEventListener('close', () => {
      if (!this.cancel.hidden) actions.cancel();
    });
    this.run.addEventListener('click', () => this.start(() => actions.run(this.quick.checked, this.kept())));
    this.anew.addEventListener('click', () => this.start(() => actions.run(this.quick.checked, '')));
    this.shown.addEventListener('click', () => this.start(() => actions.show_frames(this.quick.checked ? 0.3 : 2)));
    this.cancel.addEventListener('click', () => {
      this.cancel.disabled = true;
      this.text.textContent = texts.cancelling;
      actions.cancel();
    });
    this.json.addEventListener('click', () =>
      save(new Blob([this.result], { type: 'application/json' }), `${this.file}.json`),
    );
    this.png.addEventListener('click', () => void this.save_png());
  }

  // The result of an earlier run that this one would continue, or ''.
  private kept(): string {
    const text = storage((store) => store.getItem(key)) ?? '';
    try {
      const result = JSON.parse(text) as Record<string, unknown>;
      return result['quick'] === this.quick.checked && this.actions.goes_on_from(result) ? text : '';
    } catch {
      return '';
    }
  }

  private show_saved(): void {
    const kept = this.kept();
    const running = !this.cancel.hidden;
    this.run.textContent = kept === '' ? texts.run : texts.go_on;
    this.anew.hidden = running || kept === '';
  }

  /** After each scenario and number of spheres. */
  saved(result: string): void {
    storage((store) => store.setItem(key, result));
  }

  private start(run: () => void): void {
    this.set_running(true);
    this.text.textContent = words.starting;
    this.bar.value = 0;
    element('thesis_charts').replaceChildren();
    element('thesis_progress').hidden = false;
    run();
  }

  private set_running(running: boolean): void {
    this.run.hidden = this.shown.hidden = running;
    this.cancel.hidden = !running;
    this.cancel.disabled = false;
    this.quick.disabled = running;
    this.json.hidden = this.png.hidden = true;
    this.show_saved();
  }

  shown_progress({ done, scenario, spheres, max_prims, turning }: ShownProgress): void {
    if (this.cancel.hidden || this.cancel.disabled) return;
    this.bar.value = done;
    this.text.textContent =
      `${texts.scene(scenario, spheres)}, ${max_prims === null ? texts.wide_engine : `BIH ${max_prims}`}, ` +
      (turning ? texts.turning : texts.at_rest);
  }

  shown_done(cancelled: boolean, result: string): void {
    this.set_running(false);
    this.result = result;
    this.charts = [];
    this.file = 'bihive-shown-frames';
    const { configurations } = JSON.parse(result) as { configurations: (Rate & { turning: boolean })[] };
    this.json.hidden = configurations.length === 0;
    this.bar.value = cancelled ? this.bar.value : 1;
    const all = configurations.map(({ fps }) => fps);
    const found = texts.shown(all.length, Math.min(...all).toFixed(1), Math.max(...all).toFixed(1));
    this.text.textContent = all.length === 0 ? texts.cancelled_before : cancelled ? texts.cancelled(found) : found;
  }

  progress(progress: ThesisProgress): void {
    if (this.cancel.hidden || this.cancel.disabled) return;
    this.bar.value = progress.done;
    const { configurations_done, configurations, seconds_left, scenario, spheres } = progress;
    this.text.textContent = texts.progress(configurations_done, configurations, time_left(seconds_left), texts.scene(scenario, spheres));
  }

  done(cancelled: boolean, result: string, charts: string[]): void {
    if (!cancelled) storage((store) => store.removeItem(key));
    this.set_running(false);
    this.result = result;
    this.file = 'bihive-figure-4.4';
    this.charts = charts.map(chart_element);
    element('thesis_charts').replaceChildren(...this.charts);
    this.json.hidden = this.png.hidden = this.charts.length === 0;
    this.bar.value = cancelled ? this.bar.value : 1;
    this.text.textContent = !cancelled
      ? `${texts.measured(pixels(JSON.parse(result) as PictureSize))} ${verdict(result)}`
      : this.charts.length > 0
        ? texts.cancelled_partly
        : texts.cancelled_before;
  }

  failed(message: string): void {
    this.set_running(false);
    this.text.textContent = message;
  }

  private async save_png(): Promise<void> {
    try {
      const { engine, device, rounds, drift, configurations, ...size } = JSON.parse(this.result) as PictureSize & {
        engine: string;
        device: string;
        rounds: number;
        drift: number;
        configurations: Rate[];
      };
      const heading = texts.heading(engine.toUpperCase(), pixels(size));
      const drifted = texts.drift(`${drift < 1 ? '−' : '+'}${Math.abs(100 * (drift - 1)).toFixed(1)}`);
      const found = verdict(this.result);
      const about = [device, ...(found === '' ? [] : [found]), ...(rounds > 1 ? [drifted] : []), ...rate_lines(configurations)];
      save(await charts_as_png(this.charts, heading, about, png_width), `${this.file}.png`);
    } catch (error) {
      fail((error as Error).message);
    }
  }
}
