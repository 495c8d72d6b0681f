// The panel: at the side of a wide window, a sheet at the bottom of a narrow one that opens and closes.
import { element } from './dom';

export function start_panel(): void {
  const panel = element('panel');
  const toggle = element<HTMLButtonElement>('panel_toggle');
  const narrow = matchMedia('(max-width: 760px)');
  const set_open = (open: boolean) => {
    panel.classList.toggle('closed', !open);
    element('panel_body').inert = !open;
    toggle.setAttribute('aria-expanded', String(open));
  };
  toggle.addEventListener('click', () => set_open(panel.classList.contains('closed')));
  narrow.addEventListener('change', () => set_open(!narrow.matches));
  set_open(!narrow.matches);
  // A finger on the sheet's handle opens and closes it too.
  let from_y: number | null = null;
  let dragged = false;
  toggle.addEventListener('pointerdown', (event) => {
    from_y = event.clientY;
    dragged = false;
  });
  toggle.addEventListener('pointermove', (event) => {
    if (from_y === null || !narrow.matches || Math.abs(event.clientY - from_y) < 24) return;
    set_open(event.clientY < from_y);
    from_y = null;
    dragged = true;
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
