// The first card, with three samples: gone at the first touch.
import { element } from './dom';

/** Shows it, or not. */
export function welcome(shown: boolean): void {
  const box = element('welcome');
  box.hidden = !shown;
  const hide = ({ target }: Event) => {
    if (target instanceof Node && box.contains(target)) return;
    box.hidden = true;
    for (const touch of ['pointerdown', 'keydown', 'wheel', 'drop']) removeEventListener(touch, hide, true);
  };
  for (const touch of ['pointerdown', 'keydown', 'wheel', 'drop']) addEventListener(touch, hide, true);
}

export function listen_for_samples(open: (built_in: string) => void): void {
  for (const button of document.querySelectorAll<HTMLButtonElement>('[data-sample]'))
    button.addEventListener('click', () => {
      element('welcome').hidden = true;
      open(button.dataset['sample']!);
    });
}
