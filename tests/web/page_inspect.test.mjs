// The picture answers: names, pins, measures; and it is taken along: sizes to save, the clipboard.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { devices } from 'playwright-core';
import {
  and_settle, close_card, compare, height, link_state, no_complaints, open_own, open_page, saved_picture, scratch, shown_picture, small, width, with_page,
} from './page_kit.mjs';

const kit = with_page();

const centres = [[0, 0, 0], [3, 0, 0], [0, 3, 0], [3, 3, 3]];
const csv = join(scratch, 'four.csv');
writeFileSync(csv, `x,y,z,r,kind\n${centres.map((centre, i) => [...centre, 1, 'ABCD'[i]].join()).join('\n')}\n`);
const moving = join(scratch, 'moving.xyz');
writeFileSync(moving, '2\nfirst\nC 0 0 0\nC 3 0 0\n2\nsecond\nC 0 0 0\nC 4.5 0 0\n');

const in_cell = join(scratch, 'in_cell.xyz');
writeFileSync(in_cell, '2\nLattice="10 0 0 0 10 0 0 0 10" Properties=species:S:1:pos:R:3\nC 1 5 5\nC 9 5 5\n');

// Where the front view of parallel rays shows a point.
async function places(page, points) {
  const { camera } = (await link_state(page)).settings;
  await close_card(page);
  await page.click('#messages button'); // what is said of the link lies over the picture
  assert.equal(camera.projection, 'orthographic');
  const box = await page.locator('#picture').boundingBox();
  const scale = Math.min(box.width, box.height) / camera.shorter_side;
  return points.map(([x, y]) => [
    box.x + box.width / 2 + scale * (x - camera.look_at[0]), box.y + box.height / 2 - scale * (y - camera.look_at[1]),
  ]);
}

const wide = { viewport: { width: 1400, height: 900 } }; // the list of pins lies beside the spheres
const beside = { viewport: { width: 900, height: 480 } }; // where names and pins cover no sphere
const pinned = (page, count) => page.waitForFunction((n) => document.querySelectorAll('#pin_list li').length === n, count);

const measure = async (page, name) => {
  await page.waitForFunction((start) => document.getElementById('pins_measure').textContent.startsWith(start), name);
  return page.textContent('#pins_measure');
};

// What the program prints of the same spheres.
function printed(file, option, ids) {
  const lines = execFileSync(process.env.BIHIVE, ['info', file, option, ids], { encoding: 'utf8' }).trim().split('\n');
  return Number(lines.at(-1).split(',').at(-1));
}

test('the laboratory shows the way of the ray under a click', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, wide);
  await open_own(page, csv, '4 spheres');
  await and_settle(page, () => page.selectOption('#projection', 'orthographic'));
  const at = await places(page, centres);
  await page.mouse.click(...at[0]);
  await pinned(page, 1);
  assert.equal(await page.locator('#ray_path details').count(), 0, 'no path while the laboratory is closed');
  await page.unfold('#ray_path');
  await page.mouse.click(...at[1]);
  await page.waitForFunction(() => document.querySelectorAll('#ray_path details').length === 2);
  assert.ok(await page.by_hand.isVisible('#ray_path'), 'the click does not close the card');
  for (const tree of ['wide', 'reference']) {
    const path = page.locator('#ray_path details', { hasText: `${tree}: nodes` });
    assert.match(await path.textContent(), /hits sphere 1 at [\d.]+/);
    await path.locator('summary').click();
    assert.match(await path.locator('li').last().textContent(), /1.*: nearest hit so far at/);
  }
  await page.screenshot({ path: join(scratch, 'ray_path.png') });
  await page.click('#laboratory > summary');
  await page.mouse.click(...at[2]);
  await page.by_hand.waitForSelector('#ray_path', { state: 'hidden' });
  no_complaints(complaints);
  await context.close();
});

test('the pointer names a sphere, clicks measure', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, wide);
  await open_own(page, csv, '4 spheres');
  await and_settle(page, () => page.selectOption('#projection', 'orthographic'));
  const at = await places(page, centres);
  await page.mouse.move(...at[1]);
  await page.waitForSelector('#tip:not([hidden])');
  assert.equal(await page.textContent('#tip_title'), 'sphere 1');
  assert.match(await page.textContent('#tip_rest'), /kind B.*radius 1 · at 3, 0, 0/);
  await page.mouse.move(5, 5);
  await page.waitForSelector('#tip', { state: 'hidden' });

  const measures = [0, printed(csv, '--distance', '0,1'), printed(csv, '--angle', '0,1,2'), printed(csv, '--dihedral', '0,1,2,3')];
  for (const [i, place] of at.entries()) {
    await page.mouse.click(...place);
    await pinned(page, i + 1);
    if (i === 0) assert.equal(await page.textContent('#pins_measure'), '');
    else {
      const words = await measure(page, ['', 'Distance', 'Angle', 'Dihedral'][i]);
      assert.ok(Math.abs(Number(words.match(/-?[\d.]+/)[0]) - measures[i]) < 1e-3, `${words}, and the program has ${measures[i]}`);
    }
  }
  assert.equal(await page.textContent('#pins_measure').then((words) => words.at(-1)), '°');
  const marks = await page.$$eval('#marks circle', (all) => all.map((one) => [Number(one.getAttribute('cx')), Number(one.getAttribute('cy'))]));
  for (const [i, mark] of marks.entries())
    assert.ok(Math.hypot(mark[0] - at[i][0], mark[1] - at[i][1]) < 0.5, `mark ${i + 1} is on its sphere`);
  assert.match(await page.textContent('#spoken'), /^Pinned: sphere 3\. Dihedral/);
  await page.screenshot({ path: join(scratch, 'pins.png') });

  // The marks turn with the scene.
  await page.focus('#picture');
  await and_settle(page, () => page.keyboard.press('ArrowLeft'));
  assert.notDeepEqual(await page.$$eval('#marks circle', (all) => all.map((one) => Number(one.getAttribute('cx')))), marks.map(([x]) => x));
  await page.keyboard.press('Escape');
  await page.waitForSelector('#pins', { state: 'hidden' });
  assert.equal(await page.locator('#marks > *').count(), 0);
  no_complaints(complaints);
  await context.close();
});

test('a click takes a pin away, a double click comes closer, and keys do it too', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, beside);
  await open_own(page, csv, '4 spheres');
  await and_settle(page, () => page.selectOption('#projection', 'orthographic'));
  const before = await shown_picture(page, '#cpu_canvas');
  const at = await places(page, centres);
  await page.mouse.click(...at[2]);
  await pinned(page, 1);
  await page.waitForTimeout(600); // or it is a double click
  await page.mouse.click(...at[2]);
  await pinned(page, 0);
  assert.ok((await shown_picture(page, '#cpu_canvas')).equals(before), 'pins change no pixel of the picture');
  await page.waitForTimeout(600);
  await and_settle(page, () => page.mouse.dblclick(...at[1]));
  await page.waitForFunction(() => document.getElementById('undo').getAttribute('aria-disabled') === 'false');
  assert.deepEqual((await link_state(page)).settings.camera.look_at, [3, 0, 0]);
  await close_card(page); // the first Escape is the card's
  await pinned(page, 0);
  await page.focus('#picture');
  await page.keyboard.press('Enter');
  await pinned(page, 1);
  assert.equal(await page.textContent('#pin_list summary'), 'sphere 1', 'the middle of the picture');
  // A drag pins nothing.
  await page.keyboard.press('Escape');
  const box = await page.locator('#picture').boundingBox();
  await and_settle(page, async () => {
    await page.mouse.move(box.width / 2, box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.width / 2 + 40, box.height / 2, { steps: 4 });
    await page.mouse.up();
  });
  await page.waitForTimeout(300);
  await pinned(page, 0);
  no_complaints(complaints);
  await context.close();
});

test('measures follow the frames', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, beside);
  await open_own(page, moving, '2 frames');
  await and_settle(page, () => page.selectOption('#projection', 'orthographic'));
  for (const [i, place] of (await places(page, [[0, 0], [3, 0]])).entries()) {
    await page.mouse.click(...place);
    await pinned(page, i + 1);
  }
  assert.equal(await measure(page, 'Distance'), 'Distance 3');
  await page.click('#player_on');
  await page.waitForFunction(() => document.getElementById('pins_measure').textContent === 'Distance 4.5');
  no_complaints(complaints);
  await context.close();
});

test('a distance in a periodic cell is that of nearest images, as the program has it, and stays over a reload', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, wide);
  await open_own(page, in_cell, '2 spheres');
  await and_settle(page, () => page.selectOption('#projection', 'orthographic'));
  for (const [i, place] of (await places(page, [[1, 5], [9, 5]])).entries()) {
    await page.mouse.click(...place);
    await pinned(page, i + 1);
  }
  assert.match(await measure(page, 'Distance'), /^Distance 2( Å)?, of nearest images$/);
  assert.equal(printed(in_cell, '--distance', '0,1'), 2);

  // A reload brings the pins back.
  await page.waitForTimeout(1000); // the page writes after a rest
  await page.reload();
  await page.waitForSelector('#picture[data-settled=true]');
  await pinned(page, 2);
  assert.match(await measure(page, 'Distance'), /^Distance 2/);
  no_complaints(complaints);
  await context.close();
});

test('on a phone a tap names, and a long press pins', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, {
    ...devices['Pixel 7'],
    viewport: { width: 360, height: 740 },
  });
  const box = await page.locator('#picture').boundingBox();
  const middle = { x: Math.round(box.width / 2), y: Math.round(box.height / 2) };
  await page.touchscreen.tap(middle.x, middle.y);
  await page.waitForSelector('#tip:not([hidden])');
  assert.match(await page.textContent('#tip_title'), /^[A-Z0-9']+, [A-Z0-9]+ \d+, chain [AB]$/);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
  await page.screenshot({ path: join(scratch, 'phone-tip.png') });
  const session = await context.newCDPSession(page);
  await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: [middle] });
  await pinned(page, 1);
  await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await page.screenshot({ path: join(scratch, 'phone-pin.png') });
  await page.tap('#pins_clear');
  await pinned(page, 0);
  no_complaints(complaints);
  await context.close();
});

test('sizes for papers and slides, and a picture for the clipboard', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, { ...small, permissions: ['clipboard-read', 'clipboard-write'] });
  const size = async (words) => {
    await page.selectOption('#save_size', words);
    return [await page.inputValue('#save_width'), await page.inputValue('#save_height')].map(Number);
  };
  assert.deepEqual(await size('as on the screen'), [width, height]);
  assert.deepEqual(await size('4 × the screen'), [4 * width, 4 * height]);
  assert.deepEqual(await size('slide'), [1920, 1080]);
  assert.deepEqual(await size('two columns, 17.8 cm at 300 dpi'), [2102, Math.round((2102 * height) / width)]);
  const saved = await saved_picture(page, 120, 80);
  assert.equal(await page.$eval('#save_size', (select) => select.selectedOptions[0].textContent), 'other');
  await page.click('#save_copy');
  await page.waitForFunction(() => document.getElementById('messages').textContent.includes('is copied'));
  const copied = await page.evaluate(async () => {
    const [item] = await navigator.clipboard.read();
    const bytes = new Uint8Array(await (await item.getType('image/png')).arrayBuffer());
    return btoa(String.fromCharCode(...bytes));
  });
  assert.deepEqual(await compare(page, saved, Buffer.from(copied, 'base64'), 0), { width: 120, height: 80, share: 0 });
  no_complaints(complaints);
  await context.close();
});
