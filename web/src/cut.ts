// The card "Cut": a plane that removes what is before it, by a slider, and by a handle over the picture.
import { element } from './dom';
import type { LookRows } from './groups';
import { minus, seen_at, type Vec3 } from './projection';
import type { Camera, Contents } from './protocol';
import { words } from './words';

interface Plane {
  normal: Vec3;
  distance: number; // n.x above it is removed
}

const axes: Record<string, Vec3> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const along = (a: Vec3, b: Vec3, by: number): Vec3 => [a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]];
const depth_words = (share: number) => `${Math.round(100 * share)} %`;
const least_px = 4; // of a normal on the screen: a shorter one points at the eye

function plane_of(text: string | null): Plane | null {
  const numbers = text?.startsWith('plane:') ? text.slice('plane:'.length).split(',').map(Number) : [];
  const [x, y, z, distance] = numbers;
  return numbers.length === 4 && numbers.every(Number.isFinite) ? { normal: [x!, y!, z!], distance: distance! } : null;
}

export class Cut {
  private readonly picture = element('picture');
  private readonly side = element<HTMLSelectElement>('cut_side');
  private readonly depth = element<HTMLInputElement>('cut_depth');
  private readonly output = document.querySelector<HTMLOutputElement>('output[for=cut_depth]')!;
  private readonly handle = element('cut_handle');
  private box: Pick<Contents, 'low' | 'high'> | null = null;
  private open = false;
  private chosen = { side: '', normal: '' }; // by the user: one that faces the eye may lie along an axis

  constructor(private readonly rows: LookRows, private readonly camera: () => Camera | null) {
    const option = (value: string, text: string) => Object.assign(document.createElement('option'), { value, textContent: text });
    this.side.append(option('', words.cut.off), ...Object.entries(words.cut.sides).map(([value, text]) => option(value, text)));
    this.side.addEventListener('change', () => this.choose());
    this.depth.addEventListener('input', () => this.set_share(Number(this.depth.value) / 100));
    this.listen();
  }

  /** Another scene, whose box is not known yet. */
  begin(): void {
    this.box = null;
    this.chosen = { side: '', normal: '' };
    this.show();
  }

  take(box: Pick<Contents, 'low' | 'high'>): void {
    this.box = box;
    this.show();
  }

  set_open(open: boolean): void {
    this.open = open;
    this.draw();
  }

  /** The rows of the look have changed. */
  show(): void {
    const plane = this.plane;
    const axis = plane && Object.keys(axes).find((name) => axes[name]!.join() === plane.normal.join());
    const is_chosen = plane?.normal.join() === this.chosen.normal;
    this.side.value = plane ? (is_chosen ? this.chosen.side : (axis ?? 'view')) : '';
    this.side.disabled = !this.box;
    this.depth.disabled = !this.box || !plane;
    const share = plane ? this.share_of(plane) : 0;
    if (Math.abs(Number(this.depth.value) / 100 - share) > 0.005) this.depth.value = String(100 * share);
    this.output.textContent = plane ? depth_words(share) : '';
    this.depth.setAttribute('aria-valuetext', depth_words(share));
    this.draw();
  }

  /** The handle follows the camera. */
  draw(): void {
    const camera = this.camera(), plane = this.plane;
    const middle = this.open && plane && this.middle_of(plane);
    const { clientWidth: width, clientHeight: height } = this.picture;
    const place = camera && middle ? seen_at(camera, width, height, middle) : null;
    this.handle.hidden = !place;
    if (place) Object.assign(this.handle.style, { left: `${place.x}px`, top: `${place.y}px` });
  }

  private get plane(): Plane | null {
    return plane_of(this.rows.value('', 'clip'));
  }

  // From the first to the last of the box's corners along a normal.
  private range(normal: Vec3): [number, number] {
    const { low, high } = this.box!;
    const ends = ([0, 1, 2] as const).map((i) => [normal[i] * low[i], normal[i] * high[i]].sort((a, b) => a - b) as [number, number]);
    return [ends.reduce((sum, [end]) => sum + end, 0), ends.reduce((sum, [, end]) => sum + end, 0)];
  }

  private share_of({ normal, distance }: Plane): number {
    if (!this.box) return 0;
    const [low, high] = this.range(normal);
    return high > low ? Math.min(1, Math.max(0, (high - distance) / (high - low))) : 0;
  }

  private choose(): void {
    const camera = this.camera();
    if (this.side.value === '' || !this.box || !camera) return this.rows.set('', 'clip', null);
    const towards = minus(camera.eye, camera.look_at);
    const normal = axes[this.side.value] ?? (towards.map((one) => +(one / Math.hypot(...towards)).toFixed(4)) as unknown as Vec3);
    const [low, high] = this.range(normal);
    this.chosen = { side: this.side.value, normal: normal.join() };
    this.set({ normal, distance: (low + high) / 2 });
  }

  private set_share(share: number): void {
    const plane = this.plane;
    if (!plane || !this.box) return;
    const [low, high] = this.range(plane.normal);
    this.set({ ...plane, distance: high - share * (high - low) });
  }

  private set({ normal, distance }: Plane): void {
    this.rows.set('', 'clip', `plane:${[...normal, +distance.toPrecision(6)].join()}`);
  }

  // The point of the plane nearest to the box's middle.
  private middle_of({ normal, distance }: Plane): Vec3 | null {
    if (!this.box) return null;
    const { low, high } = this.box;
    const middle: Vec3 = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
    return along(middle, normal, (distance - dot(normal, middle)) / dot(normal, normal));
  }

  private listen(): void {
    let from: { x: number; y: number; plane: Plane } | null = null;
    this.handle.addEventListener('pointerdown', (event) => {
      const plane = this.plane;
      if (!plane) return;
      event.preventDefault();
      from = { x: event.clientX, y: event.clientY, plane };
      this.handle.setPointerCapture(event.pointerId);
    });
    this.handle.addEventListener('pointermove', ({ clientX, clientY }) => {
      const camera = this.camera();
      const middle = from && this.middle_of(from.plane);
      if (!from || !middle || !camera) return;
      const { normal, distance } = from.plane;
      const [low, high] = this.range(normal);
      const step = (high - low) / 10;
      const { clientWidth: width, clientHeight: height } = this.picture;
      const seen = (point: Vec3) => seen_at(camera, width, height, point);
      const [here, there] = [seen(middle), seen(along(middle, normal, step / dot(normal, normal)))];
      const on_screen = here && there ? { x: there.x - here.x, y: there.y - here.y } : { x: 0, y: 0 };
      const length = Math.hypot(on_screen.x, on_screen.y);
      const [right, down] = [clientX - from.x, clientY - from.y];
      // A plane that faces the eye goes away as the hand goes down.
      const steps = length > least_px ? (right * on_screen.x + down * on_screen.y) / length ** 2 : -down / (height / 20);
      this.set({ normal, distance: Math.min(high, Math.max(low, distance + steps * step)) });
    });
    for (const end of ['pointerup', 'pointercancel'] as const) this.handle.addEventListener(end, () => (from = null));
  }
}
