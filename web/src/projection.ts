// From the world to the picture: where a point is seen, in pixels of the page.
import type { Camera } from './protocol';

export type Vec3 = readonly [number, number, number];

export const minus = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
];
const length = (a: Vec3): number => Math.hypot(...a);
const unit = (a: Vec3): Vec3 => {
  const by = length(a);
  return [a[0] / by, a[1] / by, a[2] / by];
};

/** Of the picture, each of length 1. */
export function directions_of(camera: Camera): { right: Vec3; down: Vec3; forward: Vec3 } {
  const forward = unit(minus(camera.look_at, camera.eye));
  const right = unit(cross(forward, camera.up));
  return { right, down: cross(forward, right), forward };
}

/** Null: behind the eye. As PixelPlaces of scene/camera.h. */
export function seen_at(camera: Camera, width: number, height: number, point: Vec3): { x: number; y: number } | null {
  const { right, down, forward } = directions_of(camera);
  const from_eye = minus(point, camera.eye);
  const along = dot(from_eye, forward);
  if (along <= 0) return null;
  const side = Math.min(width, height);
  const scale =
    camera.projection === 'orthographic'
      ? side / camera.shorter_side
      : side / (2 * Math.tan((camera.fov_deg * Math.PI) / 360) * along);
  return { x: width / 2 + scale * dot(from_eye, right), y: height / 2 + scale * dot(from_eye, down) };
}
