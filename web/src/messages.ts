// The page's messages: notes that stay as long as it takes to read them, or until the scene that they are about is
// replaced, and errors that stay until the user closes them.
import { element } from './dom';
import { words as words_of_page } from './words';

const most_at_once = 3;
const tick_ms = 250;
const reading_ms = (text: string) => 5000 + 70 * text.length; // 14 letters per second, after a while to notice it

function show(box: HTMLElement, text: string, kind: string, on_close = () => {}): HTMLElement {
  const message = document.createElement('div');
  message.className = `message ${kind}`;
  const words = document.createElement('p');
  words.textContent = text;
  const close = document.createElement('button');
  close.type = 'button';
  close.textContent = '×';
  close.setAttribute('aria-label', words_of_page.dismiss);
  close.addEventListener('click', () => {
    message.remove();
    on_close();
  });
  message.append(words, close);
  box.append(message);
  return message;
}

interface Note {
  text: string;
  load: number;
  left_ms: number;
  message: HTMLElement | null; // null: it waits for room
}

let notes: Note[] = [];
let loads = 0; // begun
let ticking = 0;

function show_notes(): void {
  for (const one of notes.slice(0, most_at_once))
    one.message ??= show(element('messages'), one.text, 'note', () => keep_notes((other) => other !== one));
  if (notes.length > 0 && ticking === 0) ticking = window.setInterval(tick, tick_ms);
  if (notes.length > 0) return;
  window.clearInterval(ticking);
  ticking = 0;
}

function keep_notes(wanted: (one: Note) => boolean): void {
  for (const one of notes) if (!wanted(one)) one.message?.remove();
  notes = notes.filter(wanted);
  show_notes();
}

// Nobody reads in a hidden page; who points at a note or has the focus there may still read it.
function tick(): void {
  if (document.hidden) return;
  for (const one of notes) if (one.message && !one.message.matches(':hover, :focus-within')) one.left_ms -= tick_ms;
  keep_notes(({ left_ms }) => left_ms > 0);
}

/** `load`: the one whose scene it is about; by itself the last that was begun. Returns what removes it. */
export function note(text: string, load = loads): () => void {
  const one: Note = { text, load, left_ms: reading_ms(text), message: null };
  keep_notes((other) => other.text !== text);
  notes.push(one);
  show_notes();
  return () => keep_notes((other) => other !== one);
}

export function fail(text: string): void {
  const box = element('errors');
  show(box, text, 'error');
  while (box.childElementCount > most_at_once) box.firstElementChild!.remove();
}

/** For those who hear the page: what is seen anyway. */
export function speak(text: string): void {
  element('spoken').textContent = text;
}

/** Another scene is requested: it starts without messages. */
export function begin_load(load: number): void {
  loads = load;
  keep_notes(() => false);
  element('errors').replaceChildren();
}

/** Its scene is there: notes about those before it are outdated. */
export function end_load(load: number): void {
  keep_notes((one) => one.load >= load);
}

/** A bar of progress over the picture. `done` 0 to 1, or null if unknown; null text hides it. */
export function busy(text: string | null, done: number | null = null): void {
  element('busy').hidden = text === null;
  if (text === null) return;
  element('busy_text').textContent = text;
  const bar = element<HTMLProgressElement>('busy_bar');
  if (done === null) bar.removeAttribute('value');
  else bar.value = done;
}
