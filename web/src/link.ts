// The whole state as a link: scene and settings in the address after "#".
import type { Changes, Look, Reading, Source } from './protocol';
import { reading_ids } from './settings';

export interface State {
  source: Source;
  settings: Changes | null;
  look: Partial<Look> | null;
}

const prefix = '#state=';

export function link_of(state: State): string {
  const bytes = new TextEncoder().encode(JSON.stringify(state));
  let binary = '';
  for (const byte of bytes) binary += String.fromCharCode(byte);
  const text = btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
  const link = new URL(prefix + text, location.href);
  link.searchParams.delete('embed'); // for a page of its own
  return link.href;
}

// The largest radius that the library holds; a factor needs no more.
const largest_radius = 3.4028234663852886e38;

const radii: string[] = ['radius', 'radius_scale'];

const is_radius = (number: unknown): number is number => typeof number === 'number' && number >= 0 && number <= largest_radius;

function is_reading(value: unknown): value is Reading {
  if (typeof value !== 'object' || value === null) return false;
  return Object.entries(value).every(
    ([key, one]) => (reading_ids as readonly string[]).includes(key) && (radii.includes(key) ? is_radius(one) : typeof one === 'string' || Number.isFinite(one)),
  );
}

function is_source(value: unknown): value is Source {
  if (typeof value !== 'object' || value === null) return false;
  const source = value as Record<string, unknown>;
  if (source['reading'] !== undefined && !is_reading(source['reading'])) return false;
  if (typeof source['file'] === 'string') return true;
  if (typeof source['built_in'] === 'string') {
    const { count } = source;
    return count === undefined || (Number.isSafeInteger(count) && (count as number) >= 1);
  }
  return typeof source['url'] === 'string';
}

// The depth that the library reads (base/json_text.h). Beyond the browser's own, copies of a document would throw.
const most_depth = 64;

const is_deep = (value: unknown, left: number): boolean =>
  typeof value === 'object' && value !== null && (left === 0 || Object.values(value).some((one) => is_deep(one, left - 1)));

/** The document in a text of JSON; null if it is none. */
export function document_of(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}

/** A state from a document; null if it is not one. The module checks settings and look. */
export function state_from(document: unknown): State | null {
  if (typeof document !== 'object' || document === null || is_deep(document, most_depth)) return null;
  const { source, settings, look } = document as Record<string, unknown>;
  if (!is_source(source)) return null;
  return {
    source,
    settings: typeof settings === 'object' ? (settings as Changes | null) : null,
    look: typeof look === 'object' ? (look as Partial<Look> | null) : null,
  };
}

export const has_state = (hash: string): boolean => hash.startsWith(prefix);

/** The state in an address; null if it has none; throws if it is damaged. */
export function state_of(hash: string): State | null {
  if (!has_state(hash)) return null;
  try {
    const binary = atob(hash.slice(prefix.length).replaceAll('-', '+').replaceAll('_', '/'));
    const state = state_from(
      JSON.parse(new TextDecoder().decode(Uint8Array.from(binary, (character) => character.charCodeAt(0)))),
    );
    if (state) return state;
  } catch {
    // reported below
  }
  throw new Error('The link is damaged: it does not hold a scene');
}

/** The reading options of an address: `?radius=0.5&frame=3&columns=x=px,y=py,z=pz`. Throws a message for the user. */
export function reading_of(search: string): Reading | undefined {
  const asked = new URLSearchParams(search);
  const reading: Reading = {};
  for (const key of reading_ids) {
    const text = asked.get(key);
    if (text === null) continue;
    if (!radii.includes(key)) reading[key] = text;
    else if (text.trim() !== '' && is_radius(Number(text))) reading[key] = Number(text);
    else throw new Error(`${key}=${text} in the address: expected a number from 0 to ${largest_radius}`);
  }
  return Object.keys(reading).length > 0 ? reading : undefined;
}
