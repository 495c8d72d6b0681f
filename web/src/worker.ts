// The worker: the C++ module, the frame loop, and the answers to the page.
import { BadInput, load_module, load_thesis_module, value_of, type Module, type Page, type ShownFramesRun, type ThesisModule, type ThesisRun } from './module';
import { FilmRun } from './film_run';
import { GlCanvas } from './gl_canvas';
import { unpacked_lzma } from './lzma';
import { PictureRun } from './picture_run';
import type {
  Answer, Changes, Choices, ColouredBy, Contents, Facts, FrameReport, Histogram, LegendKey, Look, Measure, Move, Picked, PlayAction, PlayerState, RayPaths, Request, Settings, ShownProgress, ThesisProgress, UnionNumbers,
} from './protocol';
import { UserFiles } from './user_files';

const frame_budget_ms = 25;
const most_waited_ms = 10; // a frame that takes longer is followed by the next one at once
const most_to_pass = 100_000; // spheres, which takes a few milliseconds
const picture_lost = 'The browser took the graphics processor away before the picture was complete';

let module: Module;
let thesis_module: () => Promise<ThesisModule>; // loads it the first time
let page: Page;
let user_files: UserFiles;
let gl: GlCanvas;
let cpu_canvas: OffscreenCanvas;
let cpu_context: OffscreenCanvasRenderingContext2D;

let has_scene = false;
let size_px = { width: 1, height: 1 };
let wanted_changes: Changes | null = null;
let serial = 0; // of the last request in wanted_changes
let wanted_look: Partial<Look> | null = null;
let look_serial = 0; // of the last request in wanted_look
let moves: Move[] = [];
let statistics_wanted = false;
let contents_wanted = false;
let legend_wanted = false;
let scenes = 0; // loaded
let spheres = 0; // of the scene
let player_words = ''; // the last state of the player that was sent, as JSON
let frame_pending = false;
let frame_ms = 0; // that the last frame took
const soon = new MessageChannel();
let gl_description = '';
let gpu_again = false; // the engine of the settings when the context was lost
let saving: PictureRun | FilmRun | null = null;
let previewing: Promise<void> | null = null; // saving is the preview
let thesis: { device: string; cancelled: boolean; saved: number } | null = null; // saved: configurations
let thesis_run: ThesisRun | null = null;

function send(answer: Answer): void {
  postMessage(answer);
}

function settings(): Settings {
  return JSON.parse(page.settings()) as Settings;
}

function look(): Look {
  return JSON.parse(page.look()) as Look;
}

// Runs a request of the user; an exception becomes a message.
async function attempt(id: number | null, work: () => void | Promise<void>): Promise<void> {
  try {
    await work();
  } catch (error) {
    if (!(error instanceof BadInput)) console.warn(error);
    send({ type: 'failed', id, message: error instanceof Error ? error.message : String(error) });
  }
}

// The graphics processor.

function attach_gl(): void {
  try {
    gl_description = value_of<{ description: string }>(page.attach_gl()).description;
  } catch (error) {
    throw new BadInput(`The GPU engine is not available: ${(error as Error).message}`);
  }
}

// A software driver takes a while to start, so it is started only when the user chooses it.
function ensure_gl(): void {
  if (gl_description !== '') return;
  if (!gl.here) throw new BadInput('This browser has no WebGL2: the CPU engine draws instead');
  attach_gl();
  send({ type: 'gpu', gpu: gl.state(gl_description) });
}

// The C++ side continues with the CPU engine.
function on_lost(): void {
  if (thesis) thesis.cancelled = true;
  if (gl_description === '') return;
  gpu_again = settings().engine === 'gpu';
  if (gpu_again) saving?.cancel(new BadInput(picture_lost));
  page.detach_gl(true);
  gl_description = '';
  send({ type: 'note', message: 'The browser took the graphics processor away; the CPU goes on until it is back.' });
  if (gpu_again) ask_for_frame();
}

function on_restored(): void {
  void attempt(null, () => {
    if (!gpu_again) return;
    ensure_gl();
    value_of(page.set(JSON.stringify({ engine: 'gpu' })));
    send({ type: 'note', message: 'The graphics processor is back.' });
    ask_for_frame();
  });
}

// Frames.

// Cameras change member by member.
function merged(before: Changes, next: Changes): Changes {
  const camera = before.camera || next.camera ? { camera: { ...before.camera, ...next.camera } } : {};
  return { ...before, ...next, ...camera };
}

function ask_for_frame(): void {
  if (frame_pending || !has_scene || thesis || saving) return;
  frame_pending = true;
  // Waiting for the display after each frame would cost up to one of its periods. The browser shows the last frame that is
  // there, and messages that came meanwhile are read first.
  if (frame_ms > most_waited_ms) soon.port2.postMessage(null);
  // Not every browser has the display's clock in workers.
  else if (typeof requestAnimationFrame === 'function') requestAnimationFrame(() => void next_frame());
  else setTimeout(() => void next_frame(), 8);
}

// One step of a hand that went on meanwhile: each takes a pass over the spheres while all of them stay in view.
function add_move(next: Move): void {
  const last = moves.at(-1);
  if (last && (last.kind === 'orbit' || last.kind === 'pan') && next.kind === last.kind)
    moves[moves.length - 1] = { ...last, dx: last.dx + next.dx, dy: last.dy + next.dy };
  else moves.push(next);
}

function apply_moves(): void {
  for (const move of moves) {
    if (move.kind === 'orbit') page.orbit(move.dx, move.dy);
    else if (move.kind === 'pan') page.pan(move.dx, move.dy);
    else if (move.kind === 'zoom') page.zoom(move.factor, move.x, move.y);
    else if (move.kind === 'look_from') value_of(page.look_from(move.side));
    else page.home();
  }
  moves = [];
}

function apply_changes(): void {
  if (!wanted_changes) return;
  const changes = wanted_changes;
  wanted_changes = null;
  try {
    if (changes.engine === 'gpu') ensure_gl();
    value_of(page.set(JSON.stringify(changes)));
  } finally {
    send({ type: 'settings', serial, settings: settings() });
  }
  if ('max_prims' in changes || 'max_depth' in changes) statistics_wanted = true;
}

interface Looked {
  counts: number[];
  coloured_by: ColouredBy[];
}

// A fault of one row is shown below it; any other fault is an error of the page.
function apply_look(): void {
  if (!wanted_look) return;
  const changes = wanted_look;
  wanted_look = null;
  let counts: number[] = [];
  let coloured_by: ColouredBy[] | null = null;
  let fault: BadInput | null = null;
  try {
    ({ counts, coloured_by } = value_of<Looked>(page.set_look(JSON.stringify(changes))));
  } catch (error) {
    if (!(error instanceof BadInput)) throw error;
    fault = error;
  } finally {
    const words = fault && { row: fault.row, message: fault.message };
    send({ type: 'look', serial: look_serial, look: look(), counts, coloured_by, fault: words });
    legend_wanted = true;
  }
  if (fault && fault.row < 0) throw fault;
  statistics_wanted = true;
}

// Frames of a file: the next one is read here, between two pictures.

function play(action: PlayAction): void {
  if ('toggle' in action) page.toggle_play(performance.now());
  else if ('step' in action) page.step_frames(action.step);
  else if ('frame' in action) page.go_to_frame(action.frame);
  else if ('loops' in action) page.set_loops(action.loops);
  else page.set_frames_per_second(action.frames_per_second);
}

function continue_playing(): void {
  try {
    value_of(page.continue_playing(performance.now()));
  } finally {
    send_player();
  }
}

function send_player(): void {
  const json = page.player();
  if (json === player_words) return;
  player_words = json;
  send({ type: 'player', player: JSON.parse(json) as PlayerState });
}

function show_cpu_image(): void {
  const { width, height } = value_of<{ width: number; height: number }>(page.take_image());
  if (width === 0 || height === 0) return;
  put_cpu_pixels(page.pixels(), width, height);
}

function put_cpu_pixels(pixels: Uint8Array, width: number, height: number): void {
  if (cpu_canvas.width !== width) cpu_canvas.width = width;
  if (cpu_canvas.height !== height) cpu_canvas.height = height;
  // A copy of the module's pixels, because the browser takes no shared memory for pictures.
  cpu_context.putImageData(new ImageData(new Uint8ClampedArray(pixels), width, height), 0, 0);
}

function show_gpu_image(): void {
  if (gl.canvas.width !== size_px.width) gl.canvas.width = size_px.width;
  if (gl.canvas.height !== size_px.height) gl.canvas.height = size_px.height;
  page.show(size_px.width, size_px.height);
}

// Its context is lost, although the event may not have arrived yet.
const on_lost_gpu = ({ engine }: Settings) => engine === 'gpu' && !gl.here;

function report_or_loss(now: Settings): FrameReport | null {
  try {
    return value_of<FrameReport>(page.frame(frame_budget_ms));
  } catch (error) {
    if (on_lost_gpu(now)) return null;
    throw error;
  }
}

soon.port1.addEventListener('message', () => void next_frame());
soon.port1.start();

async function next_frame(): Promise<void> {
  frame_pending = false;
  if (thesis || saving) return;
  // A fault of one does not prevent the others from being applied.
  for (const apply of [apply_moves, apply_look, apply_changes, continue_playing]) await attempt(null, apply);
  await attempt(null, () => {
    const now = settings();
    if (on_lost_gpu(now)) return;
    const report = report_or_loss(now);
    if (!report) return;
    frame_ms = now.engine === 'cpu' ? report.frame_ms : 0;
    if (report.drawn) {
      if (now.engine === 'gpu') show_gpu_image();
      else show_cpu_image();
    }
    if (report.drawn || report.settled)
      send({ type: 'frame', report, serial, settings: now, width_px: size_px.width, height_px: size_px.height });
    const { playing, shown } = JSON.parse(player_words) as PlayerState;
    if (!report.settled || playing || !shown) ask_for_frame();
    if (report.settled || (report.drawn && spheres <= most_to_pass)) tell_contents();
  });
  if (statistics_wanted) {
    statistics_wanted = false;
    setTimeout(() => send({ type: 'statistics', json: page.statistics() }));
  }
}

// Scenes.

interface Loaded {
  facts: Facts;
  settings: Settings;
  coloured_by: ColouredBy[];
}

// The look and the settings of a link, or of the scene. The engine is the user's choice: without one it stays.
// Returns the colouring attributes and the rows' numbers of spheres, null without a requested look, and the messages of
// failures.
function choose(wanted_settings: Changes, wanted: Partial<Look> | null) {
  const notes: string[] = [];
  let looked: Looked | null = null;
  if (wanted) {
    try {
      looked = value_of<Looked>(page.set_look(JSON.stringify(wanted)));
    } catch (error) {
      notes.push(`The look does not fit this scene and was left out: ${(error as Error).message}`);
    }
  }
  let { engine, ...others } = wanted_settings;
  if (engine === 'gpu') {
    try {
      ensure_gl();
    } catch (error) {
      engine = 'cpu';
      notes.push((error as Error).message);
    }
  }
  try {
    value_of(page.set(JSON.stringify({ ...others, ...(engine && { engine }) })));
  } catch (error) {
    notes.push(`Some settings do not fit this scene and were left out: ${(error as Error).message}`);
    if (engine) value_of(page.set(JSON.stringify({ engine })));
  }
  return { notes, counts: looked?.counts ?? null, coloured_by: looked?.coloured_by ?? null };
}

// Passes over all spheres. Those of large scenes wait until the picture is at rest.
function tell_contents(): void {
  if (!contents_wanted && !legend_wanted) return;
  const contents = contents_wanted ? value_of<Contents>(page.contents()) : null;
  contents_wanted = legend_wanted = false;
  send({ type: 'contents', contents, legend: value_of<LegendKey[]>(page.legend()) });
}

async function load(request: Request & { type: 'load' }): Promise<void> {
  let loaded: Loaded;
  const reading = JSON.stringify(request.source.reading ?? {});
  if ('built_in' in request.source) {
    loaded = value_of(page.load_built_in(request.source.built_in, request.source.count ?? 0, reading));
    user_files.forget();
  } else {
    const { name, trajectory } = await user_files.show(request.files!);
    try {
      loaded = value_of(page.load(name, trajectory, reading));
    } catch (error) {
      user_files.keep(false);
      throw error;
    }
    user_files.keep(true);
  }
  saving?.cancel();
  moves = [];
  wanted_look = null;
  has_scene = true;
  spheres = loaded.facts.spheres;
  ++scenes;
  const { id, source } = request;
  const ground = request.ground !== '' && loaded.facts.is_file_of_spheres ? { background: request.ground } : null;
  const chosen = choose(request.settings ?? {}, request.look ?? ground);
  const coloured_by = chosen.coloured_by ?? loaded.coloured_by;
  const notes = [...loaded.facts.warnings, ...chosen.notes];
  send({ type: 'loaded', id, source, facts: loaded.facts, settings: settings(), look: look(), counts: chosen.counts, coloured_by, notes });
  send_player();
  statistics_wanted = contents_wanted = true;
  ask_for_frame();
}

// Another state of the same scene. Requests before it are outdated.
function restore(request: Request & { type: 'restore' }): void {
  moves = [];
  wanted_look = wanted_changes = null;
  serial = request.serial;
  const { notes, counts, coloured_by } = choose(request.settings, request.look);
  send({ type: 'restored', settings: settings(), look: look(), counts, coloured_by, notes });
  statistics_wanted = legend_wanted = true;
  ask_for_frame();
}

// In the picture that was asked for last, although it may not be shown yet.
async function pick({ id, x_px, y_px }: Request & { type: 'pick' }): Promise<void> {
  if (!has_scene) return send({ type: 'picked', id, picked: null });
  if (!saving) for (const apply of [apply_moves, apply_look, apply_changes]) await attempt(null, apply);
  send({ type: 'picked', id, ...value_of<{ picked: Picked | null }>(page.pick(x_px, y_px)) });
}

// Through the trees of what is shown.
async function ray_paths({ x_px, y_px }: Request & { type: 'ray_paths' }): Promise<void> {
  let paths: RayPaths | null = null;
  try {
    if (!saving) for (const apply of [apply_moves, apply_look, apply_changes]) await attempt(null, apply);
    if (has_scene) paths = value_of<RayPaths>(page.ray_paths(x_px, y_px));
  } finally {
    send({ type: 'ray_paths', paths });
  }
}

// Of the frame that is shown.
function describe({ spheres }: Request & { type: 'describe' }): void {
  const of_one = (id: number) => value_of<{ picked: Picked | null }>(page.sphere(id)).picked;
  if (has_scene) send({ type: 'described', spheres: spheres.map(of_one), measure: value_of<Measure>(page.measured(spheres)) });
}

const most_lines = 100; // in one message
const histogram_bins = 48;

// The measure of every frame. Other requests are answered between two frames; another scene ends it.
async function measure_frames({ spheres, frames }: Request & { type: 'measure_frames' }): Promise<void> {
  const scene = scenes;
  let lines: string[] = [];
  for (let frame = 0; frame < frames; ++frame) {
    lines.push(value_of<{ line: string }>(page.measured_in(frame, spheres)).line);
    const finished = frame + 1 === frames;
    if (!finished && lines.length < most_lines) continue;
    send({ type: 'measured_frames', lines, done: (frame + 1) / frames, finished });
    lines = [];
    await new Promise((resolve) => setTimeout(resolve));
    if (scene !== scenes) return;
  }
}

// Of a text there is none.
// Of the spheres of the shown frame that the look does not hide.
async function measure_union({ selection, probe }: Request & { type: 'measure_union' }): Promise<void> {
  let numbers: UnionNumbers | null = null;
  try {
    if (!saving) for (const apply of [apply_moves, apply_look, apply_changes]) await attempt(null, apply);
    if (has_scene) numbers = value_of<UnionNumbers>(page.measures(selection, probe));
  } finally {
    send({ type: 'measured_union', numbers });
  }
}

function histogram({ attribute }: Request & { type: 'histogram' }): void {
  let found: Histogram | null = null;
  try {
    found = has_scene ? value_of<Histogram>(page.histogram(attribute, histogram_bins)) : null;
  } catch (error) {
    if (!(error instanceof BadInput)) throw error;
  }
  send({ type: 'histogram', attribute, histogram: found });
}

// A picture or a film to be saved. No frames are drawn meanwhile.
async function save<Run extends PictureRun | FilmRun>(run: Run, draw: (run: Run) => Promise<Answer>): Promise<void> {
  if (previewing) saving?.cancel();
  await previewing;
  if (!has_scene || thesis || saving) throw new BadInput('There is no picture to be saved just now');
  apply_moves();
  apply_look();
  apply_changes();
  saving = run;
  try {
    send(await draw(run));
  } catch (error) {
    throw on_lost_gpu(settings()) ? new BadInput(picture_lost) : error;
  } finally {
    saving = null;
    ask_for_frame();
  }
}

const picture = (request: Request & { type: 'picture' }) =>
  save(new PictureRun(page, (done) => send({ type: 'picture_progress', done })), async (run) => {
    const { samples_per_pixel } = settings();
    return { type: 'picture', picture: await run.draw({ ...request, samples_per_pixel }) };
  });

// In few samples; anything else is more important.
const preview_samples = 4;

async function preview(request: Request & { type: 'preview' }): Promise<void> {
  let picture: Blob | null = null;
  if (has_scene && !thesis && !saving) {
    const run = new PictureRun(page, () => {});
    saving = run;
    try {
      picture = await run.draw({ ...request, samples_per_pixel: Math.min(preview_samples, settings().samples_per_pixel) });
    } catch {
      // "Save picture" would say why.
    } finally {
      saving = null;
      ask_for_frame();
    }
  }
  send({ type: 'preview', picture });
}

const film = (request: Request & { type: 'film' }) =>
  save(new FilmRun(page, (done) => send({ type: 'film_progress', done })), async (run) => ({ type: 'film', film: await run.draw(request) }));

// The thesis's measurements. No frames are drawn meanwhile.

interface ThesisSoFar {
  result: string;
  charts: string[];
}

const busy_saving = 'A picture is being drawn to be saved: wait for it, or cancel it';

async function run_thesis(quick: boolean, device: string, saved: string): Promise<void> {
  if (thesis) return;
  try {
    if (saving) throw new BadInput(busy_saving);
    apply_changes();
    const on_gpu = settings().engine === 'gpu';
    thesis = { device, cancelled: false, saved: 0 };
    const made = await thesis_module();
    if (on_gpu) gl.lend(made);
    thesis_run = new made.ThesisRun(on_gpu);
    thesis.saved = value_of<{ resumed: number }>(thesis_run.begin(quick, saved)).resumed;
    setTimeout(step_thesis);
  } catch (error) {
    thesis_run?.delete();
    thesis_run = null;
    thesis = null;
    send({ type: 'thesis_failed', message: (error as Error).message });
    ask_for_frame();
  }
}

function step_thesis(): void {
  const run = thesis!, measured = thesis_run!;
  try {
    if (!run.cancelled) {
      const progress = value_of<ThesisProgress>(measured.step());
      send({ type: 'thesis_progress', progress });
      if (progress.configurations_done > run.saved) {
        run.saved = progress.configurations_done;
        send({ type: 'thesis_saved', result: value_of<ThesisSoFar>(measured.so_far(run.device)).result });
      }
      // The page's messages are read between two steps, so a cancel takes effect.
      if (!progress.finished) return void setTimeout(step_thesis);
    }
    const { result, charts } = value_of<ThesisSoFar>(measured.so_far(run.device));
    send({ type: 'thesis_done', cancelled: run.cancelled, result, charts });
  } catch (error) {
    send({ type: 'thesis_failed', message: (error as Error).message });
  }
  measured.delete();
  thesis = null;
  thesis_run = null;
  ask_for_frame();
}

// Frames on the screen: the next picture is drawn when the browser asks for one, and counts when it asks again.

const next_refresh = () =>
  new Promise<number>((resolve) => {
    if (typeof requestAnimationFrame === 'function') requestAnimationFrame(() => resolve(performance.now()));
    else setTimeout(() => resolve(performance.now()), 4);
  });

async function show_frames(seconds: number, device: string): Promise<void> {
  if (thesis) return;
  const run = { device, cancelled: false, saved: 0 };
  let frames: ShownFramesRun | null = null;
  try {
    if (saving) throw new BadInput(busy_saving);
    thesis = run;
    const made = await thesis_module();
    frames = new made.ShownFramesRun();
    value_of(frames.begin(seconds));
    let done = -1;
    for (let finished = false; !finished && !run.cancelled; ) {
      const { width, height } = value_of<{ width: number; height: number }>(frames.draw());
      put_cpu_pixels(frames.pixels(), width, height);
      const progress = value_of<ShownProgress>(frames.shown(await next_refresh()));
      finished = progress.finished;
      if (progress.done !== done) send({ type: 'shown_progress', progress });
      done = progress.done;
    }
    const { result } = value_of<{ result: string }>(frames.result(device));
    send({ type: 'shown_done', cancelled: run.cancelled, result });
  } catch (error) {
    send({ type: 'thesis_failed', message: (error as Error).message });
  }
  frames?.delete();
  thesis = null;
  // The scene's own picture again.
  if (has_scene && settings().engine === 'cpu') show_cpu_image();
  ask_for_frame();
}

async function start(request: Request & { type: 'start' }): Promise<void> {
  const wasm = request.packed ? await WebAssembly.compile(unpacked_lzma(request.packed)) : request.wasm;
  module = await load_module(request.base, request.threads, wasm);
  let loaded: Promise<ThesisModule> | null = null;
  const load_it = () =>
    load_thesis_module(request.base, request.threads).catch((error: unknown) => {
      loaded = null; // another time the server may answer
      throw error;
    });
  thesis_module = () => (loaded ??= load_it());
  page = new module.Page();
  if (request.embedded) page.let_page_through();
  user_files = new UserFiles(module);
  cpu_canvas = request.cpu_canvas;
  cpu_context = cpu_canvas.getContext('2d', { alpha: request.embedded })!;
  gl = new GlCanvas(module, request.gpu_canvas, request.embedded, { lost: on_lost, restored: on_restored });
  const choices = JSON.parse(page.choices()) as Choices;
  send({ type: 'ready', version: module.version(), threads: module.threads(), gpu: gl.state(''), choices });
}

let started: Promise<void> | null = null;

addEventListener('message', async (event: MessageEvent<Request>) => {
  const request = event.data;
  if (request.type === 'start') {
    started = attempt(null, () => start(request));
    return;
  }
  await started;
  if (!page) return;
  switch (request.type) {
    case 'load':
      return attempt(request.id, () => load(request));
    case 'set':
      wanted_changes = merged(wanted_changes ?? {}, request.changes);
      serial = request.serial;
      return ask_for_frame();
    case 'look':
      wanted_look = { ...wanted_look, ...request.changes };
      look_serial = request.serial;
      return ask_for_frame();
    case 'restore':
      return attempt(null, () => restore(request));
    case 'resize':
      size_px = { width: request.width_px, height: request.height_px };
      page.resize(size_px.width, size_px.height);
      return ask_for_frame();
    case 'move':
      serial = request.serial;
      add_move(request.move);
      return ask_for_frame();
    case 'play':
      play(request.action);
      return ask_for_frame();
    case 'pick':
      return attempt(request.id, () => pick(request));
    case 'ray_paths':
      return attempt(null, () => ray_paths(request));
    case 'describe':
      return attempt(null, () => describe(request));
    case 'measure_frames':
      return attempt(null, () => measure_frames(request));
    case 'measure_union':
      return attempt(null, () => measure_union(request));
    case 'histogram':
      return attempt(null, () => histogram(request));
    case 'picture':
      return attempt(request.id, () => picture(request));
    case 'preview':
      previewing = preview(request); // the page asks for one at a time
      await previewing;
      previewing = null;
      return;
    case 'film':
      return attempt(request.id, () => film(request));
    case 'picture_cancel':
      saving?.cancel();
      return;
    case 'thesis':
      return attempt(null, () => run_thesis(request.quick, request.device, request.saved));
    case 'shown_frames':
      return attempt(null, () => show_frames(request.seconds, request.device));
    case 'thesis_cancel':
      if (thesis) thesis.cancelled = true;
      return;
  }
});
