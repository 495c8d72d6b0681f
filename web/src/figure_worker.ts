// The worker for figures, one for each: draws a picture of bihive again as its record says, and compares the bits. A worker
// and a module of its own, so that the scene on the page goes on, and that a cancel is the worker's end.
import type { FigureAnswer, FigureRequest, NamedBlob } from './figure_protocol';
import { unpacked } from './gunzip';
import { BadInput, load_figure_module, value_of, type FigureModule } from './module';
import { read_png } from './png_file';

interface Recorded {
  drawn_by: string;
  scene: string;
  is_film: boolean;
  files: { option: string; name: string; sha256: string }[];
}

const send = (answer: FigureAnswer) => postMessage(answer);

const listed = (names: string[]) =>
  names.length < 2 ? (names[0] ?? '') : `${names.slice(0, -1).join(', ')} and ${names[names.length - 1]!}`;

// The name of a file on the disk: the record's may say a place inside it.
const on_disk = (name: string) => name.replace(/:\/.*/s, '');

const hash_folder = '/candidates';

// The SHA-256 of files, by Emscripten's file system: the browser's own needs an encrypted connection.
function hashes_of(module: FigureModule, files: NamedBlob[]): string[] {
  const blobs = files.map(({ content }, i) => ({ name: String(i), data: content }));
  module.FS.mkdir(hash_folder);
  module.FS.mount(module.FS.filesystems.WORKERFS, { blobs }, hash_folder);
  const hashes = blobs.map(({ name }) => value_of<{ sha256: string }>(module.sha256_at(`${hash_folder}/${name}`)).sha256);
  module.FS.unmount(hash_folder);
  return hashes;
}

// Puts the recorded files, found among `inputs` by their bytes, where the module looks for them. Returns whether all are
// there; those that are not are told.
async function mount_inputs(module: FigureModule, { files }: Recorded, inputs: NamedBlob[]): Promise<boolean> {
  if (files.length === 0) return true;
  const all = [...inputs, { name: '1hpv.pdb', content: new Blob([new Uint8Array(module.bundled())]) }];
  const hashes = hashes_of(module, all);
  const found = files.map(({ sha256 }) => all[hashes.indexOf(sha256)]);
  const missing = files.filter((_, i) => !found[i]).map(({ name }) => on_disk(name));
  if (missing.length > 0) {
    const others = missing.filter((name) => inputs.some((input) => input.name === name));
    send({ type: 'missing', names: listed(missing), other_bytes: listed(others) });
    return false;
  }
  const blobs = new Map<string, Blob>();
  for (const [i, { name }] of files.entries()) blobs.set(on_disk(name), await unpacked(found[i]!.content, name));
  if (new Set(files.map(({ name, sha256 }) => on_disk(name) + sha256)).size > blobs.size)
    throw new BadInput('was drawn from two files of the same name in different folders: bihive verify compares it');
  const folder = module.Figure.folder().replace(/\/$/, '');
  module.FS.mkdir(folder);
  const mounted = [...blobs].map(([name, data]) => ({ name, data }));
  module.FS.mount(module.FS.filesystems.WORKERFS, { blobs: mounted }, folder);
  return true;
}

async function verify({ base, threads, figure, inputs }: FigureRequest): Promise<void> {
  const png = await read_png(figure.content);
  if (png.record === '') throw new BadInput('holds no record of how it was drawn. It is a picture: atoms and points are read from files such as PDB, XYZ or CSV');
  const module = await load_figure_module(base, threads);
  const check = new module.Figure();
  const record = value_of<Recorded>(check.open(figure.name, png.record));
  if (record.is_film) throw new BadInput('is a film: bihive verify compares its pictures');
  const from = record.scene || listed(record.files.map(({ name }) => name));
  if (from === '') throw new BadInput(`was drawn by bihive ${record.drawn_by} from spheres that came from no file`);
  send({ type: 'record', drawn_by: record.drawn_by, from });
  if (!(await mount_inputs(module, record, inputs))) return;
  const pixels = await png.pixels();
  value_of(check.draw((done: number) => send({ type: 'progress', done })));
  const { width, height, channels, bits } = png;
  send({ type: 'verdict', ...value_of<{ holds: boolean; words: string }>(check.compare(width, height, channels, bits, pixels)) });
}

addEventListener('message', async (event: MessageEvent<FigureRequest>) => {
  try {
    await verify(event.data);
  } catch (error) {
    if (!(error instanceof BadInput)) console.warn(error);
    send({ type: 'failed', message: error instanceof Error ? error.message : String(error) });
  }
});
