// The page's GPU engine on WebGL2 (drawn by software here): the same pictures as the CPU within the tolerance, a
// context that is lost, and the thesis's run on both engines.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import {
  and_settle, compare, folder, launch, link_state, native_picture, no_complaints, open_page, saved_picture, set_value,
  settled,
} from './page_kit.mjs';
import { serve } from './page_server.mjs';

// The worker's WebGL2 context, where a test can reach it.
const catch_context = `{
  const get_context = OffscreenCanvas.prototype.getContext;
  OffscreenCanvas.prototype.getContext = function (kind, ...options) {
    const context = get_context.call(this, kind, ...options);
    if (kind === 'webgl2' && context) self.caught_context = context;
    return context;
  };
}
`;

let browser, server;
before(async () => {
  browser = await launch();
  server = await serve(folder, { before: [/\/worker-.*\.js$/, catch_context] });
});
after(async () => {
  await browser?.close();
  server?.close();
});

const choose_gpu = (page) =>
  and_settle(page, async () => {
    await page.click('#engine input[value=gpu] + span');
    await page.waitForSelector('#gpu_canvas:not([hidden])');
  });

test('the GPU engine agrees with the program within the tolerance', async () => {
  // A small window: software draws slowly.
  const { page, context, complaints } = await open_page(browser, server.url, { viewport: { width: 780, height: 240 } });
  for (const [scene, count] of [['four-spheres'], ['scenario2', '256']]) {
    if (scene !== 'four-spheres') await and_settle(page, () => page.click('#engine input[value=cpu] + span'));
    await and_settle(page, () => page.selectOption('#built_in', scene));
    if (count) await and_settle(page, () => set_value(page, '#count', count));
    await choose_gpu(page);
    await set_value(page, '#samples', 1);
    for (const [recursion, most] of [[1, 0.0005], [5, 0.005]]) {
      await and_settle(page, () => set_value(page, '#recursion', recursion));
      const native = native_picture(scene, `${scene}-gpu`, '--size', '320x200', '--samples', '1', '--recursion',
        String(recursion), ...(count ? ['--count', count] : []));
      const { share, width } = await compare(page, native, await saved_picture(page, 320, 200), 2);
      assert.equal(width, 320);
      console.log(`${scene}, recursion ${recursion}: ${(100 * share).toFixed(3)} % of the pixels differ`);
      assert.ok(share <= most, `${scene}, recursion ${recursion}: ${share} of the pixels differ`);
    }
    assert.equal((await link_state(page)).settings.engine, 'gpu');
  }
  no_complaints(complaints);
  await context.close();
});

test('a context that is lost comes back with the picture', async () => {
  const { page, context, complaints } = await open_page(browser, server.url);
  await and_settle(page, () => page.selectOption('#built_in', 'four-spheres'));
  await choose_gpu(page);
  const look = () => page.locator('#gpu_canvas').screenshot();
  const before = await look();
  const workers = await Promise.all(
    page.workers().map(async (worker) => ((await worker.evaluate(() => !!self.caught_context)) ? worker : null)),
  );
  const worker = workers.find(Boolean);
  await page.evaluate(() => (document.getElementById('picture').dataset.settled = 'false'));
  await worker.evaluate(() => {
    self.losing = self.caught_context.getExtension('WEBGL_lose_context');
    self.losing.loseContext();
  });
  await page.waitForFunction(() => /took the graphics processor away/.test(document.querySelector('#messages').textContent));
  await page.waitForSelector('#cpu_canvas:not([hidden])');
  await worker.evaluate(() => self.losing.restoreContext());
  await page.waitForFunction(() => /is back/.test(document.querySelector('#messages').textContent));
  await page.waitForSelector('#gpu_canvas:not([hidden])');
  await settled(page);
  assert.equal((await link_state(page)).settings.engine, 'gpu');
  await page.evaluate(() => document.getElementById('messages').replaceChildren());
  assert.ok((await compare(page, before, await look(), 2)).share < 0.01);
  no_complaints(complaints);
  await context.close();
});

for (const engine of ['cpu', 'gpu'])
  test(`the thesis on this device, by the ${engine}`, async () => {
    const { page, context, complaints } = await open_page(browser, `${server.url}?quick`, {
      viewport: { width: 900, height: 700 },
    });
    if (engine === 'gpu') await choose_gpu(page);
    await page.click('#thesis_open');
    assert.ok(await page.isChecked('#thesis_quick'));

    // Cancelled while it runs, with what was complete.
    await page.click('#thesis_run');
    await page.waitForFunction(() => /^[1-9]\d* of 54 configurations, about /.test(document.querySelector('#thesis_text').textContent));
    await page.click('#thesis_cancel');
    await page.waitForFunction(() => /^Cancelled/.test(document.querySelector('#thesis_text').textContent));
    assert.ok(await page.isVisible('#thesis_run'));

    // To the end.
    if (engine === 'cpu') {
      await page.click('#thesis_run');
      await page.waitForFunction(() => /All configurations/.test(document.querySelector('#thesis_text').textContent), null, {
        timeout: 120_000,
      });
      assert.equal(await page.locator('#thesis_charts svg').count(), 4);
      assert.match(await page.textContent('#thesis_charts'), /iPhone 5s, stated/);
    }
    const [json] = await Promise.all([page.waitForEvent('download'), page.click('#thesis_json')]);
    const result = JSON.parse(readFileSync(await json.path(), 'utf8'));
    assert.equal(result.engine, engine);
    assert.equal(result.complete, engine === 'cpu');
    if (result.complete) assert.equal(result.configurations.length, 54);
    assert.ok(result.configurations.every(({ fps }) => fps > 0));
    assert.equal(result.stated['brute.fps.spheres256'].value, 1.87);
    const [png] = await Promise.all([page.waitForEvent('download'), page.click('#thesis_png')]);
    const size = await page.evaluate(async (base64) => {
      const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (character) => character.charCodeAt(0))]));
      return [bitmap.width, bitmap.height];
    }, readFileSync(await png.path()).toString('base64'));
    assert.equal(size[0], 1200);
    assert.ok(size[1] > 600);
    await page.click('#thesis_close');
    await and_settle(page, () => page.press('#picture', 'ArrowLeft'));
    no_complaints(complaints);
    await context.close();
  });
