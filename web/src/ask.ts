// Asks for the user's own file that a link was made for.
import { element } from './dom';
import type { State } from './link';
import { words as page_words } from './words';

const texts = page_words.ask;

export interface Ask {
  file: string; // its name
  state: State;
  close(): void;
  /** Another file was opened instead. */
  say_other(name: string): void;
}

export function ask_for({ file, state }: { file: string; state: State }): Ask {
  const box = element('ask');
  const words = element('ask_words');
  words.textContent = texts.made_for(file);
  const open = element<HTMLButtonElement>('ask_open');
  open.textContent = texts.open(file);
  open.onclick = () => element('file').click();
  const close = () => void (box.hidden = true);
  element<HTMLButtonElement>('ask_close').onclick = close;
  box.hidden = false;
  return {
    file,
    state,
    close,
    say_other: (name) => (words.textContent = texts.other(name, file)),
  };
}
