// The result of a run of Figure 4.4 on a device (frame_rates_json() in thesis/frame_rates_report.h), as far as pages
// show it.

export interface Rate {
  scenario: number;
  spheres: number;
  max_prims: number | null; // null: brute force
  fps: number;
}

export interface Costs {
  inner_per_test: number;
  inner_per_test_error: number;
  leaf_per_inner: number;
  leaf_per_inner_error: number;
  rms: number; // relative, of a frame's time
  winner: string;
  wins: number;
  configurations: number;
}

const with_error = (value: number, error: number) => `${value.toFixed(2)} ± ${error.toFixed(2)}`;

/** The costs of a ray's steps, with standard errors, and the winner at these costs. */
export function costs_in_words(costs: Costs): string {
  return (
    `an inner node costs ${with_error(costs.inner_per_test, costs.inner_per_test_error)} sphere tests and a leaf ` +
    `${with_error(costs.leaf_per_inner, costs.leaf_per_inner_error)} inner nodes: ${costs.winner} wins ${costs.wins} of ` +
    `${costs.configurations}, where the thesis says 7 of 9. These costs miss a frame’s time by ${(100 * costs.rms).toFixed(0)} %.`
  );
}
