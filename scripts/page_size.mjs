// How much a visitor of the page downloads: every file raw and compressed. Fails where it is too much.
//   node scripts/page_size.mjs PAGE_FOLDER [--json]
import { readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { brotliCompressSync, gzipSync } from 'node:zlib';

const mostBytes = 2e6; // compressed with gzip, with the larger one of the two modules
const [folder, json] = process.argv.slice(2);
const files = readdirSync(folder, { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile())
  .map((entry) => join(entry.parentPath ?? entry.path, entry.name))
  .sort();

const totals = { threads: [0, 0, 0], single: [0, 0, 0] };
const row = (name, sizes) =>
  json || console.log(name.padEnd(34) + sizes.map((size) => String(size).padStart(12)).join(''));
row('bytes', ['raw', 'gzip', 'brotli']);
for (const file of files) {
  const bytes = readFileSync(file);
  const sizes = [bytes.length, gzipSync(bytes, { level: 9 }).length, brotliCompressSync(bytes).length];
  const name = relative(folder, file);
  row(name, sizes);
  for (const [variant, total] of Object.entries(totals))
    if (!name.startsWith('wasm/') || name.startsWith(`wasm/${variant}/`)) sizes.forEach((size, i) => (total[i] += size));
}
for (const [variant, total] of Object.entries(totals)) row(`download, ${variant}`, total);
if (json) console.log(JSON.stringify(totals));
const largest = Math.max(...Object.values(totals).map(([, gzip]) => gzip));
if (largest > mostBytes) {
  console.error(`page_size: a visitor downloads ${largest} bytes, more than ${mostBytes}`);
  process.exit(1);
}
