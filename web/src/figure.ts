// Pictures of bihive that are dropped on the page: by what they were drawn, and whether their bits are the same when they
// are drawn again. One at a time, each by a worker of its own.
import { element } from './dom';
import type { FigureAnswer, FigureRequest, NamedBlob } from './figure_protocol';
import { fail } from './messages';
import { is_one_file } from './one_file';

const most_at_once = 3;

/** By the ending: a picture, or a film, which is no input of the page. */
export const is_figure = ({ name }: File): boolean => /\.(png|apng|tiff?|exr|mp4|mov|mkv|webm|gif|y4m)$/i.test(name);

const is_png_name = (name: string) => /\.a?png$/i.test(name);
const is_film_name = (name: string) => /\.(mp4|mov|mkv|webm|gif|y4m)$/i.test(name);

// A figure in the box: its words, its progress, and its button.
class Entry {
  private readonly box = document.createElement('div');
  private readonly words = document.createElement('p');
  private readonly bar = document.createElement('progress');
  private readonly close = document.createElement('button');
  drawn = ''; // "drawn by bihive 0.2.0 from 1hpv.pdb"

  constructor(
    readonly figure: NamedBlob,
    readonly on_close: () => void,
  ) {
    this.box.className = 'message figure';
    this.bar.max = 1;
    this.bar.hidden = true;
    this.bar.setAttribute('aria-label', `${figure.name} is drawn again`);
    this.close.type = 'button';
    this.close.textContent = '×';
    this.close.addEventListener('click', () => this.end());
    const text = document.createElement('div');
    text.append(this.words, this.bar);
    this.box.append(text, this.close);
    this.say('', 'waits');
    element('figures').append(this.box);
  }

  /** `state`: for the style. */
  say(more: string, state: 'waits' | 'busy' | 'holds' | 'fails'): void {
    const drawn = this.drawn === '' ? '' : `: ${this.drawn}`;
    this.words.textContent = `${this.figure.name}${drawn}${more === '' ? '' : `. ${more}`}`;
    this.box.dataset['state'] = state;
    this.bar.hidden = state !== 'busy';
    if (state !== 'busy') this.bar.removeAttribute('value');
    const what = state === 'busy' ? 'Cancel the comparison' : 'Dismiss';
    this.close.setAttribute('aria-label', `${what}: ${this.figure.name}`);
  }

  progress(done: number): void {
    this.bar.value = done;
  }

  end(): void {
    this.box.remove();
    this.on_close();
  }
}

export class Figures {
  private readonly waiting: Entry[] = []; // for their inputs
  private readonly stopped = new WeakSet<Entry>();
  private running: { entry: Entry; stop(): void } | null = null;
  private line: Promise<void> = Promise.resolve();

  /** `inputs`: what is there to be drawn from. */
  constructor(
    private readonly module: { base: string; threads: boolean },
    private readonly inputs: () => NamedBlob[],
  ) {}

  /** Verifies pictures that were dropped, or opened. */
  open(files: File[], beside: File[]): void {
    for (const { name } of files.filter(({ name }) => !is_png_name(name)))
      fail(`${name} is a ${is_film_name(name) ? 'film' : 'picture'} that this page does not compare: bihive verify ${name} does`);
    if (is_one_file && files.some(({ name }) => is_png_name(name)))
      return fail('A page that is one file compares no pictures: bihive web does, and bihive verify');
    const entries = files.filter(({ name }) => is_png_name(name)).map((file) => this.entry(file));
    // The oldest verdicts make room.
    const judged = [...element('figures').querySelectorAll<HTMLElement>('[data-state=holds] button, [data-state=fails] button')];
    for (const button of judged.slice(0, Math.max(0, element('figures').childElementCount - most_at_once))) button.click();
    for (const entry of entries) this.queue(entry, named(beside));
  }

  /** Files were opened: figures may have waited for them. */
  try_again(files: File[]): void {
    for (const entry of this.waiting.splice(0)) this.queue(entry, named(files));
  }

  private entry(file: File): Entry {
    const entry: Entry = new Entry({ name: file.name, content: file }, () => this.stop(entry));
    return entry;
  }

  private stop(entry: Entry): void {
    const at = this.waiting.indexOf(entry);
    if (at >= 0) this.waiting.splice(at, 1);
    this.stopped.add(entry);
    if (this.running?.entry === entry) this.running.stop();
  }

  private queue(entry: Entry, beside: NamedBlob[]): void {
    this.line = this.line.then(() => (this.stopped.has(entry) ? undefined : this.verify(entry, beside)));
  }

  // Resolves when its worker has ended.
  private verify(entry: Entry, beside: NamedBlob[]): Promise<void> {
    entry.say('', 'busy');
    return new Promise((resolve) => {
      const worker = new Worker(new URL('./figure_worker.ts', import.meta.url), { type: 'module', name: 'bihive figure' });
      const stop = () => {
        worker.terminate();
        this.running = null;
        resolve();
      };
      this.running = { entry, stop };
      worker.addEventListener('message', (event: MessageEvent<FigureAnswer>) => {
        if (this.shows(event.data, entry)) stop();
      });
      worker.addEventListener('error', (event) => {
        this.shows({ type: 'failed', message: `could not be compared: ${event.message || 'the worker did not start'}` }, entry);
        stop();
      });
      const request: FigureRequest = { ...this.module, figure: entry.figure, inputs: [...beside, ...this.inputs()] };
      worker.postMessage(request);
    });
  }

  // Whether it was the last answer.
  private shows(answer: FigureAnswer, entry: Entry): boolean {
    switch (answer.type) {
      case 'record':
        entry.drawn = `drawn by bihive ${answer.drawn_by} from ${answer.from}`;
        entry.say('', 'busy');
        return false;
      case 'progress':
        entry.progress(answer.done);
        return false;
      case 'missing':
        this.waiting.push(entry);
        if (answer.other_bytes !== '')
          entry.say(`Not verified: ${answer.other_bytes} here has other bytes than what it was drawn from`, 'fails');
        else entry.say(`Open ${answer.names} to verify it`, 'waits');
        return true;
      case 'verdict':
        entry.say(`${answer.holds ? 'Verified' : 'Not verified'}: ${answer.words}`, answer.holds ? 'holds' : 'fails');
        return true;
      case 'failed':
        if (entry.drawn === '') {
          entry.end();
          fail(`${entry.figure.name} ${answer.message}`);
        } else entry.say(`Not verified: ${answer.message}`, 'fails');
        return true;
    }
  }
}

const named = (files: File[]): NamedBlob[] => files.map((file) => ({ name: file.name, content: file }));
