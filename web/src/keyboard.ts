// Moves the picture by keys, wherever the focus is, unless a control takes the key itself, and by the buttons for zoom.
import { element } from './dom';
import { remember, remembered } from './remembered';
import type { EngineName, Move } from './protocol';

const step_px = 24; // of the page
const zoom_step = 1.15;
const arrows: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

export interface KeyActions {
  scale(): number;
  size(): { width: number; height: number };
  move(move: Move): void;
  /** The view of this number, from 1; false if there is none. */
  view(number: number): boolean;
  engine(): EngineName;
  set_engine(engine: EngineName): void;
  /** A key of the player; false if there is nothing to play. */
  play(key: string): boolean;
}

const single_keys = 'bihive-single-keys'; // 'off': letters, digits and signs do nothing by themselves

/** Zooms at the middle of the picture. */
export function zoom_by(factor: number, { width, height }: { width: number; height: number }): Move {
  return { kind: 'zoom', factor, x: width / 2, y: height / 2 };
}

export function listen_for_zoom(size: () => { width: number; height: number }, move: (move: Move) => void): void {
  for (const [id, factor] of [['zoom_in', zoom_step ** 2], ['zoom_out', zoom_step ** -2]] as const)
    element(id).addEventListener('click', () => move(zoom_by(factor, size())));
  element('zoom_all').addEventListener('click', () => move({ kind: 'home' }));
}

// Fields take letters and digits; sliders, radio buttons and the scrolled panel take arrows and Home.
function takes(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target.closest('dialog, select, textarea')) return true;
  const scrolls = key in arrows || key === 'Home';
  if (target instanceof HTMLInputElement)
    return (
      !['checkbox', 'radio', 'range', 'file'].includes(target.type) ||
      (scrolls && target.type !== 'checkbox') ||
      (key === ' ' && target.type !== 'range')
    );
  if (key === ' ') return target.closest('button, summary, label') !== null;
  return scrolls && target.closest('#panel') !== null && target.closest('button, summary, label') === null;
}

export function listen_for_keys(actions: KeyActions): void {
  const single = element<HTMLInputElement>('single_keys');
  single.checked = remembered(single_keys) !== 'off';
  single.addEventListener('change', () => remember(single_keys, single.checked ? 'on' : 'off'));
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (takes(event.target, event.key) || document.querySelector('dialog[open]')) return;
    if (event.key.length === 1 && event.key !== ' ' && !single.checked) return;
    const arrow = arrows[event.key];
    const zoom = { '+': zoom_step, '=': zoom_step, '-': 1 / zoom_step, _: 1 / zoom_step }[event.key];
    if (arrow) {
      const px = step_px * actions.scale();
      actions.move({ kind: event.shiftKey ? 'pan' : 'orbit', dx: arrow[0] * px, dy: arrow[1] * px });
    } else if (zoom) actions.move(zoom_by(zoom, actions.size()));
    else if (event.key === 'Home') actions.move({ kind: 'home' });
    else if (event.key === 'e' || event.key === 'E') actions.set_engine(actions.engine() === 'gpu' ? 'cpu' : 'gpu');
    else if (!actions.view(Number(event.key)) && !actions.play(event.key)) return;
    event.preventDefault();
  });
}
