// What the page says to people, as far as scripts say it. Other languages replace these, and the texts of index.html (language.ts).
import { english_costs } from './thesis_result';

let whole: Intl.NumberFormat | undefined;

/** 12345 as "12,345", or as the page's language writes it. */
export const grouped = (count: number): string =>
  (whole ??= new Intl.NumberFormat(document.documentElement.lang, { maximumFractionDigits: 0 })).format(count);

export type Words = typeof words;

export const words = {
  light_labels: {
    studio: 'studio: key, fill, rim', cloudy: 'cloudy sky', headlight: 'headlight', thesis: 'one point, as in the thesis',
  } as Record<string, string>,
  groups: { kind: 'Kinds', ligand: 'Ligands', chain: 'Chains', element: 'Elements', type: 'Types' } as Record<string, string>,
  entry: {
    shown: (name: string) => `Show ${name}`,
    only: 'Only this',
    colour: 'Colour',
    opacity: 'Opacity',
    material: 'Material',
    own_material: 'the style’s',
    reset: 'As it was',
    awaited: 'What is here follows after the first picture.',
  },
  more_entries: (count: number) => `${count} more…`,
  cut: {
    off: 'nothing',
    sides: { view: 'towards me', x: 'along x', y: 'along y', z: 'along z' } as Record<string, string>,
  },
  select: { sphere: 'This', residue: 'Residue', chain: 'Chain', kind: 'All of its kind', label: 'Select' },
  film: {
    kinds: { up: 'once around, upright', x: 'once around x', y: 'once around y', z: 'once around z', frames: 'all frames of the file' } as Record<string, string>,
    drawing: 'Drawing the film',
    cancelled: 'The film was cancelled.',
  },
  embed: {
    copied: 'The code is copied: it shows this scene in a page of yours.',
    with_page: (page: string) => `The code is copied. It shows ${page}, which “Save as page” writes: put both into one folder.`,
  },
  recent: { forget: (name: string) => `Forget ${name}` },
  measuring: 'Measuring all frames',
  union: {
    measuring: 'Measuring…',
    area: (area: string) => `Area ${area}`,
    volume: (volume: string) => `Volume ${volume}`,
    cavities: (count: number, volume: string, components: number) =>
      `${count === 0 ? 'No cavities' : `${count} ${count === 1 ? 'cavity' : 'cavities'} of ${volume}`}; ${components === 1 ? 'in one piece' : `in ${components} pieces`}`,
    undecided: 'Cavities could not be told apart in this arrangement.',
    of: (spheres: string) => `Of ${spheres} spheres, with their radii as read.`,
  },
  starting: 'Starting',
  drawing: 'Drawing',
  loading: (name: string) => `Loading ${name}`,
  fetching: (name: string) => `Fetching ${name}`,
  dismiss: 'Dismiss',
  no_picture: 'No picture',
  saving: {
    drawing: 'Drawing the picture',
    cancelled: 'The picture was cancelled.',
    copied: 'The picture is copied.',
    not_copied: (why: string) => `The picture could not be copied: ${why}. Save it instead.`,
    sizes: {
      screen: 'as on the screen', twice: '2 × the screen', four_times: '4 × the screen', slide: 'slide', square: 'square',
      one_column: 'one column, 8.5 cm at 300 dpi', two_columns: 'two columns, 17.8 cm at 300 dpi', other: 'other',
    },
  },
  scene: {
    spheres: (count: string, one: boolean) => `${count} ${one ? 'sphere' : 'spheres'}`,
    atoms: (count: string, one: boolean) => `${count} ${one ? 'atom' : 'atoms'}`,
    frames: (count: string) => `${count} frames`,
  },
  player: { play: 'Play', pause: 'Pause', at: (frame: string, last: string) => `frame ${frame} of 0 to ${last}` },
  pins: {
    measures: ['', '', 'Distance', 'Angle', 'Dihedral'] as string[], // by their number
    of_nearest_images: ', of nearest images',
    pinned: (what: string) => `Pinned: ${what}`,
    no_longer: (what: string) => `No longer pinned: ${what}`,
  },
  whose: { style: 'the style’s', file: 'the file’s', lines_of_style: 'the style’s lines', lines_of_file: 'the file’s lines' },
  none: 'none',
  kept: {
    nothing: 'This browser keeps nothing for the page: a reload begins anew.',
    forgotten: 'Nothing is kept any more: a reload begins anew.',
    too_large: (name: string, size: string, most: string) => `${name} is too large to be kept for a reload: ${size}, of ${most} at most.`,
    changes: 'A reload brings back your changes: they are kept in this browser for a day.',
    file_and_changes: (name: string) => `A reload brings back ${name} and your changes: they are kept in this browser for a day.`,
  },
  ask: {
    made_for: (file: string) => `This link was made for your file ${file}. It is not in the link: open it to see it as it was.`,
    open: (file: string) => `Open ${file}…`,
    other: (name: string, file: string) => `${name} is open. The link was made for ${file}, which it still waits for.`,
  },
  link: {
    asks_for: (file: string) => `It asks for the file ${file}, which is not in it.`,
    copied: 'The link is copied.',
    in_address: 'The link is in the address bar: this browser does not let the page copy it.',
    share: 'Share link',
  },
  page_saved: (megabytes: string) => `The page has ${megabytes} MB. It opens by itself, without a network, on a phone too.`,
  several_files: (name: string) => `Several files were chosen; this is ${name}.`,
  engine: {
    software: 'WebGL2 is drawn by software here: the CPU engine is faster.',
    missing: 'This browser gives the page no WebGL2, so the GPU engine cannot be chosen: the CPU engine draws.',
  },
  about: (version: string, threads: number, requests: boolean) =>
    `bihive ${version}, ${threads === 1 ? 'one thread' : `${threads} threads`}. ${requests ? "No request leaves this page's server" : 'This page makes no requests'}.`,
  lacking: (what: string, browsers: string) => `This browser has no ${what}, so the page cannot draw. ${browsers} and newer ones have it.`,
  row_waits: (value: string, example: string) => `It waits for ${value}: ${example}`,
  ray_path: {
    tree: (name: string) => (name === 'bih' ? 'reference' : name),
    work: (nodes: string, box_tests: string, sphere_tests: string) => `nodes ${nodes} · boxes ${box_tests} · spheres ${sphere_tests}`,
    hit: (sphere: number, t: string) => `hits sphere ${sphere} at ${t}`,
    no_hit: 'hits nothing',
    without_spheres: (nodes: string) => `nodes without spheres: ${nodes}`,
    more: (count: string) => `and ${count} more`,
    nearest: (t: string) => `nearest hit so far at ${t}`,
    none_yet: 'no hit yet',
  },
  thesis: {
    run: 'Run', go_on: 'Continue', cancelling: 'Cancelling', wide_engine: 'wide engine', turning: 'turning', at_rest: 'at rest',
    scene: (scenario: number, spheres: number) => `Scenario ${scenario}, ${spheres} spheres`,
    rates: (scene: string) => `${scene}, fps: `,
    brute_force: (fps: string) => `BF ${fps}`,
    seconds_left: (seconds: number) => `about ${seconds} s left`,
    minutes_left: (minutes: number) => `about ${minutes} min left`,
    progress: (done: number, all: number, left: string, scene: string) => `${done} of ${all} configurations, ${left}: ${scene}`,
    pictures: (width: number, height: number) => `pictures of ${width} × ${height}`,
    measured: (pictures: string) => `All configurations are measured, ${pictures}.`,
    cancelled: (text: string) => `Cancelled: ${text}`,
    cancelled_partly: 'Cancelled; what was complete is below.',
    cancelled_before: 'Cancelled before a configuration was complete.',
    shown: (count: number, least: string, most: string) => `${count} measurements, ${least} to ${most} frames shown per second.`,
    here: (costs: string) => `Here ${costs}`,
    costs: english_costs,
    heading: (engine: string, pictures: string) => `bihive: Figure 4.4 by the ${engine} engine, ${pictures}`,
    drift: (percent: string) => `Last round over first: ${percent} % time`,
  },
  undo: {
    undo: 'Undo', redo: 'Redo',
    undone: (what: string) => `Undone: ${what}`, redone: (what: string) => `Redone: ${what}`,
    nothing_to_undo: 'Nothing to undo', nothing_to_redo: 'Nothing to redo',
    more: ' and more',
    members: {
      reading: 'how the file is read', replicate: 'copies', focus_on: 'focus', element_colours: 'colours of elements', colour_by: 'colours',
      nan_colour: 'colour of unknown numbers', crease: 'lines between', floor: 'floor', floor_up: 'floor', rows: 'looks of selections',
      'rows.clip': 'cut', 'rows.hide': 'what is hidden', 'rows.colour': 'colours of selections',
    } as Record<string, string>,
  },
  heights: { whole: 'Whole window', half: 'Half the window' },
};
