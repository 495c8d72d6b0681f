// The sources of scenes: built-in names, files that are picked or dropped, addresses on this server.
import { element } from './dom';
import { busy } from './messages';
import type { Files, Reading, Source } from './protocol';

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
    busy(`Fetching ${name}`, at / length);
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

const reading_inputs = () =>
  (['radius', 'radius_scale', 'columns'] as const).map((id) => element<HTMLInputElement>(id)) as [
    radius: HTMLInputElement, scale: HTMLInputElement, columns: HTMLInputElement,
  ];

/** Calls `read` with the radii and columns that the panel asks for, and whether the columns are what has changed. */
export function listen_for_reading(read: (reading: Reading | undefined, columns_changed: boolean) => void): void {
  const [radius, scale, columns] = reading_inputs();
  for (const input of [radius, scale, columns])
    input.addEventListener('change', () => {
      if (!radius.reportValidity() || !scale.reportValidity()) return;
      const reading: Reading = {};
      if (radius.value !== '') reading.radius = Number(radius.value);
      if (scale.value !== '') reading.radius_scale = Number(scale.value);
      if (columns.value.trim() !== '') reading.columns = columns.value.trim();
      read(Object.keys(reading).length > 0 ? reading : undefined, input === columns);
    });
}

/** Calls `open` with files picked or dropped anywhere, and with sources chosen in the panel. */
export function listen_for_sources(open_source: (source: Source) => void, open_files: (files: File[]) => void): void {
  const built_in = element<HTMLSelectElement>('built_in');
  const count = element<HTMLInputElement>('count');
  const choose = () => {
    const scenario = built_in.value.startsWith('scenario');
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
  const name = 'built_in' in source ? source.built_in : '';
  element<HTMLSelectElement>('built_in').value = name;
  element('count_row').hidden = !name.startsWith('scenario');
  const [radius, scale, columns] = reading_inputs();
  radius.value = String(source.reading?.radius ?? '');
  scale.value = String(source.reading?.radius_scale ?? '');
  columns.value = String(source.reading?.columns ?? '');
  // The thesis's scenes have their own radii: scenarios take another one.
  radius.disabled = name === 'four-spheres';
  element('radius_scale_row').hidden = name !== '' && name !== 'demo';
  element('columns_row').hidden = element('columns_help').hidden = name !== '' && name !== 'demo';
  if ('built_in' in source && source.count) element<HTMLInputElement>('count').value = String(source.count);
}
