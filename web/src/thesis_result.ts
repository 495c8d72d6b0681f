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

export const english_costs = {
  ratios: (inner: string, leaf: string) =>
    `the cost of an inner node over that of a sphere test is ${inner}, and that of a leaf over an inner node is ${leaf}`,
  undetermined: (ratios: string) => `${ratios}, so that no winner follows.`,
  winner: (ratios: string, winner: string, wins: number, configurations: number, percent: string) =>
    `${ratios}. At these costs ${winner} wins ${wins} of ${configurations}, where the thesis says 7 of 9. ` +
    `They miss a frame’s time by ${percent} %.`,
};

/** The costs of a ray's steps, with standard errors, and the winner at these costs. */
export function costs_in_words(costs: Costs, words = english_costs): string {
  const ratios = words.ratios(costs.inner_words, costs.leaf_words);
  if (!costs.determined) return words.undetermined(ratios);
  return words.winner(ratios, costs.winner, costs.wins, costs.configurations, (100 * costs.rms).toFixed(0));
}
