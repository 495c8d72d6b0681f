// The states that a scene has been in, for undo and redo.
import type { Look, LookRow, Reading, Settings } from './protocol';

/** All that the user can change, but for the scene itself. */
export interface Snapshot {
  reading: Reading | null;
  settings: Settings;
  look: Look;
  framed: boolean; // the camera was not moved since it showed the whole scene, or was the scene's own
}

/** As it is kept for a reload. */
export interface Past {
  states: Snapshot[];
  at: number; // the one that is shown
}

const most_states = 200;
const one_change_ms = 1000; // changes of the same things in a shorter time are one

const same = (a: unknown, b: unknown) => JSON.stringify(a) === JSON.stringify(b);

// Members of these that differ. `set` follows from the others.
const differing = (a: object, b: object) =>
  Object.keys({ ...a, ...b }).filter((key) => key !== 'set' && !same((a as never)[key], (b as never)[key]));

// "rows.clip" where no other action's rows differ.
function rows_member(a: LookRow[], b: LookRow[]): string {
  const actions = new Set([...a, ...b].map(({ action }) => action));
  const differ = [...actions].filter((one) => !same(a.filter(({ action }) => action === one), b.filter(({ action }) => action === one)));
  return differ.length === 1 ? `rows.${differ[0]}` : 'rows';
}

/** What differs between two states, by the names of its members: of the most telling kind alone, since another file's
 * reading changes the look, and another style changes settings. */
export function changed_members(a: Snapshot, b: Snapshot): string[] {
  if (!same(a.reading, b.reading)) return ['reading'];
  const looks = differing(a.look, b.look).map((member) => (member === 'rows' ? rows_member(a.look.rows, b.look.rows) : member));
  return looks.length > 0 ? looks : differing(a.settings, b.settings);
}

export class History {
  private states: Snapshot[] = [];
  private at = -1;
  private last_change = ''; // what the newest change was of
  private last_ms = -Infinity;

  begin(state: Snapshot): void {
    this.resume({ states: [state], at: 0 });
  }

  resume({ states, at }: Past): void {
    this.states = [...states];
    this.at = at;
    this.last_ms = -Infinity;
  }

  get past(): Past {
    return { states: this.states, at: this.at };
  }

  /** The state that is shown now. One that the user did not make takes the place of the last. */
  note(state: Snapshot, by_user: boolean, now_ms: number): void {
    const last = this.states[this.at];
    if (!last) return this.begin(state);
    const members = changed_members(last, state);
    if (members.length === 0) return;
    const change = members.join();
    const goes_on = change === this.last_change && now_ms - this.last_ms < one_change_ms && this.at > 0;
    if (by_user && !goes_on) {
      this.states = [...this.states.slice(0, this.at + 1), state].slice(-most_states);
      this.at = this.states.length - 1;
    } else this.states[this.at] = state;
    if (!by_user) return;
    this.last_change = change;
    this.last_ms = now_ms;
  }

  /** What undo (-1) or redo (1) would change; null: there is nothing. */
  next(by: -1 | 1): string[] | null {
    const [now, other] = [this.states[this.at], this.states[this.at + by]];
    return now && other ? changed_members(now, other) : null;
  }

  /** Goes one back (-1) or on (1), and returns the state there. */
  go(by: -1 | 1): Snapshot | null {
    const state = this.states[this.at + by];
    if (!state) return null;
    this.at += by;
    this.last_ms = -Infinity;
    return state;
  }
}
