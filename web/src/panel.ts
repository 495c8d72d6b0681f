// The panel: at the side of a wide window, where it folds; in a narrow one a sheet at the bottom, which is closed, half as
// high as the window, or covers it. The picture takes what is left (style.css).
import { element } from './dom';

type Height = 'closed' | 'half' | 'whole';
const heights: Height[] = ['closed', 'half', 'whole'];

const first_px = 24, next_px = 90; // a finger on the sheet's handle moves it by a height

export function start_panel(): void {
  const toggle = element<HTMLButtonElement>('panel_toggle');
  const tall = element<HTMLButtonElement>('panel_tall');
  const narrow = matchMedia('(max-width: 560px), (max-width: 760px) and (orientation: portrait)'); // as in style.css
  const low_phone = matchMedia('(max-height: 480px) and (pointer: coarse)');
  let height: Height = 'half';
  const set_height = (now: Height) => {
    height = now;
    document.documentElement.dataset['panel'] = now;
    element('panel_body').inert = now === 'closed';
    toggle.setAttribute('aria-expanded', String(now !== 'closed'));
    toggle.title = now === 'closed' ? 'Show the controls' : 'Hide the controls';
    tall.setAttribute('aria-pressed', String(now === 'whole'));
    tall.hidden = !narrow.matches || now === 'closed';
  };
  const begin = () => set_height(narrow.matches || low_phone.matches ? 'closed' : 'half');
  toggle.addEventListener('click', () => set_height(height === 'closed' ? 'half' : 'closed'));
  tall.addEventListener('click', () => set_height(height === 'whole' ? 'half' : 'whole'));
  narrow.addEventListener('change', begin);
  begin();
  // A finger on the handle.
  let from_y: number | null = null;
  let dragged = false;
  toggle.addEventListener('pointerdown', (event) => {
    from_y = event.clientY;
    dragged = false;
    toggle.setPointerCapture(event.pointerId);
  });
  toggle.addEventListener('pointermove', (event) => {
    if (from_y === null || !narrow.matches || Math.abs(event.clientY - from_y) < (dragged ? next_px : first_px)) return;
    const next = heights[heights.indexOf(height) + (event.clientY < from_y ? 1 : -1)];
    from_y = event.clientY;
    dragged = true;
    if (next) set_height(next);
  });
  // The click that ends a drag does not count. A click without a finger's down event does.
  toggle.addEventListener(
    'click',
    (event) => {
      if (dragged && event.detail > 0) event.stopImmediatePropagation();
      from_y = null;
      dragged = false;
    },
    { capture: true },
  );
}
