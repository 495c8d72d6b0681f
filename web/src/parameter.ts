// A row of the library's table of a picture's parameters (src/bihive/settings/), as Page::choices() gives it.
import { words } from './words';
import type { Settings } from './protocol';
import type { PictureSettings } from './settings';

export type Id = keyof PictureSettings;
export type Value = PictureSettings[Id];

export interface Parameter {
  id: Id;
  kind: 'flag' | 'whole' | 'number' | 'choice' | 'text' | 'colour';
  least?: number;
  most?: number;
  above_least?: boolean; // least itself is out of range
  or_zero?: boolean; // 0 is in range, and means none
  names?: string[]; // of a choice
  default: Value;
  group: string;
  in_window?: boolean; // available in window and page
  cpu_only?: boolean;
  needs?: 'soft_light' | 'see_through' | 'orthographic';
  implies?: Id; // switched on by setting this one
  label?: string; // none: it has no control
  long_label?: string;
  place?: number; // in its group: lower ones first
  choice_labels?: string[];
  empty_means?: string;
  slider?: [least: number, most: number, step: number];
  unit?: string; // '%': of a share
  only_with?: Id; // without that one this one changes nothing
  replaced_by?: Id;
  note?: string; // why engine or camera cannot draw it
  help: string;
}

/** Whether engine or camera cannot draw it. */
export function is_beyond({ cpu_only, needs }: Parameter, { engine, camera }: Settings): boolean {
  return (cpu_only && engine === 'gpu') || (needs === 'orthographic' && camera.projection === 'perspective');
}

/** Whether changing it has no effect. A setting that the camera cannot draw can still be switched off. */
export function is_off(row: Parameter, rows: Parameter[], settings: Settings): boolean {
  const { implies, only_with, replaced_by } = row;
  if ((implies && !settings[implies]) || (only_with && !settings[only_with])) return true;
  const other = replaced_by && settings[replaced_by] ? rows.find(({ id }) => id === replaced_by) : undefined;
  if (other && !is_beyond(other, settings)) return true;
  return is_beyond(row, settings) && (row.cpu_only || row.kind !== 'flag' || !settings[row.id]);
}

/** Why it may be off for engine or camera; empty: both draw it always. */
export function note_of({ cpu_only, needs, note }: Parameter): string {
  if (cpu_only) return note ?? 'The CPU engine alone draws this';
  return needs === 'orthographic' ? (note ?? 'This needs the projection orthographic') : '';
}

/** A slider's number with its unit, and its sign if the slider has both. */
export function slider_words({ or_zero, unit, slider }: Parameter, value: number): string {
  if (or_zero && value === 0) return words.none;
  if (unit === '%') return `${Math.round(100 * value)} %`;
  const number = slider![0] < 0 && value > 0 ? `+${value}` : String(value);
  return unit ? `${number} ${unit}` : number;
}

export function is_in_range({ least = -Infinity, most = Infinity, above_least, or_zero }: Parameter, value: number): boolean {
  return (or_zero && value === 0) || ((above_least ? value > least : value >= least) && value <= most);
}
