// The service worker of the page: what was fetched once is there without a network. scripts/build_web writes the list
// of the page's files, offline.json, with a version. Answers come from the network first, so a new version shows at once;
// files whose names hold a hash of their content never change and come from the cache.
const keep = async () => {
  const { version, files } = await (await fetch('offline.json', { cache: 'no-store' })).json();
  const cache = await caches.open(`bihive ${version}`);
  await cache.addAll(files);
  for (const name of await caches.keys()) if (name.startsWith('bihive ') && name !== `bihive ${version}`) await caches.delete(name);
};

const cached = async (request) =>
  (await caches.match(request, { ignoreSearch: true })) ?? (request.mode === 'navigate' ? caches.match('./') : undefined);

self.addEventListener('install', (event) => {
  self.skipWaiting();
  event.waitUntil(keep());
});

self.addEventListener('activate', (event) => event.waitUntil(self.clients.claim()));

self.addEventListener('fetch', (event) => {
  const { request } = event;
  const url = new URL(request.url);
  if (request.method !== 'GET' || url.origin !== self.location.origin || request.headers.has('range')) return;
  const answer = async () => {
    const kept = await cached(request);
    if (kept && /\/assets\/[^/]*-[\w-]{8}\.\w+$/.test(url.pathname)) return kept;
    try {
      return await fetch(request);
    } catch (error) {
      if (kept) return kept;
      throw error;
    }
  };
  event.respondWith(answer());
});
