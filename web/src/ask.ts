// Asks for the user's own file that a link was made for.
import { element } from './dom';
import type { State } from './link';

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
  words.textContent = `This link was made for your file ${file}. It is not in the link: open it to see it as it was.`;
  const open = element<HTMLButtonElement>('ask_open');
  open.textContent = `Open ${file}…`;
  open.onclick = () => element('file').click();
  const close = () => void (box.hidden = true);
  element<HTMLButtonElement>('ask_close').onclick = close;
  box.hidden = false;
  return {
    file,
    state,
    close,
    say_other: (name) => (words.textContent = `${name} is open. The link was made for ${file}, which it still waits for.`),
  };
}
