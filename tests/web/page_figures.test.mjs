// Pictures of bihive that are dropped on the page: by what they were drawn, and whether they hold.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { made_files } from './page_files.mjs';
import { and_settle, decoded, native_picture, no_complaints, open_page, scratch, shown_error, small, source, with_page } from './page_kit.mjs';

const kit = with_page();
const open = (options = small) => open_page(kit.browser, kit.server.url, options);
const picked = (name, buffer) => ({ name, mimeType: 'application/octet-stream', buffer });
const pick = (page, ...files) => page.setInputFiles('#file', files.map(([name, bytes]) => picked(name, bytes)));

// A small picture. `options`: further ones of bihive render.
const figure = (input, name, ...options) => native_picture(input, name, '--size', '64x48', '--samples', '1', ...options);
const own_file = join(scratch, 'four.xyz');
const four = made_files.find(({ name }) => name === 'four.xyz').bytes;
writeFileSync(own_file, four);

/** The words of the last figure when it is compared. */
async function judged(page, pattern) {
  await page.waitForFunction(
    (source) => new RegExp(source, 's').test(document.querySelector('#figures .message:last-child p')?.textContent ?? ''),
    pattern.source,
  );
  return page.textContent('#figures .message:last-child p');
}

const crc_of = (bytes) => {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xedb88320 ^ (crc >>> 1) : crc >>> 1;
  }
  return ~crc >>> 0;
};
function chunk(type, data) {
  const bytes = Buffer.concat([Buffer.alloc(4), Buffer.from(type, 'latin1'), data, Buffer.alloc(4)]);
  bytes.writeUInt32BE(data.length, 0);
  bytes.writeUInt32BE(crc_of(bytes.subarray(4, 8 + data.length)), 8 + data.length);
  return bytes;
}
/** The same file with other pixels. */
function with_pixels(png, change) {
  const { width, height, channels, bytes } = decoded(png);
  change(bytes);
  const row = width * channels;
  const rows = Array.from({ length: height }, (_, y) => Buffer.concat([Buffer.of(0), bytes.subarray(y * row, (y + 1) * row)]));
  const parts = [png.subarray(0, 8)];
  let written = false;
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
    const is_data = png.toString('latin1', at + 4, at + 8) === 'IDAT';
    if (!is_data) parts.push(png.subarray(at, at + 12 + png.readUInt32BE(at)));
    else if (!written) parts.push(chunk('IDAT', deflateSync(Buffer.concat(rows))));
    written ||= is_data;
  }
  return Buffer.concat(parts);
}

test('figures of built-in scenes hold, whatever the page shows: 8 and 16 bits, opacity, styles', async () => {
  const { page, context, complaints } = await open();
  for (const [name, input, ...options] of [
    ['demo', 'demo', '--style', 'illustrative'],
    ['deep', 'demo', '--bits', '16', '--background', 'none'],
    ['spheres', 'four-spheres', '--recursion', '3'],
    ['bundled', join(source, 'data/1hpv.pdb'), '--title', 'Protease'], // the bytes of the demo
  ]) {
    await pick(page, [`${name}.png`, figure(input, name, ...options)]);
    const from = name === 'bundled' ? '1hpv.pdb' : input;
    const words = await judged(page, /erified: /);
    assert.match(words, new RegExp(`^${name}\\.png: drawn by bihive \\d+\\.\\d+\\.\\d+.* from ${from}\\. Verified: the same bits`));
    assert.equal(await page.getAttribute('#figures .message:last-child', 'data-state'), 'holds');
    await page.click('#figures .message:last-child button');
  }
  assert.match(await page.textContent('#facts'), /1,\d+ spheres, PDB/, 'the scene stays');
  no_complaints(complaints);
  await context.close();
});

test('one changed pixel is found', async () => {
  const { page, context, complaints } = await open();
  const png = figure('demo', 'changed', '--style', 'plain');
  await pick(page, ['changed.png', with_pixels(png, (bytes) => (bytes[3 * (64 * 7 + 5)] ^= 2))]);
  const words = await judged(page, /erified: /);
  assert.match(words, /Not verified: 1 pixel differs, by up to 2, the first at \(5, 7\); the file's pixels were changed after it was drawn/);
  assert.equal(await page.getAttribute('#figures .message', 'data-state'), 'fails');
  no_complaints(complaints);
  await context.close();
});

test('a figure of a file waits for it, and does not take another one of its name', async () => {
  const { page, context, complaints } = await open();
  const png = figure(own_file, 'own');
  await pick(page, ['own.png', png]);
  assert.match(await judged(page, /Open four/), /^own\.png: drawn by bihive .* from four\.xyz\. Open four\.xyz to verify it$/);

  const other = Buffer.from(four.toString().replace('0.9', '0.8'));
  await and_settle(page, () => pick(page, ['four.xyz', other]));
  assert.match(await judged(page, /other bytes/), /Not verified: four\.xyz here has other bytes/);
  await and_settle(page, () => pick(page, ['renamed.xyz', four]));
  await judged(page, /Verified: the same bits/);
  await page.click('#figures .message button');
  assert.equal(await page.locator('#figures .message').count(), 0);

  // It is the one on the page, and now its figure comes.
  await pick(page, ['own.png', png]);
  await judged(page, /Verified: the same bits/);
  await page.click('#figures .message button');

  // Both at once.
  const fresh = await open();
  await and_settle(fresh.page, () => pick(fresh.page, ['own.png', png], ['four.xyz', four]));
  await judged(fresh.page, /Verified: the same bits/);
  assert.match(await fresh.page.textContent('#facts'), /four\.xyz/, 'and the file is shown');
  for (const one of [{ context, complaints }, fresh]) {
    no_complaints(one.complaints);
    await one.context.close();
  }
});

test('what is no figure is refused with the reason', async () => {
  const { page, context, complaints } = await open();
  const png = figure('demo', 'refused', '--style', 'plain');
  for (const [name, bytes, reason] of [
    ['plain.png', figure('demo', 'bare', '--style', 'plain', '--no-metadata'), /plain\.png holds no record of how it was drawn/],
    ['cut.png', png.subarray(0, png.length - 30), /cut\.png is damaged/],
    ['flipped.png', Buffer.from(png.map((byte, i) => (i === 60 ? byte ^ 1 : byte))), /flipped\.png is damaged/],
    ['text.png', Buffer.from('no picture'), /text\.png is no PNG/],
    ['run.mp4', Buffer.from('film'), /run\.mp4 is a film that this page does not compare: bihive verify run\.mp4 does/],
    ['page.tif', Buffer.from('II*'), /page\.tif is a picture that this page does not compare/],
  ]) {
    await pick(page, [name, bytes]);
    assert.match(await shown_error(page), reason);
    await page.click('#errors .message button');
    assert.equal(await page.locator('#figures .message').count(), 0, 'nothing is left of it');
  }
  no_complaints(complaints);
  await context.close();
});

test('a comparison says how far it is, and can be cancelled by key', async () => {
  const { page, context, complaints } = await open();
  await pick(page, ['long.png', native_picture('demo', 'long', '--size', '640x480', '--samples', '16')]);
  await page.waitForFunction(() => document.querySelector('#figures progress')?.value > 0);
  assert.equal(await page.getAttribute('#figures', 'aria-live'), 'polite');
  assert.equal(await page.getAttribute('#figures .message button', 'aria-label'), 'Cancel the comparison: long.png');
  await page.focus('#figures .message button');
  await page.keyboard.press('Enter');
  assert.equal(await page.locator('#figures .message').count(), 0);
  await pick(page, ['next.png', figure('demo', 'next')]);
  await judged(page, /Verified: the same bits/);
  no_complaints(complaints);
  await context.close();
});

for (const [width, height] of [[390, 844], [1280, 800]])
  test(`figures on a screen of ${width} x ${height}`, async () => {
    const { page, context, complaints } = await open({ viewport: { width, height } });
    const png = figure('demo', 'shown', '--style', 'plain');
    await pick(page, ['figure.png', png]);
    await judged(page, /Verified/);
    await pick(page, ['a figure with a rather long name, as they are in papers.png', with_pixels(png, (bytes) => (bytes[0] ^= 1))]);
    await judged(page, /Not verified/);
    await pick(page, ['bare.png', figure('demo', 'bare', '--style', 'plain', '--no-metadata')], ['own.png', figure(own_file, 'own')]);
    await judged(page, /Open four/);
    await shown_error(page);
    const boxes = await page.$$eval('#notices .message', (all) =>
      all.map((one) => one.getBoundingClientRect()).map(({ left, right, top, bottom }) => ({ left, right, top, bottom })));
    for (const [i, { left, right, top }] of boxes.entries())
      assert.ok(left >= 0 && right <= width && (i === 0 || top >= boxes[i - 1].bottom), 'one below the other, none outside');
    await page.screenshot({ path: join(scratch, `figures-${width}.png`) });
    no_complaints(complaints);
    await context.close();
  });
