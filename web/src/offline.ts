// The page without a network, and as the program that opens files: what an installed page has (web/public).

/** From https, where a browser may install the page. `bihive web` is there anyway, so its pages need no cache; the
 * address ?offline asks for one all the same. */
export function keep_for_offline(): void {
  const wanted = location.protocol === 'https:' || new URLSearchParams(location.search).has('offline');
  if (!wanted || !('serviceWorker' in navigator)) return;
  navigator.serviceWorker.register(new URL('offline.js', document.baseURI)).catch((error: unknown) => {
    console.warn(`the page cannot be kept for use without a network: ${String(error)}`);
  });
}

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
