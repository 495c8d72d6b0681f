// A small server of static files for tests of the page: with the headers that let a page share memory among threads, or
// without them. Users have `bihive web`; this server can leave the headers out, and change files.
import { createReadStream, readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const types = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.json': 'application/json',
  '.wasm': 'application/wasm',
  '.svg': 'image/svg+xml',
  '.webmanifest': 'application/manifest+json',
};
const isolation = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
  'Cross-Origin-Resource-Policy': 'same-origin',
};

/** Serves `folder`, and `files` (paths of URLs to paths on disk) beside it. `before`: [pattern, code] that goes before
 * every script whose path matches. `asked`: called with the path of each request. Resolves to {url, close}. */
export function serve(folder, { isolated = true, files = {}, before = null, asked = () => {} } = {}) {
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://host/').pathname);
    asked(path);
    const name = files[path] ?? join(folder, normalize(path === '/' ? '/index.html' : path));
    let size;
    try {
      size = statSync(name).size;
    } catch {
      response.writeHead(404).end();
      return;
    }
    const headers = { 'Content-Type': types[extname(name)] ?? 'application/octet-stream', ...(isolated ? isolation : {}) };
    if (before && before[0].test(path)) {
      response.writeHead(200, headers).end(before[1] + readFileSync(name, 'utf8'));
      return;
    }
    response.writeHead(200, { ...headers, 'Content-Length': size });
    createReadStream(name).pipe(response);
  });
  return new Promise((resolve) => {
    server.listen(0, '127.0.0.1', () =>
      resolve({
        url: `http://127.0.0.1:${server.address().port}/`,
        close: () => {
          server.closeAllConnections();
          server.close();
        },
      }),
    );
  });
}
