// The page's groups colours, light, lines, lens and labels draw what the program draws with the same options, bit for
// bit, on the screen and saved; and their link.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { ways_in } from './page_files.mjs';
import {
  and_settle, assert_same_picture, height, link_state, native_picture, no_complaints, open_page, saved_picture,
  scratch, set_value, shown_error, shown_picture, size, small, width, with_page,
} from './page_kit.mjs';

const kit = with_page();

// Opens a group by the keyboard.
async function open_group(page, id) {
  if ((await page.locator(`#${id} > summary`).count()) === 0) return page.unfold(`#${id}`);
  await page.focus(`#${id} > summary`);
  await page.keyboard.press('Enter');
  assert.ok(await page.evaluate((group) => document.getElementById(group).open, id));
}

const groups = {
  light_group: [
    [(page) => page.selectOption('#lights', 'cloudy'), ['--light', 'cloudy']],
    [async (page) => {
      await page.selectOption('#lights', 'own');
      await page.fill('#own_lights', 'headlight from:-1,1,1:orange:0.5:20');
      await page.press('#own_lights', 'Enter');
    }, ['--light', 'headlight', '--light', 'from:-1,1,1:orange:0.5:20'], ['--light', 'cloudy']],
    [(page) => set_value(page, '#light_points', 3), ['--light-points', '3']],
    [(page) => set_value(page, '#ao_distance', 4), ['--ao-distance', '4']],
    [(page) => set_value(page, '#ao_directions', 20), ['--ao-directions', '20']],
    [(page) => set_value(page, '#fog', 0.6), ['--fog', '0.6']],
    [(page) => page.click('#shadows'), ['--no-shadows']],
  ],
  lines_group: [
    [(page) => set_value(page, '#outline_px', 3), ['--outline', '3']],
    [(page) => page.selectOption('#crease', 'chain'), ['--crease', 'chain']],
    [(page) => page.selectOption('#floor', 'shadow'), ['--floor', 'shadow']],
  ],
  colours_group: [
    [(page) => page.selectOption('#colour_by', 'b_factor'), ['--colour-by', 'b_factor']],
    [(page) => page.selectOption('#colour_map', 'magma'), ['--colour-by', 'b_factor:magma'], ['--colour-by', 'b_factor']],
    [async (page) => {
      await page.fill('#colour_min', '5');
      await page.fill('#colour_max', '30');
      await page.press('#colour_max', 'Enter');
    }, ['--colour-by', 'b_factor:magma:5,30'], ['--colour-by', 'b_factor:magma']],
    [(page) => page.click('#colour_log'), ['--colour-by', 'b_factor:magma:5,30:log'], ['--colour-by', 'b_factor:magma:5,30']],
  ],
  lens_group: [
    [(page) => set_value(page, '#fov', 50), ['--fov', '50']],
    [(page) => set_value(page, '#exposure', 0.5), ['--exposure', '0.5']],
    [(page) => page.selectOption('#tone', 'filmic'), ['--tone', 'filmic']],
    [(page) => set_value(page, '#aperture', 3), ['--aperture', '3']],
    [async (page) => {
      await page.selectOption('#focus', 'spheres');
      await page.fill('#focus_on', 'resname 478');
      await page.press('#focus_on', 'Enter');
    }, ['--focus', 'resname 478']],
    [async (page) => {
      await set_value(page, '#samples_per_pixel', 8);
      await page.selectOption('#focus', 'distance');
      await page.fill('#focus_distance', '40');
      await page.press('#focus_distance', 'Enter');
    }, ['--focus', '40', '--samples', '8'], ['--focus', 'resname 478', '--samples', '2']],
  ],
  labels_group: [
    [async (page) => {
      await page.fill('#title', 'HIV-1 protease');
      await page.press('#title', 'Enter');
    }, ['--title', 'HIV-1 protease']],
    [(page) => page.click('#legend'), ['--legend']],
    [(page) => page.click('#axes'), ['--axes']],
    [(page) => page.selectOption('#projection', 'orthographic'), ['--projection', 'orthographic']],
    [(page) => page.click('#scale_bar'), ['--scale-bar']],
    [async (page) => {
      await page.fill('#length_unit', 'units');
      await page.press('#length_unit', 'Enter');
    }, ['--length-unit', 'units']],
  ],
};

// Without pairs of an option and its value.
function without(options, gone) {
  const text = options.join('\n');
  const cut = gone.reduce((left, word, i) => (i % 2 ? left : left.replace(`${word}\n${gone[i + 1]}`, '')), text);
  return cut.split('\n').filter(Boolean);
}

for (const [group, steps] of Object.entries(groups))
  test(`${group}: each control is an option of the program`, async () => {
    const { page, context, complaints } = await open_page(kit.browser, kit.server.url, { viewport: { width: 800, height: 900 } });
    await and_settle(page, () => set_value(page, '#samples_per_pixel', 2));
    await open_group(page, group);
    await and_settle(page, () => page.setViewportSize(small.viewport));
    let options = ['--samples', '2'];
    for (const [act, added, gone = []] of steps) {
      await and_settle(page, () => act(page));
      options = [...without(options, gone), ...added];
      const native = native_picture('demo', group, ...size, ...options);
      assert_same_picture(await saved_picture(page, width, height), native, `saved: ${options.join(' ')}`);
    }
    // On the screen, too.
    await and_settle(page, () => page.setViewportSize({ width: 540, height: 270 }));
    const native = native_picture('demo', group, '--size', '540x270', ...options);
    assert_same_picture(await shown_picture(page, '#cpu_canvas'), native, `shown: ${options.join(' ')}`);

    // A link brings it back, into the controls as well.
    const state = await link_state(page);
    const other = await open_page(kit.browser, page.url(), { viewport: { width: 540, height: 270 } });
    assert.deepEqual(await link_state(other.page), state);
    assert_same_picture(await saved_picture(other.page, 540, 270), native, 'by the link');
    const values = (one) =>
      one.$$eval(`#${group} :is(input, select)`, (all) => all.map((input) => [input.id, input.type === 'checkbox' ? input.checked : input.value, input.disabled]));
    assert.deepEqual(await values(other.page), await values(page));
    no_complaints(other.complaints);
    await other.context.close();
    no_complaints(complaints);
    await context.close();
  });

test('each parameter of the library has its control, with its label, its help and its state', async () => {
  const rows = JSON.parse(execFileSync(process.env.BIHIVE, ['describe', 'settings'])).filter((row) => row.in_window && row.label);
  assert.ok(rows.length > 15);
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  const written = (text) => text.replace(/\s+/g, ' ').replaceAll("'", '’');
  const first_large = (text) => written(text.charAt(0).toUpperCase() + text.slice(1));
  const type = ({ kind, slider }) =>
    ({ flag: 'checkbox', choice: 'select-one', text: 'text', colour: 'text' })[kind] ?? (slider ? 'range' : 'number');
  const shown = await page.$$eval('[data-parameters] :is(input, select)', (all) =>
    all.map(({ id, type, title, labels, disabled, parentElement }) =>
      ({ id, type, title, label: labels[0].textContent, disabled, group: parentElement.parentElement.dataset.parameters })));
  const off = ['scale_bar', 'length_unit', 'legend_title']; // in perspective, and without a legend
  const expected = rows.map((row) => ({
    id: row.id, type: type(row), title: first_large(row.help), label: first_large(row.long_label ?? row.label),
    disabled: off.includes(row.id), group: row.group,
  }));
  const by_id = (a, b) => a.id.localeCompare(b.id);
  assert.deepEqual(shown.sort(by_id), expected.sort(by_id));

  // A part is disabled without its whole.
  await and_settle(page, () => page.evaluate(() => document.getElementById('ao').click()));
  assert.ok(await page.isDisabled('#ao_distance'));
  assert.ok(await page.isDisabled('#ao_directions'));
  await and_settle(page, () => page.evaluate(() => document.getElementById('shadows').click()));
  assert.ok(await page.isDisabled('#light_points'));
  // What is set is in the link, and nothing else.
  assert.deepEqual((await link_state(page)).settings.set, ['shadows', 'ao']);
  no_complaints(complaints);
  await context.close();
});

test('a lens brings 64 samples where nobody has chosen a number, and ends more samples on edges', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  const shows = (id, value) => page.waitForFunction(([at, wanted]) => document.getElementById(at).value === wanted, [id, value]);
  const own = await page.inputValue('#samples_per_pixel');
  await set_value(page, '#aperture', 3);
  await shows('samples_per_pixel', '64');
  await set_value(page, '#aperture', 0);
  await shows('samples_per_pixel', own);
  await page.click('#samples_auto');
  await page.waitForFunction(() => document.getElementById('samples_per_pixel').disabled);
  await set_value(page, '#aperture', 3);
  await shows('samples_per_pixel', '64');
  assert.ok(!(await page.isChecked('#samples_auto')));
  await set_value(page, '#samples_per_pixel', 8);
  await set_value(page, '#aperture', 2);
  await and_settle(page, () => set_value(page, '#recursion', 1));
  assert.equal(await page.inputValue('#samples_per_pixel'), '8');
  no_complaints(complaints);
  await context.close();
});

test('samples on edges', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  await and_settle(page, () => page.click('#samples_auto'));
  assert.ok(await page.isDisabled('#samples_per_pixel'));
  assert_same_picture(await saved_picture(page, width, height), native_picture('demo', 'auto', ...size, '--samples', 'auto'), 'auto');
  no_complaints(complaints);
  await context.close();
});

test('the cell: edges and copies; only where there is one, and as the scene file says', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  assert.ok(await page.isVisible('#cell_group'), 'the molecule is a crystal');
  await and_settle(page, () => page.selectOption('#built_in', 'four-spheres'));
  assert.ok(await page.isHidden('#cell_group'));
  const text = 'ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 4\n0 5\n0 6\n' +
    'ITEM: ATOMS id type x y z\n1 1 1 1 1\n2 2 2 3 4\n';
  const path = join(scratch, 'cell.lammpstrj');
  writeFileSync(path, text);
  await and_settle(page, () => ways_in.picker(page, { name: 'cell.lammpstrj', bytes: Buffer.from(text) }));
  await open_group(page, 'cell_group');
  const same = async (what, ...options) =>
    assert_same_picture(await saved_picture(page, width, height), native_picture(path, 'cell', ...size, ...options), what);
  await same('as it came');
  await and_settle(page, () => page.click('#cell'));
  await same('edges', '--cell');
  await page.fill('#copies_a', '2');
  await and_settle(page, () => page.press('#copies_a', 'Enter'));
  assert.deepEqual(await Promise.all(['a', 'b', 'c'].map((axis) => page.getAttribute(`#copies_${axis}`, 'placeholder'))), ['1', '1', '1']);
  await same('copies', '--cell', '--replicate', '2x1x1');
  await and_settle(page, () => page.click('#cell'));
  await same('copies alone', '--replicate', '2x1x1');
  const state = await link_state(page);
  assert.deepEqual([state.settings.cell, state.settings.replicate], [false, [2, 1, 1]]);

  // The edges of a scene file can be switched off.
  const document = { bihive_scene: 2, cell: { vectors: [[4, 0, 0], [0, 4, 0], [0, 0, 4]] },
    picture: { cell_lines: { width_px: 3 } }, spheres: [[1, 1, 1, 1]] };
  await and_settle(page, () => ways_in.picker(page, { name: 'own.json', bytes: Buffer.from(JSON.stringify(document)) }));
  assert.ok(await page.isChecked('#cell'));
  await and_settle(page, () => page.click('#cell'));
  delete document.picture;
  const plain = join(scratch, 'plain.json');
  writeFileSync(plain, JSON.stringify(document));
  assert_same_picture(await saved_picture(page, width, height), native_picture(plain, 'plain', ...size), 'switched off');
  no_complaints(complaints);
  await context.close();
});

test('what a scene file says is shown and kept by the controls', async () => {
  const document = {
    bihive_scene: 2,
    camera: { eye: [0, 0, 9], look_at: [0, 0, 0], aperture: 0.2, focus: 8 },
    picture: {
      samples_per_pixel: 9, ambient_occlusion: { distance: 2, directions: 12 }, fog: { strength: 0.75, start: 0.5 },
      outline: { width_px: 3 }, exposure: 0.5, tone: 'soft', light_points: 5,
    },
    spheres: [[0, 0, 0, 1], [1, 0.5, -3, 1]],
  };
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  const file = { name: 'own.json', bytes: Buffer.from(JSON.stringify(document)) };
  await and_settle(page, () => ways_in.picker(page, file));
  const value = (id) => page.inputValue(`#${id}`);
  assert.deepEqual(await Promise.all(['ao_distance', 'ao_directions', 'fog', 'outline_px', 'exposure', 'tone', 'light_points', 'aperture', 'focus', 'focus_distance', 'samples_per_pixel'].map(value)),
    ['2', '12', '0.75', '3', '0.5', 'soft', '5', '0.2', 'distance', '8', '9']);
  const path = join(scratch, file.name);
  writeFileSync(path, file.bytes);
  assert_same_picture(await saved_picture(page, width, height), native_picture(path, 'own', ...size), 'as it came');
  await and_settle(page, () => set_value(page, '#outline_px', 1));
  assert_same_picture(await saved_picture(page, width, height), native_picture(path, 'own', ...size, '--outline', '1'), 'one thing changed');
  no_complaints(complaints);
  await context.close();
});

test('what a picture cannot have is said, and the control goes back', async () => {
  const { page, context } = await open_page(kit.browser, kit.server.url, small);
  assert.ok(await page.isDisabled('#scale_bar'), 'in perspective');
  await and_settle(page, () => page.selectOption('#built_in', 'four-spheres'));
  await page.evaluate(() => (document.getElementById('labels_group').open = true));
  await page.click('#legend');
  assert.match(await shown_error(page), /no meaning.*“Colour by” in the panel/);
  await page.waitForFunction(() => !document.getElementById('legend').checked);
  await page.click('#errors button');
  await page.evaluate(() => (document.getElementById('light_group').open = true));
  await page.selectOption('#lights', 'own');
  await page.fill('#own_lights', 'candle');
  await page.press('#own_lights', 'Enter');
  assert.match(await shown_error(page), /light: expected one of thesis, studio/);
  assert.equal(await page.inputValue('#own_lights'), 'candle', 'to be mended');
  assert.deepEqual((await link_state(page)).look.lights, []);
  await context.close();
});
