// Cameras that go around what they look at.
import { minus, type Vec3 } from './projection';
import type { Camera, TurnAxis } from './protocol';

type Vector = [number, number, number];

const axes: Record<Exclude<TurnAxis, 'up'>, Vec3> = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const plus = (a: Vec3, b: Vec3): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const times = (by: number, a: Vec3): Vector => [by * a[0], by * a[1], by * a[2]];

// Around an axis of length 1, by Rodrigues' formula.
function rotated(vector: Vec3, axis: Vec3, degrees: number): Vector {
  const angle = (degrees * Math.PI) / 180;
  const [cosine, sine] = [Math.cos(angle), Math.sin(angle)];
  const aside: Vec3 = [
    axis[1] * vector[2] - axis[2] * vector[1], axis[2] * vector[0] - axis[0] * vector[2], axis[0] * vector[1] - axis[1] * vector[0],
  ];
  return plus(plus(times(cosine, vector), times(sine, aside)), times(dot(axis, vector) * (1 - cosine), axis));
}

/** The camera after a turn about an axis through what it looks at: the spheres turn to the right about `up`. */
export function turned(camera: Camera, about: TurnAxis, degrees: number): Camera {
  if (degrees === 0) return camera;
  const axis = about === 'up' ? times(1 / Math.hypot(...camera.up), camera.up) : axes[about];
  const back = rotated(minus(camera.eye, camera.look_at), axis, -degrees);
  return { ...camera, eye: plus(camera.look_at, back), up: rotated(camera.up, axis, -degrees) };
}

/** These cameras, all as far away as the farthest: `far_enough` gives the one that a camera needs. */
export function equally_far(cameras: Camera[], far_enough: (camera: Camera) => Camera): Camera[] {
  const away = ({ eye, look_at }: Camera) => Math.hypot(...minus(eye, look_at));
  const needed = cameras.map(far_enough);
  const distance = Math.max(...needed.map(away));
  const shorter_side = Math.max(...needed.map((one) => one.shorter_side));
  return cameras.map((one) => ({ ...one, shorter_side, eye: plus(one.look_at, times(distance / away(one), minus(one.eye, one.look_at))) }));
}
