// The result of a run of Figure 4.4 on a device (frame_rates_json() in thesis/frame_rates_report.h), as far as pages
// show it.

export interface Rate {
  scenario: number;
  spheres: number;
  max_prims: number | null; // null: brute force
  fps: number;
}

export interface Costs {
  inner_words: string; // an inner node in sphere tests, with its standard error, or why it has none
  leaf_words: string; // a leaf in inner nodes
  determined: boolean; // both of them
  rms: number; // relative, of a frame's time
  winner: string;
  wins: number;
  configurations: number;
}

/** The costs of a ray's steps, with standard errors, and the winner at these costs. */
export function costs_in_words(costs: Costs): string {
  const ratios =
    `the cost of an inner node over that of a sphere test is ${costs.inner_words}, and that of a leaf over an inner node ` +
    `is ${costs.leaf_words}`;
  if (!costs.determined) return `${ratios}, so that no winner follows.`;
  return (
    `${ratios}. At these costs ${costs.winner} wins ${costs.wins} of ${costs.configurations}, where the thesis says 7 of 9. ` +
    `They miss a frame’s time by ${(100 * costs.rms).toFixed(0)} %.`
  );
}
