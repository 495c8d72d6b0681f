// What a reload of the page brings back: the user's file, the state, and its history. They are in the browser's database,
// under the name of the tab, for a day at most.
import { element } from './dom';
import type { Past } from './history';
import { has_state } from './link';
import type { Source } from './protocol';
import type { OwnFiles } from './sources';
import { words } from './words';

const longest_ms = 24 * 3600 * 1000;
const most_bytes = 256e6; // of files; larger ones are not copied
const after_ms = 400; // of rest

interface KeptState {
  tab: string;
  when: number;
  /** Of the page, and the text of its first input: another one begins anew. */
  address: string;
  start: string;
  source: Source;
  past: Past;
  pins: number[]; // spheres by their ids
}

interface KeptFiles {
  tab: string;
  own: OwnFiles;
}

export interface Kept {
  source: Source;
  past: Past;
  pins: number[];
  own: OwnFiles | null;
}

const done = <T>(request: IDBRequest<T>) =>
  new Promise<T>((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error as Error);
  });

function opened(): Promise<IDBDatabase> {
  const request = indexedDB.open('bihive', 1);
  request.onupgradeneeded = () => {
    for (const name of ['states', 'files']) request.result.createObjectStore(name, { keyPath: 'tab' });
  };
  return done(request);
}

// The tab's own name. A tab that the browser duplicated begins with the other one's state, and then has its own.
const name_key = 'bihive tab';
const new_name = () => `${Date.now()}-${Math.random()}`;

async function name_of_tab(before: string | null): Promise<string> {
  const mine = before ?? new_name();
  const { locks } = navigator as { locks?: LockManager }; // only where the page is secure
  const is_free = await new Promise<boolean>((resolve) => {
    if (!locks) return resolve(true);
    const hold = (lock: Lock | null) => {
      resolve(lock !== null);
      return lock ? new Promise<void>(() => {}) : undefined;
    };
    void locks.request(`${name_key} ${mine}`, { ifAvailable: true }, hold);
  });
  const name = is_free ? mine : new_name();
  sessionStorage.setItem(name_key, name);
  return name;
}

const size_of = (own: OwnFiles | null) => (own?.file.size ?? 0) + (own?.trajectory?.size ?? 0);
const megabytes = (bytes: number) => `${Math.ceil(bytes / 1e6).toLocaleString('en')} MB`;

export class Keeper {
  private base: IDBDatabase | null = null; // null: nothing is kept
  private tab = '';
  private start = '';
  private source: Source | null = null;
  private own: OwnFiles | null = null;
  private past: Past | null = null;
  private pins: number[] = [];
  private opened = false; // whether there is a database is known
  private forgotten = false; // by the user, until another scene is opened
  private timer = 0;
  private last: Promise<unknown> = Promise.resolve(); // the last work on the database

  /** `forget_more`: what else the page keeps. */
  constructor(private readonly forget_more: () => Promise<void>) {
    element('forget').addEventListener('click', () => void this.forget());
  }

  /** Opens the database, and returns what the tab showed before it was loaded again; null: nothing of this address and
   * with this first input. */
  async open(start: string): Promise<Kept | null> {
    this.start = start;
    try {
      const before = sessionStorage.getItem(name_key);
      const base = await opened();
      this.tab = await name_of_tab(before);
      await this.drop_old(base);
      this.base = base;
      this.opened = true;
      return before === null ? null : await this.read(before);
    } catch {
      this.opened = true;
      return null; // A private window, or no room: the page works without it.
    }
  }

  /** The scene that is shown now, and the user's files that it came from. */
  show(source: Source, own: OwnFiles | null): void {
    this.source = source;
    this.past = null;
    if (own !== null && own === this.own) return; // read anew
    this.own = own;
    this.forgotten = false;
    this.work(async (base) => {
      const files = base.transaction('files', 'readwrite').objectStore('files');
      if (own && this.fits) await done(files.put({ tab: this.tab, own } satisfies KeptFiles));
      else await done(files.delete(this.tab));
    });
  }

  keep(past: Past): void {
    this.past = past;
    this.write_soon();
    this.say();
  }

  keep_pins(spheres: number[]): void {
    this.pins = spheres;
    this.write_soon();
  }

  private write_soon(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.write(), after_ms);
  }

  private get fits(): boolean {
    return size_of(this.own) <= most_bytes;
  }

  private async read(tab: string): Promise<Kept | null> {
    const stores = this.base!.transaction(['states', 'files']);
    const [record, files] = await Promise.all([
      done<KeptState | undefined>(stores.objectStore('states').get(tab)),
      done<KeptFiles | undefined>(stores.objectStore('files').get(tab)),
    ]);
    if (!record || record.address !== location.href) return null;
    // A link that was copied is in the address, and comes before the first input.
    if (!has_state(location.hash) && record.start !== this.start) return null;
    if ('file' in record.source && !files) return null;
    return { source: record.source, past: record.past, pins: record.pins ?? [], own: 'file' in record.source ? files!.own : null };
  }

  private async drop_old(base: IDBDatabase): Promise<void> {
    const stores = base.transaction(['states', 'files'], 'readwrite');
    const [states, files] = [stores.objectStore('states'), stores.objectStore('files')];
    const young = new Set<IDBValidKey>();
    for (const { tab, when } of await done<KeptState[]>(states.getAll()))
      if (Date.now() - when < longest_ms) young.add(tab);
      else states.delete(tab);
    for (const tab of await done(files.getAllKeys())) if (!young.has(tab)) files.delete(tab);
  }

  // One after another, so that a file is not written after it was forgotten.
  private work(what: (base: IDBDatabase) => Promise<void>): void {
    const { base } = this;
    if (!base) return;
    this.last = this.last.then(() => what(base)).catch(() => {
      this.base = null;
      this.say();
    });
  }

  private write(): void {
    const { source, past, start, tab } = this;
    if (!source || !past || this.forgotten || !this.fits) return;
    const record: KeptState = { tab, when: Date.now(), address: location.href, start, source, past, pins: this.pins };
    this.work(async (base) => void (await done(base.transaction('states', 'readwrite').objectStore('states').put(record))));
  }

  private async forget(): Promise<void> {
    this.forgotten = true;
    clearTimeout(this.timer);
    // What other tabs keep goes too.
    this.work(async (base) => {
      const stores = base.transaction(['states', 'files'], 'readwrite');
      await Promise.all(['states', 'files'].map((name) => done(stores.objectStore(name).clear())));
    });
    await Promise.all([this.last, this.forget_more()]);
    this.say();
    element('kept').focus(); // the button is gone
  }

  private say(): void {
    if (!this.opened) return;
    const name = this.own?.file.name;
    element('forget').hidden = !this.base || this.forgotten;
    element('kept').textContent = !this.base
      ? words.kept.nothing
      : this.forgotten
        ? words.kept.forgotten
        : !this.fits
          ? words.kept.too_large(name ?? '', megabytes(size_of(this.own)), megabytes(most_bytes))
          : name ? words.kept.file_and_changes(name) : words.kept.changes;
  }
}
