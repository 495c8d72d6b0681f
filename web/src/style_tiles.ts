// The tiles of the styles, with a small picture of each. The pictures come after the first one of the scene.
import { element } from './dom';
import type { Choices } from './protocol';

const addresses = import.meta.glob<string>('./styles/*.png', { query: '?url', import: 'default', eager: true });

let pictures: [HTMLImageElement, string][] = [];

/** Makes a tile for each style of the library. */
export function build_style_tiles(styles: Choices['styles']): void {
  const tiles = styles.map(({ name, description }) => {
    const [label, input, box, picture] = [
      document.createElement('label'), document.createElement('input'), document.createElement('span'), new Image(96, 72),
    ] as const;
    label.title = description;
    Object.assign(input, { type: 'radio', name: 'style', value: name });
    picture.alt = '';
    pictures.push([picture, addresses[`./styles/${name}.png`] ?? '']);
    box.append(picture, name);
    label.append(input, box);
    return label;
  });
  element('style').append(...tiles);
}

export function load_style_pictures(): void {
  for (const [picture, address] of pictures) if (address) picture.src = address;
  pictures = [];
}
