// Mouse, touch and pen on the picture: one finger or the left button turns, two fingers or the right button move, the
// wheel and a pinch zoom.
import type { Move } from './protocol';

const zoom_per_wheel_px = 0.0015;

interface Point {
  x: number;
  y: number;
}

/** `scale`: pixels of the picture for one of the page's. */
export function listen_for_pointers(picture: HTMLElement, scale: () => number, send: (move: Move) => void): void {
  const down = new Map<number, Point>();

  const place = (event: MouseEvent): Point => {
    const box = picture.getBoundingClientRect();
    return { x: (event.clientX - box.left) * scale(), y: (event.clientY - box.top) * scale() };
  };
  const middle = ([a, b]: Point[]): Point => ({ x: (a!.x + b!.x) / 2, y: (a!.y + b!.y) / 2 });
  const apart = ([a, b]: Point[]): number => Math.hypot(a!.x - b!.x, a!.y - b!.y);

  picture.addEventListener('pointerdown', (event) => {
    picture.setPointerCapture(event.pointerId);
    if (down.size < 2) down.set(event.pointerId, place(event));
  });
  for (const end of ['pointerup', 'pointercancel'] as const)
    picture.addEventListener(end, (event) => down.delete(event.pointerId));

  picture.addEventListener('pointermove', (event) => {
    const before = down.get(event.pointerId);
    if (!before) return;
    const points_before = [...down.values()];
    const now = place(event);
    down.set(event.pointerId, now);
    if (down.size === 1) {
      const kind = event.shiftKey || (event.buttons & 6) !== 0 ? 'pan' : 'orbit';
      send({ kind, dx: now.x - before.x, dy: now.y - before.y });
      return;
    }
    const points = [...down.values()];
    const from = middle(points_before), to = middle(points);
    send({ kind: 'pan', dx: to.x - from.x, dy: to.y - from.y });
    const factor = apart(points) / Math.max(1, apart(points_before));
    if (factor > 0 && factor !== 1) send({ kind: 'zoom', factor, x: to.x, y: to.y });
  });

  picture.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      // Turns lines and pages into pixels. A pinch on a touchpad arrives as small wheel steps with Ctrl.
      const unit = event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1;
      const speed = event.ctrlKey ? 8 : 1;
      const factor = Math.exp(-event.deltaY * unit * speed * zoom_per_wheel_px);
      send({ kind: 'zoom', factor, ...place(event) });
    },
    { passive: false },
  );
  picture.addEventListener('contextmenu', (event) => event.preventDefault());
}
