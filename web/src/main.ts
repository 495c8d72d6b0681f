// The page: it starts the worker, shows the worker's answers, and passes on the user's actions.
import { start_language } from './language'; // first: the others take their words from it
import { watch_badge } from './badge';
import { able_browsers, lacking } from './browser_needs';
import { Controls } from './controls';
import { Cards } from './cards';
import { Cut } from './cut';
import { element } from './dom';
import { Engine } from './engine';
import { Figures, is_figure } from './figure';
import { Film } from './film';
import type { NamedBlob } from './figure_protocol';
import type { Past, Snapshot } from './history';
import { Keeper, type Kept } from './kept';
import { Inspector } from './inspect';
import { listen_for_keys, listen_for_zoom } from './keyboard';
import { GroupLists } from './groups';
import { LookControls } from './look';
import { ask_for, type Ask } from './ask';
import { has_host, is_embedded, start_embedded } from './embedded';
import { Host } from './host';
import { document_of, has_state, link_of, reading_of, state_from, state_of, type State } from './link';
import { data_inside, data_of_page, escaped, is_one_file, is_page, packed_module, page_with, type Inside } from './one_file';
import { keep_for_offline, listen_for_launches, remember_start, remembered_start } from './offline';
import { begin_load, busy, end_load, fail, note } from './messages';
import { Preview } from './preview';
import { PlayerBar } from './player';
import { listen_for_pointers } from './pointer';
import type { Changes, EngineName, Facts, FrameReport, GpuState, Look, Move, Reading, Settings, Source } from './protocol';
import { RecentFiles } from './recent';
import { ReadingControls } from './reading_controls';
import { Saving } from './saving';
import {
  build_sources, is_trajectory, kind_of, listen_for_sources, show_source, wanted_files, wanted_source, with_reading,
  type OwnFiles, type Wanted,
} from './sources';
import { describe_device } from './device';
import { save } from './download';
import { RayPathTable } from './ray_path';
import { show_statistics } from './statistics';
import { load_style_pictures } from './style_tiles';
import { is_dark, start_theme } from './theme';
import { ThesisDialog } from './thesis';
import { Tripod } from './tripod';
import { Undo } from './undo';
import { UnionMeasures } from './union';
import { listen_for_samples, welcome } from './welcome';
import { grouped, words as texts } from './words';

const most_pixels = 2560 * 1600; // of a picture on the screen
const finest_ratio = 2; // finer pixels of a phone are invisible

const picture = element('picture');
const gpu_canvas = element<HTMLCanvasElement>('gpu_canvas');
const cpu_canvas = element<HTMLCanvasElement>('cpu_canvas');

let source: Source = { built_in: 'demo' };
let settings: Settings | null = null;
let look: Look | null = null;
let facts: Facts | null = null;
let gpu: GpuState = { name: '', here: false, software: false, why_not: '', description: '' };
let serial = 0;
let look_serial = 0;
let look_answered = 0;
let loading = 0; // id of the load that is awaited
let first_frame = false; // of the newly loaded scene: it is awaited
let chosen: OwnFiles | null = null; // the user's shown files
let shown_files: NamedBlob[] = []; // of the shown scene, which figures may have been drawn from
let figures: Figures;
let refused: OwnFiles | null = null; // the user's files that were opened last and could not be read
let asked_columns = ''; // of the load that is awaited
let asked: Ask | null = null; // the user's own file that a link was made for
let address_reading: Reading | undefined;
let measured: { name: string; lines: string[] } | null = null; // the table of frames that is being made
let framed = true; // the camera was not moved since it showed the whole scene, or was the scene's own
// Loads by their ids: what holds once they are done. `past`: the scene's; 'same' after another reading of the shown one.
const awaited = new Map<number, { own: OwnFiles | null; files: NamedBlob[]; framed: boolean; past: Past | 'same' | null; undone: -1 | 1 | null }>();
let kept_pins: number[] = []; // of the scene that a reload brings back, until it is loaded
const host = new Host();
let shown_frame = 0;
let titles_vary = false; // each frame of the file has a title of its own
let scale = 1;
let size = { width: 1, height: 1 };

const engine = new Engine(
  {
    ready: ({ version, threads, gpu: found, choices }) => {
      controls.build(choices);
      looks.build(choices);
      build_sources(choices);
      reading.build(choices.reading);
      groups.build(choices.materials);
      saving.limit(choices.most_pixels);
      element('file_formats').textContent = choices.formats;
      undo.name_by(choices.settings);
      program_version = version;
      gpu = found;
      show_gpu();
      element('about').textContent =
        texts.about(version, threads, !is_one_file);
    },
    loaded: (answer) => {
      if (answer.id === loading) {
        busy(texts.drawing);
        first_frame = true;
      }
      end_load(answer.id);
      source = answer.source;
      const now = awaited.get(answer.id);
      awaited.delete(answer.id);
      chosen = now?.own ?? null;
      shown_files = now?.files ?? [];
      refused = null;
      framed = now?.framed ?? true;
      titles_vary = answer.facts.frames > 1 && answer.facts.format === 'XYZ';
      show_facts(answer.facts);
      show_source(source);
      reading.show(source, kind_of(source), facts);
      show_settings(answer.settings);
      controls.show_facts(answer.facts);
      film.show_frames(answer.facts.frames);
      controls.show(answer.settings);
      look = answer.look;
      looks.show_facts(answer.facts);
      inspector.begin(answer.facts.length_unit, answer.facts.frames > 1);
      inspector.recall(kept_pins.splice(0));
      groups.begin();
      preview.begin();
      union.begin(answer.facts.length_unit);
      measured = null;
      looks.show(look, answer.counts, answer.coloured_by);
      cut.begin();
      look_answered = look_serial;
      keeper?.show(source, chosen);
      recent?.add(chosen, answer.facts.title, source.reading);
      if (now?.past !== 'same') undo.begin(snapshot()!, now?.past ?? null);
      else if (!now.undone) undo.act();
      for (const text of answer.notes) note(text, answer.id);
      host.loaded(answer.id, answer.facts, answer.settings, answer.look);
    },
    failed: ({ id, message }) => {
      busy(null);
      first_frame = false;
      saving.failed(id);
      film.failed(id);
      const own = id === null ? null : (awaited.get(id)?.own ?? null);
      const undone = id === null ? null : (awaited.get(id)?.undone ?? null);
      if (undone) undo.take_back(undone);
      if (id !== null) awaited.delete(id);
      if (id === loading) {
        show_source(source);
        reading.show(source, kind_of(source), facts);
        // Other columns may help, so the request stays in the panel, and a change reads the same file again.
        if (own && own !== chosen) {
          refused = own;
          reading.keep_columns(asked_columns);
        }
      }
      fail(message);
      host.failed(id, message);
    },
    note: ({ message }) => note(message),
    gpu: ({ gpu: found }) => {
      gpu = found;
      show_gpu();
    },
    settings: (answer) => {
      show_settings(answer.settings);
      if (answer.serial === serial) controls.show(answer.settings);
    },
    look: (answer) => {
      look = answer.look;
      look_answered = Math.max(look_answered, answer.serial);
      if (answer.serial === look_serial) looks.answer(look, answer.counts, answer.coloured_by, answer.fault);
      look_changed();
      host.look_answered();
    },
    restored: (answer) => {
      show_settings(answer.settings);
      controls.show(answer.settings);
      look = answer.look;
      looks.show(look, answer.counts, answer.coloured_by ?? []);
      look_changed();
      for (const text of answer.notes) note(text);
    },
    contents: ({ contents, legend }) => {
      groups.take(contents, legend);
      if (contents) cut.take(contents);
    },
    measured_union: ({ numbers }) => union.done(numbers),
    histogram: ({ attribute, histogram }) => looks.histogram(attribute, histogram),
    measured_frames: ({ lines, done, finished }) => {
      if (!measured) return;
      measured.lines.push(...lines);
      busy(finished ? null : texts.measuring, done);
      if (!finished) return;
      const table = [`frame,time_ps,step,${measured.name}`, ...measured.lines].join('\n');
      save(new Blob([`${table}\n`], { type: 'text/csv' }), `${file_stem()}-${measured.name.split('_')[0]}.csv`);
      measured = null;
    },
    frame: (answer) => {
      show_settings(answer.settings);
      if (answer.serial === serial) controls.show(answer.settings);
      show_engine(answer.settings.engine);
      inspector.draw();
      cut.draw();
      // Between two steps of a drag too, when all that was asked for is shown.
      if (answer.serial === serial && look_answered === look_serial) undo.note(snapshot()!);
      show_frame(answer.report, answer.width_px, answer.height_px);
      if (first_frame && answer.report.drawn) {
        busy(null);
        load_style_pictures();
      }
      if (answer.report.drawn) first_frame = false;
    },
    player: ({ player: state }) => {
      player.show(state);
      if (state.shown && state.frame !== shown_frame) {
        inspector.moved();
        union.outdated();
      }
      if (state.shown) shown_frame = state.frame;
      if (state.shown && facts && state.title !== facts.title) {
        titles_vary = true;
        show_facts({ ...facts, title: state.title });
      }
    },
    statistics: ({ json }) => show_statistics(json),
    picture_progress: ({ done }) => saving.progress(done),
    film_progress: ({ done }) => film.progress(done),
    film: ({ film: file }) => film.done(file, file_stem()),
    picked: ({ id, picked }) => inspector.picked(id, picked) || host.picked(id, picked),
    ray_paths: ({ paths }) => ray_path.show(paths),
    described: ({ spheres, measure }) => inspector.described(spheres, measure),
    preview: ({ picture: file }) => preview.take(file),
    picture: ({ picture: file }) => host.picture(file) || saving.done(file, facts?.name ?? 'picture'),
    thesis_progress: ({ progress }) => thesis.progress(progress),
    thesis_failed: ({ message }) => {
      if (settings) show_engine(settings.engine);
      thesis.failed(message);
    },
    thesis_saved: ({ result }) => thesis.saved(result),
    shown_progress: ({ progress }) => {
      show_engine('cpu'); // its canvas shows the frames
      thesis.shown_progress(progress);
    },
    shown_done: ({ cancelled, result }) => {
      if (settings) show_engine(settings.engine);
      thesis.shown_done(cancelled, result);
    },
    thesis_done: ({ cancelled, result, charts }) => thesis.done(cancelled, result, charts),
  },
  (message) => {
    busy(null);
    fail(`The C++ module could not be started: ${message}`);
  },
);

function change(changes: Changes): void {
  undo.act();
  engine.send({ type: 'set', serial: ++serial, changes });
}

// In pixels of the page; returns the id of the request.
function pick(x: number, y: number): number {
  const id = engine.new_id();
  engine.send({ type: 'pick', id, x_px: x * scale, y_px: y * scale });
  return id;
}

function move_camera(move: Move): void {
  framed = move.kind === 'look_from' || move.kind === 'home';
  undo.act();
  engine.send({ type: 'move', serial: ++serial, move });
}

const controls = new Controls({ change, move: move_camera });
function change_look(changes: Partial<Look>): void {
  picture.dataset['settled'] = 'false';
  engine.send({ type: 'look', serial: ++look_serial, changes });
}

const looks = new LookControls(
  (changes) => {
    undo.act();
    change_look(changes);
    groups.show();
    cut.show();
  },
  (attribute) => engine.send({ type: 'histogram', attribute }),
);
const groups = new GroupLists(looks, () => cards.show('show'));
const reading = new ReadingControls(read_again);
const cut = new Cut(looks, () => settings?.camera ?? null);
const saving = new Saving({
  draw: (width_px, height_px) => {
    const id = engine.new_id();
    engine.send({ type: 'picture', id, width_px, height_px });
    return id;
  },
  cancel: () => engine.send({ type: 'picture_cancel' }),
  resized: () => preview.follow(),
});
const preview = new Preview({
  state: () => JSON.stringify([settings, look, shown_frame]),
  size: () => saving.size(),
  at_rest: () => picture.dataset['settled'] === 'true',
  draw: (width_px, height_px) => engine.send({ type: 'preview', width_px, height_px }),
});
const cards = new Cards((name) => {
  cut.set_open(name === 'cut');
  preview.set_open(name === 'save');
});

function look_changed(): void {
  groups.show();
  cut.show();
  inspector.moved();
  union.outdated();
}
const film = new Film({
  draw: (request) => {
    const id = engine.new_id();
    engine.send({ type: 'film', id, ...request, keep_in_view: framed });
    return id;
  },
  cancel: () => engine.send({ type: 'picture_cancel' }),
  size: () => saving.chosen(),
});
const tripod = new Tripod();
const inspector = new Inspector({
  pick,
  describe: (spheres) => engine.send({ type: 'describe', spheres }),
  camera: () => settings?.camera ?? null,
  look_at: (eye, look_at) => {
    framed = false;
    change({ camera: { eye: [...eye], look_at: [...look_at] } });
  },
  dismiss: () => !ray_path.is_wanted() && cards.dismiss(),
  clicked: (x, y) => ray_path.ask(x, y),
  pinned: (pins) => {
    host.pinned(pins);
    keeper?.keep_pins(pins.map(({ sphere }) => sphere));
  },
  select: (selection) => {
    cards.show('show');
    looks.begin_row(selection);
  },
  measure_frames: (spheres, name) => {
    measured = { name, lines: [] };
    busy(texts.measuring, 0);
    engine.send({ type: 'measure_frames', spheres, frames: facts?.frames ?? 1 });
  },
});
const ray_path = new RayPathTable((x, y) => engine.send({ type: 'ray_paths', x_px: x * scale, y_px: y * scale }));
const union = new UnionMeasures((selection, probe) => engine.send({ type: 'measure_union', selection, probe }));
const player = new PlayerBar((action) => engine.send({ type: 'play', action }));
const thesis = new ThesisDialog({
  run: (quick, saved) => engine.send({ type: 'thesis', quick, device: device_json(), saved }),
  show_frames: (seconds) => engine.send({ type: 'shown_frames', seconds, device: device_json() }),
  cancel: () => engine.send({ type: 'thesis_cancel' }),
  goes_on_from: (result) => result['engine'] === settings?.engine && result['version'] === program_version,
});

const keeps = !is_embedded && !is_one_file;
const recent = keeps
  ? new RecentFiles((own, reading) => {
      forget_asked();
      void open(wanted_files(own, reading), own.file.name, null, own);
    })
  : null;
const keeper = keeps ? new Keeper(() => recent!.forget_all()) : null;
const undo = new Undo({ restore, changed: (past) => keeper?.keep(past) });

let program_version = '';
const device_json = () => describe_device(gpu.name, navigator.hardwareConcurrency, program_version);

// The background of files of spheres in the dark theme: that of the page.
const dark_ground = '#101317';
const ground = () => (is_dark() && !has_host ? dark_ground : '');

// Unless another one was chosen.
function follow_theme(): void {
  if (!look || !facts?.is_file_of_spheres || has_host) return;
  const before = is_dark() ? '' : dark_ground;
  if (look.background === before) change_look({ background: is_dark() ? dark_ground : '' });
}

const file_stem = () => (facts?.name ?? 'picture').replace(/.*\//, '').replace(/\.[^.]*$/, '');

const snapshot = (): Snapshot | null => settings && look && { reading: source.reading ?? null, settings, look, framed };

// Answers of the worker.

function show_settings(now: Settings): void {
  settings = now;
  tripod.draw(now.camera);
  host.settings(now);
}

function show_engine(name: EngineName): void {
  gpu_canvas.hidden = name !== 'gpu';
  cpu_canvas.hidden = name !== 'cpu';
}

function show_gpu(): void {
  const words = element('engine_note');
  words.hidden = gpu.here && !gpu.software;
  words.textContent = gpu.here
    ? texts.engine.software
    : texts.engine.missing;
  words.title = gpu.why_not;
  for (const button of document.querySelectorAll<HTMLInputElement>('#engine input[value=gpu]'))
    button.disabled = !gpu.here;
}

function show_facts(now: Facts): void {
  facts = now;
  const file = now.name.replace(/.*\//, '');
  // The built-in ones have names for people in the list of samples.
  const built_in = 'built_in' in source && document.querySelector(`#built_in option[value="${source.built_in}"]`);
  const name = (built_in && built_in.textContent) || (!titles_vary && now.title) || file;
  const counted = texts.scene[now.has_elements ? 'atoms' : 'spheres'](grouped(now.spheres), now.spheres === 1);
  const entry = now.entry_id === name ? '' : now.entry_id;
  element('badge_name').textContent = name;
  element('badge').title = name;
  element('badge_more').textContent = [titles_vary && now.title, entry, counted, now.format].filter(Boolean).join(' · ');
  document.title = [name, entry, 'bihive'].filter(Boolean).join(' · ');
  const spheres = texts.scene.spheres(grouped(now.spheres), now.spheres === 1);
  element('scene_title').textContent = now.title;
  element('scene_title').hidden = now.title === '';
  element('facts').textContent =
    `${file}: ${spheres}, ${now.format}` +
    (now.frames > 1 ? `, ${texts.scene.frames(grouped(now.frames))}` : '');
  picture.setAttribute('aria-label', `${name}, ${spheres}`);
  element('rules_box').hidden = now.rules.length === 0;
  element('rules').replaceChildren(
    ...now.rules.map((rule) => Object.assign(document.createElement('li'), { textContent: rule })),
  );
}

function show_frame(report: FrameReport, width: number, height: number): void {
  const words = [];
  if (report.fps > 0) words.push(`${report.fps < 10 ? report.fps.toFixed(1) : report.fps.toFixed(0)} fps`);
  words.push(`${report.mray_per_s < 10 ? report.mray_per_s.toFixed(1) : report.mray_per_s.toFixed(0)} Mray/s`);
  element('frame_rate').textContent = words.join(' · ');
  element('badge_frame').textContent = report.settled
    ? `${width} × ${height}`
    : `${width} × ${height}${report.divisor > 1 ? ` / ${report.divisor}` : ''} · ${Math.floor(100 * report.done)} %`;
  element('stage').classList.toggle('titled', settings?.title !== '');
  picture.dataset['settled'] = String(report.settled);
  if (report.settled) preview.follow();
  // For measurements of the page's start.
  if (report.drawn && performance.getEntriesByName('first picture').length === 0) performance.mark('first picture');
}

// Actions of the user.

type AskedState = Omit<State, 'source'> & { framed?: boolean };

// `own`: files of the user's, so that they can be read again. `past`, `undone`: as in `awaited`.
async function open(
  what: Promise<Wanted>,
  name: string,
  wanted: AskedState | null = null,
  own: OwnFiles | null = null,
  past: Past | 'same' | null = null,
  undone: -1 | 1 | null = null,
): Promise<void> {
  const id = (loading = engine.new_id());
  first_frame = false;
  refused = null;
  begin_load(id);
  picture.dataset['settled'] = 'false';
  busy(texts.loading(name));
  try {
    const { source: from, files } = await what;
    if (id !== loading) return; // another one was requested meanwhile
    const state = { settings: wanted?.settings ?? null, look: wanted?.look ?? null };
    const blobs = files ? [files, ...(files.trajectory ? [files.trajectory] : [])] : [];
    const named = blobs.map(({ name, content }) => ({ name, content }));
    awaited.set(id, { own, files: named, framed: wanted?.framed ?? !state.settings?.camera?.eye, past, undone });
    asked_columns = String(from.reading?.columns ?? '');
    engine.send({ type: 'load', id, source: from, files, ...state, ground: ground() });
  } catch (error) {
    busy(null);
    show_source(source);
    reading.show(source, kind_of(source), facts);
    if (undone) undo.take_back(undone);
    fail((error as Error).message);
    host.failed(id, (error as Error).message);
  }
}

const name_of = (from: Source) => ('built_in' in from ? from.built_in : 'url' in from ? from.url : from.file);

function open_source(from: Source, wanted: Omit<State, 'source'> | null = null): Promise<void> {
  return open(wanted_source(from.reading ? from : with_reading(from, address_reading)), name_of(from), wanted);
}

function forget_asked(): void {
  asked?.close();
  asked = null;
}

// The state of a link goes to the file that it was made for.
async function open_file(file: File, trajectory: File | null = null): Promise<void> {
  const own = { file, trajectory };
  const waiting = asked;
  const fits = waiting?.file === file.name;
  if (fits) forget_asked();
  const reading = (fits && waiting?.state.source.reading) || address_reading;
  await open(wanted_files(own, reading), file.name, fits ? waiting!.state : null, own);
  if (waiting && !fits) waiting.say_other(file.name);
}

// A trajectory belongs to the other chosen file, or to the shown one, whose state stays.
async function open_files(files: File[]): Promise<void> {
  const moves = files.find(is_trajectory) ?? null;
  const file = files.find((one) => !is_trajectory(one));
  if (file) {
    await open_file(file, moves);
    if (files.length > (moves ? 2 : 1)) note(texts.several_files(file.name));
  } else if (!chosen) fail(`${moves!.name} holds places alone: open the file of its spheres first, or both at once`);
  else {
    const own = { file: chosen.file, trajectory: moves };
    await open(wanted_files(own, source.reading), moves!.name, settings && { settings, look }, own);
  }
}

// What the user dropped or picked: pictures are compared, other files are opened.
async function take_files(files: File[]): Promise<void> {
  element('welcome').hidden = true;
  const page = files.find(is_page);
  if (page) return open_page(page);
  const pictures = files.filter(is_figure);
  const others = files.filter((file) => !is_figure(file));
  if (others.length > 0) await open_files(others);
  figures.try_again(others);
  figures.open(pictures, others);
}

// The same file with other radii or columns. A camera that was not moved is placed again.
// Columns may be those that a file lacked which could not be read; radii are of the shown one.
function read_again(reading: Reading | undefined, columns_changed = true): void {
  if (refused && columns_changed) return void open(wanted_files(refused, reading), refused.file.name, null, refused);
  if (!settings) return;
  if (refused && reading) {
    const { columns: _, ...radii } = reading;
    const { columns } = source.reading ?? {};
    reading = columns === undefined ? radii : { ...radii, columns };
  }
  const { fov_deg, projection, aperture, focus } = settings.camera;
  const camera = framed ? { fov_deg, projection, aperture, focus } : settings.camera;
  open_shown(reading, { settings: { ...settings, camera }, look }, 'same');
}

// The shown scene, with this state.
function open_shown(reading: Reading | undefined, state: AskedState, past: 'same', undone: -1 | 1 | null = null): void {
  if (chosen) void open(wanted_files(chosen, reading), chosen.file.name, state, chosen, past, undone);
  else void open(wanted_source(with_reading(source, reading)), name_of(source), state, null, past, undone);
}

// A state from the history of the shown scene.
function restore(state: Snapshot, by: -1 | 1): void {
  const reading = state.reading ?? undefined;
  if (JSON.stringify(reading) !== JSON.stringify(source.reading)) return open_shown(reading, state, 'same', by);
  framed = state.framed;
  picture.dataset['settled'] = 'false';
  look_answered = ++look_serial;
  engine.send({ type: 'restore', serial: ++serial, settings: state.settings, look: state.look });
}

// What the tab showed before it was loaded again.
function open_kept({ source: from, past, pins, own }: Kept): Promise<void> {
  kept_pins = pins;
  const state = past.states[past.at]!;
  const reading = state.reading ?? undefined;
  if (own) return open(wanted_files(own, reading), own.file.name, state, own, past);
  return open(wanted_source(with_reading(from, reading)), name_of(from), state, null, past);
}

function watch_size(): void {
  const fit = () => {
    const box = picture.getBoundingClientRect();
    if (box.width < 1 || box.height < 1) return;
    const ratio = Math.min(devicePixelRatio || 1, finest_ratio);
    scale = Math.min(ratio, Math.sqrt(most_pixels / (box.width * box.height)));
    size = { width: Math.max(1, Math.round(box.width * scale)), height: Math.max(1, Math.round(box.height * scale)) };
    picture.dataset['settled'] = 'false';
    engine.send({ type: 'resize', width_px: size.width, height_px: size.height });
    saving.propose(size.width, size.height);
  };
  new ResizeObserver(fit).observe(picture);
  fit();
}

// A phone has a sheet of its own for links.
const shares_links = 'share' in navigator && matchMedia('(pointer: coarse)').matches;

async function copy_link(): Promise<void> {
  if (!settings) return;
  const link = link_of({ source, settings, look });
  if (!is_embedded) history.replaceState(null, '', link);
  const words = 'file' in source ? texts.link.asks_for(source.file) : '';
  if (shares_links) {
    // Closing the system's sheet is no fault.
    await navigator.share({ title: document.title, url: link }).catch(() => {});
    return;
  }
  try {
    await navigator.clipboard.writeText(link);
    note(`${texts.link.copied} ${words}`);
  } catch {
    note(`${texts.link.in_address} ${words}`);
  }
}

// A link to a server of this machine is nobody else's, and a file of the user's is in no link: then the code shows the page
// that is saved as one file.
async function copy_embed(): Promise<void> {
  if (!settings) return;
  const needs_page = is_one_file || 'file' in source || /^(localhost|127\.|\[::1\])/.test(location.hostname);
  const page = `${file_stem()}.html`;
  const link = new URL(needs_page ? `https://x/${encodeURIComponent(page)}` : link_of({ source, settings, look }));
  link.searchParams.set('embed', '');
  const address = needs_page ? `${link.pathname.slice(1)}${link.search}` : link.href;
  const attributes = { src: address, title: document.title, width: '640', height: '480', style: 'border: 0', loading: 'lazy' };
  const code = `<iframe ${Object.entries(attributes).map(([name, value]) => `${name}="${escaped(value)}"`).join(' ')}></iframe>`;
  try {
    await navigator.clipboard.writeText(code);
    note(needs_page ? texts.embed.with_page(page) : texts.embed.copied);
  } catch {
    element('embed_help').textContent = code;
  }
}

// All that is shown as one file, which opens without a server.
async function save_page(): Promise<void> {
  if (!settings || !look) return;
  try {
    const file = await page_with({ source, settings, look }, shown_files);
    save(file, `${file_stem()}.html`);
    note(texts.page_saved((file.size / 1e6).toFixed(1)));
  } catch (error) {
    fail((error as Error).message);
  }
}

const show_inside = ({ state, own }: Inside) =>
  own ? open(wanted_files(own, state.source.reading), own.file.name, state, own) : open_source(state.source, state);

// What a page holds that “Save as page” wrote.
async function open_page(file: File): Promise<void> {
  try {
    const inside = await data_of_page(file);
    if (!inside) throw new Error(`${file.name} is no page that bihive saved`);
    await show_inside(inside);
  } catch (error) {
    fail((error as Error).message);
  }
}

// What this page, which is one file, holds.
async function open_inside(): Promise<void> {
  try {
    await show_inside((await data_inside()) ?? { state: { source: { built_in: 'demo' }, settings: null, look: null }, own: null });
  } catch (error) {
    fail((error as Error).message);
  }
}

// The FILE of `bihive web FILE`, as the text of a state; empty: there is none, or the address has a state.
async function started(): Promise<string> {
  if (has_state(location.hash)) return '';
  return fetch(new URL('start.json', document.baseURI))
    .then((response) => (response.ok ? response.text() : ''))
    .then(remember_start)
    .catch(remembered_start);
}

// The first input: the state in the address, that FILE, or the molecule.
const first_state = (start: string): State =>
  state_of(location.hash) ?? state_from(document_of(start)) ?? { source: { built_in: 'demo' }, settings: null, look: null };

async function start(): Promise<void> {
  start_theme(follow_theme);
  start_language();
  start_embedded();
  keep_for_offline();
  const lack = lacking();
  if (lack !== '') {
    fail(texts.lacking(lack, able_browsers));
    element('badge').hidden = true;
    picture.setAttribute('aria-label', texts.no_picture);
    element('tools').inert = true;
    return;
  }
  const threads_asked = new URLSearchParams(location.search).get('threads');
  const threads = globalThis.crossOriginIsolated && typeof SharedArrayBuffer !== 'undefined' && threads_asked !== '0';
  figures = new Figures({ base: document.baseURI, threads }, () => shown_files);
  const canvases = [gpu_canvas.transferControlToOffscreen(), cpu_canvas.transferControlToOffscreen()] as const;
  busy(texts.starting);
  const wasm = await host.begin(threads);
  const packed = packed_module();
  engine.send(
    { type: 'start', threads, base: document.baseURI, embedded: is_embedded, wasm, packed, gpu_canvas: canvases[0], cpu_canvas: canvases[1] },
    [...canvases, ...(packed ? [packed.buffer] : [])],
  );
  watch_size();
  watch_badge();

  listen_for_pointers(picture, () => scale, move_camera);
  listen_for_zoom(() => size, move_camera);
  listen_for_keys({
    scale: () => scale,
    size: () => size,
    move: move_camera,
    view: (number) => controls.set_view_at(number),
    engine: () => settings?.engine ?? 'cpu',
    set_engine: (name) => controls.set_engine(name),
    play: (key) => player.key(key),
  });
  listen_for_sources((from) => {
    element('welcome').hidden = true;
    forget_asked();
    void open_source(from);
  }, (files) => void take_files(files));
  listen_for_launches((files) => void take_files(files));
  element('copy_link').addEventListener('click', () => void copy_link());
  element('copy_embed').addEventListener('click', () => void copy_embed());
  element('save_page').addEventListener('click', () => void save_page());
  // A link to a file of one's own is nobody else's, and there is no server.
  if (is_one_file) for (const id of ['copy_link', 'link_help', 'url_form', 'thesis_group', 'language_row']) element(id).hidden = true;
  if (shares_links) element('copy_link').textContent = texts.link.share;

  const open_state = async (start: string) => {
    try {
      address_reading = reading_of(location.search);
      const state = first_state(start);
      forget_asked();
      if ('file' in state.source) {
        // The camera of one file would be confusing for another.
        asked = ask_for({ file: state.source.file, state });
        await open_source({ built_in: 'demo' });
      } else await open_source(state.source, state);
    } catch (error) {
      const opened = open_source({ built_in: 'demo' });
      fail((error as Error).message);
      await opened;
    }
  };
  host.start({
    open: ({ source: from, file, trajectory, look, camera }) => {
      const state = { settings: camera && { camera }, look };
      if (file) void open(wanted_files({ file, trajectory }, from.reading), file.name, state, { file, trajectory });
      else void open_source(from, state);
      return loading;
    },
    read_again: (reading) => {
      read_again(reading);
      return loading;
    },
    look: change_look,
    camera: (camera) => {
      framed = false;
      change({ camera });
    },
    pick,
    draw: (width, height) => {
      const id = engine.new_id();
      engine.send({ type: 'picture', id, width_px: width ?? size.width, height_px: height ?? size.height });
      return id;
    },
  });
  if (has_host) return;
  listen_for_samples((built_in) => void open_source({ built_in }));

  // The browser asks whether to leave.
  addEventListener('beforeunload', (event) => {
    if (saving.is_running || film.is_running) event.preventDefault();
  });
  addEventListener('hashchange', () => {
    if (has_state(location.hash)) void open_state('');
  });
  if (is_one_file) return void (await open_inside());
  const text = await started();
  const kept = (await keeper?.open(text)) ?? null;
  welcome(!kept && !is_embedded && !has_state(location.hash) && state_from(document_of(text)) === null);
  await (kept ? open_kept(kept) : open_state(text));
}

void start();
