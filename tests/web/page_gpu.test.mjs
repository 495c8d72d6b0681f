// The page's GPU engine on WebGL2 (drawn by software here): the same pictures as the CPU within the tolerance, a
// context that is lost, and the thesis's run on both engines.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import {
  agreement, and_settle, close_card, compare, folder, launch, link_state, native_picture, no_complaints, open_page, saved_picture,
  set_value, settled, shown_error, shown_picture,
} from './page_kit.mjs';
import { serve } from './page_server.mjs';

// Keeps the worker's WebGL2 context, so that a test can use it.
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

// The share of pixels that may differ from the CPU's by more than 2 of 255, each on an edge: as tests/gl has it natively.
const most_differing = { 1: 0.0005, 5: 0.005 };

function assert_agreement(found, recursion, what) {
  const { pixels, differing, share, off_edge, largest } = found;
  console.log(`${what}: ${differing} of ${pixels} pixels differ (${(100 * share).toFixed(4)} %), ${off_edge} off edges, ` +
    `by at most ${largest}`);
  assert.ok(share <= most_differing[recursion], what);
  assert.equal(off_edge, 0, `${what}: ${found.examples.join('; ')}`);
}

test('the GPU engine agrees with the CPU: few pixels differ, and each on an edge', async () => {
  // A small window: software draws slowly.
  const { page, context, complaints } = await open_page(browser, server.url, { viewport: { width: 524, height: 262 } });
  await choose_gpu(page);
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  for (const scene of ['demo', 'four-spheres', 'scenario1', 'scenario2', 'scenario3']) {
    if (scene === 'demo') await and_settle(page, () => page.check('#style input[value=plain]', { force: true }));
    else await and_settle(page, () => page.selectOption('#built_in', scene));
    await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
    for (const recursion of [1, 5]) {
      await and_settle(page, () => set_value(page, '#recursion', recursion));
      const { settings } = await link_state(page);
      assert.deepEqual([settings.engine, settings.recursion, settings.samples_per_pixel], ['gpu', recursion, 1]);
      const what = `${scene}, recursion ${recursion}`;
      const saved = await saved_picture(page, 320, 200);
      assert_agreement(agreement(scene, `gpu-${scene}-${recursion}`, saved, settings), recursion, what);
      if (recursion !== 5) continue;
      const shown = await shown_picture(page, '#gpu_canvas');
      assert_agreement(agreement(scene, `shown-${scene}`, shown, settings), recursion, `${what}, on the screen`);
    }
  }
  no_complaints(complaints);
  await context.close();
});

test('more samples on edges are the CPU engine’s: the GPU engine takes their number', async () => {
  const { page, context } = await open_page(browser, server.url, { viewport: { width: 524, height: 262 } });
  await and_settle(page, () => page.click('#samples_auto'));
  assert.ok(await page.isDisabled('#samples_per_pixel'));
  await choose_gpu(page);
  assert.ok(await page.isEnabled('#samples_per_pixel'));
  assert.ok(await page.isDisabled('#samples_auto'));
  assert.ok(await page.isVisible('#samples_auto_note'));
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 2));
  assert.equal((await link_state(page)).settings.samples_per_pixel, 2);
  await context.close();
});

test('the GPU engine draws styles, and a transparent background', async () => {
  const { page, context, complaints } = await open_page(browser, server.url, { viewport: { width: 524, height: 262 } });
  await choose_gpu(page);
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 2));
  for (const style of ['default', 'xray']) {
    await and_settle(page, () => page.check(`#style input[value=${style}]`, { force: true }));
    await and_settle(page, () => set_value(page, '#samples_per_pixel', 2));
    const { settings, look } = await link_state(page);
    assert.equal(settings.engine, 'gpu');
    assert.ok(look.style === style || (style === 'default' && !look.style));
    const saved = await saved_picture(page, 96, 60);
    const native = native_picture('demo', `native-${style}`, '--style', style, '--size', '96x60', '--samples', '2');
    const { share } = await compare(page, saved, native, 8);
    assert.ok(share <= 0.01, `${style}: ${share}`);
  }
  no_complaints(complaints);
  await context.close();
});

// Runs before the worker's script: a browser whose WebGL2 cannot draw into textures of floating point.
const without_floats = `{
  const hidden = /^EXT_color_buffer_(half_)?float$/;
  const { getExtension, getSupportedExtensions } = WebGL2RenderingContext.prototype;
  WebGL2RenderingContext.prototype.getSupportedExtensions = function () {
    return getSupportedExtensions.call(this).filter((name) => !hidden.test(name));
  };
  WebGL2RenderingContext.prototype.getExtension = function (name) {
    return hidden.test(name) ? null : getExtension.call(this, name);
  };
  const texImage2D = WebGL2RenderingContext.prototype.texImage2D;
  self.formats = new Set();
  WebGL2RenderingContext.prototype.texImage2D = function (...all) {
    self.formats.add(all[2]);
    return texImage2D.apply(this, all);
  };
}
`;

test('without textures of floating point the GPU engine draws the very same pictures', async () => {
  const poor = await serve(folder, { before: [/\/worker-.*\.js$/, without_floats] });
  const pictures = [];
  for (const { url } of [server, poor]) {
    const { page, context, complaints } = await open_page(browser, url, { viewport: { width: 524, height: 262 } });
    await and_settle(page, () => page.selectOption('#built_in', 'four-spheres'));
    await choose_gpu(page);
    await and_settle(page, () => set_value(page, '#samples_per_pixel', 2));
    const mine = [];
    for (const view of ['shaded', 'distance']) {
      await and_settle(page, () => page.selectOption('#view', view));
      mine.push(await saved_picture(page, 160, 100), await shown_picture(page, '#gpu_canvas'));
    }
    assert.equal((await link_state(page)).settings.engine, 'gpu');
    pictures.push(mine);
    if (url === poor.url) {
      const formats = await Promise.all(page.workers().map((worker) => worker.evaluate(() => [...(self.formats ?? [])])));
      assert.ok(formats.flat().includes(0x8d70), 'the film is one of RGBA32UI');
    }
    no_complaints(complaints);
    await context.close();
  }
  const judge = await browser.newPage();
  for (const i of pictures[0].keys())
    assert.equal((await compare(judge, pictures[0][i], pictures[1][i], 0)).share, 0, `picture ${i}`);
  await judge.close();
  poor.close();
});

test('without WebGL2 the CPU draws, and the page says why', async () => {
  const without = await launch('--disable-gpu', '--disable-software-rasterizer');
  try {
    const { page, context, complaints } = await open_page(without, server.url);
    const check = async () => {
      assert.ok(await page.isVisible('#cpu_canvas'));
      assert.ok(await page.isHidden('#gpu_canvas'));
      assert.ok(await page.isDisabled('#engine input[value=gpu]'));
      assert.ok(await page.isChecked('#engine input[value=cpu]'));
      assert.match(await page.textContent('#engine_note'), /no WebGL2, so the GPU engine cannot be chosen/);
      assert.ok(await page.isVisible('#engine_note'));
    };
    await check();
    await and_settle(page, () => page.selectOption('#built_in', 'four-spheres'));
    await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
    const native = native_picture('four-spheres', 'no-webgl', '--size', '320x200', '--samples', '1');
    assert.equal((await compare(page, native, await saved_picture(page, 320, 200), 0)).share, 0);

    // Asked for by a key, and by a link.
    await page.press('#picture', 'e');
    assert.match(await shown_error(page), /no WebGL2/);
    await settled(page);
    await check();
    const state = await link_state(page);
    assert.equal(state.settings.engine, 'cpu');
    state.settings.engine = 'gpu';
    no_complaints(complaints);
    await context.close();
    const link = `${server.url}#state=${Buffer.from(JSON.stringify(state)).toString('base64url')}`;
    const linked = await open_page(without, link);
    assert.match(await linked.page.textContent('#messages'), /no WebGL2/);
    assert.equal((await link_state(linked.page)).settings.engine, 'cpu');
    no_complaints(linked.complaints);
  } finally {
    await without.close();
  }
});

async function begin_large_picture(page) {
  await page.fill('#save_width', '4000');
  await page.fill('#save_height', '4000');
  await page.click('#save');
  await page.waitForFunction(() => document.querySelector('#busy_bar').value > 0 && !document.querySelector('#busy').hidden);
}

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

  // A picture to be saved that is cancelled, and one that is lost with the context.
  await begin_large_picture(page);
  await page.click('#save_cancel');
  await page.waitForSelector('#save:not([hidden])');
  assert.equal(await page.locator('#errors .message').count(), 0);
  await begin_large_picture(page);
  await page.evaluate(() => (document.getElementById('picture').dataset.settled = 'false'));
  await worker.evaluate(() => {
    self.losing = self.caught_context.getExtension('WEBGL_lose_context');
    self.losing.loseContext();
  });
  await page.waitForFunction(() => /took the graphics processor away/.test(document.querySelector('#messages').textContent));
  await page.waitForSelector('#cpu_canvas:not([hidden])');
  assert.match(await shown_error(page), /before the picture was complete/);
  await page.waitForSelector('#save:not([hidden])');
  await worker.evaluate(() => self.losing.restoreContext());
  await page.waitForFunction(() => /is back/.test(document.querySelector('#messages').textContent));
  await page.waitForSelector('#gpu_canvas:not([hidden])');
  await settled(page);
  assert.equal((await link_state(page)).settings.engine, 'gpu');
  await page.evaluate(() => document.querySelectorAll('.message button').forEach((button) => button.click()));
  assert.ok((await compare(page, before, await look(), 2)).share < 0.01);
  no_complaints(complaints);
  await context.close();
});

// A scene that software draws quickly. A reload keeps scene, settings and engine: what is so already draws nothing anew.
async function draw_a_little_by_gpu(page) {
  await and_settle(page, () => page.selectOption('#built_in', 'four-spheres'));
  if ((await page.inputValue('#samples_per_pixel')) !== '1') await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  if (await page.isHidden('#gpu_canvas')) await choose_gpu(page);
}

for (const engine of ['cpu', 'gpu'])
  test(`the thesis on this device, by the ${engine}`, async () => {
    const { page, context, complaints } = await open_page(browser, `${server.url}?quick`, {
      viewport: { width: 800, height: 400 },
    });
    if (engine === 'gpu') await draw_a_little_by_gpu(page);
    await page.click('#thesis_open');
    assert.ok(await page.isChecked('#thesis_quick'));

    // Cancelled while it runs; the complete results are kept, and a later visit goes on from them.
    const text = () => page.textContent('#thesis_text');
    const until = (words) =>
      page.waitForFunction((source) => new RegExp(source).test(document.querySelector('#thesis_text').textContent), words);
    assert.equal(await page.textContent('#thesis_run'), 'Run');
    assert.ok(await page.isHidden('#thesis_anew'));
    await page.click('#thesis_run');
    await until('^([6-9]|[1-5]\\d) of 54 configurations, about ');
    await page.click('#thesis_cancel');
    await until('^Cancelled');
    assert.equal(await page.textContent('#thesis_run'), 'Continue');
    await page.reload();
    await settled(page);
    if (engine === 'gpu') await draw_a_little_by_gpu(page);
    await page.click('#thesis_open');
    assert.equal(await page.textContent('#thesis_run'), 'Continue');
    // What was kept is of this engine and size alone.
    await page.uncheck('#thesis_quick');
    assert.equal(await page.textContent('#thesis_run'), 'Run');
    await page.check('#thesis_quick');
    assert.ok(await page.isVisible('#thesis_anew'));

    // To the end, also where software is the graphics processor: its pictures are smaller.
    const kept = JSON.parse(await page.evaluate(() => localStorage.getItem('bihive-thesis')));
    assert.ok(kept.configurations.length >= 6 && kept.configurations.length % 6 === 0);
    await page.click('#thesis_run');
    await until('All configurations');
    if (engine === 'cpu') assert.match(await text(), /pictures of 284 × 160/);
    assert.equal(await page.textContent('#thesis_run'), 'Run');
    assert.equal(await page.evaluate(() => localStorage.getItem('bihive-thesis')), null);
    // The diagram of costs, with this device as a point; and three charts of rates.
    assert.equal(await page.locator('#thesis_charts svg').count(), 4);
    const follows = !/no winner follows/.test(await text()); // on a busy machine the frames may not tell
    assert.equal(await page.locator('#thesis_charts .bihive-costs .point').count(), follows ? 1 : 0);
    assert.match(await text(), /the cost of an inner node over that of a sphere test is .+, and that of a leaf over an inner node is .+(\. At these costs BIH 8 wins \d of 9|, so that no winner follows)/);
    // The pictures are smaller than the text's.
    assert.doesNotMatch(await page.textContent('#thesis_charts'), /iPhone 5s, stated/);
    const [json] = await Promise.all([page.waitForEvent('download'), page.click('#thesis_json')]);
    const result = JSON.parse(readFileSync(await json.path(), 'utf8'));
    assert.equal(result.engine, engine);
    assert.equal(result.complete, true);
    assert.equal(result.configurations.length, 54);
    assert.deepEqual(result.configurations.slice(0, kept.configurations.length), kept.configurations);
    assert.match(result.gpu, /SwiftShader/i);
    assert.match(result.browser, /Chrom/);
    assert.match(result.screen, /^\d+ x \d+, [\d.]+ pixels each$/);
    assert.ok(result.device.includes(result.gpu) && result.device.includes(result.browser));
    assert.ok(result.drift > 0);
    assert.ok(result.costs.test_ns > 0 && result.costs.wins >= 0 && result.costs.configurations === 9);
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

test('frames shown a second are counted', async () => {
  const { page, context, complaints } = await open_page(browser, `${server.url}?quick`, {
    viewport: { width: 800, height: 400 },
  });
  await draw_a_little_by_gpu(page); // the frames are the CPU's all the same
  await close_card(page);
  const before = await page.locator('#gpu_canvas').screenshot();
  await page.click('#thesis_open');
  await page.click('#thesis_shown');
  await page.waitForFunction(() => /^Scenario \d, \d+ spheres, (wide engine|BIH 8), (turning|at rest)$/.test(document.querySelector('#thesis_text').textContent));
  await page.click('#thesis_cancel');
  await page.waitForFunction(() => /^Cancelled/.test(document.querySelector('#thesis_text').textContent));
  await page.click('#thesis_shown');
  await page.waitForFunction(() => /^36 measurements, [\d.]+ to [\d.]+ frames shown per second/.test(document.querySelector('#thesis_text').textContent));
  const [json] = await Promise.all([page.waitForEvent('download'), page.click('#thesis_json')]);
  assert.equal(json.suggestedFilename(), 'bihive-shown-frames.json');
  const shown = JSON.parse(readFileSync(await json.path(), 'utf8'));
  assert.deepEqual([shown.experiment, shown.by, shown.complete], ['shown-frames', 'page', true]);
  assert.deepEqual([shown.width_px, shown.height_px], [1136, 640]);
  assert.equal(shown.configurations.length, 36);
  // A page shows no more than its screen does; 60 here, and frames are whole.
  for (const { fps, frames, seconds } of shown.configurations) {
    assert.ok(frames >= 1 && Math.abs(fps - frames / seconds) < 1e-9);
    assert.ok(fps < 75, `${fps} frames a second`);
  }
  await page.click('#thesis_close');
  await settled(page);
  await page.waitForSelector('#gpu_canvas:not([hidden])');
  await close_card(page);
  assert.ok((await compare(page, before, await page.locator('#gpu_canvas').screenshot(), 2)).share < 0.01);
  no_complaints(complaints);
  await context.close();
});
