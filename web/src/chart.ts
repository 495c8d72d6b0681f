// The library's charts (SVG texts) on the page, and as one picture.

/** Its style sheet is removed: the page's own has the user's colours, and the page's policy forbids others. */
export function chart_element(text: string): SVGSVGElement {
  const bare = text.replace(/<style>.*?<\/style>/s, '');
  const parsed = new DOMParser().parseFromString(bare, 'image/svg+xml').documentElement;
  return document.importNode(parsed, true) as unknown as SVGSVGElement;
}

const copied = ['fill', 'stroke', 'stroke-width', 'stroke-linejoin', 'font-family', 'font-size', 'font-weight', 'color', 'paint-order'];

// An identical copy that needs no style sheet.
function with_looks(chart: SVGSVGElement): SVGSVGElement {
  const copy = chart.cloneNode(true) as SVGSVGElement;
  const originals = [chart, ...chart.querySelectorAll('*')];
  [copy, ...copy.querySelectorAll('*')].forEach((element, i) => {
    const style = getComputedStyle(originals[i]!);
    for (const name of copied) element.setAttribute(name, style.getPropertyValue(name));
  });
  return copy;
}

// Breaks words into lines no wider than `width`; a longer word has a line of its own.
function lines_of(context: CanvasRenderingContext2D, text: string, width: number): string[] {
  const lines: string[] = [];
  for (const word of text.split(' ')) {
    const longer = lines.length > 0 ? `${lines[lines.length - 1]} ${word}` : word;
    if (lines.length > 0 && context.measureText(longer).width <= width) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

/** All charts, one below the other, under a heading and smaller lines about it; `width` in pixels. */
export async function charts_as_png(
  charts: SVGSVGElement[],
  heading: string,
  about: string[],
  width: number,
): Promise<Blob> {
  const margin = 24, line_height = 26;
  const heights = charts.map((chart) => (width - 2 * margin) * (chart.viewBox.baseVal.height / chart.viewBox.baseVal.width));
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('2d')!;
  const about_font = '18px system-ui, sans-serif';
  context.font = about_font;
  const lines = about.flatMap((text) => lines_of(context, text, width - 2 * margin));
  const heading_height = 66 + line_height * lines.length;
  canvas.width = width; // forgets the font
  canvas.height = Math.ceil(heading_height + heights.reduce((sum, height) => sum + height + margin, 0));
  const style = getComputedStyle(document.body);
  context.fillStyle = style.backgroundColor;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = style.color;
  context.font = '600 24px system-ui, sans-serif';
  context.fillText(heading, margin, 44);
  context.font = about_font;
  lines.forEach((line, i) => context.fillText(line, margin, 74 + line_height * i));
  let y = heading_height;
  for (const [i, chart] of charts.entries()) {
    const copy = with_looks(chart);
    copy.setAttribute('width', String(width - 2 * margin));
    copy.setAttribute('height', String(heights[i]));
    const address = URL.createObjectURL(
      new Blob([new XMLSerializer().serializeToString(copy)], { type: 'image/svg+xml' }),
    );
    const image = new Image();
    image.src = address;
    await image.decode();
    context.drawImage(image, margin, y, width - 2 * margin, heights[i]!);
    URL.revokeObjectURL(address);
    y += heights[i]! + margin;
  }
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The charts could not be drawn'))), 'image/png'),
  );
}
