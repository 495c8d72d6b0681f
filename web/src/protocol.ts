// The messages between the page and its worker. The worker owns the C++ module and both canvases; the page owns the
// controls. Numbers and names of settings are those of the C++ library.
import type { Parameter } from './parameter';
import type { ReadingRow } from './reading_controls';
import type { PictureSettings, Projection, ReadingId, ViewName } from './settings';

export type EngineName = 'cpu' | 'gpu';

export interface Camera {
  eye: [number, number, number];
  look_at: [number, number, number];
  up: [number, number, number];
  fov_deg: number;
  projection: Projection;
  shorter_side: number;
  aperture: number;
  focus: number; // 0: where look_at is
}

/** As ViewerSettings of the library; a limit of the tree that is null leaves the choice to the engine. */
export interface Settings extends PictureSettings {
  engine: EngineName;
  view: ViewName;
  max_prims: number | 'unlimited' | null;
  max_depth: number | 'unlimited' | null;
  set: (keyof PictureSettings)[]; // set by the user; the others are the scene's
  focus_on: string;
  replicate: [number, number, number] | null; // null: the input's copies
  camera: Camera;
}

/** One action on selected spheres: as the options of `bihive render` after --select. */
export interface LookRow {
  select: string; // empty: all
  action: string;
  value: string;
}

/** As ViewerLook of the library; an empty text leaves the choice to the input, or to its style. */
export interface Look {
  style: string;
  element_colours: string;
  background: string;
  lights: string[];
  colour_by: string;
  nan_colour: string;
  crease: string;
  floor: string;
  floor_up: [number, number, number] | null; // its normal; null: up of the file's camera, or y
  rows: LookRow[];
}

/** Why a look was refused. `row`: the faulty row, or -1. */
export interface LookFault {
  row: number;
  message: string;
}

/** Changes of settings; missing values of a camera stay. */
export type Changes = Omit<Partial<Settings>, 'camera'> & { camera?: Partial<Camera> };

/** How a file is read, as on the command line ("x=px,y=py,z=pz,r=5"); missing values are the file's own. */
export type Reading = Partial<Record<ReadingId, string | number>>;

/** The source of a scene. A dropped file has no address: a link names it, and the page asks for it. */
export type Source = ({ built_in: string; count?: number } | { url: string } | { file: string; trajectory?: string }) & { reading?: Reading };

/** The attributes that colour the spheres; categories have no range. */
export interface ColouredBy {
  attribute: string;
  range?: [number, number];
}

export interface Facts {
  name: string;
  title: string; // what the file says that it shows; may be empty, as the entry's id may
  entry_id: string;
  format: string;
  spheres: number;
  frames: number;
  rules: string[];
  warnings: string[];
  takes_style: boolean;
  is_file_of_spheres: boolean;
  has_elements: boolean;
  has_cell: boolean;
  copies: [number, number, number]; // along the cell's vectors, as the input asks for
  attributes: string[];
  length_unit: string; // empty: unknown
}

/** Spheres with a name in common (viewer/contents.h). */
export interface Group {
  of: string;
  name: string;
  select: string;
  count: number;
}

/** Groups of the scene, and its bounding box. */
export interface Contents {
  groups: Group[];
  low: [number, number, number];
  high: [number, number, number];
}

/** An attribute that colours the spheres, with its categories, or its numbers from low to high. */
export interface LegendKey {
  title: string;
  entries: { name: string; colour: string; select: string }[];
  scale: { least: number; most: number; logarithmic: boolean; colours: string[] } | null;
}

export interface Histogram {
  least: number;
  most: number;
  counts: number[];
}

export interface MapColours {
  name: string;
  colours: string[]; // from low to high; none of a map for categories
}

export interface FrameReport {
  drawn: boolean;
  settled: boolean;
  done: number;
  divisor: number;
  frame_ms: number;
  fps: number;
  mray_per_s: number;
}

export interface ThesisProgress {
  finished: boolean;
  done: number;
  seconds_left: number;
  configurations_done: number;
  configurations: number;
  scenario: number;
  spheres: number;
}

/** A configuration whose frames are shown and counted. */
export interface ShownProgress {
  finished: boolean;
  done: number;
  scenario: number;
  spheres: number;
  max_prims: number | null; // null: the wide engine
  turning: boolean;
}

/** A file of the user's, and its separate trajectory, if any. They are read in pieces, in place. */
export interface Files {
  name: string;
  content: Blob;
  trajectory: { name: string; content: Blob } | null;
}

/** The requested frame, and the playback. */
export interface PlayerState {
  frames: number;
  frame: number;
  shown: boolean; // it is displayed
  playing: boolean;
  loops: boolean;
  frames_per_second: number;
  time_ps: number | null;
  title: string; // of the shown frame
}

export type PlayAction = { toggle: true } | { step: number } | { frame: number } | { frames_per_second: number } | { loops: boolean };

/** One step of the pointer or a key, in pixels of the picture. */
export type Move =
  | { kind: 'orbit' | 'pan'; dx: number; dy: number }
  | { kind: 'zoom'; factor: number; x: number; y: number }
  | { kind: 'look_from'; side: string }
  | { kind: 'home' };

/** What a turn is about: the picture's up, or an axis of the world. */
export type TurnAxis = 'up' | 'x' | 'y' | 'z';

/** A film: once around in this number of pictures, or, without a turn, the first `frames` frames of the file. */
export interface FilmRequest {
  width_px: number;
  height_px: number;
  frames: number;
  frames_per_second: number;
  turn: TurnAxis | null;
  keep_in_view: boolean; // the camera goes as far away as the whole scene needs
}

/** The sphere at a place of the picture (viewer/pick.h). */
export interface Picked {
  sphere: number; // its id in the shown set
  point: [number, number, number]; // on its surface
  distance: number; // from the eye
  centre: [number, number, number];
  radius: number;
  attributes: Record<string, number | string | null>;
}

/** The way of one ray through both trees, as `bihive compare --pixel --json` prints it. */
export interface RayPaths {
  structures: {
    name: string;
    t: number | null; // of the hit
    id: number; // of the sphere, or -1
    nodes: number;
    box_tests: number;
    sphere_tests: number;
    steps: { spheres: number[]; t: number | null }[]; // t: of the nearest hit after this node
  }[];
}

/** Of two to four spheres: a distance in the scene's unit, or an angle in degrees. */
export interface Measure {
  value: number | null; // null: of fewer, or not defined
  nearest_images: boolean; // a periodic cell has made it another one
}

/** Of a union of spheres, in the scene's unit (viewer/shown_measures.h). */
export interface UnionNumbers {
  spheres: number;
  area: number;
  area_error: number;
  volume: number;
  volume_error: number;
  components: number;
  undecided_spheres: number; // above 0: cavities and components are not known
  cavities: number[]; // their volumes, from large to small
}

/** Messages to the worker. `id` is returned with the answer. `packed`: the module, by LZMA. `ground`: the background of files
 * of spheres without a look; empty: their own. */
export type Request =
  | { type: 'start'; threads: boolean; base: string; embedded: boolean; wasm: WebAssembly.Module | null; packed: Uint8Array<ArrayBuffer> | null; gpu_canvas: OffscreenCanvas; cpu_canvas: OffscreenCanvas }
  | { type: 'load'; id: number; source: Source; files: Files | null; settings: Changes | null; look: Partial<Look> | null; ground: string }
  | { type: 'set'; serial: number; changes: Changes }
  | { type: 'look'; serial: number; changes: Partial<Look> }
  | { type: 'resize'; width_px: number; height_px: number }
  | { type: 'move'; serial: number; move: Move }
  | { type: 'restore'; serial: number; settings: Settings; look: Look } // of the same scene
  | { type: 'pick'; id: number; x_px: number; y_px: number }
  | { type: 'ray_paths'; x_px: number; y_px: number }
  | { type: 'describe'; spheres: number[] } // by their ids
  | { type: 'measure_frames'; spheres: number[]; frames: number }
  | { type: 'measure_union'; selection: string; probe: number } // of the shown frame
  | { type: 'histogram'; attribute: string }
  | { type: 'picture'; id: number; width_px: number; height_px: number }
  | { type: 'preview'; width_px: number; height_px: number }
  | ({ type: 'film'; id: number } & FilmRequest)
  | { type: 'picture_cancel' } // and of a film
  | { type: 'play'; action: PlayAction }
  | { type: 'thesis'; quick: boolean; device: string; saved: string } // device: JSON; saved: of a run to be continued, or ''
  | { type: 'shown_frames'; seconds: number; device: string }
  | { type: 'thesis_cancel' };

/** Messages from the worker. `serial`: the last request included in these settings. */
export type Answer =
  | { type: 'ready'; version: string; threads: number; gpu: GpuState; choices: Choices }
  | { type: 'loaded'; id: number; source: Source; facts: Facts; settings: Settings; look: Look; counts: number[] | null; coloured_by: ColouredBy[]; notes: string[] }
  | { type: 'restored'; settings: Settings; look: Look; counts: number[] | null; coloured_by: ColouredBy[] | null; notes: string[] }
  | { type: 'failed'; id: number | null; message: string }
  | { type: 'note'; message: string }
  | { type: 'gpu'; gpu: GpuState }
  | { type: 'settings'; serial: number; settings: Settings }
  | { type: 'look'; serial: number; look: Look; counts: number[]; coloured_by: ColouredBy[] | null; fault: LookFault | null }
  | { type: 'frame'; report: FrameReport; serial: number; settings: Settings; width_px: number; height_px: number }
  | { type: 'player'; player: PlayerState }
  | { type: 'statistics'; json: string }
  | { type: 'picked'; id: number; picked: Picked | null }
  | { type: 'ray_paths'; paths: RayPaths | null } // null: an error was shown
  | { type: 'described'; spheres: (Picked | null)[]; measure: Measure }
  | { type: 'measured_frames'; lines: string[]; done: number; finished: boolean }
  | { type: 'measured_union'; numbers: UnionNumbers | null } // null: an error was shown
  | { type: 'histogram'; attribute: string; histogram: Histogram | null }
  | { type: 'contents'; contents: Contents | null; legend: LegendKey[] } // null: as before
  | { type: 'picture_progress'; done: number }
  | { type: 'picture'; picture: Blob | null } // null: cancelled
  | { type: 'preview'; picture: Blob | null } // null: not just now
  | { type: 'film_progress'; done: number }
  | { type: 'film'; film: Blob | null } // null: cancelled
  | { type: 'thesis_progress'; progress: ThesisProgress }
  | { type: 'thesis_saved'; result: string } // after each configuration: lets a later visit continue
  | { type: 'shown_progress'; progress: ShownProgress }
  | { type: 'shown_done'; cancelled: boolean; result: string }
  | { type: 'thesis_failed'; message: string }
  | { type: 'thesis_done'; cancelled: boolean; result: string; charts: string[] };

export interface BuiltIn {
  name: string;
  label: string;
  kind: 'file' | 'scenario' | 'fixed';
}

/** What a row of the look does, and its value, if it has one. */
export interface Action {
  name: string;
  label: string;
  value: string;
  example: string;
  names: 'none' | 'colours' | 'materials' | 'attributes';
  is_number: boolean;
}

/** What lists offer, from the library's tables (viewer/choices.h). */
export interface Choices {
  built_ins: BuiltIn[];
  styles: { name: string; description: string }[];
  actions: Action[];
  materials: string[];
  lights: string[];
  colours: string[];
  element_colours: string[];
  sides: string[];
  projections: Projection[];
  views: { name: ViewName; label: string }[];
  maps: MapColours[];
  settings: Parameter[];
  reading: ReadingRow[];
  formats: string; // their names in a sentence
  most_pixels: number; // of a picture that memory holds
}

/** The available GPU. */
export interface GpuState {
  name: string; // of the GPU, as the browser reports it; may be empty
  here: boolean;
  software: boolean; // drawn by the CPU: slower than the CPU engine
  why_not: string; // the browser's reason why there is none; may be empty
  description: string;
}
