// The way of one ray through both trees, in the laboratory: a click on the picture asks for it while that is open.
import { element } from './dom';
import { readable } from './field';
import type { RayPaths } from './protocol';
import { grouped, words } from './words';

type Structure = RayPaths['structures'][number];

const texts = words.ray_path;
const most_spheres = 8; // named in one line

const made = <Name extends keyof HTMLElementTagNameMap>(name: Name, text = '', ...children: Node[]) => {
  const one = document.createElement(name);
  one.append(...(text ? [text] : []), ...children);
  return one;
};

// A line for each node with spheres; nodes without are counted together.
function lines_of({ steps }: Structure): string[] {
  const lines: string[] = [];
  let without = 0;
  const tell = () => {
    if (without > 0) lines.push(texts.without_spheres(grouped(without)));
    without = 0;
  };
  for (const { spheres, t } of steps) {
    if (spheres.length === 0) {
      ++without;
      continue;
    }
    tell();
    const more = spheres.length - most_spheres;
    const named = spheres.slice(0, most_spheres).join(' ') + (more > 0 ? ` ${texts.more(grouped(more))}` : '');
    lines.push(`${named}: ${t === null ? texts.none_yet : texts.nearest(readable(t))}`);
  }
  tell();
  return lines;
}

function path_of(structure: Structure): HTMLElement {
  const { name, t, id, nodes, box_tests, sphere_tests } = structure;
  const work = texts.work(grouped(nodes), grouped(box_tests), grouped(sphere_tests));
  const hit = t === null ? texts.no_hit : texts.hit(id, readable(t));
  const steps = made('ol', '', ...lines_of(structure).map((line) => made('li', line)));
  return made('details', '', made('summary', `${texts.tree(name)}: ${work}`), made('p', hit), steps);
}

export class RayPathTable {
  private readonly box = element('ray_path');

  /** `request`: in pixels of the page; show() gets the answer. */
  constructor(private readonly request: (x: number, y: number) => void) {}

  /** Whether a click on the picture is meant for it. */
  is_wanted(): boolean {
    return element<HTMLDetailsElement>('laboratory').open && this.box.offsetParent !== null;
  }

  ask(x: number, y: number): void {
    if (this.is_wanted()) this.request(x, y);
  }

  /** Which trees were open stays so. */
  show(paths: RayPaths | null): void {
    const open = [...this.box.querySelectorAll('details')].map((one) => one.open);
    this.box.replaceChildren(...(paths?.structures ?? []).map(path_of));
    this.box.querySelectorAll('details').forEach((one, i) => void (one.open = open[i] ?? false));
  }
}
