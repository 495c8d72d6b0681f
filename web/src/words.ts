// The library's messages name options of the command line; the page has controls instead.
const controls: Record<string, string> = {
  radius: 'Radius',
  columns: 'Columns',
  'radius-scale': 'Radius ×',
  style: 'Style',
  'element-colours': 'Elements',
  background: 'Background',
  light: 'Lights',
  'colour-by': 'Colour by',
  'nan-colour': 'Unknown numbers',
  projection: 'Projection',
  fov: 'Angle',
  aperture: 'Aperture',
  focus: 'Sharp',
  exposure: 'Exposure',
  tone: 'Tone',
  legend: 'Legend',
  'scale-bar': 'Scale bar',
  samples: 'Samples',
  recursion: 'Recursion',
  view: 'Show',
  engine: 'Engine',
  count: 'Spheres',
  'max-prims': 'max_prims',
  'max-depth': 'max_depth',
};

/** "--radius R sets another" becomes "“Radius” in the panel sets another". */
export function in_words_of_the_page(message: string): string {
  return message.replace(/--([a-z]+(?:-[a-z]+)*)( [A-Z]+\b)?/g, (option, name: string) =>
    name in controls ? `“${controls[name]}” in the panel` : option,
  );
}
