// The web component <bihive-viewer> as npm packs it, in pages of other people.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { compare, decoded, folder, native_picture, scratch, settled, small, source, with_page } from './page_kit.mjs';
import { serve } from './page_server.mjs';

const kit = with_page();
const root = join(scratch, 'packed', 'package');
const patience_ms = 300_000;

// Two spheres side by side, seen from the front: the left one is grey, the right one too.
const two = 'x,y,z,r,charge\n0,0,0,1,1\n3,0,0,1,2\n';

before(() => {
  const packed = join(scratch, 'packed');
  mkdirSync(packed, { recursive: true });
  execFileSync(join(source, 'scripts/pack_viewer'), [folder, packed], { stdio: ['ignore', 'ignore', 'inherit'] });
  const [archive] = readdirSync(packed).filter((name) => name.endsWith('.tgz'));
  execFileSync('tar', ['xzf', archive], { cwd: packed });
  writeFileSync(join(root, 'two.csv'), two);
});

/** Opens a page with this body, in which a viewer is 320 by 240: {page, frame, close}. Events are kept in `heard`. */
async function open_host(body, options = {}) {
  writeFileSync(
    join(root, 'own.html'),
    '<!doctype html><title>own</title><script type="module" src="bihive-viewer.js"></script>' +
      '<style>body { margin: 0; } bihive-viewer { width: 320px; height: 240px; }</style>' + body,
  );
  const asked = [];
  const server = await serve(root, { asked: (path) => asked.push(path) });
  const context = await kit.browser.newContext({ ...small, ...options });
  context.setDefaultTimeout(patience_ms);
  const page = await context.newPage();
  const complaints = [];
  // The example has no icon.
  page.on('console', (message) => {
    if (message.type() === 'error' && !message.location().url.endsWith('/favicon.ico')) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(error.message));
  await page.addInitScript(() => {
    globalThis.heard = [];
    for (const type of ['load', 'error', 'camera', 'pick'])
      addEventListener(`bihive-${type}`, ({ detail }) => globalThis.heard.push({ type, detail }));
  });
  await page.goto(`${server.url}own.html`);
  const close = async () => {
    await context.close();
    server.close();
  };
  return { page, context, asked, complaints, close, url: server.url };
}

const heard = (page, type) => page.evaluate((wanted) => globalThis.heard.filter((one) => one.type === wanted).map(({ detail }) => detail), type);

/** Waits for the next event of a type after `work`; resolves to its detail. */
async function next(page, type, work) {
  const count = (await heard(page, type)).length;
  await work();
  await page.waitForFunction(
    ([wanted, before]) => globalThis.heard.filter((one) => one.type === wanted).length > before, [type, count], { timeout: patience_ms });
  return (await heard(page, type))[count];
}

const loaded = (page, count = 1) =>
  page.waitForFunction((least) => globalThis.heard.filter(({ type }) => type === 'load').length >= least, count, { timeout: patience_ms });

const frames_of = (page) => page.frames().filter((one) => one.url().includes('/page/'));

/** The frame, when all of its picture is drawn. */
async function drawn(page) {
  await loaded(page);
  const [frame] = frames_of(page);
  await settled(frame);
  return frame;
}

// A change of an attribute, until it is drawn.
async function change(page, frame, attributes) {
  await frame.evaluate(() => (document.getElementById('picture').dataset.settled = 'false'));
  await page.evaluate((changes) => {
    const viewer = document.querySelector('bihive-viewer');
    for (const [name, text] of Object.entries(changes)) text === null ? viewer.removeAttribute(name) : viewer.setAttribute(name, text);
  }, attributes);
  await settled(frame);
}

const camera_of = (page) => page.evaluate(() => document.querySelector('bihive-viewer').camera);

const pixel = (png, x, y) => {
  const { width, channels, bytes } = decoded(png);
  return [...bytes.subarray((y * width + x) * channels, (y * width + x) * channels + 3)];
};

test('the packed component shows a file in a few lines, and says what came of it', async () => {
  for (const name of ['bihive-viewer.d.ts', 'README.md', 'LICENSE', 'example.html']) assert.ok(existsSync(join(root, name)), name);
  const { page, complaints, close, url } = await open_host('<bihive-viewer src="two.csv" look="flat"></bihive-viewer>');
  await drawn(page);
  assert.deepEqual(await heard(page, 'load'), [{ name: 'two.csv', format: 'CSV', spheres: 2, frames: 1 }]);
  const shown = await page.locator('bihive-viewer').screenshot({ path: join(scratch, 'viewer-shown.png') });
  const native = native_picture(join(root, 'two.csv'), 'viewer', '--style', 'flat', '--size', '320x240');
  const { width, height, share } = await compare(page, shown.toString('base64'), native.toString('base64'), 24);
  assert.deepEqual([width, height], [320, 240]);
  assert.ok(share < 0.01, `${share} of the pixels differ from the picture of bihive render`);

  await page.goto(`${url}example.html`);
  const frame = await drawn(page);
  assert.equal((await heard(page, 'load'))[0].spheres, 1631);
  assert.equal(await frame.isVisible('#bar'), false, 'the picture alone');
  assert.equal(await frame.inputValue('input[name=style]:checked'), 'illustrative');
  assert.deepEqual(complaints, []);
  await close();
});

test('attributes change the picture in place, and the camera stays', async () => {
  const { page, close } = await open_host('<bihive-viewer src="two.csv"></bihive-viewer>');
  const frame = await drawn(page);
  await frame.evaluate(() => (globalThis.same = true));
  await page.evaluate(() => (document.querySelector('bihive-viewer').camera = { eye: [1.5, 2, 9], look_at: [1.5, 0, 0] }));
  await page.waitForFunction(() => document.querySelector('bihive-viewer').camera.eye[1] === 2);
  const camera = await camera_of(page);
  for (const [name, text] of [['look', 'flat'], ['background', '#ff0000'], ['colour-by', 'charge'], ['radius', '0.5'], ['colour-by', null]]) {
    await change(page, frame, { [name]: text });
    assert.ok(await frame.evaluate(() => globalThis.same), `${name} keeps the frame`);
    assert.deepEqual(await camera_of(page), camera, `${name} keeps the camera`);
    assert.equal(frames_of(page).length, 1);
  }
  assert.equal(await frame.inputValue('input[name=style]:checked'), 'flat');
  assert.deepEqual(pixel(await page.locator('bihive-viewer').screenshot(), 3, 3), [255, 0, 0]);
  assert.equal(await frame.inputValue('#radius'), '0.5');

  // Another file in the same frame has its own camera, and the same look.
  await next(page, 'load', () => page.evaluate(() => (document.querySelector('bihive-viewer').src = '1hpv.pdb')));
  await settled(frame);
  assert.ok(await frame.evaluate(() => globalThis.same));
  assert.notDeepEqual(await camera_of(page), camera);
  assert.equal(await frame.inputValue('input[name=style]:checked'), 'flat');

  // Parts beside the picture.
  assert.equal(await frame.isVisible('#badge'), false);
  await page.evaluate(() => document.querySelector('bihive-viewer').setAttribute('badge', ''));
  await frame.waitForSelector('#badge', { state: 'visible' });
  await page.evaluate(() => document.querySelector('bihive-viewer').setAttribute('panel', ''));
  await frame.waitForSelector('#bar', { state: 'visible' });
  assert.deepEqual(await heard(page, 'error'), []);
  await close();
});

test('unknown values of attributes are told, with the one that is near', async () => {
  const { page, close } = await open_host('<bihive-viewer src="two.csv" look="ilustrative" background="#00ff00"></bihive-viewer>');
  const frame = await drawn(page);
  await page.waitForFunction(() => globalThis.heard.some(({ type }) => type === 'error'), null, { timeout: patience_ms });
  assert.match((await heard(page, 'error'))[0].message, /no style "ilustrative".*did you mean "illustrative"/);
  await settled(frame);
  await page.waitForTimeout(500);
  await settled(frame);
  assert.deepEqual(pixel(await page.locator('bihive-viewer').screenshot(), 316, 236), [0, 255, 0], 'the right attribute is taken');
  assert.equal((await heard(page, 'error')).length, 1);
  const set = (name, text) =>
    next(page, 'error', () => page.evaluate(([one, to]) => document.querySelector('bihive-viewer').setAttribute(one, to), [name, text]));
  assert.match((await set('look', 'flatt')).message, /did you mean "flat"/);
  assert.match((await set('background', 'whitee')).message, /background:.*did you mean "white"/);
  assert.match((await set('colour-by', 'chargee')).message, /did you mean 'charge'/);
  assert.match((await set('radius', 'big')).message, /radius="big": expected a number from 0/);
  assert.match((await set('columns', 'x=q')).message, /q/);
  assert.match((await set('src', 'missing.pdb')).message, /missing\.pdb/);
  assert.match((await set('src', 'http://[')).message, /is not an address/);
  await close();
});

test('the page shows through a transparent picture, in light and dark', async () => {
  for (const colorScheme of ['light', 'dark']) {
    const { page, close } = await open_host(
      '<style>body { background: #40e0d0; }</style><bihive-viewer src="two.csv" look="flat" background="transparent"></bihive-viewer>', { colorScheme });
    const frame = await drawn(page);
    const shown = await page.locator('bihive-viewer').screenshot({ path: join(scratch, `viewer-transparent-${colorScheme}.png`) });
    assert.deepEqual(pixel(shown, 3, 3), [0x40, 0xe0, 0xd0], colorScheme);
    assert.deepEqual(pixel(shown, 160, 5), [0x40, 0xe0, 0xd0], colorScheme);
    assert.notDeepEqual(pixel(shown, 80, 120), [0x40, 0xe0, 0xd0], 'a sphere is opaque');
    const saved = await page.evaluate(async () => {
      const blob = await document.querySelector('bihive-viewer').toBlob();
      return [...new Uint8Array(await blob.arrayBuffer())];
    });
    assert.equal(decoded(Buffer.from(saved)).bytes[3], 0, 'a saved picture is transparent, too');
    if (colorScheme === 'light') {
      await frame.evaluate(() => {
        document.getElementById('picture').dataset.settled = 'false';
        document.querySelector('#engine input[value=gpu]').click();
      });
      await frame.waitForSelector('#gpu_canvas:not([hidden])', { state: 'attached' });
      await settled(frame);
      const by_gpu = await page.locator('bihive-viewer').screenshot({ path: join(scratch, 'viewer-transparent-gpu.png') });
      assert.deepEqual(pixel(by_gpu, 3, 3), [0x40, 0xe0, 0xd0]);
      const { share } = await compare(page, shown, by_gpu, 40);
      assert.ok(share < 0.01, `${share} of the pixels differ from the CPU's`);
    }
    await close();
  }
});

test('wheel and swipe scroll the page, unless the viewer is active', async () => {
  const { page, context, close } = await open_host(
    '<div style="height: 3000px"><bihive-viewer src="two.csv" look="flat"></bihive-viewer><button style="display: block">Other</button></div>',
    { hasTouch: true });
  const frame = await drawn(page);
  const scrolled = () => page.evaluate(() => Math.round(scrollY));
  const is_active = () => page.evaluate(() => document.querySelector('bihive-viewer').active);
  const wheel = async (by) => {
    await page.mouse.move(160, 60);
    await page.mouse.wheel(0, by);
    await page.waitForTimeout(400);
  };
  const home = async () => {
    await page.evaluate(() => scrollTo(0, 0));
    await page.waitForTimeout(100);
  };
  const start = await camera_of(page);

  await wheel(40);
  assert.equal(await scrolled(), 40, 'the wheel scrolls the page');
  await home();
  const touch = await context.newCDPSession(page);
  const finger = (type, y) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: y === null ? [] : [{ x: 160, y }] });
  await finger('touchStart', 200);
  for (let y = 190; y >= 120; y -= 10) await finger('touchMove', y);
  // A finger that rests before it is lifted leaves no momentum.
  await page.waitForFunction(() => scrollY > 20);
  await page.waitForTimeout(500);
  await finger('touchMove', 120);
  await page.waitForTimeout(300);
  await finger('touchEnd', null);
  await page.waitForTimeout(500);
  assert.deepEqual(await camera_of(page), start, 'and nothing turns');
  await home();

  await page.mouse.click(160, 60);
  assert.equal(await is_active(), true);
  await next(page, 'camera', () => wheel(40));
  assert.equal(await scrolled(), 0, 'the wheel zooms');
  assert.notDeepEqual(await camera_of(page), start);
  await page.keyboard.press('Escape');
  await page.waitForFunction(() => !document.querySelector('bihive-viewer').active);
  const after = await camera_of(page);
  await wheel(40);
  assert.equal(await scrolled(), 40, 'Escape ends it');
  assert.deepEqual(await camera_of(page), after);
  await home();

  await page.mouse.click(160, 60);
  await page.waitForFunction(() => document.querySelector('bihive-viewer').active);
  await frame.waitForFunction(() => document.hasFocus());
  await page.evaluate(() => document.querySelector('button').focus({ preventScroll: true }));
  await page.waitForFunction(() => !document.querySelector('bihive-viewer').active);
  assert.equal(await is_active(), false, 'a lost focus ends it');

  await page.evaluate(() => document.querySelector('bihive-viewer').setAttribute('interactive', ''));
  await next(page, 'camera', () => wheel(40));
  assert.equal(await scrolled(), 0, 'with `interactive` it is always active');
  await close();
});

test('several viewers share one module, and one that is taken away gives its memory back', async () => {
  const { page, asked, complaints, close } = await open_host(
    '<bihive-viewer src="two.csv" look="flat"></bihive-viewer><bihive-viewer src="1hpv.pdb" look="flat"></bihive-viewer><bihive-viewer look="flat"></bihive-viewer>');
  await loaded(page, 3);
  for (const frame of frames_of(page)) await settled(frame);
  assert.equal(asked.filter((path) => path.endsWith('bihive.wasm')).length, 1, 'one download');
  const devtools = await kit.browser.newBrowserCDPSession();
  const workers = async () => {
    const { targetInfos } = await devtools.send('Target.getTargets', { filter: [{ type: 'worker' }] });
    return targetInfos.filter(({ url }) => url.startsWith(new URL(page.url()).origin)).length;
  };
  const all = await workers();
  assert.ok(all >= 3, `${all} workers`);
  await page.evaluate(() => document.querySelector('bihive-viewer').remove());
  await page.waitForTimeout(1000);
  assert.equal(frames_of(page).length, 2);
  assert.equal(await workers(), (all / 3) * 2);
  await page.evaluate(() => document.querySelectorAll('bihive-viewer').forEach((viewer) => viewer.remove()));
  await page.waitForTimeout(1000);
  assert.equal(page.frames().length, 1, 'nothing is left of viewers that are taken away');
  assert.equal(await workers(), 0);

  // One that comes later works as the first.
  await next(page, 'load', () => page.evaluate(() => document.body.append(document.createElement('bihive-viewer'))));
  assert.equal(asked.filter((path) => path.endsWith('bihive.wasm')).length, 2, 'the module was not kept either');
  assert.deepEqual(complaints, []);
  await close();
});

test('methods: data, camera, pick and picture', async () => {
  const { page, complaints, close } = await open_host('<bihive-viewer look="flat" interactive></bihive-viewer>');
  await drawn(page);
  const [frame] = frames_of(page);
  const in_viewer = (work, argument) => page.evaluate(`(${work})(document.querySelector('bihive-viewer'), ${JSON.stringify(argument)})`);

  const facts = await in_viewer((viewer, text) => viewer.load(text, { name: 'two.csv' }), two);
  assert.deepEqual(facts, { name: 'two.csv', format: 'CSV', spheres: 2, frames: 1 });
  assert.deepEqual((await heard(page, 'load')).at(-1), facts);
  assert.equal((await in_viewer((viewer, text) => viewer.load(new TextEncoder().encode(text).buffer, { name: 'b.csv' }), two)).name, 'b.csv');
  assert.equal((await in_viewer((viewer, text) => viewer.load(new File([text], 'c.csv')), two)).name, 'c.csv');
  assert.equal((await in_viewer((viewer, text) => viewer.load(text), two)).spheres, 2, 'without a name');
  const fault = await in_viewer((viewer) => viewer.load('nothing', { name: 'bad.csv' }).then(() => '', (error) => error.message));
  assert.match(fault, /bad\.csv/);
  assert.equal((await heard(page, 'error')).at(-1).message, fault);
  const both = await in_viewer(async (viewer, text) => {
    const first = viewer.load(text, { name: 'first.csv' }).then(() => 'shown', (error) => error.message);
    const second = await viewer.load(text, { name: 'second.csv' });
    return [await first, second.name];
  }, two);
  assert.deepEqual(both, ['Another file was opened meanwhile', 'second.csv']);

  // A camera that is set is that of the picture, and of the next answer.
  await next(page, 'camera', () => in_viewer((viewer) => void (viewer.camera = { eye: [1.5, 0, 10], look_at: [1.5, 0, 0], up: [0, 1, 0], fov_deg: 40 })));
  await page.waitForFunction(() => document.querySelector('bihive-viewer').camera.eye[2] === 10);
  assert.deepEqual((await camera_of(page)).look_at, [1.5, 0, 0]);
  const x_of = (x) => 160 + ((x - 1.5) / (Math.tan((20 * Math.PI) / 180) * 9)) * 120;
  const picked = await in_viewer((viewer, x) => viewer.pick(x, 120), x_of(3));
  assert.equal(picked.sphere, 1);
  assert.deepEqual(picked.centre, [3, 0, 0]);
  assert.equal(picked.radius, 1);
  assert.equal(picked.attributes.charge, 2);
  assert.equal(await in_viewer((viewer) => viewer.pick(2, 2)), null);

  // A click asks, a drag turns.
  const click = await next(page, 'pick', () => page.mouse.click(x_of(0), 120));
  assert.equal(click.picked.sphere, 0);
  assert.ok(Math.abs(click.x - x_of(0)) <= 1 && click.y === 120, JSON.stringify(click));
  const picks = (await heard(page, 'pick')).length;
  const turned = await next(page, 'camera', async () => {
    await page.mouse.move(160, 120);
    await page.mouse.down();
    await page.mouse.move(200, 130, { steps: 4 });
    await page.mouse.up();
  });
  assert.notDeepEqual(turned.eye, [1.5, 0, 10]);
  await settled(frame);
  assert.equal((await heard(page, 'pick')).length, picks);

  const sizes = await in_viewer(async (viewer) => {
    const blobs = await Promise.all([viewer.toBlob(), viewer.toBlob({ width: 64, height: 48 })]);
    const bitmaps = await Promise.all(blobs.map((blob) => createImageBitmap(blob)));
    return [blobs[0].type, ...bitmaps.flatMap(({ width, height }) => [width, height])];
  });
  assert.deepEqual(sizes, ['image/png', 320, 240, 64, 48]);
  assert.match(await in_viewer((viewer) => viewer.toBlob({ width: 0, height: 48 }).then(() => '', (error) => error.message)), /./);
  assert.deepEqual(complaints, []);
  await close();
});

test('its types hold what the component has', async () => {
  const file = join(scratch, 'typed.ts');
  writeFileSync(
    file,
    `import type { BihiveViewer, LoadedSpheres, Picked, ViewerCamera } from '${join(root, 'bihive-viewer.js')}';
export async function use(viewer: BihiveViewer, file: File): Promise<void> {
  const facts: LoadedSpheres = await viewer.load(file);
  await viewer.load('0 0 0', { name: facts.name, trajectory: file });
  await viewer.load(new ArrayBuffer(8));
  const camera: ViewerCamera | null = viewer.camera;
  viewer.camera = { eye: [0, 0, 1] };
  const picked: Picked | null = await viewer.pick(1, 2);
  const blob: Blob = await viewer.toBlob({ width: 10, height: 10 });
  viewer.active = picked === null && camera === null && blob.size === 0;
  viewer.addEventListener('bihive-pick', ({ detail }) => console.log(detail.x, detail.picked?.attributes['chain']));
  viewer.addEventListener('bihive-camera', ({ detail }) => console.log(detail.eye[0]));
  document.querySelector('bihive-viewer')!.addEventListener('bihive-error', ({ detail }) => console.log(detail.message));
}
`,
  );
  execFileSync(join(source, 'web/node_modules/.bin/tsc'),
    ['--noEmit', '--strict', '--target', 'es2022', '--module', 'esnext', '--moduleResolution', 'bundler', '--lib', 'es2022,dom', file],
    { stdio: ['ignore', 'inherit', 'inherit'] });
  const viewer = readFileSync(join(root, 'bihive-viewer.js'), 'utf8');
  const described = readFileSync(join(root, 'README.md'), 'utf8');
  for (const name of viewer.match(/observedAttributes = \[(.*)\]/)[1].match(/[a-z-]+/g))
    assert.ok(described.includes(`\`${name}\``), `README.md leaves out the attribute ${name}`);
});
