// The page's messages: notes that disappear by themselves, and errors that stay until the user closes them.
import { element } from './dom';

const note_ms = 7000;
const most_at_once = 3;

function show(box: HTMLElement, text: string, kind: string): HTMLElement {
  const message = document.createElement('div');
  message.className = `message ${kind}`;
  const words = document.createElement('p');
  words.textContent = text;
  const close = document.createElement('button');
  close.type = 'button';
  close.textContent = '×';
  close.setAttribute('aria-label', 'Dismiss');
  close.addEventListener('click', () => message.remove());
  message.append(words, close);
  box.append(message);
  while (box.childElementCount > most_at_once) box.firstElementChild!.remove();
  return message;
}

export function note(text: string): void {
  const message = show(element('messages'), text, 'note');
  setTimeout(() => message.remove(), note_ms);
}

export function fail(text: string): void {
  show(element('errors'), text, 'error');
}

/** Notes belong to the shown scene: another one starts without them. */
export function clear_notes(): void {
  element('messages').replaceChildren();
}

export function clear_errors(): void {
  element('errors').replaceChildren();
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
