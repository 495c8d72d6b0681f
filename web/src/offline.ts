// The installed page: works without a network, and opens files (web/public).
import { remember, remembered } from './remembered';

/** Only from https, where a browser may install the page. Pages of `bihive web` need no cache; the address ?offline
 * requests one anyway. */
export function keep_for_offline(): void {
  const wanted = location.protocol === 'https:' || new URLSearchParams(location.search).has('offline');
  if (!wanted || !('serviceWorker' in navigator)) return;
  navigator.serviceWorker.register(new URL('offline.js', document.baseURI)).catch((error: unknown) => {
    console.warn(`the page cannot be kept for use without a network: ${String(error)}`);
  });
}

// The page's first input, under its address: without a network it cannot be asked for, and no other one may take its place.
const start_key = () => `bihive start ${new URL('.', document.baseURI).pathname}`;

/** Keeps the text of start.json, and returns it. Without storage, the page without a network begins with the molecule. */
export function remember_start(text: string): string {
  remember(start_key(), text);
  return text;
}

/** The text of the last visit; empty if there is none. */
export const remembered_start = (): string => remembered(start_key()) ?? '';

interface LaunchParameters {
  files: readonly { getFile(): Promise<File> }[];
}
interface LaunchQueue {
  setConsumer(take: (parameters: LaunchParameters) => void): void;
}

/** Calls `open` with the files that the system opens with the installed page. */
export function listen_for_launches(open: (files: File[]) => void): void {
  const { launchQueue } = globalThis as { launchQueue?: LaunchQueue };
  launchQueue?.setConsumer(({ files }) => {
    if (files.length > 0) void Promise.all(files.map((file) => file.getFile())).then(open);
  });
}
