// The page as one file: opened without a server and without a network, with engine and data inside.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';
import {
  and_settle, assert_same_picture, folder, launch, native_picture, no_complaints, open_own, open_page, saved_picture, scratch,
  set_value, settled, shown_error, with_cards,
} from './page_kit.mjs';
import { dcd } from './page_files.mjs';
import { serve } from './page_server.mjs';

const water = join(scratch, 'w & "water".xyz');
const points = join(scratch, 'many.xyz.gz');
let browser, server;
before(async () => {
  writeFileSync(water, '3\nwater\nO 0 0 0\nH 0.96 0 0\nH -0.24 0.93 0\n');
  const lines = Array.from({ length: 3000 }, (_, i) => `C ${i % 15} ${Math.floor(i / 15) % 15} ${Math.floor(i / 225)}`);
  writeFileSync(points, gzipSync(`3000\ngrid\n${lines.join('\n')}\n`));
  browser = await launch();
  server = await serve(folder, { isolated: false });
});
after(async () => {
  await browser?.close();
  server?.close();
});

/** What `bihive web INPUT --html` writes. */
function written(name, ...words) {
  const file = join(scratch, name);
  execFileSync(process.env.BIHIVE, ['web', ...words, '--html', file], { env: { ...process.env, BIHIVE_PAGE: folder } });
  return file;
}

async function open_file(file, options = {}) {
  const context = await browser.newContext({ viewport: { width: 900, height: 600 }, acceptDownloads: true, offline: true, ...options });
  context.setDefaultTimeout(300_000);
  const page = with_cards(await context.newPage());
  const complaints = [];
  page.on('console', (message) => message.type() === 'error' && complaints.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`script: ${error.message}`));
  context.on('request', (request) => /^(file|data|blob):/.test(request.url()) || complaints.push(`a request: ${request.url()}`));
  await page.goto(pathToFileURL(file).href);
  return { context, page, complaints };
}

async function save_page(page, name) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save_page')]);
  const file = join(scratch, name);
  copyFileSync(await download.path(), file);
  return { file, name: download.suggestedFilename() };
}

const style_of = (page) => page.$eval('#style input:checked', ({ value }) => value);

test('the page without data is one file of at most 2 MB, which shows the molecule', async () => {
  const file = join(folder, 'one_file.html');
  assert.ok(statSync(file).size <= 2e6, `${statSync(file).size} bytes`);
  assert.doesNotMatch(readFileSync(file, 'utf8').replace(/<style>[^]*?<\/style>/, ''), /<[^>]* (src|href)="(?!data:|#)/);
  const { context, page, complaints } = await open_file(file);
  await settled(page);
  assert.match(await page.textContent('#facts'), /demo: /);
  assert.ok(await page.isHidden('#copy_link'));
  console.log(`first picture from a file: ${(await page.evaluate(() => performance.getEntriesByName('first picture')[0].startTime)).toFixed(0)} ms`);
  await page.screenshot({ path: join(scratch, 'one-file.png') });
  no_complaints(complaints);
  await context.close();
});

for (const [name, input, words] of [
  ['a file', water, ['--style', 'studio', '--eye', '2,3,9', '--look-at', '0,0.3,0', '--background', '#203040']],
  ['a packed file', points, ['--radius', '0.3', '--colour-by', 'z', '--eye', '30,40,50', '--look-at', '7,7,6']],
  ['a built-in scene', 'scenario2', ['--count', '500', '--recursion', '3']],
])
  test(`bihive web --html writes ${name} as one page, which draws the bits of bihive render`, async () => {
    const file = written('written.html', input, ...words);
    const { context, page, complaints } = await open_file(file);
    await settled(page);
    assert_same_picture(await saved_picture(page, 300, 200), native_picture(input, 'written', ...words, '--size', '300x200', '--no-metadata'), name);
    no_complaints(complaints);
    await context.close();
  });

test('what the page shows is saved as one page, and again from that', async () => {
  const { page, context, complaints } = await open_page(browser, server.url);
  await open_own(page, water, '3 spheres');
  await and_settle(page, () => page.check('#style input[value=glossy]', { force: true }));
  await and_settle(page, () => page.click('button[data-side=back]'));
  const shown = await saved_picture(page, 240, 160);
  const saved = await save_page(page, 'saved.html');
  assert.equal(saved.name, 'w & _water_.html');
  no_complaints(complaints);
  await context.close();

  const first = await open_file(saved.file, { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true });
  await settled(first.page);
  assert.match(await first.page.textContent('#facts'), /^w & "water"\.xyz: 3 spheres, XYZ/);
  assert.equal(await style_of(first.page), 'glossy');
  await first.page.screenshot({ path: join(scratch, 'one-file-phone.png') });
  await first.context.close();

  const wide = await open_file(saved.file);
  await settled(wide.page);
  assert_same_picture(await saved_picture(wide.page, 240, 160), shown, 'opened');
  await and_settle(wide.page, () => set_value(wide.page, '#fov', 70));
  const again = await save_page(wide.page, 'again.html');
  const other = await saved_picture(wide.page, 240, 160);
  no_complaints(wide.complaints);
  await wide.context.close();

  // A page that is served opens it, too, with data and state.
  const served = await open_page(browser, server.url);
  await open_own(served.page, again.file, '3 spheres');
  assert.equal(await style_of(served.page), 'glossy');
  assert_same_picture(await saved_picture(served.page, 240, 160), other, 'opened by a page');
  await served.page.setInputFiles('#file', { name: 'other.html', mimeType: 'text/html', buffer: Buffer.from('<p>Hello</p>') });
  assert.match(await shown_error(served.page), /other\.html is no page that bihive saved/);
  no_complaints(served.complaints);
  await served.context.close();

  const last = await open_file(again.file);
  await settled(last.page);
  assert_same_picture(await saved_picture(last.page, 240, 160), other, 'opened again');
  // A file of the reader's own works there too.
  await open_own(last.page, points, '3,000 spheres');
  no_complaints(last.complaints);
  await last.context.close();
});

test('a widget of a notebook tells Python of camera and pins, and takes a camera', async () => {
  const html = readFileSync(written('widget.html', water, '--eye', '0,0,9', '--look-at', '0,0,0'));
  const module = readFileSync(join(process.env.SOURCE, 'bindings/python/bihive/_widget.js'), 'utf8');
  const file = join(scratch, 'widget-frame.html');
  writeFileSync(file, '<!doctype html><div id="cell" style="width: 700px"></div>');
  const { context, page, complaints } = await open_file(file);
  // The part of a model that anywidget gives to render().
  await page.evaluate(async ([text, base64]) => {
    const { default: widget } = await import(URL.createObjectURL(new Blob([text], { type: 'text/javascript' })));
    const bytes = Uint8Array.from(atob(base64), (byte) => byte.charCodeAt(0));
    const state = { name: 'water', height: 500, page: new DataView(bytes.buffer), camera: {}, pins: [], picked: null };
    const listeners = new Set();
    window.saved = 0;
    window.model = {
      get: (name) => state[name],
      set: (name, value) => (state[name] = value),
      save_changes: () => ++window.saved,
      on: (event, listener) => event === 'change:camera' && listeners.add(listener),
      off: (event, listener) => listeners.delete(listener),
      of_python: (camera) => {
        state.camera = camera;
        for (const listener of listeners) listener();
      },
      listeners,
    };
    window.end = widget.render({ model: window.model, el: document.getElementById('cell') });
  }, [module, html.toString('base64')]);
  await page.waitForSelector('iframe[title=water]');
  const frame = with_cards(await (await page.$('iframe')).contentFrame());
  await frame.waitForSelector('#picture[data-settled=true]');
  const value = (name) => page.evaluate((called) => window.model.get(called), name);
  await page.waitForFunction(() => window.model.get('camera').eye?.[2] === 9 && window.saved > 0);
  await frame.focus('#picture');
  await page.keyboard.press('ArrowLeft');
  await page.waitForFunction(() => window.model.get('camera').eye[2] !== 9);
  await frame.waitForSelector('#picture[data-settled=true]');
  const turned = (await value('camera')).eye;
  // Python looks from elsewhere; the page does not send the same camera for ever.
  await page.evaluate(() => window.model.of_python({ eye: [0, 9, 1], look_at: [0, 0, 0] }));
  await page.waitForFunction(() => window.model.get('camera').eye[1] === 9 && window.model.get('camera').projection);
  assert.notDeepEqual(turned, (await value('camera')).eye);
  await frame.waitForSelector('#picture[data-settled=true]');
  await frame.focus('#picture');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => window.model.get('pins').length === 1);
  const picked = await value('picked');
  assert.deepEqual(await value('pins'), [picked.sphere]);
  assert.equal(picked.attributes.element, 'H', 'which is before the oxygen, seen from above');
  await page.keyboard.press('Escape');
  await page.waitForFunction(() => window.model.get('pins').length === 0 && window.model.get('picked') === null);
  await page.evaluate(() => window.end());
  assert.equal(await page.evaluate(() => window.model.listeners.size), 0);
  no_complaints(complaints);
  await context.close();
});

test('in the frame of a notebook, which gives it no origin, it works, and saves pictures', async () => {
  const words = ['--style', 'studio', '--eye', '2,3,9', '--look-at', '0,0.3,0'];
  const html = readFileSync(written('notebook.html', water, ...words), 'utf8');
  const escaped = html.replace(/[&<>"]/g, (one) => `&#${one.charCodeAt(0)};`);
  const file = join(scratch, 'notebook-frame.html');
  // As bihive.Page of Python writes it.
  writeFileSync(file, `<!doctype html><iframe sandbox="allow-scripts allow-downloads" style="width: 100%; height: 520px" srcdoc="${escaped}"></iframe>`);
  const { context, page, complaints } = await open_file(file);
  const frame = with_cards(page.frames().find((one) => one.parentFrame() === page.mainFrame()));
  await frame.waitForSelector('#picture[data-settled=true]');
  assert.match(await frame.textContent('#facts'), /3 spheres, XYZ/);
  await frame.fill('#save_width', '120');
  await frame.fill('#save_height', '80');
  const [download] = await Promise.all([page.waitForEvent('download'), frame.click('#save')]);
  assert_same_picture(readFileSync(await download.path()), native_picture(water, 'notebook', ...words, '--size', '120x80', '--no-metadata'), 'of a notebook');
  await page.screenshot({ path: join(scratch, 'notebook.png') });
  no_complaints(complaints);
  await context.close();
});

test('a trajectory is in the page that bihive web --html writes', async () => {
  const run = join(scratch, 'walk.dcd');
  writeFileSync(run, dcd([0, 1, 2, 3].map((i) => [[0, 0, 0], [0.96 + i, 0, 0], [-0.24, 0.93, 0]])));
  const { context, page, complaints } = await open_file(written('walk.html', water, '--trajectory', run));
  await settled(page);
  assert.match(await page.textContent('#facts'), /4 frames/);
  await page.click('#player_on');
  await page.waitForSelector('#player[data-frame="1"]');
  no_complaints(complaints);
  await context.close();
});

test('where the page was built without the one file, saving says so', async () => {
  const partial = await serve(folder, { isolated: false, files: { '/one_file.html': join(scratch, 'absent') } });
  const { page, context } = await open_page(browser, partial.url);
  await page.click('#save_page');
  assert.match(await shown_error(page), /could not be saved: it was built without one_file\.html/);
  await context.close();
  partial.close();
});
