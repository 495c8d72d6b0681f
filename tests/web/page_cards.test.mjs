// The cards over the picture: one at a time; what the file holds, the legend, a cut, a histogram and a table of measures change and say
// what the program does and says.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { made_files, ways_in } from './page_files.mjs';
import {
  and_settle, assert_same_picture, close_card, link_state, native_picture, no_complaints, open_own, open_page, saved_picture, scratch,
  set_value, small, with_page,
} from './page_kit.mjs';

const kit = with_page();
const wide = { viewport: { width: 1000, height: 520 } };

const entry = (list, name) => `${list} .group_entry:has(summary span:text-is("${name}"))`;
const rows_of = async (page) => (await link_state(page)).look.rows;
const one_sample = ['--samples', '1'];

// The list of another scene comes with its first picture at rest.
const holds = (page, name) => page.by_hand.waitForSelector(entry('#groups', name), { state: 'attached' });

test('one card at a time, by mouse and keys; the first card goes with the first touch', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, wide);
  const shown = () => page.$$eval('.card', (all) => all.filter((one) => one.getClientRects().length > 0).map(({ id }) => id));
  assert.ok(await page.isVisible('#welcome'));
  assert.deepEqual(await shown(), [], 'the picture first');
  await page.focus('#bar [data-card=style]');
  await page.keyboard.press('Enter');
  assert.ok(await page.isHidden('#welcome'));
  assert.deepEqual(await shown(), ['card_style']);
  assert.equal(await page.getAttribute('#bar [data-card=style]', 'aria-expanded'), 'true');
  await page.click('#bar [data-card=save]');
  assert.deepEqual(await shown(), ['card_save']);
  assert.equal(await page.getAttribute('#bar [data-card=style]', 'aria-expanded'), 'false');
  await page.focus('#save_width');
  await page.keyboard.press('Escape');
  assert.deepEqual(await shown(), []);
  assert.equal(await page.evaluate(() => document.activeElement.dataset.card), 'save', 'the focus stays at hand');
  await page.click('#badge');
  assert.deepEqual(await shown(), ['card_scene']);
  assert.equal(await page.textContent('#badge'), 'HIV-1 protease with amprenavir1HPV · 1,631 atoms · PDB');
  assert.equal(await page.title(), 'HIV-1 protease with amprenavir · 1HPV · bihive');
  assert.match(await page.textContent('#scene_title'), /^HIV-1 PROTEASE .* COMPLEXED WITH VX-478/);
  assert.ok((await page.locator('#rules li').count()) > 0, 'how it was read');
  // A click on the picture closes it; a drag does not.
  await page.mouse.move(300, 300);
  await page.mouse.down();
  await page.mouse.move(340, 300, { steps: 3 });
  await page.mouse.up();
  assert.deepEqual(await shown(), ['card_scene']);
  await page.mouse.click(300, 300);
  assert.deepEqual(await shown(), []);

  const linked = await open_page(kit.browser, `${kit.server.url}#state=${Buffer.from('{"source": {"built_in": "four-spheres"}}').toString('base64url')}`, wide);
  assert.ok(await linked.page.isHidden('#welcome'), 'not with a link');
  await linked.context.close();
  const formats = await page.textContent('#file_help');
  for (const { format } of made_files.filter(({ format }) => format !== 'scene file')) assert.ok(formats.includes(format), format);
  assert.match(formats, /GSD.*SDF/s, 'as the library has them');
  no_complaints(complaints);
  await context.close();
});

test('what the file holds is hidden, coloured and shown alone, as the program draws it', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  await holds(page, 'water');
  assert.equal(await page.textContent(`${entry('#groups', 'water')} .count`), '80');
  await and_settle(page, () => page.click(`${entry('#groups', 'water')} .eye`));
  assert.equal(await page.getAttribute(`${entry('#groups', 'water')} .eye`, 'aria-pressed'), 'false');
  await page.click(`${entry('#groups', 'A')} summary`);
  await and_settle(page, () => set_value(page, `${entry('#groups', 'A')} input[type=color]`, '#ff8800'));
  await and_settle(page, () => set_value(page, `${entry('#groups', 'A')} input[type=range]`, '0.5'));
  const rows = [['water', 'hide', ''], ['chain A', 'colour', '#ff8800'], ['chain A', 'opacity', '0.5']];
  assert.deepEqual(await rows_of(page), rows.map(([select, action, value]) => ({ select, action, value })));
  const options = rows.flatMap(([select, action, value]) => ['--select', select, `--${action}`, ...(value ? [value] : [])]);
  assert_same_picture(await saved_picture(page, 262, 131), native_picture('demo', 'groups', '--size', '262x131', ...one_sample, ...options), 'groups');

  await page.unfold('#groups');
  await and_settle(page, () => page.click(`${entry('#groups', 'A')} button:text-is("Only this")`));
  assert.deepEqual((await rows_of(page)).at(-1), { select: 'not (chain A)', action: 'hide', value: '' });
  await page.unfold('#groups');
  await and_settle(page, () => page.click(`${entry('#groups', 'A')} button:text-is("As it was")`));
  assert.deepEqual(await rows_of(page), [{ select: 'water', action: 'hide', value: '' }]);
  await and_settle(page, () => page.click('#undo'));
  assert.ok((await rows_of(page)).length > 1, 'a step of the history');

  // What would leave nothing is refused, with a word.
  await and_settle(page, () => page.selectOption('#built_in', 'demo'));
  await holds(page, 'B');
  for (const element of ['C', 'N', 'O', 'S']) await page.click(`${entry('#groups', element)} .eye`);
  await page.waitForSelector('#errors .message');
  assert.match(await page.textContent('#errors'), /every sphere is hidden/);
  assert.equal(await page.getAttribute(`${entry('#groups', 'S')} .eye`, 'aria-pressed'), 'true');
  no_complaints(complaints);
  await context.close();
});

test('the legend says what the colours mean, and is a control', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, wide);
  await holds(page, 'water');
  const names = () => page.$$eval('#legend_box summary', (all) => all.map((one) => one.textContent.trim()));
  assert.deepEqual(await names(), ['C', 'N', 'O', 'S']);
  await close_card(page);
  await and_settle(page, () => page.click(`${entry('#legend_box', 'O')} .eye`));
  assert.deepEqual(await rows_of(page), [{ select: 'element O', action: 'hide', value: '' }]);
  await and_settle(page, () => page.selectOption('#colour_by', 'chain'));
  await page.waitForFunction(() => document.querySelector('#legend_box p').textContent === 'chain');
  assert.deepEqual((await names()).slice(0, 2), ['A', 'B']);
  await and_settle(page, () => page.selectOption('#colour_by', 'b_factor'));
  await page.by_hand.waitForSelector('#legend_box .scale');
  no_complaints(complaints);
  await context.close();
});

test('a histogram shows the range of colours, and changes it', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, wide);
  await and_settle(page, () => page.selectOption('#colour_by', 'b_factor'));
  await page.waitForSelector('#histogram rect');
  assert.equal(await page.locator('#histogram rect').count(), 48);
  const { x, y, width, height } = await page.locator('#histogram').boundingBox();
  await and_settle(page, () => page.mouse.click(x + 0.75 * width, y + height / 2));
  const [least, most] = await Promise.all(['#colour_min', '#colour_max'].map((id) => page.inputValue(id).then(Number)));
  assert.ok(least > 0 && least < 10 && most > 80 && most < 110, `${least} to ${most}`);
  assert.equal((await link_state(page)).look.colour_by, `b_factor::${least},${most}`);
  await and_settle(page, () => page.selectOption('#colour_by', 'chain'));
  assert.ok(await page.isHidden('#histogram'), 'texts have none');
  no_complaints(complaints);
  await context.close();
});

test('a cut by slider and handle is that of the program', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, wide);
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  await holds(page, 'water');
  assert.ok(await page.isHidden('#cut_handle'));
  const { camera } = (await link_state(page)).settings;
  await and_settle(page, () => page.selectOption('#cut_side', 'x'));
  assert.ok(await page.isVisible('#cut_handle'));
  const clip = async () => (await rows_of(page)).find(({ action }) => action === 'clip').value;
  const half = await clip();
  assert.match(half, /^plane:1,0,0,-?[\d.]+$/);
  await and_settle(page, () => set_value(page, '#cut_depth', 30));
  const shallow = await clip();
  assert.ok(Number(shallow.split(',')[3]) > Number(half.split(',')[3]), 'less is removed');
  const of_camera = ['--eye', camera.eye.join(), '--look-at', camera.look_at.join(), '--up', camera.up.join(), '--fov', String(camera.fov_deg)];
  const native = native_picture('demo', 'cut', '--size', '250x130', ...one_sample, ...of_camera, '--clip', shallow);
  assert_same_picture(await saved_picture(page, 250, 130), native, 'cut');

  await page.unfold('#cut_side');
  const handle = await page.locator('#cut_handle').boundingBox();
  const [x, y] = [handle.x + handle.width / 2, handle.y + handle.height / 2];
  await and_settle(page, async () => {
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x - 40, y, { steps: 4 });
    await page.mouse.up();
  });
  assert.ok(Number((await clip()).split(',')[3]) < Number(shallow.split(',')[3]), 'to the left, along x');
  await page.unfold('#cut_side');
  const moved = await page.locator('#cut_handle').boundingBox();
  assert.ok(Math.abs(moved.x + moved.width / 2 - (x - 40)) < 2, 'the handle stays under the hand');
  assert.deepEqual((await link_state(page)).settings.camera, camera, 'and the picture in its place');
  await and_settle(page, () => page.selectOption('#cut_side', ''));
  assert.deepEqual(await rows_of(page), []);
  no_complaints(complaints);
  await context.close();
});

test('a measure of all frames is a table, as the program prints it; a pin selects its kind', async () => {
  const file = join(scratch, 'moves.xyz');
  const frame = (i) => `3\nframe ${i}\nC 0 0 0\nC ${3 + 0.5 * i} 0 0\nO 0 3 0\n`;
  writeFileSync(file, [0, 1, 2].map(frame).join(''));
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, wide);
  await open_own(page, file, '3 frames');
  await and_settle(page, () => page.selectOption('#projection', 'orthographic'));
  const { camera } = (await link_state(page)).settings;
  await page.click('#messages button');
  await close_card(page);
  const box = await page.locator('#picture').boundingBox();
  const scale = Math.min(box.width, box.height) / camera.shorter_side;
  for (const [i, x] of [[1, 0], [2, 3]]) {
    await page.mouse.click(box.width / 2 + scale * (x - camera.look_at[0]), box.height / 2 + scale * camera.look_at[1]);
    await page.waitForFunction((n) => document.querySelectorAll('#pin_list li').length === n, i);
  }
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#pins_csv')]);
  assert.equal(download.suggestedFilename(), 'moves-distance.csv');
  assert.equal(readFileSync(await download.path(), 'utf8'), execFileSync(process.env.BIHIVE, ['info', file, '--distance', '0,1'], { encoding: 'utf8' }));
  await page.click('#pins_select button:text-is("All of its kind")');
  assert.equal(await page.inputValue('.look_row .select'), 'element "C"');
  await and_settle(page, () => page.selectOption('.look_row .action', 'hide'));
  assert.deepEqual(await rows_of(page), [{ select: 'element "C"', action: 'hide', value: '' }]);
  await page.waitForFunction(() => document.getElementById('pins').hidden, null, { timeout: 20_000 });
  no_complaints(complaints);
  await context.close();
});

test('in the dark theme the picture is dark, unless another background was chosen', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, { ...small, colorScheme: 'dark' });
  const background = async () => (await link_state(page)).look.background;
  assert.equal(await background(), '#101317');
  assert.equal(await page.getAttribute('#undo', 'aria-disabled'), 'true', 'no step of the history');
  await and_settle(page, () => page.click('#theme input[value=light] + span'));
  assert.equal(await background(), '');
  await and_settle(page, () => page.selectOption('#background', 'none'));
  await page.click('#theme input[value=dark] + span');
  assert.equal(await background(), 'none');
  const scene = JSON.stringify({ bihive_scene: 2, background: 'white', spheres: [[0, 0, 0, 1]] });
  await and_settle(page, () => ways_in.picker(page, { name: 'own.json', bytes: Buffer.from(scene) }));
  assert.equal(await background(), '', 'a scene file has its own');
  no_complaints(complaints);
  await context.close();
});

test('area, volume and cavities are those that the program measures', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, wide);
  const by_program = (...options) => JSON.parse(execFileSync(process.env.BIHIVE, ['measure', 'demo', '--json', ...options], { encoding: 'utf8' }));
  const measured = async (selection, probe) => {
    await page.fill('#union_selection', selection);
    await page.fill('#union_probe', probe);
    await page.click('#union_measure');
    await page.waitForFunction(() => document.querySelectorAll('#union_result p').length === 4 && !document.getElementById('union_measure').disabled);
    return page.$$eval('#union_result p', (all) => all.map(({ textContent }) => textContent));
  };
  const six = (number) => String(+number.toPrecision(6));
  for (const [selection, probe] of [['', '1.4'], ['chain A', '0']]) {
    const expected = by_program('--probe', probe, ...(selection ? ['--select', selection] : []));
    const shown = await measured(selection, probe);
    assert.equal(shown[0], `Area ${six(expected.area)} Å²`);
    assert.equal(shown[1], `Volume ${six(expected.volume)} Å³`);
    assert.match(shown[2], new RegExp(`^${expected.cavities || 'No'} cavit`));
    assert.match(shown[2], expected.components === 1 ? /in one piece$/ : new RegExp(`in ${expected.components} pieces$`));
  }
  // What is hidden does not count, and another look makes the numbers old.
  await holds(page, 'water');
  await and_settle(page, () => page.click(`${entry('#groups', 'water')} .eye`));
  assert.equal(await page.textContent('#union_result'), '');
  const without = by_program('--probe', '1.4', '--select', 'not water');
  assert.equal((await measured('', '1.4'))[0], `Area ${six(without.area)} Å²`);
  await page.fill('#union_selection', 'resname ZZZ');
  await page.click('#union_measure');
  await page.waitForSelector('#errors .message');
  assert.match(await page.textContent('#errors'), /nothing to measure/);
  assert.equal(await page.isDisabled('#union_measure'), false);
  no_complaints(complaints);
  await context.close();
});
