// The page inside another one: <bihive-viewer> (web/viewer) shows it in a frame, without its panel. How both speak with
// each other stands in host.ts.
import { element } from './dom';

const asked = new URLSearchParams(location.search).get('embed');

export const is_embedded = asked !== null;

/** The component around the page says what it shows: `?embed=viewer`. Without one the address does. */
export const has_host = asked === 'viewer' && parent !== window;

/** Hides what belongs to a separate page; `?embed=panel` keeps the panel. */
export function start_embedded(): void {
  if (!is_embedded) return;
  show_parts({ panel: asked === 'panel', badge: !has_host });
}

/** What is shown beside the picture. */
export function show_parts({ panel, badge }: { panel: boolean; badge: boolean }): void {
  const root = document.documentElement;
  root.classList.add('embedded');
  root.classList.toggle('embedded_alone', !panel);
  root.classList.toggle('without_badge', !badge);
  element('badge').inert = !panel; // there it is a name alone
  // The reader's theme of the separate page would make the frame opaque: browsers draw a ground below it where light
  // meets dark.
  if (!panel) delete root.dataset['theme'];
}
