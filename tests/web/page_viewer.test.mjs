// The page without a network, and files that the system opens with the installed page.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { made_files } from './page_files.mjs';
import { folder, open_page, scratch, settled, shown_error, small, with_page } from './page_kit.mjs';
import { serve } from './page_server.mjs';

const kit = with_page();

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
