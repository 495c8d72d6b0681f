// The parameters of a picture, written by scripts/settings_tables from the table in src/bihive/settings/.

export interface PictureSettings {
  samples_auto: boolean;
  samples_per_pixel: number;
  recursion: number;
  shadows: boolean;
  ao: boolean;
  ao_distance: number | null;
  ao_directions: number;
  opacity_rule: 'each_surface' | 'once' | 'first' | 'as_one';
  light_points: number;
  outline_px: number;
  outline_step: number;
  outline_colour: [number, number, number] | string;
  line_unit: 'px' | 'picture' | 'pt';
  bonds: 'none' | 'distance' | 'file' | 'auto';
  bond_reach: number;
  bond_orders: boolean;
  stick_radius: number;
  ball_scale: number;
  arrows: string;
  arrow_select: string;
  arrow_scale: number;
  arrow_share: number;
  arrow_radius: number | null;
  arrow_pivot: 'tail' | 'middle';
  arrow_colour: string;
  trace: 'none' | 'chain' | 'mol';
  trace_select: string;
  trace_radius: string;
  trace_atoms: 'hidden' | 'shown';
  hbonds: boolean;
  hbond_radius: number;
  hbond_colour: [number, number, number] | string;
  show_contacts: number | null;
  link_radius: string;
  link_colour: string;
  link_dashes: boolean;
  fog: number;
  fog_start: number;
  fog_end: number;
  cell: boolean;
  cell_width: number;
  cell_colour: [number, number, number] | string;
  fit_share: number;
  exposure: number;
  tone: 'none' | 'soft' | 'filmic';
  title: string;
  legend: boolean;
  legend_title: string;
  axes: boolean;
  scale_bar: boolean;
  length_unit: string | null;
}

/** How a file is read; src/bihive/io/reading_settings.cpp. */
// prettier-ignore
export const reading_ids = ['radius', 'radius_scale', 'frame', 'smooth', 'recenter', 'assembly', 'columns', 'replicate', 'cell_vectors', 'cell_origin', 'periodic', 'no_periodic', 'wrap', 'wrap_molecules', 'unwrap', 'exposed_area'] as const;
export type ReadingId = (typeof reading_ids)[number];

/** src/bihive/scene/names.h */
export type ViewName = 'shaded' | 'recursion' | 'traversal' | 'normal' | 'distance' | 'id' | 'tree';
export type Projection = 'perspective' | 'orthographic';
