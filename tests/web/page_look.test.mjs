// The page's looks: styles, colours, background and the rows of selections draw what the program draws with the same
// options, bit for bit.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { ways_in } from './page_files.mjs';
import {
  and_settle, assert_same_picture, decoded, height, link_state, native_picture, no_complaints, open_page,
  saved_picture, scratch, set_value, shown_picture, size, small, width, with_page,
} from './page_kit.mjs';

const kit = with_page();

const choose_style = (page, style) => and_settle(page, () => page.check(`#style input[value="${style}"]`, { force: true }));

// Adds a row by the keyboard alone.
async function add_row(page, { select, action, value }) {
  await page.focus('#look_add');
  await page.keyboard.press('Enter');
  await page.keyboard.type(select);
  const row = page.locator('.look_row').last();
  if (action !== 'colour') await row.locator('.action').selectOption(action);
  if (value === undefined) return;
  await row.locator('.value').focus();
  await page.keyboard.type(value);
  await page.keyboard.press('Enter');
}

const words_of = async (page, row) => page.textContent(`.look_row:nth-child(${row}) .words`);

test('each style is the one of the program, with its name and picture', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  const { styles } = JSON.parse(execFileSync(process.env.BIHIVE, ['styles', '--json']));
  const names = styles.map(({ name }) => name);
  assert.deepEqual(await page.$$eval('#style input', (all) => all.map(({ value }) => value).filter(Boolean)), names);
  assert.ok(await page.isChecked('#style input[value=default]'), 'without being asked for');
  assert.ok(await page.isHidden('#own_style'));
  for (const image of await page.$$('#style img'))
    assert.ok(await image.evaluate(({ complete, naturalWidth }) => complete && naturalWidth > 0), 'a small picture');

  // As it comes, on the screen too.
  assert_same_picture(await shown_picture(page, '#cpu_canvas'), native_picture('demo', 'shown', ...size), 'on the screen');
  // The style that is chosen already comes last.
  for (const style of [...names.slice(1), names[0]]) {
    await choose_style(page, style);
    const native = native_picture('demo', `style-${style}`, '--style', style, ...size);
    assert_same_picture(await saved_picture(page, width, height), native, style);
    assert.equal((await link_state(page)).look.style, style);
  }
  await page.screenshot({ path: join(scratch, 'page-style.png') });
  no_complaints(complaints);
  await context.close();
});

test('looks of selections, colours of elements and a background, by keys; and their link', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, { viewport: { width: 800, height: 560 } });
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  await and_settle(page, () => page.selectOption('#element_colours', 'cpk'));
  await page.selectOption('#background', 'colour');
  await and_settle(page, () => set_value(page, '#background_colour', '#203040'));
  const rows = [
    { select: 'chain A', action: 'colour-by', value: 'b_factor:magma' },
    { select: 'within 5 of resname 478', action: 'colour', value: 'orange' },
    { select: 'water', action: 'hide' },
    { select: 'name CA', action: 'radius-scale', value: '1.3' },
    { select: 'chain B', action: 'material', value: 'metal' },
    { select: 'chain B and resid 10..20', action: 'opacity', value: '0.5' },
  ];
  for (const row of rows) await and_settle(page, () => add_row(page, row));
  const attributes = await page.$$eval('#colour_attributes option', (all) => all.map(({ value }) => value));
  for (const name of ['b_factor', 'chain', 'resname', 'element']) assert.ok(attributes.includes(name), name);
  assert.equal(await words_of(page, 2), '138 spheres', 'as docs/selections.md says');
  const options = rows.flatMap(({ select, action, value }) => ['--select', select, `--${action}`, ...(value ? [value] : [])]);
  const native = native_picture('demo', 'rows', '--size', '800x560', '--samples', '1', '--element-colours', 'cpk',
    '--background', '#203040', ...options);
  assert_same_picture(await saved_picture(page, 800, 560), native, 'rows');
  await page.locator('#look_title').scrollIntoViewIfNeeded();
  await page.screenshot({ path: join(scratch, 'page-rows.png') });

  // A link brings all of it back.
  const state = await link_state(page);
  assert.deepEqual(state.look.rows.map(({ select }) => select), rows.map(({ select }) => select));
  const other = await open_page(kit.browser, page.url(), { viewport: { width: 800, height: 560 } });
  assert.deepEqual(await link_state(other.page), state);
  assert.equal(await other.page.inputValue('.look_row:nth-child(2) .value'), 'orange');
  assert.equal(await other.page.inputValue('#element_colours'), 'cpk');
  assert.equal(await other.page.inputValue('#background_colour'), '#203040');
  assert_same_picture(await saved_picture(other.page, 800, 560), native, 'by the link');
  no_complaints(other.complaints);
  await other.context.close();

  // Rows go one by one.
  for (let left = rows.length; left > 0; --left)
    await and_settle(page, () => page.click('.look_row:nth-child(1) button'));
  assert.deepEqual((await link_state(page)).look.rows, []);
  no_complaints(complaints);
  await context.close();
});

test('a wrong row says why and where below it, and the picture stays', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  const picture = await saved_picture(page, 96, 64);
  await add_row(page, { select: 'chain A and wter', action: 'hide' });
  await page.waitForSelector('.look_row .words.fault');
  assert.match(await words_of(page, 1), /column 13: .*wter.*water/);
  assert.equal(await page.getAttribute('.look_row .select', 'aria-invalid'), 'true');
  const described = await page.getAttribute('.look_row .select', 'aria-describedby');
  assert.equal(await page.textContent(`#${described}`), await words_of(page, 1));
  assert.deepEqual((await link_state(page)).look.rows, [], 'no link holds it');
  assert_same_picture(await saved_picture(page, 96, 64), picture, 'before');

  // It waits while something else changes, and counts once it is mended.
  await choose_style(page, 'flat');
  assert.equal(await page.inputValue('.look_row .select'), 'chain A and wter');
  await page.fill('.look_row .select', 'chain A and water');
  await and_settle(page, () => page.press('.look_row .select', 'Enter'));
  assert.match(await words_of(page, 1), /^\d+ spheres$/);
  await add_row(page, { select: '', action: 'opacity', value: '7' });
  await page.waitForSelector('.look_row:nth-child(2) .words.fault');
  assert.match(await words_of(page, 2), /expected a number from 0 to 1, found "7"/);

  // Another scene begins without rows; the style stays for files.
  await and_settle(page, () => page.selectOption('#built_in', 'four-spheres'));
  assert.equal(await page.locator('.look_row').count(), 0);
  assert.ok(await page.isHidden('#style'));
  assert.ok(await page.isVisible('#style_note'));
  assert.ok(await page.isHidden('#element_colours_row'));
  no_complaints(complaints);
  await context.close();
});

test('a scene file keeps its own look until a style is chosen', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  const name = 'own.json';
  const text = JSON.stringify({ bihive_scene: 2, background: 'black', spheres: [[0, 0, 0, 1], [2, 0, 0, 1]],
    picture: { ambient_occlusion: {} } });
  const file = join(scratch, name);
  writeFileSync(file, text);
  await and_settle(page, () => ways_in.picker(page, { name, bytes: Buffer.from(text) }));
  assert.ok(await page.isVisible('#own_style'));
  assert.ok(await page.isChecked('#own_style input', { force: true }));
  assert_same_picture(await saved_picture(page, width, height), native_picture(file, 'own', ...size), 'own');
  await choose_style(page, 'studio');
  const studio = native_picture(file, 'own-studio', '--style', 'studio', ...size);
  assert_same_picture(await saved_picture(page, width, height), studio, 'in a style');
  no_complaints(complaints);
  await context.close();
});

test('a transparent picture of any size is the program’s, with its opacity', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  await and_settle(page, () => page.selectOption('#background', 'none'));
  const saved = await saved_picture(page, width, height);
  assert.equal(decoded(saved).channels, 4);
  assert_same_picture(saved, native_picture('demo', 'clear', '--background', 'none', ...size), 'transparent');
  const large = decoded(await saved_picture(page, 9000, 40));
  assert.deepEqual([large.width, large.height], [9000, 40]);
  assert.equal((await link_state(page)).look.background, 'none');
  await page.screenshot({ path: join(scratch, 'page-clear.png') });
  no_complaints(complaints);
  await context.close();
});

test('a link with a look that does not fit says so and shows the scene', async () => {
  const state = { source: { built_in: 'demo' }, settings: null, look: { style: 'studio', rows: [{ select: 'charge > 0', action: 'hide' }] } };
  const link = `${kit.server.url}#state=${Buffer.from(JSON.stringify(state)).toString('base64url')}`;
  const { page, context, complaints } = await open_page(kit.browser, link, small);
  assert.match(await page.textContent('#messages'), /look does not fit this scene and was left out.*charge/);
  assert.equal((await link_state(page)).look.style, '');
  no_complaints(complaints);
  await context.close();
});

test('320 pixels are wide enough', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, { viewport: { width: 320, height: 640 } });
  await add_row(page, { select: 'chain A', action: 'colour-by', value: 'resid' });
  for (const box of ['#panel_body', '#style', '.look_row'])
    assert.ok(await page.$eval(box, (element) => element.scrollWidth <= element.clientWidth), box);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 320);
  await page.locator('#look_title').scrollIntoViewIfNeeded();
  await page.screenshot({ path: join(scratch, 'page-320.png') });
  no_complaints(complaints);
  await context.close();
});
