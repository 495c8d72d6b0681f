// Measures between the centres of spheres: a distance, an angle at the second of three, a dihedral about the middle two of
// four.
import { cross, dot, length, minus, type Vec3 } from './projection';

const degrees = (radians: number) => (radians * 180) / Math.PI;

export interface Measured {
  name: 'distance' | 'angle' | 'dihedral';
  value: number; // in the scene's unit, or degrees
}

/** Null: fewer than two points, or none is defined, where points coincide or lie on one line. */
export function measured(points: Vec3[]): Measured | null {
  const [a, b, c, d] = points;
  if (!a || !b) return null;
  if (!c) return { name: 'distance', value: length(minus(a, b)) };
  const [to_a, to_c] = [minus(a, b), minus(c, b)];
  const value = d
    ? dihedral(minus(b, a), to_c, minus(d, c))
    : degrees(Math.atan2(length(cross(to_a, to_c)), dot(to_a, to_c)));
  const defined = d || (length(to_a) > 0 && length(to_c) > 0);
  return defined && Number.isFinite(value) ? { name: d ? 'dihedral' : 'angle', value } : null;
}

// Positive where the far bond is turned clockwise, seen along the middle one: as IUPAC has it.
function dihedral(first: Vec3, middle: Vec3, last: Vec3): number {
  const [n, m] = [cross(first, middle), cross(middle, last)];
  if (length(n) === 0 || length(m) === 0) return NaN;
  return degrees(Math.atan2(length(middle) * dot(first, m), dot(n, m)));
}
