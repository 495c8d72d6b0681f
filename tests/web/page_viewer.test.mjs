// The page in other people's pages, and without a network: the web component <bihive-viewer> as npm packs it, the service
// worker, and files that the system opens with the installed page.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { made_files } from './page_files.mjs';
import { compare, folder, native_picture, open_page, scratch, settled, shown_error, small, source, with_page } from './page_kit.mjs';
import { serve } from './page_server.mjs';

const kit = with_page();

test('the packed component shows a file in ten lines, and says what came of it', async () => {
  const packed = join(scratch, 'packed');
  mkdirSync(packed, { recursive: true });
  execFileSync(join(source, 'scripts/pack_viewer'), [folder, packed], { stdio: ['ignore', 'ignore', 'inherit'] });
  const [archive] = readdirSync(packed).filter((name) => name.endsWith('.tgz'));
  execFileSync('tar', ['xzf', archive], { cwd: packed });
  const root = join(packed, 'package');
  assert.ok(readFileSync(join(root, 'example.html'), 'utf8').trim().split('\n').length <= 11, 'an example of ten lines');
  for (const name of ['bihive-viewer.d.ts', 'README.md', 'LICENSE']) assert.ok(existsSync(join(root, name)), name);
  writeFileSync(join(root, 'two.csv'), 'x,y,z,r\n0,0,0,1\n3,0,0,1\n');
  writeFileSync(
    join(root, 'own.html'),
    '<!doctype html><title>own</title><script type="module" src="bihive-viewer.js"></script>' +
      '<style>bihive-viewer { width: 320px; height: 240px; }</style><bihive-viewer src="two.csv"></bihive-viewer>',
  );

  const server = await serve(root);
  const context = await kit.browser.newContext(small);
  const page = await context.newPage();
  const complaints = [];
  // The pages around the component have no icon.
  page.on('console', (message) => {
    if (message.type() === 'error' && !message.location().url.endsWith('/favicon.ico')) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(error.message));
  const next = (type) =>
    page.evaluate((wanted) => new Promise((take) => addEventListener(wanted, ({ detail }) => take(detail), { once: true })), type);

  await page.addInitScript(() => addEventListener('bihive-load', ({ detail }) => (globalThis.first_load = detail)));
  await page.goto(`${server.url}example.html`);
  await page.waitForFunction(() => globalThis.first_load);
  assert.deepEqual(await page.evaluate(() => globalThis.first_load),
    { bihive: 'loaded', name: '1hpv.pdb', format: 'PDB', spheres: 1631, frames: 1 });
  const frame = page.frames().find((one) => one.url().includes('/page/'));
  await settled(frame);
  assert.equal(await frame.isVisible('#panel'), false, 'the picture alone');
  assert.equal(await frame.inputValue('input[name=style]:checked'), 'illustrative');

  await page.goto(`${server.url}own.html`);
  await page.waitForFunction(() => globalThis.first_load?.name === 'two.csv');
  const box = await page.locator('bihive-viewer').boundingBox();
  assert.deepEqual([box.width, box.height], [320, 240]);

  // Attributes that change load anew; a file that is missing is said.
  let heard = next('bihive-load');
  await page.evaluate(() => Object.assign(document.querySelector('bihive-viewer'), { look: 'flat' }));
  assert.equal((await heard).spheres, 2);
  assert.equal(await page.evaluate(() => document.querySelector('bihive-viewer').look), 'flat');
  const flat = page.frames().find((one) => one.url().includes('/page/'));
  await settled(flat);
  assert.equal(await flat.inputValue('input[name=style]:checked'), 'flat');
  const shown = await page.locator('bihive-viewer').screenshot({ path: join(scratch, 'viewer-shown.png') });
  const native = native_picture(join(root, 'two.csv'), 'viewer', '--style', 'flat', '--size', '320x240');
  const { width, height, share } = await compare(page, shown.toString('base64'), native.toString('base64'), 24);
  assert.deepEqual([width, height], [320, 240]);
  assert.ok(share < 0.12, `${share} of the pixels differ: more than a name in the corner`);
  assert.deepEqual(complaints, []);
  heard = next('bihive-error');
  await page.evaluate(() => (document.querySelector('bihive-viewer').src = 'missing.pdb'));
  assert.match((await heard).message, /missing\.pdb/);
  await page.evaluate(() => document.querySelector('bihive-viewer').remove());
  assert.equal(page.frames().length, 1, 'nothing is left of a viewer that is taken away');
  await context.close();
  server.close();
});

test('after one visit the page is there without a network', async () => {
  const server = await serve(folder);
  const { page, context } = await open_page(kit.browser, `${server.url}?offline`, small);
  const cached = await page.evaluate(async () => {
    await navigator.serviceWorker.ready;
    const { files } = await (await fetch('offline.json')).json();
    const cache = await caches.open((await caches.keys())[0]);
    return [files.length, (await cache.keys()).length];
  });
  assert.ok(cached[0] > 10, `${cached[0]} files`);
  assert.equal(cached[1], cached[0]);
  server.close();
  await page.reload();
  await settled(page);
  assert.match(await page.textContent('#facts'), /1,631 spheres/);
  await context.close();
});

test('without a network the file of `bihive web FILE` is missed, and no other scene takes its place', async () => {
  const { name, bytes } = made_files.find(({ name }) => name === 'four.xyz');
  const files = { '/start.json': join(scratch, 'start.json'), [`/file/${name}`]: join(scratch, name) };
  writeFileSync(files['/start.json'], JSON.stringify({ source: { url: `file/${name}` } }));
  writeFileSync(files[`/file/${name}`], bytes);
  const server = await serve(folder, { files });
  const { page, context } = await open_page(kit.browser, `${server.url}?offline`, small);
  assert.match(await page.textContent('#facts'), /four\.xyz/);
  await page.evaluate(() => navigator.serviceWorker.ready);
  server.close();
  await page.reload();
  assert.match(await shown_error(page), /four\.xyz could not be fetched: the server http:.* cannot be reached/);
  assert.doesNotMatch(await page.textContent('#facts'), /spheres/);
  assert.ok(await page.isHidden('#busy'));
  await context.close();
});

test('without being asked for, a page on this machine keeps nothing', async () => {
  const { page, context } = await open_page(kit.browser, kit.server.url, small);
  assert.deepEqual(await page.evaluate(() => caches.keys()), []);
  await context.close();
});

test('the installed page opens the files that the system gives it', async () => {
  const { name, spheres, bytes } = made_files.find((file) => file.name === 'three.pdb');
  const manifest = JSON.parse(readFileSync(join(folder, 'bihive.webmanifest'), 'utf8'));
  assert.ok(manifest.file_handlers[0].accept['application/x-pdb'].includes('.pdb'));
  assert.ok(existsSync(join(folder, manifest.icons[0].src)));
  const context = await kit.browser.newContext(small);
  const page = await context.newPage();
  await page.addInitScript(
    ([called, text]) => {
      const launch = { files: [{ getFile: async () => new File([text], called) }] };
      Object.defineProperty(globalThis, 'launchQueue', {
        value: { setConsumer: (take) => addEventListener('launch now', () => take(launch)) },
      });
    },
    [name, bytes.toString()],
  );
  await page.goto(kit.server.url);
  await settled(page);
  // What Chromium does not take of it, such as an unknown type of a file, it only says here.
  const taken = await (await context.newCDPSession(page)).send('Page.getAppManifest');
  assert.deepEqual(taken.errors, []);
  assert.ok(taken.data.includes('file_handlers'));
  await page.evaluate(() => dispatchEvent(new Event('launch now')));
  await page.waitForFunction((wanted) => document.getElementById('facts').textContent.startsWith(wanted), `${name}: ${spheres} spheres`);
  await context.close();
});
