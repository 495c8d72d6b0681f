// The sources of scenes: built-in names, files that are picked or dropped, addresses on this server.
import { add_options, element } from './dom';
import { busy } from './messages';
import type { BuiltIn, Choices, Files, Reading, Source } from './protocol';
import { words } from './words';

/** A scene to load, and its files unless it is built in. */
export interface Wanted {
  source: Source;
  files: Files | null;
}

/** Fetches an address of this origin. Throws a message for the user. */
async function fetched(source: Source & { url: string }): Promise<Wanted> {
  const { url } = source;
  let address: URL;
  try {
    address = new URL(url, document.baseURI);
  } catch {
    throw new Error(`"${url}" is not an address`);
  }
  if (address.origin !== location.origin)
    throw new Error(`${address.origin} is another server: this page only loads files of its own (${location.origin})`);
  const name = decodeURIComponent(address.pathname.split('/').pop() || address.pathname);
  const response = await fetch(address).catch(() => {
    throw new Error(`${name} could not be fetched: the server ${address.origin} cannot be reached`);
  });
  if (!response.ok) throw new Error(`${address.href}: the server answered ${response.status} ${response.statusText}`);
  return { source, files: { name, content: new Blob([await with_progress(response, name)]), trajectory: null } };
}

async function with_progress(response: Response, name: string): Promise<ArrayBuffer> {
  // An unpacked answer is longer than its Content-Length.
  const length = response.headers.get('Content-Encoding') ? 0 : Number(response.headers.get('Content-Length') ?? 0);
  if (!response.body || length === 0) return response.arrayBuffer();
  const bytes = new Uint8Array(length);
  let at = 0;
  const reader = response.body.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return at === length ? bytes.buffer : bytes.slice(0, at).buffer;
    if (at + value.byteLength > length) throw new Error(`${name}: the server sends more than it announced`);
    bytes.set(value, at);
    at += value.byteLength;
    busy(words.fetching(name), at / length);
  }
}

/** A source with these reading options. */
export function with_reading(source: Source, reading: Reading | undefined): Source {
  const { reading: _, ...place } = source;
  return reading ? { ...place, reading } : place;
}

export async function wanted_source(source: Source): Promise<Wanted> {
  if ('built_in' in source) return { source, files: null };
  if ('url' in source) return fetched(source);
  throw new Error(`The file ${source.file} must be opened`);
}

/** A file of the user's own, and the coordinates of its other frames. */
export interface OwnFiles {
  file: File;
  trajectory: File | null;
}

export async function wanted_files({ file, trajectory }: OwnFiles, reading?: Reading): Promise<Wanted> {
  const place = trajectory ? { file: file.name, trajectory: trajectory.name } : { file: file.name };
  const moves = trajectory && { name: trajectory.name, content: trajectory };
  return { source: with_reading(place, reading), files: { name: file.name, content: file, trajectory: moves } };
}

/** By the ending: a trajectory of coordinates alone, which needs the file of the spheres. */
export const is_trajectory = ({ name }: File): boolean => /\.(dcd|xtc|trr)$/i.test(name);

let built_ins: BuiltIn[] = [];

/** What the parameters of a source change. */
export const kind_of = (source: Source): BuiltIn['kind'] =>
  'built_in' in source ? (built_ins.find(({ name }) => name === source.built_in)?.kind ?? 'fixed') : 'file';

/** The library's names. */
export function build_sources(choices: Choices): void {
  built_ins = choices.built_ins;
  add_options(element('built_in'), built_ins);
}

/** Calls `open` with files picked or dropped anywhere, and with sources chosen in the panel. */
export function listen_for_sources(open_source: (source: Source) => void, open_files: (files: File[]) => void): void {
  const built_in = element<HTMLSelectElement>('built_in');
  const count = element<HTMLInputElement>('count');
  const choose = () => {
    const scenario = kind_of({ built_in: built_in.value }) === 'scenario';
    element('count_row').hidden = !scenario;
    if (scenario && !count.reportValidity()) return;
    open_source(scenario ? { built_in: built_in.value, count: Number(count.value) } : { built_in: built_in.value });
  };
  built_in.addEventListener('change', choose);
  count.addEventListener('change', choose);

  const file = element<HTMLInputElement>('file');
  file.addEventListener('change', () => {
    const picked = [...(file.files ?? [])];
    file.value = ''; // so that the same file may be picked again
    if (picked.length > 0) open_files(picked);
  });

  element<HTMLFormElement>('url_form').addEventListener('submit', (event) => {
    event.preventDefault();
    const url = element<HTMLInputElement>('url').value.trim();
    if (url !== '') open_source({ url });
  });

  const hint = element('drop_hint');
  addEventListener('dragover', (event) => {
    event.preventDefault();
    hint.hidden = false;
  });
  addEventListener('dragleave', (event) => {
    if (!event.relatedTarget) hint.hidden = true;
  });
  addEventListener('drop', (event) => {
    event.preventDefault();
    hint.hidden = true;
    const dropped = [...(event.dataTransfer?.files ?? [])];
    if (dropped.length > 0) open_files(dropped);
  });
}

/** Shows in the panel where the scene came from. */
export function show_source(source: Source): void {
  element<HTMLSelectElement>('built_in').value = 'built_in' in source ? source.built_in : '';
  element('count_row').hidden = kind_of(source) !== 'scenario';
  if ('built_in' in source && source.count) element<HTMLInputElement>('count').value = String(source.count);
}
