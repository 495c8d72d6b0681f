// The C++ module: the choice of one of its two builds, and its functions (bindings/wasm/page.h).

export interface Page {
  load(name: string, trajectory: string, reading: string): string;
  load_built_in(name: string, count: number, reading: string): string;
  player(): string;
  toggle_play(now_ms: number): void;
  step_frames(by: number): void;
  go_to_frame(frame: number): void;
  set_frames_per_second(speed: number): void;
  set_loops(loops: boolean): void;
  continue_playing(now_ms: number): string;
  choices(): string;
  settings(): string;
  set(changes: string): string;
  look(): string;
  set_look(changes: string): string;
  resize(width_px: number, height_px: number): void;
  orbit(dx_px: number, dy_px: number): void;
  pan(dx_px: number, dy_px: number): void;
  zoom(factor: number, x_px: number, y_px: number): void;
  look_from(side: string): string;
  home(): void;
  far_enough(camera: string, width_px: number, height_px: number): string;
  attach_gl(): string;
  detach_gl(lost: boolean): void;
  frame(budget_ms: number): string;
  take_image(): string;
  pixels(): Uint8Array;
  show(width_px: number, height_px: number): void;
  let_page_through(): void;
  pick(x_px: number, y_px: number): string;
  sphere(id: number): string;
  measured(ids: number[]): string;
  measured_in(frame: number, ids: number[]): string;
  measures(selection: string, probe: number): string;
  contents(): string;
  legend(): string;
  histogram(attribute: string, bins: number): string;
  begin_picture(width_px: number, height_px: number, samples_per_pixel: number): string;
  step_picture(budget_ms: number): string;
  take_picture(): string;
  drop_picture(): void;
  ray_paths(x_px: number, y_px: number): string;
  statistics(): string;
}

/** Figure 4.4 by one engine (bindings/wasm/thesis_run.h). */
export interface ThesisRun {
  begin(quick: boolean, saved: string): string;
  begin_pass(seconds: number): string;
  step(): string;
  so_far(device: string): string;
  delete(): void;
}

/** Frames shown per second. */
export interface ShownFramesRun {
  begin(seconds: number): string;
  draw(): string;
  pixels(): Uint8Array;
  shown(now_ms: number): string;
  result(device: string): string;
  delete(): void;
}

/** Emscripten's list of contexts: what the C++ side calls WebGL through. */
export interface GlContexts {
  registerContext(context: WebGL2RenderingContext, attributes: Record<string, unknown>): number;
  makeContextCurrent(handle: number): boolean;
}

/** Emscripten's files, as far as the worker uses them. */
export interface FileSystem {
  filesystems: { WORKERFS: unknown };
  mkdir(path: string): void;
  mount(type: unknown, options: { blobs: { name: string; data: Blob }[] }, path: string): void;
  unmount(path: string): void;
}

/** The functions of both modules. */
export interface DrawingModule {
  GL: GlContexts;
  version(): string;
  threads(): number;
}

/** The thesis's measurements. */
export interface ThesisModule extends DrawingModule {
  ThesisRun: { new (gpu: boolean): ThesisRun };
  ShownFramesRun: { new (): ShownFramesRun };
}

export interface Module extends DrawingModule {
  Page: { new (): Page; folder(): string };
  FS: FileSystem;
}

/** A figure that proves itself (bindings/wasm/figure.h). */
export interface Figure {
  open(name: string, record: string): string;
  draw(progress: (done: number) => void): string;
  compare(width: number, height: number, channels: number, bits: number, pixels: Uint8Array): string;
}

export interface FigureModule {
  Figure: { new (): Figure; folder(): string };
  FS: FileSystem;
  bundled(): Uint8Array;
  sha256_at(path: string): string;
}

type Instantiate = (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void) => object;

// Emscripten's way to use a module that is compiled already.
const instantiate =
  (wasm: WebAssembly.Module): Instantiate =>
  (imports, done) => {
    void WebAssembly.instantiate(wasm, imports).then((instance) => done(instance, wasm));
    return {};
  };

interface Script<M> {
  default(options?: { instantiateWasm: Instantiate }): Promise<M>;
}

// The page that is one file has the module's script inside (scripts/build_one_file).
const inside = <M>() => (globalThis as { bihive_module_script?: Script<M> }).bihive_module_script;

async function load<M>(name: string, base: string, threads: boolean, wasm: WebAssembly.Module | null = null): Promise<M> {
  const fetched = () => import(/* @vite-ignore */ new URL(`wasm/${threads ? 'threads' : 'single'}/${name}.js`, base).href) as Promise<Script<M>>;
  const { default: create } = inside<M>() ?? (await fetched());
  return wasm ? create({ instantiateWasm: instantiate(wasm) }) : create();
}

/** `base`: the page's own address; `wasm`: the module, if somebody has compiled it already. Throws if it cannot be loaded. */
export const load_module = (base: string, threads: boolean, wasm: WebAssembly.Module | null): Promise<Module> =>
  load('bihive', base, threads, wasm);

/** The module for figures, which only they need. */
export const load_figure_module = (base: string, threads: boolean): Promise<FigureModule> => load('figure', base, threads);

/** The module for the thesis's measurements, which few visitors start. */
export const load_thesis_module = (base: string, threads: boolean): Promise<ThesisModule> => load('thesis', base, threads);

interface Failure {
  message: string;
  file: string;
  line: number;
  column: number;
  hint: string;
  row?: number;
}

/** A fault of the user's input; the page shows its message. */
export class BadInput extends Error {
  /** `row`: the faulty row of a look, or -1. */
  constructor(
    message: string,
    readonly row = -1,
  ) {
    super(message);
  }
}

/** An answer of the module as a value; throws BadInput if it is an error, with message and location. */
export function value_of<T>(answer: string): T {
  const value = JSON.parse(answer) as T & { error?: Failure };
  if (!value.error) return value;
  const { message, file, line, column, hint, row } = value.error;
  const place = [file, line > 0 ? `line ${line}` : '', column > 0 ? `column ${column}` : ''].filter(Boolean).join(', ');
  throw new BadInput(`${place ? `${place}: ` : ''}${message}${hint ? `; ${hint}` : ''}`, row);
}
