// The tiles of the styles, with a small picture of each. The pictures come after the first one of the scene.
import { element } from './dom';
import { style_in_words } from './language';
import type { Choices } from './protocol';

const addresses = import.meta.glob<string>('./styles/*.png', { query: '?url', import: 'default', eager: true });

let pictures: [HTMLImageElement, string][] = [];

/** Makes a tile for each style of the library. */
export function build_style_tiles(styles: Choices['styles']): void {
  const tiles = styles.map(({ name, description }) => {
    const [label, input, box, picture] = [
      document.createElement('label'), document.createElement('input'), document.createElement('span'), new Image(96, 72),
    ] as const;
    const [shown, about] = style_in_words(name, description);
    label.title = about;
    Object.assign(input, { type: 'radio', name: 'style', value: name });
    picture.alt = '';
    pictures.push([picture, addresses[`./styles/${name}.png`] ?? '']);
    box.append(picture, shown);
    label.append(input, box);
    return label;
  });
  element('style').append(...tiles);
}

export function load_style_pictures(): void {
  for (const [picture, address] of pictures) if (address) picture.src = address;
  pictures = [];
}
