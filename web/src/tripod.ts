// The directions of x, y and z as the camera sees them, beside the buttons for zoom.
import { element } from './dom';
import { directions_of } from './projection';
import type { Camera } from './protocol';

const ns = 'http://www.w3.org/2000/svg';
const reach = 17; // of an axis, in the drawing's units
const names = ['x', 'y', 'z'] as const;

export class Tripod {
  private readonly axes = names.map((name) => {
    const group = document.createElementNS(ns, 'g');
    const line = document.createElementNS(ns, 'line');
    const letter = document.createElementNS(ns, 'text');
    group.setAttribute('class', `axis_${name}`);
    letter.textContent = name;
    group.append(line, letter);
    return { group, line, letter };
  });
  private shown = '';

  draw(camera: Camera): void {
    const text = JSON.stringify([camera.eye, camera.look_at, camera.up]);
    if (text === this.shown) return;
    this.shown = text;
    const { right, down, forward } = directions_of(camera);
    for (const [i, { line, letter }] of this.axes.entries()) {
      const [x, y] = [reach * right[i]!, reach * down[i]!];
      line.setAttribute('x2', x.toFixed(2));
      line.setAttribute('y2', y.toFixed(2));
      letter.setAttribute('x', (1.3 * x).toFixed(2));
      letter.setAttribute('y', (1.3 * y).toFixed(2));
    }
    // The nearest one last, over the others.
    const far_first = this.axes.map(({ group }, i) => ({ group, away: forward[i]! })).sort((a, b) => b.away - a.away);
    element('tripod').replaceChildren(...far_first.map(({ group }) => group));
  }
}
