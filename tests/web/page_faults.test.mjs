// Faults that the page once had: each test fails on the page before.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { made_files, points_in_a_cube, ways_in } from './page_files.mjs';
import {
  and_settle, assert_same_picture, folder, height, launch, link_state, native_picture, no_complaints, open_page, saved_picture,
  scratch, set_value, settled, shown_error, size as sized, small, source, width,
} from './page_kit.mjs';
import { serve } from './page_server.mjs';

// From a small phone to a large screen.
const sizes = [[320, 480], [360, 740], [768, 1024], [1280, 800], [2560, 1440]];
const molecule = { name: 'mine.pdb', bytes: readFileSync(join(source, 'data/1hpv.pdb')) };
const points = { name: 'points.csv', bytes: Buffer.from('x,y,z\n0,0,0\n1,0,0\n0,2,0\n') };

let browser, server;
before(async () => {
  browser = await launch();
  server = await serve(folder);
});
after(async () => {
  await browser?.close();
  server?.close();
});

const scrolled = (page) =>
  page.evaluate(() => [...document.querySelectorAll('html, body, main, #stage, #picture')].map((box) => [box.scrollTop, box.scrollLeft]).flat());
const not_scrolled = async (page, what) => assert.deepEqual(new Set(await scrolled(page)), new Set([0]), what);

test('a link made from a file of one’s own asks for that file, and gives its camera to no other', async () => {
  const { page, context, complaints } = await open_page(browser, server.url, small);
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  await and_settle(page, () => ways_in.picker(page, molecule));
  await and_settle(page, () => page.click('[data-side=left]'));
  await and_settle(page, () => page.press('#picture', 'ArrowUp'));
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  const state = await link_state(page);
  assert.deepEqual(state.source, { file: 'mine.pdb' });
  const picture = await saved_picture(page, 96, 64);

  const other = await open_page(browser, page.url(), small);
  assert.ok(await other.page.isVisible('#ask'));
  assert.match(await other.page.textContent('#ask'), /made for your file mine\.pdb.*Open mine\.pdb/s);
  assert.equal(await other.page.getAttribute('#ask', 'role'), 'alert');
  const fresh = await open_page(browser, server.url, small);
  assert.deepEqual((await link_state(other.page)).settings.camera, (await link_state(fresh.page)).settings.camera);
  await fresh.context.close();

  // Another file stays as it is, and the link waits on.
  await and_settle(other.page, () => ways_in.picker(other.page, { ...made_files[0], name: 'another.pdb' }));
  assert.match(await other.page.textContent('#ask'), /another\.pdb is open.*made for mine\.pdb/);
  assert.notDeepEqual((await link_state(other.page)).settings.camera, state.settings.camera);

  // Its own file comes by the box's button, and with it everything else.
  const chooser = other.page.waitForEvent('filechooser');
  await other.page.focus('#ask_open');
  await other.page.keyboard.press('Enter');
  const { name, bytes } = molecule;
  await and_settle(other.page, async () =>
    (await chooser).setFiles({ name, mimeType: 'application/octet-stream', buffer: bytes }));
  assert.ok(await other.page.isHidden('#ask'));
  assert.deepEqual(await link_state(other.page), state);
  assert_same_picture(await saved_picture(other.page, 96, 64), picture, 'by the link');
  for (const one of [{ context, complaints }, other]) {
    no_complaints(one.complaints);
    await one.context.close();
  }
});

for (const [width, height] of sizes)
  test(`by click and by Tab nothing scrolls the picture away, ${width} x ${height}`, async () => {
    const { page, context, complaints } = await open_page(browser, server.url, { viewport: { width, height } });
    await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
    // Clicks on what stands for hidden inputs, far down in a card.
    for (const control of ['#style input[value=plain] + *', '#theme input[value=dark] + span', '#engine input[value=cpu] + span', '#theme input[value=auto] + span']) {
      await page.unfold(control);
      await page.locator(control).scrollIntoViewIfNeeded();
      await page.click(control);
      await not_scrolled(page, `a click on ${control}`);
    }

    // Tab goes to every control of every card once; each is seen while it has the focus.
    let seen = 0;
    for (const card of await page.$$eval('.card', (all) => all.map(({ id }) => id))) {
      await page.evaluate((id) => document.querySelector(`[data-card="${id.slice(5)}"]:not([aria-expanded=true])`)?.click(), card);
      await page.evaluate(() => document.querySelectorAll('details.group').forEach((group) => (group.open = true)));
      const wanted = await page.$$eval(`#${card} :is(input, select, button, summary)`, (all) =>
        all.filter((one) => !one.disabled && one.getClientRects().length > 0).length);
      await page.by_hand.focus('#panel_close');
      for (let i = 0; i < wanted + 3; ++i) {
        await page.keyboard.press('Tab');
        const place = await page.evaluate(() => {
          const focused = document.activeElement;
          if (!focused || !focused.closest('#panel_body')) return null;
          const box = (focused.closest('label') ?? focused).getBoundingClientRect();
          const panel = document.getElementById('panel').getBoundingClientRect();
          const visible = box.bottom > panel.top && box.top < panel.bottom && box.right > 0 && box.left < innerWidth;
          return { name: focused.id || focused.textContent.trim() || focused.value, visible, wide: box.right > panel.right + 1 };
        });
        if (!place) break;
        ++seen;
        assert.ok(place.visible && !place.wide, `${place.name} is seen while it has the focus`);
        await not_scrolled(page, `Tab to ${place.name}`);
      }
      await page.screenshot({ path: join(scratch, `${card}-${width}x${height}.png`) });
    }
    assert.ok(seen > 60, `Tab reaches ${seen} controls`);
    const box = await page.locator('#picture').boundingBox();
    assert.deepEqual([box.x, box.y], [0, 0], 'the picture is where it was');
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    no_complaints(complaints);
    await context.close();
  });

// The sheet of a phone once covered the molecule that its user was changing.
test('the scene is in what the controls leave free', async () => {
  const { page, context, complaints } = await open_page(browser, server.url, { viewport: { width: 360, height: 740 } });
  const free = () =>
    page.evaluate(() => {
      const box = (id) => document.getElementById(id).getBoundingClientRect();
      const [picture, panel] = [box('picture'), document.getElementById('panel').hidden ? box('bar') : box('panel')];
      return [picture.height, panel.top - picture.bottom, picture.width].map(Math.round);
    });
  assert.deepEqual(await free(), [686, 0, 360]);
  await and_settle(page, () => page.click('[data-card=style]'));
  const [above, gap] = await free();
  assert.ok(above > 300 && gap === 0, `${above} pixels above the sheet`);
  assert.match(await page.textContent('#badge_frame'), new RegExp(`360 × ${above}$`), 'the picture is of that size');
  // A finger on its head makes it lower, and Escape ends it; a button makes it as high as the window.
  const head = await page.locator('#panel_title').boundingBox();
  await page.mouse.move(head.x + 20, head.y + 8);
  await page.mouse.down();
  await page.mouse.move(head.x + 20, head.y + 60, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  assert.ok((await free())[0] > above && (await free())[1] === 0);
  await page.click('#panel_tall');
  assert.ok((await page.locator('#panel').boundingBox()).height > 650);
  await and_settle(page, () => page.keyboard.press('Escape'));
  assert.deepEqual(await free(), [686, 0, 360]);

  await page.setViewportSize({ width: 1000, height: 600 });
  await settled(page);
  assert.deepEqual(await free().then(([high, , wide]) => [wide, high]), [1000, 600]);
  await page.click('[data-card=style]');
  assert.deepEqual(await free().then(([high, , wide]) => [wide, high]), [1000, 600], 'a card lies over it');
  await page.mouse.click(300, 300);
  assert.ok(await page.by_hand.isHidden('#panel'), 'a click on the picture closes it');
  assert.ok(await page.isHidden('#pins'), 'and pins nothing');
  assert.ok(await page.isVisible('#undo'));
  no_complaints(complaints);
  await context.close();
});

test('buttons come closer, and single keys can be switched off', async () => {
  const { page, context, complaints } = await open_page(browser, server.url, small);
  const eye = async () => (await link_state(page)).settings.camera.eye;
  const away = async () => Math.hypot(...(await eye()));
  const first = await eye();
  const far = await away();
  await and_settle(page, () => page.click('#zoom_in'));
  assert.ok((await away()) < far);
  await and_settle(page, () => page.click('#zoom_all'));
  assert.deepEqual(await eye(), first);
  await page.locator('#single_keys').uncheck();
  await page.focus('#picture');
  for (const key of ['4', 'e', '+']) await page.keyboard.press(key);
  await page.waitForTimeout(300);
  const { settings } = await link_state(page);
  assert.deepEqual([settings.view, settings.engine, settings.camera.eye], ['shaded', 'cpu', first]);
  await page.reload();
  await settled(page);
  assert.ok(!(await page.locator('#single_keys').isChecked()), 'the browser remembers it');
  await page.locator('#single_keys').check();
  await page.focus('#picture');
  await and_settle(page, () => page.keyboard.press('4'));
  assert.equal((await link_state(page)).settings.view, 'normal');
  no_complaints(complaints);
  await context.close();
});

test('notes and errors go with the file that they are about', async () => {
  const { page, context } = await open_page(browser, server.url, small);
  await and_settle(page, () => ways_in.picker(page, points));
  await page.waitForSelector('#messages .message');
  assert.match(await page.textContent('#messages'), /radius/);
  await and_settle(page, () => ways_in.picker(page, made_files[5]));
  assert.equal(await page.locator('#messages .message').count(), 0, 'no words about the file before');
  await context.close();
});

test('progress ends with the first picture, not before', async () => {
  const { page, context } = await open_page(browser, server.url, small);
  // Every end of the progress, and whether the new scene's picture was there.
  await page.evaluate(() => {
    window.ends = [];
    const canvas = document.getElementById('badge_frame');
    new MutationObserver(() => (window.drawn = true)).observe(canvas, { childList: true });
    new MutationObserver(() => {
      const busy = document.getElementById('busy');
      if (!busy.hidden) window.drawn = false;
      else window.ends.push(window.drawn);
    }).observe(document.getElementById('busy'), { attributes: true, attributeFilter: ['hidden'] });
  });
  await and_settle(page, () => ways_in.picker(page, molecule));
  assert.deepEqual(await page.evaluate(() => window.ends), [true]);
  await context.close();
});

test('keys move the picture before anybody has clicked it', async () => {
  const { page, context, complaints } = await open_page(browser, server.url, small);
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  const camera = async () => (await link_state(page)).settings.camera;
  const first = await camera();
  await page.evaluate(() => document.activeElement?.blur());
  await and_settle(page, () => page.keyboard.press('ArrowLeft'));
  const turned = await camera();
  assert.notDeepEqual(turned.eye, first.eye);
  await and_settle(page, () => page.click('[data-side=front]'));
  await and_settle(page, () => page.keyboard.press('4'));
  assert.equal((await link_state(page)).settings.view, 'normal', 'also after a click on a button');
  await and_settle(page, () => page.keyboard.press('1'));

  // Fields keep the words that are written into them, and sliders their keys.
  await page.focus('#url');
  await page.keyboard.type('4e+');
  await page.focus('#recursion');
  const before = await page.inputValue('#recursion');
  await page.keyboard.press('ArrowRight');
  assert.notEqual(await page.inputValue('#recursion'), before);
  const state = await link_state(page);
  assert.equal(state.settings.view, 'shaded');
  assert.equal(await page.inputValue('#url'), '4e+');
  no_complaints(complaints);
  await context.close();
});

test('a scene that turns for two seconds announces nothing', async () => {
  const { page, context } = await open_page(browser, server.url, small);
  await page.evaluate(() => {
    window.announced = [];
    const live = (node) => {
      for (let box = node.nodeType === 1 ? node : node.parentElement; box; box = box.parentElement) {
        const said = box.getAttribute('aria-live');
        if (said) return said !== 'off';
        if (['status', 'alert', 'log'].includes(box.getAttribute('role')) || box.localName === 'output') return true;
      }
      return false;
    };
    new MutationObserver((records) => {
      for (const { target } of records) if (live(target)) window.announced.push(target.textContent);
    }).observe(document.body, { subtree: true, childList: true, characterData: true });
  });
  const end = Date.now() + 2000;
  let moves = 0;
  for (; Date.now() < end || moves <= 10; ++moves) {
    await page.press('#picture', 'ArrowLeft');
    await page.waitForTimeout(20);
  }
  await settled(page);
  assert.deepEqual(await page.evaluate(() => window.announced), []);
  await context.close();
});

test('without JavaScript, OffscreenCanvas or exceptions of WebAssembly, the page says so', async () => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.goto(server.url);
  assert.match(await page.innerText('body'), /JavaScript is\s+switched off here/);
  await context.close();

  const without = {
    OffscreenCanvas: () => {
      delete window.OffscreenCanvas;
      delete HTMLCanvasElement.prototype.transferControlToOffscreen;
    },
    'WebAssembly exceptions': () => delete WebAssembly.Tag,
  };
  for (const [what, script] of Object.entries(without)) {
    const lacking = await browser.newContext();
    await lacking.addInitScript(script);
    const poor = await lacking.newPage();
    const faults = [];
    poor.on('pageerror', (error) => faults.push(error.message));
    await poor.goto(server.url);
    assert.match(await shown_error(poor), new RegExp(`This browser has no ${what}, so the page cannot draw. Chrome 95, `));
    assert.deepEqual(faults, []);
    await lacking.close();
  }
});

test('a long molecule stays in the picture while it turns', async () => {
  const { page, context } = await open_page(browser, server.url, { viewport: { width: 580, height: 300 } });
  const rod = `x,y,z,r\n${Array.from({ length: 81 }, (_, i) => `0,0,${i - 40},1`).join('\n')}\n`;
  await and_settle(page, () => ways_in.picker(page, { name: 'rod.csv', bytes: Buffer.from(rod) }));
  await and_settle(page, () => page.selectOption('#background', 'none'));
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  for (let i = 0; i < 3; ++i) {
    await and_settle(page, () => page.press('#picture', 'ArrowLeft'));
    const png = await saved_picture(page, 580, 300);
    const clear = await page.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
      canvas.drawImage(bitmap, 0, 0);
      const { data, width, height } = canvas.getImageData(0, 0, bitmap.width, bitmap.height);
      let opaque = 0;
      for (let y = 0; y < height; ++y) opaque += data[4 * y * width + 3] + data[4 * (y * width + width - 1) + 3];
      return opaque === 0 && data.some((value, i) => i % 4 === 3 && value > 0);
    }, png.toString('base64'));
    assert.ok(clear, `nothing is cropped at the left and right border after ${i + 1} steps`);
  }
  await context.close();
});

test('a radius is a field and an address, and messages name the field', async () => {
  const { page, context, complaints } = await open_page(browser, server.url, small);
  await and_settle(page, () => ways_in.picker(page, points));
  const words = await page.textContent('#messages');
  assert.match(words, /“Radius” in the panel sets another/);
  assert.doesNotMatch(words, /--/);
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  await and_settle(page, () => set_value(page, '#radius', 0.25));
  const state = await link_state(page);
  assert.deepEqual(state.source, { file: 'points.csv', reading: { radius: 0.25 } });
  assert.equal(state.settings.samples_per_pixel, 1, 'settings stay');
  const file = join(scratch, 'points.csv');
  writeFileSync(file, points.bytes);
  const native = (...options) => native_picture(file, 'radius', ...sized, '--samples', '1', ...options);
  assert_same_picture(await saved_picture(page, width, height), native('--radius', '0.25'), 'a radius of 0.25');
  await and_settle(page, () => set_value(page, '#radius_scale', 3));
  assert_same_picture(await saved_picture(page, width, height), native('--radius', '0.25', '--radius-scale', '3'), 'times 3');
  await and_settle(page, () => set_value(page, '#radius', ''));
  await and_settle(page, () => set_value(page, '#radius_scale', ''));
  assert_same_picture(await saved_picture(page, width, height), native(), 'the file’s own');
  no_complaints(complaints);
  await context.close();

  const asked = await open_page(browser, `${server.url}?radius=0.5&radius_scale=2`, small);
  await and_settle(asked.page, () => ways_in.picker(asked.page, points));
  assert.equal(await asked.page.inputValue('#radius'), '0.5');
  await and_settle(asked.page, () => set_value(asked.page, '#samples_per_pixel', 1));
  assert_same_picture(await saved_picture(asked.page, width, height), native('--radius', '0.5', '--radius-scale', '2'), 'by address');
  await asked.context.close();

  const wrong = await open_page(browser, `${server.url}?radius=wide`, small);
  assert.match(await shown_error(wrong.page), /radius=wide in the address: expected a number from 0/);
  await wrong.context.close();
});

test('columns are a field and an address, also for a file that cannot be read without', async () => {
  const table = { name: 'table.csv', bytes: Buffer.from('px,py,pz,size\n0,0,0,1\n3,0,0,0.5\n0,2,1,0.75\n') };
  const file = join(scratch, 'table.csv');
  writeFileSync(file, table.bytes);
  const native = () =>
    native_picture(file, 'columns', ...sized, '--samples', '1', '--columns', 'x=px,y=py,z=pz,r=size');
  const { page, context, complaints } = await open_page(browser, server.url, small);
  await ways_in.picker(page, table);
  assert.match(await shown_error(page), /table\.csv.*“Columns” in the panel/s);
  await set_value(page, '#columns', 'x=px,y=py,z=missing');
  await page.waitForFunction(() => document.getElementById('errors').textContent.includes('missing'));
  assert.equal(await page.inputValue('#columns'), 'x=px,y=py,z=missing', 'what was asked for stays');
  await and_settle(page, () => set_value(page, '#columns', 'x=px,y=py,z=pz,r=size'));
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  const state = await link_state(page);
  assert.deepEqual(state.source, { file: 'table.csv', reading: { columns: 'x=px,y=py,z=pz,r=size' } });
  assert_same_picture(await saved_picture(page, width, height), native(), 'columns by name');
  no_complaints(complaints);
  await context.close();

  const asked = await open_page(browser, `${server.url}?columns=x=px,y=py,z=pz,r=size`, small);
  await and_settle(asked.page, () => ways_in.picker(asked.page, table));
  await and_settle(asked.page, () => set_value(asked.page, '#samples_per_pixel', 1));
  assert_same_picture(await saved_picture(asked.page, width, height), native(), 'columns by address');
  await asked.context.close();
});

test('numbers of a link that no radius and no count can be are refused, and so is a deep document', async () => {
  const link = (source) => `${server.url}#state=${Buffer.from(source).toString('base64url')}`;
  for (const source of [
    '{"source": {"built_in": "scenario1", "reading": {"radius": 1e39}}}',
    '{"source": {"built_in": "scenario1", "reading": {"radius": 1e999}}}',
    '{"source": {"built_in": "scenario1", "count": 1e300}}',
    '{"source": {"built_in": "scenario1", "count": -5}}',
    '{"source": {"built_in": "scenario1", "count": 2.5}}',
    `{"source": {"built_in": "scenario1"}, "look": {"rows": ${'['.repeat(1000)}${']'.repeat(1000)}}}`,
  ]) {
    const { page, context } = await open_page(browser, link(source), small);
    assert.match(await shown_error(page), /The link is damaged/, source);
    await context.close();
  }
  const asked = await open_page(browser, `${server.url}?radius=1e39`, small);
  assert.match(await shown_error(asked.page), /radius=1e39 in the address: expected a number from 0 to 3\.4/);
  await asked.context.close();
});

test('a file that cannot be read leaves the one before: its radii are changed, and its camera stays', async () => {
  const { page, context } = await open_page(browser, server.url, small);
  await and_settle(page, () => ways_in.picker(page, points));
  await and_settle(page, () => page.press('#picture', 'ArrowUp'));
  const before = (await link_state(page)).settings.camera;
  await ways_in.picker(page, { name: 'broken.csv', bytes: Buffer.from('x,y,z\n1,2,what\n') });
  await shown_error(page);
  await page.fill('#radius', '0.25');
  await and_settle(page, () => page.press('#radius', 'Enter'));
  const state = await link_state(page);
  assert.deepEqual(state.source, { file: 'points.csv', reading: { radius: 0.25 } });
  assert.deepEqual(state.settings.camera, before, 'the user has moved it');
  await context.close();
});

// Searches for the nearest other point, which choose the radii, once waited forever for a thread in a browser.
test('two million points without radii', async () => {
  const file = join(scratch, 'millions.csv');
  writeFileSync(file, points_in_a_cube(2_000_000));
  const { page, context, complaints } = await open_page(browser, server.url, small);
  await and_settle(page, () => page.setInputFiles('#file', file));
  assert.match(await page.textContent('#facts'), /millions\.csv: 2,000,000 spheres/);
  no_complaints(complaints);
  await context.close();
});

test('300,000 points of NPY without radii', async () => {
  const header = `{'descr': '<f4', 'fortran_order': False, 'shape': (300000, 3), }`.padEnd(117) + '\n';
  const start = Buffer.concat([Buffer.from('\x93NUMPY\x01\x00', 'latin1'), Buffer.from([118, 0]), Buffer.from(header)]);
  const numbers = points_in_a_cube(300_000).trimEnd().split('\n').slice(1).flatMap((line) => line.split(',').map(Number));
  const bytes = Buffer.concat([start, Buffer.from(new Float32Array(numbers).buffer)]);
  const { page, context, complaints } = await open_page(browser, server.url, small);
  await and_settle(page, () => ways_in.picker(page, { name: 'many.npy', bytes }));
  assert.match(await page.textContent('#facts'), /many\.npy: 300,000 spheres/);
  no_complaints(complaints);
  await context.close();
});

test('notes stay until they are read, errors leave progress in view, and "cancelled" goes with a new try', async () => {
  const { page, context, complaints } = await open_page(browser, server.url, small);
  const picked = ({ name, bytes }) => ({ name, mimeType: 'application/octet-stream', buffer: bytes });
  await and_settle(page, () => page.setInputFiles('#file', [made_files[0], made_files[2]].map(picked)));
  assert.match(await page.textContent('#messages'), /Several files were chosen; this is three\.pdb/);
  await and_settle(page, () => ways_in.picker(page, made_files[5]));
  assert.equal(await page.locator('#messages .message').count(), 0, 'outdated');

  await and_settle(page, () => page.selectOption('#built_in', 'demo'));
  await ways_in.picker(page, { name: 'broken.csv', bytes: Buffer.from('x,y,z\n1,2,what\n') });
  await shown_error(page);
  await page.fill('#save_width', '4000');
  await page.fill('#save_height', '3000');
  await page.click('#save');
  await page.waitForFunction(() => document.querySelector('#busy_bar').value > 0 && !document.querySelector('#busy').hidden);
  const [progress, error] = await Promise.all(['#busy', '#errors .message'].map((one) => page.locator(one).boundingBox()));
  assert.ok(error.y >= progress.y + progress.height || progress.y >= error.y + error.height, 'one below the other');
  await page.click('#save_cancel');
  await page.waitForFunction(() => /cancelled/.test(document.querySelector('#messages').textContent));
  await page.click('#save');
  await page.waitForFunction(() => !/cancelled/.test(document.querySelector('#messages').textContent), null, { timeout: 4000 });
  await page.click('#save_cancel');
  await page.waitForFunction(() => /cancelled/.test(document.querySelector('#messages').textContent));
  no_complaints(complaints);
  await context.close();
});
