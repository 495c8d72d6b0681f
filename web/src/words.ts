// What the page says to people, as far as scripts say it: for another language these are what changes, and index.html.

const whole = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });

/** 12345 as "12,345". */
export const grouped = (count: number): string => whole.format(count);

export const words = {
  light_labels: {
    studio: 'studio: key, fill, rim', cloudy: 'cloudy sky', headlight: 'headlight', thesis: 'one point, as in the thesis',
  } as Record<string, string>,
  groups: { kind: 'Kinds', ligand: 'Ligands', chain: 'Chains', element: 'Elements', type: 'Types' } as Record<string, string>,
  entry: {
    shown: (name: string) => `Show ${name}`,
    only: 'Only this',
    colour: 'Colour',
    opacity: 'Opacity',
    material: 'Material',
    own_material: 'the style’s',
    reset: 'As it was',
  },
  more_entries: (count: number) => `${count} more…`,
  cut: {
    off: 'nothing',
    sides: { view: 'towards me', x: 'along x', y: 'along y', z: 'along z' } as Record<string, string>,
  },
  select: { sphere: 'This', residue: 'Residue', chain: 'Chain', kind: 'All of its kind', label: 'Select' },
  film: {
    kinds: { up: 'once around, upright', x: 'once around x', y: 'once around y', z: 'once around z', frames: 'all frames of the file' } as Record<string, string>,
    drawing: 'Drawing the film',
    cancelled: 'The film was cancelled.',
  },
  embed: {
    copied: 'The code is copied: it shows this scene in a page of yours.',
    with_page: (page: string) => `The code is copied. It shows ${page}, which “Save as page” writes: put both into one folder.`,
  },
  recent: { forget: (name: string) => `Forget ${name}` },
  measuring: 'Measuring all frames',
  union: {
    measuring: 'Measuring…',
    area: (area: string) => `Area ${area}`,
    volume: (volume: string) => `Volume ${volume}`,
    cavities: (count: number, volume: string, components: number) =>
      `${count === 0 ? 'No cavities' : `${count} ${count === 1 ? 'cavity' : 'cavities'} of ${volume}`}; ${components === 1 ? 'in one piece' : `in ${components} pieces`}`,
    undecided: 'Cavities could not be told apart in this arrangement.',
    of: (spheres: string) => `Of ${spheres} spheres, with their radii as read.`,
  },
  heights: { whole: 'Whole window', half: 'Half the window' },
};
