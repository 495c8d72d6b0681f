// Which field the user is typing in: it has been typed in, and its text has not been taken yet.

let field: EventTarget | null = null;

document.addEventListener('input', ({ target }) => (field = target));
for (const end of ['change', 'focusout']) document.addEventListener(end, () => (field = null), true);

export const is_typing_in = (input: Element): boolean => field === input;

/** A field of text or of a number, which has an undo of its own for what is typed. */
export function is_typing(): boolean {
  const now = document.activeElement;
  return now instanceof HTMLInputElement && field === now && ['text', 'number'].includes(now.type);
}
