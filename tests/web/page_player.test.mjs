// The page's player: each frame is the program's picture of it, by buttons, keys and the time line, on small screens too;
// with a trajectory in a file of its own; from a file that is read in pieces.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { devices } from 'playwright-core';
import {
  and_settle, assert_same_picture, height, native_picture, no_complaints, open_page, saved_picture, scratch, shown_error,
  size, small, width, with_page,
} from './page_kit.mjs';
import { dcd } from './page_files.mjs';

const kit = with_page();

// Two spheres stay, so that every frame is framed alike; one goes from the first to the second.
const places = (frame) => [[0, 0, 0], [6, 3, 0], [1 + 0.5 * frame, 1 + 0.25 * frame, 0]];
const frames = 6;
const xyz = (count) =>
  Array.from({ length: count }, (_, frame) => `3\nframe ${frame}\n${places(frame).map((p, i) => `${'CON'[i]} ${p.join(' ')}\n`).join('')}`).join('');
const run = { name: 'run.xyz', bytes: Buffer.from(xyz(frames)) };

const pick = (page, ...files) =>
  page.setInputFiles('#file', files.map(({ name, bytes }) => ({ name, mimeType: 'application/octet-stream', buffer: bytes })));
const on_show = (page, frame) => page.waitForSelector(`#player[data-frame="${frame}"]`);
const settled_at = async (page, frame) => {
  await on_show(page, frame);
  await page.waitForSelector('#picture[data-settled=true]');
};
function on_disk({ name, bytes }) {
  const path = join(scratch, name);
  writeFileSync(path, bytes);
  return path;
}

test('each frame is the program’s, by buttons, keys and the time line', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  assert.ok(await page.isHidden('#player'), 'the molecule stands still');
  await and_settle(page, () => pick(page, run));
  assert.ok(await page.isVisible('#player'));
  assert.match(await page.textContent('#facts'), /6 frames/);
  const path = on_disk(run);
  const same = async (frame) => {
    await settled_at(page, frame);
    const native = native_picture(path, 'frame', ...size, '--frame', String(frame));
    assert_same_picture(await saved_picture(page, width, height), native, `frame ${frame}`);
  };
  await same(0);
  assert.equal(await page.textContent('#badge_name'), 'frame 0', 'the comment of the frame');
  await page.click('#player_on');
  await same(1);
  assert.equal(await page.textContent('#badge_name'), 'frame 1');
  await page.focus('#picture');
  await page.keyboard.press('.');
  await same(2);
  await page.keyboard.press(',');
  await same(1);
  await page.focus('#player_frame');
  await page.keyboard.press('End');
  await same(5);
  assert.match(await page.getAttribute('#player_frame', 'aria-valuetext'), /frame 5 of 0 to 5/);

  // A name, a role and a state of each control for those who do not see it.
  for (const [role, name] of [['button', 'One frame back'], ['button', 'Play'], ['button', 'One frame on'], ['slider', 'Frame'], ['spinbutton', /Speed/], ['checkbox', 'Loop']])
    assert.equal(await page.getByRole(role, { name, exact: typeof name === 'string' }).count(), 1, String(name));

  // Without a loop it stops at the end; with one it goes on.
  await page.uncheck('#player_loop');
  await page.fill('#player_speed', '50');
  await page.press('#player_speed', 'Enter');
  await page.focus('#picture');
  await page.keyboard.press(' ');
  await page.waitForSelector('#player_play[aria-label=Pause]');
  await page.waitForSelector('#player_play[aria-label=Play]');
  await same(5);
  await page.check('#player_loop');
  await page.focus('#picture');
  await page.keyboard.press(' ');
  await on_show(page, 0);
  await on_show(page, 3);
  await on_show(page, 1);
  // The camera moves while it plays.
  await page.keyboard.press('ArrowLeft');
  await on_show(page, 4);
  await page.click('#player_play');
  await page.waitForSelector('#player_play[aria-label=Play]');
  no_complaints(complaints);
  await context.close();
});

test('a frame in the address is where the player begins', async () => {
  const { page, context, complaints } = await open_page(kit.browser, `${kit.server.url}?frame=3`, small);
  await and_settle(page, () => pick(page, run));
  await settled_at(page, 3);
  const native = native_picture(on_disk(run), 'begin', ...size, '--frame', '3');
  assert_same_picture(await saved_picture(page, width, height), native, 'frame 3');
  await page.click('#player_on');
  await settled_at(page, 4);
  no_complaints(complaints);
  await context.close();
});

test('a trajectory in a file of its own, at once with its spheres or behind them', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  const spheres = { name: 'three.xyz', bytes: Buffer.from(xyz(1)) }, moves = { name: 'run.dcd', bytes: dcd(Array.from({ length: frames }, (_, frame) => places(frame))) };
  const [path, trajectory] = [on_disk(spheres), on_disk(moves)];
  const same = async (frame) => {
    await settled_at(page, frame);
    const native = native_picture(path, 'frame', ...size, '--trajectory', trajectory, '--frame', String(frame));
    assert_same_picture(await saved_picture(page, width, height), native, `frame ${frame}`);
  };
  await pick(page, moves);
  assert.match(await shown_error(page), /run\.dcd holds places alone/);
  await and_settle(page, () => pick(page, moves, spheres));
  await same(0);
  await page.click('#player_back');
  await same(5);
  await and_settle(page, () => pick(page, spheres));
  assert.ok(await page.isHidden('#player'));
  await and_settle(page, () => pick(page, moves));
  await page.click('#player_on');
  await same(1);
  // One that does not fit leaves this one, of which more frames can be read.
  await pick(page, { name: 'two.xyz', bytes: Buffer.from('2\n\nC 0 0 0\nC 1 0 0\n') }, moves);
  assert.match(await shown_error(page), /3 atoms/);
  await page.click('#player_on');
  await same(2);
  no_complaints(complaints);
  await context.close();
});

test('a large file is read in pieces', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  const atoms = 20000;
  const frame = (z) => `${atoms}\n\n${Array.from({ length: atoms }, (_, i) => `C ${i % 100} ${Math.floor(i / 100)} ${z}.000000000000\n`).join('')}`;
  const large = join(scratch, 'large.xyz');
  writeFileSync(large, Array.from({ length: 200 }, (_, z) => frame(z)).join(''));
  await and_settle(page, () => page.setInputFiles('#file', large));
  assert.match(await page.textContent('#facts'), /200 frames/);
  await page.focus('#player_frame');
  await page.keyboard.press('End');
  await settled_at(page, 199);
  no_complaints(complaints);
  await context.close();
});

for (const viewport of [{ width: 320, height: 480 }, { width: 390, height: 844 }])
  test(`a phone of ${viewport.width} x ${viewport.height} plays`, async () => {
    const { page, context, complaints } = await open_page(kit.browser, kit.server.url, { ...devices['Pixel 7'], viewport });
    await and_settle(page, () => pick(page, run));
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), viewport.width);
    const boxes = await page.$$eval('#player button, #player input', (all) => all.map((input) => [input.id, input.getBoundingClientRect().toJSON()]));
    const sheet = (await page.locator('#bar').boundingBox()).y;
    for (const [id, box] of boxes) {
      assert.ok(box.left >= 0 && box.right <= viewport.width && box.bottom <= sheet, `${id} is in reach`);
      if (id !== 'player_loop') assert.ok(box.height >= 38, `${id} is as high as a fingertip`);
    }
    await page.tap('#player_on');
    await on_show(page, 1);
    await page.tap('#player_play');
    await on_show(page, 4);
    await page.tap('#player_play');
    await page.waitForSelector('#player_play[aria-label=Play]');
    await page.screenshot({ path: join(scratch, `player-${viewport.width}.png`) });
    no_complaints(complaints);
    await context.close();
  });
