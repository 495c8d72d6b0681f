// The page in a real browser, as a desktop's user sees it: pictures, controls, files, links, errors.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { gzipSync } from 'node:zlib';
import { made_files, points_in_a_cube, ways_in } from './page_files.mjs';
import {
  and_settle, compare, folder, launch, link_state, native_picture, no_complaints, open_page, saved_picture, scratch,
  set_value, settled, shown_error, small, source,
} from './page_kit.mjs';
import { serve } from './page_server.mjs';

let browser, server, plain;
before(async () => {
  const files = {};
  for (const { name, bytes } of made_files) writeFileSync((files[`/file/${name}`] = join(scratch, name)), bytes);
  browser = await launch();
  server = await serve(folder, { files });
  plain = await serve(folder, { isolated: false, files });
});
after(async () => {
  await browser?.close();
  server?.close();
  plain?.close();
});

// The module without threads is a build of its own: run_page_test says whether it is there.
const modes = process.env.ONE_THREAD ? [['no threads', true]] : [['threads', false]];

// Speed is measured by the benchmark (scripts/bench page), because other tests may keep the machine busy.
for (const [name, is_plain] of modes)
  test(`the molecule comes without being asked for, with ${name}`, async () => {
    const { page, context, complaints } = await open_page(browser, (is_plain ? plain : server).url);
    const [time, isolated] = await page.evaluate(() => [
      performance.getEntriesByName('first picture')[0].startTime,
      crossOriginIsolated,
    ]);
    console.log(`first picture, ${name}: ${time.toFixed(0)} ms`);
    assert.equal(isolated, !is_plain);
    assert.match(await page.textContent('#about'), is_plain ? /one thread/ : /[2-9]\d* threads|one thread/);
    assert.match(await page.textContent('#facts'), /1,\d+ spheres, PDB/);
    no_complaints(complaints);
    await context.close();
  });

for (const [name, is_plain] of modes)
  test(`the CPU engine's pictures are the program's own, with ${name}`, async () => {
    const { page, context, complaints } = await open_page(browser, (is_plain ? plain : server).url);
    for (const [scene, options] of [['four-spheres', []], ['scenario3', ['--count', '256']]]) {
      await and_settle(page, () => page.selectOption('#built_in', scene));
      if (options.length) await and_settle(page, () => set_value(page, '#count', options[1]));
      const native = native_picture(scene, scene, '--size', '320x200', '--samples', '1', '--recursion', '5', ...options);
      await set_value(page, '#samples_per_pixel', 1);
      await and_settle(page, () => set_value(page, '#recursion', 5));
      const here = await saved_picture(page, 320, 200);
      assert.deepEqual(await compare(page, native, here, 0), { width: 320, height: 200, share: 0 }, scene);
    }
    no_complaints(complaints);
    await context.close();
  });

for (const [name, is_plain] of modes)
  test(`150,000 points without radii, with ${name}`, async () => {
    const { page, context, complaints } = await open_page(browser, (is_plain ? plain : server).url, small);
    const file = join(scratch, 'many.csv');
    writeFileSync(file, points_in_a_cube(150_000));
    await and_settle(page, () => page.setInputFiles('#file', file));
    await set_value(page, '#samples_per_pixel', 1);
    assert.match(await page.textContent('#facts'), /many\.csv: 150,000 spheres/);
    const native = native_picture(file, 'many', '--size', '96x64', '--samples', '1');
    assert.equal((await compare(page, native, await saved_picture(page, 96, 64), 0)).share, 0);
    no_complaints(complaints);
    await context.close();
  });

for (const [name, is_plain] of modes)
  test(`a figure of the molecule is verified, with ${name}`, async () => {
    const { page, context, complaints } = await open_page(browser, (is_plain ? plain : server).url, small);
    native_picture('demo', 'figure', '--size', '64x48', '--samples', '1');
    await page.setInputFiles('#file', join(scratch, 'figure.png'));
    await page.waitForFunction(() => /erified/.test(document.querySelector('#figures').textContent));
    assert.match(await page.textContent('#figures p'), /^figure\.png: drawn by bihive .* from demo\. Verified: the same bits/);
    no_complaints(complaints);
    await context.close();
  });

test('every control changes what it says', async () => {
  const { page, context, complaints } = await open_page(browser, server.url);
  const before = await link_state(page);
  assert.equal(before.source.built_in, 'demo');

  // Values.
  await set_value(page, '#recursion', 2);
  await set_value(page, '#samples_per_pixel', 1);
  await and_settle(page, () => page.click('#shadows'));
  let { settings } = await link_state(page);
  assert.deepEqual([settings.recursion, settings.samples_per_pixel, settings.shadows], [2, 1, !before.settings.shadows]);

  // The tree, with its table.
  const cell = (row, column) => page.textContent(`#statistics tbody tr:nth-child(${row}) td:nth-of-type(${column})`);
  await page.waitForSelector('#statistics tbody tr');
  const nodes = await cell(1, 1), bytes = await cell(5, 1);
  await and_settle(page, () => set_value(page, '#max_prims', 1));
  await page.waitForFunction((old) => document.querySelector('#statistics tbody td').textContent !== old, nodes);
  assert.ok(Number((await cell(5, 1)).replaceAll(',', '')) > Number(bytes.replaceAll(',', '')), 'a finer tree is larger');
  await and_settle(page, () => set_value(page, '#max_depth', 3));
  ({ settings } = await link_state(page));
  assert.deepEqual([settings.max_prims, settings.max_depth], [1, 3]);

  // Every view makes another picture.
  const seen = new Set();
  for (const view of ['shaded', 'recursion', 'traversal', 'normal', 'distance', 'id', 'tree']) {
    await and_settle(page, () => page.selectOption('#view', view));
    seen.add((await saved_picture(page, 96, 64)).toString('base64'));
  }
  assert.equal(seen.size, 7);
  await and_settle(page, () => page.selectOption('#view', 'normal'));

  // Every side another camera, and home the first one.
  const eyes = new Set();
  for (const side of await page.$$eval('.sides [data-side]', (all) => all.map(({ dataset }) => dataset.side))) {
    await and_settle(page, () => page.click(`[data-side=${side}]`));
    eyes.add(String((await link_state(page)).settings.camera.eye));
  }
  assert.equal(eyes.size, 7);
  await and_settle(page, () => page.click('#home'));
  const round = (camera) => JSON.stringify(camera, (_, value) => (typeof value === 'number' ? +value.toPrecision(6) : value));
  assert.equal(round((await link_state(page)).settings.camera), round(before.settings.camera));

  // The projection, which still shows all.
  await and_settle(page, () => page.selectOption('#projection', 'orthographic'));
  const native = native_picture('demo', 'parallel', '--projection', 'orthographic', '--size', '720x480', '--samples', '1',
    '--recursion', '2', '--view', 'normal');
  assert.equal((await compare(page, native, await saved_picture(page, 720, 480), 0)).share, 0);
  await and_settle(page, () => page.selectOption('#projection', 'perspective'));

  // Colours.
  for (const [theme, colour] of [['dark', 'rgb(16, 19, 23)'], ['light', 'rgb(244, 244, 241)']]) {
    await page.click(`#theme input[value=${theme}] + span`);
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), colour);
  }
  await page.click('#theme input[value=auto] + span');
  no_complaints(complaints);
  await context.close();
});

test('mouse, wheel and keys move the camera', async () => {
  const { page, context, complaints } = await open_page(browser, server.url);
  await and_settle(page, () => page.selectOption('#view', 'normal'));
  const camera = async () => (await link_state(page)).settings.camera;
  const length = (a, b) => Math.hypot(...a.map((value, i) => value - b[i]));
  const away = ({ eye, look_at }) => length(eye, look_at);
  const first = await camera();
  const drag = async (options = {}) => {
    if (options.key) await page.keyboard.down(options.key);
    await page.mouse.move(200, 300);
    await page.mouse.down({ button: options.button ?? 'left' });
    await page.mouse.move(300, 340, { steps: 4 });
    await page.mouse.up({ button: options.button ?? 'left' });
    if (options.key) await page.keyboard.up(options.key);
  };

  await and_settle(page, () => drag());
  const turned = await camera();
  assert.ok(length(turned.eye, first.eye) > 0.1 * away(first), 'a drag turns');
  assert.ok(away(turned) / away(first) > 1 - 1e-6 && away(turned) / away(first) < 2, 'and keeps all of it in view');
  for (const options of [{ button: 'right' }, { key: 'Shift' }]) {
    const old = await camera();
    await and_settle(page, () => drag(options));
    const now = await camera();
    assert.ok(length(now.look_at, old.look_at) > 0, 'a drag with the right button or Shift moves');
  }
  const wheel = async (by) => {
    await page.mouse.move(200, 300);
    await page.mouse.wheel(0, by);
  };
  for (const [act, nearer] of [
    [() => wheel(-200), true],
    [() => wheel(200), false],
    [() => page.press('#picture', '+'), true],
    [() => page.press('#picture', '-'), false],
  ]) {
    const old = away(await camera());
    await and_settle(page, act);
    assert.equal(away(await camera()) < old, nearer);
  }
  for (const key of ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'Shift+ArrowLeft']) {
    const old = await camera();
    await and_settle(page, () => page.press('#picture', key));
    assert.notDeepEqual(await camera(), old, key);
  }
  await and_settle(page, () => page.press('#picture', '6'));
  assert.equal((await link_state(page)).settings.view, 'id');
  await and_settle(page, () => page.press('#picture', 'Home'));
  assert.ok(Math.abs(away(await camera()) / away(first) - 1) < 1e-6);
  no_complaints(complaints);
  await context.close();
});

for (const [way, put] of Object.entries(ways_in))
  test(`files of every format, by ${way}`, async () => {
    const { page, context, complaints } = await open_page(browser, server.url);
    for (const file of made_files) {
      const { name, spheres, format } = file;
      await and_settle(page, () => put(page, file));
      const words = `${name}: ${spheres} ${spheres === 1 ? 'sphere' : 'spheres'}, ${format}`;
      assert.equal(await page.textContent('#facts'), words);
      // The comment of an XYZ file is its title.
      const title = /\.xyz/.test(name) ? (spheres === 4 ? 'ammonia' : 'carbon') : name;
      assert.equal(await page.getAttribute('#picture', 'aria-label'), `${title}, ${spheres} ${spheres === 1 ? 'sphere' : 'spheres'}`);
      const { source: from } = await link_state(page);
      assert.deepEqual(from, way === 'address' ? { url: `file/${name}` } : { file: name }, 'no link holds a file');
      // A built-in scene in between shows whether the file was really taken.
      if (name === 'four.xyz') await and_settle(page, () => page.selectOption('#built_in', 'four-spheres'));
    }
    no_complaints(complaints);
    await context.close();
  });

test('a molecule packed and not, as large as they are', async () => {
  const { page, context, complaints } = await open_page(browser, server.url);
  const bytes = readFileSync(join(source, 'data/1hpv.pdb'));
  const { spheres } = JSON.parse(execFileSync(process.env.BIHIVE, ['info', join(source, 'data/1hpv.pdb'), '--json']));
  for (const file of [{ name: '1hpv.pdb', bytes }, { name: '1hpv.pdb.gz', bytes: gzipSync(bytes) }]) {
    await and_settle(page, () => ways_in.picker(page, file));
    assert.equal(await page.textContent('#facts'), `${file.name}: ${spheres.toLocaleString('en')} spheres, PDB`);
  }
  no_complaints(complaints);
  await context.close();
});

test('addresses: one elsewhere is refused before anything is sent, one of nothing is said', async () => {
  const { page, context, complaints } = await open_page(browser, server.url);
  await page.fill('#url', 'http://example.com/a.pdb');
  await page.click('#url_form button');
  assert.match(await shown_error(page), /another server/);
  no_complaints(complaints);
  await page.fill('#url', 'file/nothing.pdb');
  await page.click('#url_form button');
  await page.waitForFunction(() => /404/.test(document.querySelector('#errors').textContent));
  await context.close();
});

test('a picture to be saved says how far it is, and can be cancelled', async () => {
  const { page, context, complaints } = await open_page(browser, server.url);
  await and_settle(page, () => page.selectOption('#built_in', 'four-spheres'));
  let downloads = 0;
  page.on('download', () => ++downloads);
  const bar = () => page.$eval('#busy_bar', ({ value }) => value);
  await set_value(page, '#samples_per_pixel', 64);
  await page.fill('#save_width', '3000');
  await page.fill('#save_height', '2000');
  await page.focus('#save');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => document.querySelector('#busy_bar').value > 0 && !document.querySelector('#busy').hidden);
  assert.match(await page.textContent('#busy_text'), /Drawing the picture: \d+ %/);
  const before = await bar();
  assert.ok(before < 0.9, 'it takes a while');
  await page.waitForFunction((value) => document.querySelector('#busy_bar').value > value, before);
  assert.ok(await page.isHidden('#save'));
  assert.equal(await page.evaluate(() => document.activeElement.id), 'save_cancel', 'the focus stays at hand');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => /cancelled/.test(document.querySelector('#messages').textContent));
  assert.ok(await page.isHidden('#busy'));
  assert.ok(await page.isHidden('#save_cancel'));
  assert.equal(await page.evaluate(() => document.activeElement.id), 'save');

  // Everything goes on; another scene ends a picture too.
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  await set_value(page, '#samples_per_pixel', 64);
  await page.click('#save');
  await page.waitForFunction(() => document.querySelector('#busy_bar').value > 0);
  await and_settle(page, () => page.selectOption('#built_in', 'demo'));
  await page.waitForSelector('#save:not([hidden])');
  assert.equal(downloads, 0);
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  const native = native_picture('demo', 'after-cancel', '--size', '720x480', '--samples', '1');
  assert.equal((await compare(page, native, await saved_picture(page, 720, 480), 0)).share, 0);
  assert.equal(downloads, 1);
  no_complaints(complaints);
  await context.close();
});

test('bad input says what and where, and keeps the old scene', async () => {
  const { page, context, complaints } = await open_page(browser, server.url);
  const facts = await page.textContent('#facts');
  const picture = await saved_picture(page, 96, 64);
  for (const [name, content, words] of [
    ['bad.csv', 'x,y,z\n1,2,3\n4,five,6\n', /bad\.csv.*line 3.*five/],
    ['empty.pdb', '', /empty\.pdb/],
    ['noise.bin', '\u0001\u0002\u0003', /noise\.bin/],
    ['scene.json', '{"bihive_scene": 1, "spheres": [[0, 0]]}', /scene\.json/],
    ['cut.pdb.gz', gzipSync(Buffer.from('ATOM')).subarray(0, 12), /cut\.pdb\.gz.*gzip/],
  ]) {
    await page.setInputFiles('#file', { name, mimeType: 'text/plain', buffer: Buffer.from(content) });
    await page.waitForFunction((file) => document.querySelector('#errors')?.textContent.includes(file), name);
    assert.match(await shown_error(page), words);
    assert.equal(await page.textContent('#facts'), facts);
    assert.equal(await page.inputValue('#built_in'), 'demo');
  }
  assert.deepEqual((await compare(page, picture, await saved_picture(page, 96, 64), 0)).share, 0);
  no_complaints(complaints);
  await context.close();
});

test('a link brings everything back', async () => {
  const { page, context } = await open_page(browser, server.url);
  await and_settle(page, () => page.selectOption('#built_in', 'scenario2'));
  await and_settle(page, () => set_value(page, '#count', 300));
  await set_value(page, '#max_prims', 3);
  await and_settle(page, () => page.selectOption('#view', 'traversal'));
  await and_settle(page, () => page.press('#picture', 'ArrowLeft'));
  const state = await link_state(page);
  const picture = await saved_picture(page, 128, 96);
  const link = page.url();
  await context.close();

  const other = await open_page(browser, link);
  assert.deepEqual(await link_state(other.page), state);
  assert.equal((await compare(other.page, picture, await saved_picture(other.page, 128, 96), 0)).share, 0);
  assert.deepEqual(state.source, { built_in: 'scenario2', count: 300 });
  no_complaints(other.complaints);
  await other.context.close();

  // A damaged file gives a message, and the molecule is shown.
  const damaged = await open_page(browser, `${server.url}#state=abc`);
  assert.match(await shown_error(damaged.page), /damaged/);
  no_complaints(damaged.complaints);
  await damaged.context.close();
});

test('every control has a name and can be reached', async () => {
  const { page, context } = await open_page(browser, server.url);
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll('button, input, select, a, [role], dialog')]
      .filter((element) => {
        const labels = element.labels ? [...element.labels].map((label) => label.textContent).join('') : '';
        const by = element.getAttribute('aria-labelledby');
        const name =
          element.getAttribute('aria-label') ?? (by ? document.getElementById(by)?.textContent : null) ?? (labels || element.textContent);
        const speaks = ['status', 'alert'].includes(element.getAttribute('role'));
        return !speaks && !name.trim();
      })
      .map((element) => element.outerHTML),
  );
  assert.deepEqual(nameless, []);
  // Through all cards by Tab alone.
  const reached = new Set();
  let snapshot = '';
  for (const card of await page.$$eval('.card', (all) => all.map(({ id }) => id.slice('card_'.length)))) {
    await page.by_hand.focus(`[data-card=${card}]`);
    await page.keyboard.press('Enter');
    await page.evaluate(() => document.querySelectorAll('details.group').forEach((group) => (group.open = true)));
    snapshot += await page.locator('body').ariaSnapshot();
    for (let i = 0; i < 130; ++i) {
      await page.keyboard.press('Tab');
      const [id, inside] = await page.evaluate(() => [document.activeElement?.id ?? '', document.activeElement?.closest('#tools, #panel, #stage') !== null]);
      reached.add(id);
      if (!inside) break;
    }
    await page.keyboard.press('Escape');
    assert.ok(await page.by_hand.isHidden('#panel'));
  }
  for (const words of ['application', 'combobox "Built-in"', 'slider "Recursion"', 'radio "GPU"', 'checkbox "Shadows"', 'textbox "Title"', 'spinbutton "Aperture"'])
    assert.ok(snapshot.includes(words), `${words} is not among what a screen reader finds:\n${snapshot}`);
  for (const id of ['built_in', 'file', 'radius', 'view', 'recursion', 'colour_by', 'fog', 'outline_px', 'aperture', 'title', 'max_prims', 'save', 'copy_link', 'thesis_open'])
    assert.ok(reached.has(id), `Tab does not reach ${id}`);
  await context.close();
});
