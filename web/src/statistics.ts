// The table of both trees' statistics (the library's statistics, as `bihive stats --json` prints them).
import { element } from './dom';
import { grouped } from './words';

interface Range {
  min: number;
  avg: number;
  max: number;
}

interface ReferenceTree {
  inner_nodes: number;
  leaves: number;
  spheres_per_leaf: Range;
  depth: Range;
  bytes: { total: number };
  allocated_bytes: number;
  build_ms: number;
}

interface WideTree {
  nodes: number;
  leaves: number;
  levels: number;
  spheres_per_leaf: Range;
  nodes_above_leaf: Range;
  bytes: { total: number };
  bytes_per_sphere: number;
  allocated_bytes: number;
  build_ms: number;
}

type Statistics = ReferenceTree & { spheres: number; wide: WideTree; error?: string };

const range = ({ min, avg, max }: Range) => `${grouped(min)}–${avg.toFixed(1)}–${grouped(max)}`;
const ms = (value: number) => (value < 10 ? value.toFixed(2) : value.toFixed(0));

function rows(s: Statistics): [string, string, string][] {
  const w = s.wide;
  return [
    ['nodes', grouped(s.inner_nodes), grouped(w.nodes)],
    ['leaves', grouped(s.leaves), grouped(w.leaves)],
    ['spheres per leaf: min–mean–max', range(s.spheres_per_leaf), range(w.spheres_per_leaf)],
    ['depth of a leaf', range(s.depth), range(w.nodes_above_leaf)],
    ['bytes', grouped(s.bytes.total), grouped(w.bytes.total)],
    ['bytes per sphere', (s.bytes.total / s.spheres).toFixed(1), w.bytes_per_sphere.toFixed(1)],
    ['build, ms', ms(s.build_ms), ms(w.build_ms)],
  ];
}

export function show_statistics(json: string): void {
  const body = element('statistics').querySelector('tbody')!;
  const statistics = JSON.parse(json) as Statistics;
  body.replaceChildren(
    ...(statistics.error ? [] : rows(statistics)).map(([name, ...values]) => {
      const row = document.createElement('tr');
      const head = document.createElement('th');
      head.scope = 'row';
      head.textContent = name;
      row.append(
        head,
        ...values.map((value) => {
          const cell = document.createElement('td');
          cell.textContent = value;
          return cell;
        }),
      );
      return row;
    }),
  );
}
