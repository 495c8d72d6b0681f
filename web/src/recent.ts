// The user's files that were opened before, in the browser's database, so that they can be opened again: listed under "Open"
// and below what the scene is.
import { element, made } from './dom';
import type { Reading } from './protocol';
import type { OwnFiles } from './sources';
import { words } from './words';

const most_files = 8;
const most_bytes = 64e6; // of a file with its trajectory; larger ones are not copied
const most_bytes_of_all = 256e6;
const longest_ms = 30 * 24 * 3600 * 1000;

interface RecentFile {
  key: string;
  when: number;
  title: string;
  own: OwnFiles;
  reading: Reading | null;
}

const done = <T>(request: IDBRequest<T>) =>
  new Promise<T>((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error as Error);
  });

function opened(): Promise<IDBDatabase> {
  const request = indexedDB.open('bihive recent', 1);
  request.onupgradeneeded = () => void request.result.createObjectStore('files', { keyPath: 'key' });
  return done(request);
}

const size_of = ({ file, trajectory }: OwnFiles) => file.size + (trajectory?.size ?? 0);
const key_of = ({ file, trajectory }: OwnFiles) =>
  [file, trajectory].map((one) => (one ? `${one.name} ${one.size} ${one.lastModified}` : '')).join('\n');
const name_of = ({ file, trajectory }: OwnFiles) => (trajectory ? `${file.name}, ${trajectory.name}` : file.name);
const readable_size = (bytes: number) => (bytes < 1e6 ? `${Math.ceil(bytes / 1e3)} kB` : `${(bytes / 1e6).toPrecision(3)} MB`);

export class RecentFiles {
  private readonly lists = [...document.querySelectorAll<HTMLElement>('.recent')];
  private files: RecentFile[] = []; // the newest first
  private shown = ''; // the key of the scene's own file
  private forgotten = ''; // a key: by the user, until another scene is opened
  private last: Promise<unknown>;
  private base: IDBDatabase | null = null; // null: nothing is kept

  constructor(private readonly open: (own: OwnFiles, reading: Reading | undefined) => void) {
    this.last = opened()
      .then(async (base) => {
        this.base = base;
        this.files = await done<RecentFile[]>(base.transaction('files').objectStore('files').getAll());
        this.files.sort((a, b) => b.when - a.when);
        await this.drop_old();
      })
      .catch(() => (this.base = null)) // A private window, or no room: the page works without it.
      .then(() => this.show());
  }

  /** The scene comes from these files; null: not from files of the user's. */
  add(own: OwnFiles | null, title: string, reading: Reading | undefined): void {
    const key = own ? key_of(own) : '';
    this.shown = key;
    if (key !== this.forgotten) this.forgotten = '';
    if (!own || key === this.forgotten || size_of(own) > most_bytes) return this.show();
    const file: RecentFile = { key, when: Date.now(), title, own, reading: reading ?? null };
    this.work(async (base) => {
      this.files = [file, ...this.files.filter((one) => one.key !== key)];
      await done(base.transaction('files', 'readwrite').objectStore('files').put(file));
      await this.drop_old();
    });
  }

  async forget_all(): Promise<void> {
    this.forgotten = this.shown;
    this.work(async (base) => {
      this.files = [];
      await done(base.transaction('files', 'readwrite').objectStore('files').clear());
    });
    await this.last;
  }

  private forget(key: string): void {
    this.work(async () => this.drop((one) => one.key === key));
  }

  // One after another; what fails is not kept.
  private work(what: (base: IDBDatabase) => Promise<void>): void {
    this.last = this.last
      .then(() => this.base && what(this.base))
      .catch(() => (this.base = null))
      .then(() => this.show());
  }

  private async drop_old(): Promise<void> {
    let bytes = 0;
    const dropped = new Set<string>();
    for (const [place, { key, when, own }] of this.files.entries()) {
      bytes += size_of(own);
      if (place >= most_files || bytes > most_bytes_of_all || Date.now() - when > longest_ms) dropped.add(key);
    }
    await this.drop(({ key }) => dropped.has(key));
  }

  private async drop(is_dropped: (file: RecentFile) => boolean): Promise<void> {
    const dropped = this.files.filter(is_dropped);
    this.files = this.files.filter((one) => !is_dropped(one));
    if (dropped.length === 0) return;
    const store = this.base!.transaction('files', 'readwrite').objectStore('files');
    await Promise.all(dropped.map(({ key }) => done(store.delete(key))));
  }

  private show(): void {
    const others = this.base ? this.files.filter(({ key }) => key !== this.shown) : [];
    for (const list of this.lists) {
      const had_focus = list.contains(document.activeElement);
      list.replaceChildren(...others.map((file) => this.entry(file)));
      list.parentElement!.hidden = others.length === 0;
      if (had_focus) (list.querySelector('button') ?? element('panel_close')).focus();
    }
  }

  private entry({ key, title, own, reading }: RecentFile): HTMLElement {
    const name = name_of(own);
    const open = made('button', { type: 'button', class: 'recent_open' });
    open.append(made('b', { dir: 'auto' }, title || name), made('span', {}, [title && name, readable_size(size_of(own))].filter(Boolean).join(' · ')));
    open.addEventListener('click', () => this.open(own, reading ?? undefined));
    const forget = made('button', { type: 'button', 'aria-label': words.recent.forget(name), title: words.recent.forget(name) }, '×');
    forget.addEventListener('click', () => this.forget(key));
    const entry = made('li');
    entry.append(open, forget);
    return entry;
  }
}
