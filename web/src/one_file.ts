// The page as one file, with engine and data inside, which opens without a server: scripts/build_one_file makes it empty,
// `bihive web --html` and "Save as page" put data into it.
import { unpacked_lzma } from './lzma';
import { state_from, document_of, type State } from './link';
import type { OwnFiles } from './sources';

// Elements of the file: what is packed by scripts/build_one_file, and places for the data. As apps/cli/commands/one_file.cpp has them.
const engine_ids = { script: 'packed_worker', module: 'packed_module' } as const;
const data_ids = { state: 'page_state', file: 'page_file', trajectory: 'page_trajectory' } as const;
const empty_place = (id: string) => `<script id="${id}" type="text/plain"></script>`;

const here = (id: string) => document.getElementById(id);

export const is_one_file = here(engine_ids.module) !== null;

function bytes_of(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function base64_of(content: Blob): Promise<string> {
  const address = await new Promise<string>((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(reader.result as string);
    reader.onerror = () => reject(new Error('the file cannot be read: it may have been changed or moved since it was chosen'));
    reader.readAsDataURL(content);
  });
  return address.slice(address.indexOf(',') + 1);
}

const through = (content: Blob, stream: CompressionStream | DecompressionStream) => new Response(content.stream().pipeThrough(stream)).blob();

// What the file holds, before anything of the page changes: the data goes, so that the rest serves for the next page.
interface Data {
  text: string; // base64
  name: string;
  is_packed: boolean;
}

function taken(id: string, page: Document): Data | null {
  const place = page.getElementById(id);
  const text = place?.textContent ?? '';
  if (!place || text === '') return null;
  const { name = '', packing = '' } = place.dataset;
  place.textContent = '';
  for (const key of Object.keys(place.dataset)) delete place.dataset[key];
  return { text, name, is_packed: packing === 'gzip' };
}

interface DataOfPage {
  state: Data | null;
  file: Data | null;
  trajectory: Data | null;
}

const all_taken = (page: Document): DataOfPage => ({
  state: taken(data_ids.state, page), file: taken(data_ids.file, page), trajectory: taken(data_ids.trajectory, page),
});
const data = is_one_file ? all_taken(document) : null;
const own_text = is_one_file ? `<!doctype html>\n${document.documentElement.outerHTML}\n` : '';

async function file_of({ text, name, is_packed }: Data): Promise<File> {
  const content = new Blob([bytes_of(text)]);
  return new File([is_packed ? await through(content, new DecompressionStream('gzip')) : content], name);
}

/** A state, and the files that it needs. */
export interface Inside {
  state: State;
  own: OwnFiles | null;
}

async function inside_of(data: DataOfPage): Promise<Inside | null> {
  if (!data.state) return null;
  const state = state_from(document_of(await (await file_of(data.state)).text()));
  if (!state) throw new Error('This page is damaged: it does not hold a scene');
  if (!('file' in state.source)) return { state, own: null };
  if (!data.file) throw new Error(`This page is damaged: it does not hold ${state.source.file}`);
  const trajectory = data.trajectory && (await file_of(data.trajectory));
  const own = { file: await file_of(data.file), trajectory };
  data.file = data.trajectory = null; // they are large
  return { state, own };
}

/** What this file shows first. */
export const data_inside = async (): Promise<Inside | null> => data && inside_of(data);

/** What another page that is one file shows first; null: it holds no data, or is another kind of page. */
export async function data_of_page(file: File): Promise<Inside | null> {
  const text = await file.text();
  if (!text.includes(`<script id="${engine_ids.module}"`)) return null;
  // The data alone: the browser would complain of styles, which the policy of this page does not allow that one.
  const places = Object.values(data_ids).map((id) => new RegExp(`<script id="${id}"[^>]*>[^<]*</script>`).exec(text)?.[0] ?? '');
  return inside_of(all_taken(new DOMParser().parseFromString(places.join('\n'), 'text/html')));
}

export const is_page = ({ name }: File): boolean => /\.html?$/i.test(name);

/** The worker of this file, and the module, which the worker unpacks. */
export const worker_inside = (): Worker =>
  new Worker(URL.createObjectURL(new Blob([unpacked_lzma(bytes_of(here(engine_ids.script)!.textContent!))], { type: 'text/javascript' })), { name: 'bihive' });

export const packed_module = (): Uint8Array<ArrayBuffer> | null => (is_one_file ? bytes_of(here(engine_ids.module)!.textContent!) : null);

async function empty_page(): Promise<string> {
  if (is_one_file) return own_text;
  const response = await fetch(new URL('one_file.html', document.baseURI)).catch(() => {
    throw new Error('The page could not be saved: its server cannot be reached');
  });
  if (!response.ok) throw new Error('The page could not be saved: it was built without one_file.html, which scripts/build_web makes');
  return response.text();
}

export const escaped = (text: string) => text.replace(/[&<>"]/g, (one) => `&#${one.charCodeAt(0)};`);

async function filled(id: string, content: Blob, name: string): Promise<string> {
  const packed = await through(content, new CompressionStream('gzip'));
  const is_smaller = packed.size < content.size;
  const text = await base64_of(is_smaller ? packed : content);
  return `<script id="${id}" type="text/plain" data-name="${escaped(name)}"${is_smaller ? ' data-packing="gzip"' : ''}>${text}</script>`;
}

/** A page with this state and these files. */
export async function page_with(state: State, files: { name: string; content: Blob }[]): Promise<Blob> {
  const page = await empty_page();
  const places = [empty_place(data_ids.state), empty_place(data_ids.file), empty_place(data_ids.trajectory)] as const;
  const at = page.indexOf(places.join('\n'));
  if (at < 0) throw new Error('The page could not be saved: one_file.html is of another version');
  const parts = [await filled(data_ids.state, new Blob([JSON.stringify(state)]), '')];
  const [file, trajectory] = files;
  parts.push(file ? await filled(data_ids.file, file.content, file.name) : places[1]);
  parts.push(trajectory ? await filled(data_ids.trajectory, trajectory.content, trajectory.name) : places[2]);
  const after = page.slice(at + places.join('\n').length);
  return new Blob([page.slice(0, at), parts.join('\n'), after], { type: 'text/html' });
}
