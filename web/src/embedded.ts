// The page inside another one: <bihive-viewer> (web/viewer) shows it in a frame, without its panel, and gets messages
// from it.

/** Messages of the frame to the page around it; `facts`: name, format, number of spheres, frames. */
export type Told = { bihive: 'loaded'; name: string; format: string; spheres: number; frames: number } | { bihive: 'failed'; message: string };

const asked = new URLSearchParams(location.search).get('embed');

export const is_embedded = asked !== null;

/** Hides what belongs to a separate page; `?embed=panel` keeps the panel. */
export function start_embedded(): void {
  if (is_embedded) document.documentElement.classList.add(asked === 'panel' ? 'embedded' : 'embedded_alone');
}

/** To a page of the same origin alone: names of files are private. */
export function tell(told: Told): void {
  if (is_embedded && parent !== window) parent.postMessage(told, location.origin);
}
