// The page that measures Figure 4.4 of the thesis on a phone: one file (scripts/build_phone), which opens without a
// server. So there are no workers, which such a file cannot start everywhere; everything runs in short steps.
import { describe_device } from './device';
import { element } from './dom';
import { save } from './download';
import { attributes, give_context, is_software, name_of } from './gl_canvas';
import { value_of, type ThesisModule, type ThesisRun } from './module';
import { costs_in_words, type Costs, type Rate } from './thesis_result';

declare function bihive_phone(options: { wasmBinary: ArrayBuffer }): Promise<ThesisModule>;

/** A run as `bihive thesis --device` reads it, as far as this page does. */
interface Result {
  engine: string;
  width_px: number;
  height_px: number;
  rounds: number;
  costs?: Costs;
  configurations: Rate[];
}
/** A pass: one frame of every configuration by one engine. `minute`: in which it began, from 1. */
interface Pass {
  engine: string;
  minute: number;
  round_ms: number;
}

const names: Record<string, string> = { cpu: 'one thread of the processor', gpu: 'the graphics processor' };
const whole = { width_px: 1136, height_px: 640 }; // the picture of the phone that the thesis measured
const asked_minutes = Number(new URLSearchParams(location.search).get('minutes') ?? '10');
const minutes = asked_minutes > 0 ? Math.min(asked_minutes, 60) : 10;
const pass_seconds = Math.min(25, (minutes * 60) / 4); // of one engine; both take turns
const shown_seconds = Math.min(1, minutes / 10); // of each of 36 measurements

const text = element('text');
const bar = element<HTMLProgressElement>('bar');
let stopped = false;
let file = '';

const pause = () => new Promise<void>((resolve) => setTimeout(resolve));
const refresh = () => new Promise<number>((resolve) => requestAnimationFrame(() => resolve(performance.now())));

async function load_module(): Promise<ThesisModule> {
  const packed = Uint8Array.from(atob(element('module').textContent!.trim()), (character) => character.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return bihive_phone({ wasmBinary: await new Response(stream).arrayBuffer() });
}

/** The name of the graphics processor; empty if the browser offers no WebGL2. */
function start_gpu(module: ThesisModule): string {
  const context = element<HTMLCanvasElement>('gpu_canvas').getContext('webgl2', attributes);
  if (!context) return '';
  give_context(module, context);
  return name_of(context);
}

// Both engines take turns, pass by pass, until the time is over; at least one pass each.
async function run_passes(runs: Map<string, ThesisRun>): Promise<Pass[]> {
  const passes: Pass[] = [];
  const start = performance.now();
  const minute_now = () => (performance.now() - start) / 60_000;
  for (let first = true; !stopped && (first || minute_now() < minutes); first = false)
    for (const [engine, run] of runs) {
      const minute = Math.floor(minute_now()) + 1;
      value_of(run.begin_pass(pass_seconds));
      for (let finished = false; !finished && !stopped; await pause()) {
        const step = value_of<{ finished: boolean; scenario: number; spheres: number; round_ms?: number }>(run.step());
        finished = step.finished;
        bar.value = Math.min(1, minute_now() / minutes);
        text.textContent = `Minute ${Math.floor(minute_now()) + 1} of ${minutes}: ${names[engine]}, Scenario ${step.scenario}, ${step.spheres} spheres`;
        if (step.round_ms !== undefined) passes.push({ engine, minute, round_ms: step.round_ms });
      }
      if (stopped) break;
    }
  return passes;
}

async function show_frames(module: ThesisModule, device: string): Promise<unknown> {
  const canvas = element<HTMLCanvasElement>('shown_canvas');
  const context = canvas.getContext('2d', { alpha: false })!;
  const frames = new module.ShownFramesRun();
  canvas.hidden = false;
  value_of(frames.begin(shown_seconds));
  for (let finished = false; !finished && !stopped; ) {
    const { width, height } = value_of<{ width: number; height: number }>(frames.draw());
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    context.putImageData(new ImageData(new Uint8ClampedArray(frames.pixels()), width, height), 0, 0);
    const progress = value_of<{ finished: boolean; done: number }>(frames.shown(await refresh()));
    finished = progress.finished;
    bar.value = progress.done;
    text.textContent = 'Frames shown on this screen';
  }
  canvas.hidden = true;
  const { result } = value_of<{ result: string }>(frames.result(device));
  frames.delete();
  return JSON.parse(result);
}

const median = (values: number[]) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)] ?? 0;
function paragraph(words: string): HTMLParagraphElement {
  const line = document.createElement('p');
  line.textContent = words;
  return line;
}

function verdict({ engine, costs }: Result, software: boolean): string {
  if (engine === 'gpu' && software) return 'WebGL2 is drawn by software here: no verdict on a graphics processor.';
  return `By ${names[engine]}, ${costs ? costs_in_words(costs) : 'the times fit no costs of the steps.'}`;
}

// Compares the first minute with the last one.
function heat_in_words(engine: string, passes: Pass[]): string {
  const own = passes.filter((pass) => pass.engine === engine);
  const last_minute = own[own.length - 1]?.minute ?? 1;
  const of = (minute: number) => median(own.filter((pass) => pass.minute === minute).map(({ round_ms }) => round_ms));
  if (last_minute === 1) return `By ${names[engine]}, the run was too short for the heat to show.`;
  const percent = 100 * (of(last_minute) / of(1) - 1);
  return (
    `By ${names[engine]}, a frame of each of the 54 configurations took ${of(1).toFixed(0)} ms together in minute 1 and ` +
    `${of(last_minute).toFixed(0)} ms in minute ${last_minute}: ${percent < 0 ? '−' : '+'}${Math.abs(percent).toFixed(0)} %.`
  );
}

const scale_of = ({ width_px, height_px }: Result) => (width_px * height_px) / (whole.width_px * whole.height_px);

// One engine's time over the other's for a frame of the same size.
function engines_in_words(results: Result[]): string {
  const [cpu, gpu] = results;
  if (!cpu || !gpu) return '';
  const ratios = cpu.configurations.map((rate, i) => (gpu.configurations[i]!.fps * scale_of(gpu)) / (rate.fps * scale_of(cpu)));
  return `In pictures of the same size the graphics processor draws ${median(ratios).toPrecision(2)} times the frames of one thread of the processor (median of all configurations).`;
}

// At least two digits, and all before the point.
const readable = (fps: number) => (fps < 10 ? fps.toPrecision(2) : fps.toFixed(0));

function rates_table(result: Result): HTMLElement[] {
  const scale = scale_of(result);
  const table = document.createElement('table');
  const trees = [...new Set(result.configurations.flatMap(({ max_prims }) => max_prims ?? []))];
  const row = (cells: string[], name: 'th' | 'td') => {
    const line = table.insertRow();
    cells.forEach((words, i) => {
      const cell = document.createElement(i === 0 ? 'th' : name);
      cell.textContent = words;
      line.append(cell);
    });
  };
  row(['Scenario, spheres', 'BF', ...trees.map((prims) => `BIH ${prims}`)], 'th');
  for (let first = 0; first < result.configurations.length; first += 1 + trees.length) {
    const group = result.configurations.slice(first, first + 1 + trees.length);
    row([`${group[0]!.scenario}, ${group[0]!.spheres}`, ...group.map(({ fps }) => readable(fps * scale))], 'td');
  }
  const label = scale === 1
    ? `By ${names[result.engine]}, in pictures of ${whole.width_px} × ${whole.height_px}:`
    : `By ${names[result.engine]}: measured in pictures of ${result.width_px} × ${result.height_px}, scaled by area to ${whole.width_px} × ${whole.height_px}:`;
  return [paragraph(label), table];
}

function shown_in_words(shown: { configurations: { fps: number }[] }): string {
  const all = shown.configurations.map(({ fps }) => fps);
  if (all.length === 0) return '';
  return (
    `Frames that this screen showed at ${whole.width_px} × ${whole.height_px}, drawn by one thread of the processor: ` +
    `${Math.min(...all).toFixed(1)} to ${Math.max(...all).toFixed(1)} per second in ${all.length} measurements. A browser shows no more than its screen does.`
  );
}

async function measure(module: ThesisModule, gpu: string): Promise<void> {
  stopped = false;
  for (const [id, hidden] of [['run', true], ['stop', false], ['bar', false], ['found', true], ['json', true], ['share', true]] as const)
    element(id).hidden = hidden;
  await (navigator.wakeLock?.request('screen') ?? Promise.resolve()).catch(() => undefined);
  const device = describe_device(gpu, module.threads(), module.version());
  const runs = new Map([['cpu', new module.ThesisRun(false)]]);
  if (gpu) runs.set('gpu', new module.ThesisRun(true));
  const passes = await run_passes(runs);
  const shown = (await show_frames(module, device)) as { configurations: { fps: number }[] };
  text.textContent = 'Fitting costs';
  await refresh();

  const results: Result[] = [];
  const charts: string[] = [];
  for (const [engine, run] of runs) {
    if (passes.some((pass) => pass.engine === engine)) {
      const so_far = value_of<{ result: string; charts: string[] }>(run.so_far(device));
      results.push(JSON.parse(so_far.result) as Result);
      if (engine === 'cpu' || !is_software(gpu)) charts.push(`<p>By ${names[engine]}:</p>${so_far.charts[0]}`);
    }
    run.delete();
  }
  file = `${JSON.stringify({ experiment: 'phone', minutes, runs: results, passes, shown }, null, 1)}\n`;
  element('verdict').replaceChildren(
    ...[
      ...results.map((result) => verdict(result, is_software(gpu))),
      engines_in_words(results),
      ...results.map(({ engine }) => heat_in_words(engine, passes)),
      shown_in_words(shown),
    ].filter(Boolean).map(paragraph),
  );
  element('charts').innerHTML = charts.join('');
  element('rates').replaceChildren(...results.flatMap(rates_table));
  element('found').hidden = element('json').hidden = results.length === 0;
  element('share').hidden = results.length === 0 || !navigator.canShare?.({ files: [as_file()] });
  element('stop').hidden = bar.hidden = true;
  element('run').hidden = false;
  text.textContent = stopped ? 'Stopped; what was complete is below.' : 'All is measured.';
}

const as_file = () => new File([file], 'bihive-phone.json', { type: 'application/json' });

async function start(): Promise<void> {
  element('minutes').textContent = String(minutes);
  const module = await load_module();
  const gpu = start_gpu(module);
  text.textContent = gpu ? `Graphics processor: ${gpu}` : 'This browser gives the page no WebGL2: the processor alone is measured.';
  const run = element<HTMLButtonElement>('run');
  run.disabled = false;
  run.addEventListener('click', () => void measure(module, gpu).catch(fail));
  element('stop').addEventListener('click', () => (stopped = true));
  element('json').addEventListener('click', () => save(as_file(), 'bihive-phone.json'));
  element('share').addEventListener('click', () => void navigator.share({ files: [as_file()] }).catch(() => undefined));
}

function fail(error: unknown): void {
  text.textContent = `It went wrong: ${(error as Error).message}`;
  element('stop').hidden = bar.hidden = true;
  element('run').hidden = false;
}

void start().catch(fail);
