// Films, and what goes out of the page besides pictures.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { and_settle, assert_same_picture, close_card, decoded, link_state, state_of_address, no_complaints, open_own, open_page, saved_picture, scratch, settled, set_value, small, with_page } from './page_kit.mjs';

const kit = with_page();

async function film(page) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#film_save')]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

// Elements of Matroska by their ids, those inside of others too.
function elements(bytes, from = 0, to = bytes.length) {
  const containers = new Set([0x18538067, 0x1549a966, 0x1654ae6b, 0xae, 0xe0, 0x1f43b675, 0x1a45dfa3]);
  const found = [];
  for (let at = from; at < to; ) {
    const id_length = Math.clz32(bytes[at]) - 23;
    const id = bytes.readUIntBE(at, id_length);
    at += id_length;
    assert.equal(bytes[at], 1, 'sizes have eight bytes');
    const size = bytes.readUIntBE(at + 2, 6);
    at += 8;
    assert.ok(at + size <= to, 'inside the one around it');
    if (containers.has(id)) found.push(...elements(bytes, at, at + size));
    else found.push({ id, content: bytes.subarray(at, at + size) });
    at += size;
  }
  return found;
}
const of_id = (all, id) => all.filter((one) => one.id === id).map(({ content }) => content);
const block_times = (all) => {
  let cluster = 0;
  return all.flatMap(({ id, content }) => {
    if (id === 0xe7) cluster = content.readUIntBE(0, content.length);
    return id === 0xa3 ? [{ time: cluster + content.readInt16BE(1), is_key: (content[3] & 0x80) !== 0 }] : [];
  });
};

test('the card shows in small what will be saved, with its shape and background', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, { viewport: { width: 900, height: 600 } });
  // The page may not fetch what it shows.
  await page.evaluate(() => {
    const plain = URL.createObjectURL;
    URL.createObjectURL = (blob) => plain.call(URL, (globalThis.shown = blob));
  });
  const drawn = async (width, height) => {
    await page.fill('#save_width', String(width));
    await page.fill('#save_height', String(height));
    const shape = (280 * height) / width <= 160 ? [280, Math.round((280 * height) / width)] : [Math.round((160 * width) / height), 160];
    await page.waitForFunction(([w, h]) => {
      const { naturalWidth, naturalHeight } = document.getElementById('save_preview');
      return naturalWidth === w && naturalHeight === h;
    }, shape);
    const base64 = await page.evaluate(async () => btoa(String.fromCharCode(...new Uint8Array(await globalThis.shown.arrayBuffer()))));
    return { png: Buffer.from(base64, 'base64'), shape };
  };
  // In its own size the picture is the preview.
  for (const [width, height] of [[700, 200], [300, 900]]) {
    const { png, shape } = await drawn(width, height);
    assert_same_picture(png, await saved_picture(page, ...shape), `${width} x ${height}`);
    await settled(page);
  }
  // Another size while one is drawn.
  await page.fill('#save_width', '900');
  await page.waitForTimeout(230);
  await drawn(640, 480);
  const before = await page.getAttribute('#save_preview', 'src');
  await page.click('#save_clear');
  await page.waitForFunction((src) => document.getElementById('save_preview').src !== src, before);
  await settled(page);
  const clear = await drawn(300, 900);
  assert.equal(decoded(clear.png).channels, 4);
  assert_same_picture(clear.png, await saved_picture(page, ...clear.shape), 'clear');
  await settled(page);
  await page.waitForTimeout(600);
  await page.screenshot({ path: join(scratch, 'preview.png') });
  // It gives way to a picture that is saved, and is not drawn without need.
  const src = await page.getAttribute('#save_preview', 'src');
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
  assert.ok(readFileSync(await download.path()).length > 1000);
  await page.waitForSelector('#picture[data-settled=true]');
  await page.waitForTimeout(600);
  assert.equal(await page.getAttribute('#save_preview', 'src'), src);
  no_complaints(complaints);
  await context.close();
});

test('a film turns once around, and leaves camera and history alone', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  const before = (await link_state(page)).settings.camera;
  await page.fill('#save_width', '97');
  await page.fill('#save_height', '64');
  await page.fill('#film_seconds', '1.5');
  await page.fill('#film_speed', '20');
  assert.ok(await page.locator('#film_kind [value=frames]').isDisabled(), 'one frame is no film');
  const { name, bytes } = await film(page);
  assert.equal(name, 'demo.webm');
  const all = elements(bytes);
  assert.deepEqual([of_id(all, 0xb0)[0].readUInt8(0), of_id(all, 0xba)[0].readUInt8(0)], [96, 64], 'even numbers of pixels');
  assert.equal(of_id(all, 0x4489)[0].readDoubleBE(0), 1500, 'milliseconds');
  assert.match(of_id(all, 0x86)[0].toString(), /^V_VP[89]$/);
  const blocks = block_times(all);
  assert.deepEqual(blocks.map(({ time }) => time), Array.from({ length: 30 }, (_, i) => 50 * i));
  assert.ok(blocks[0].is_key && blocks[25].is_key);
  writeFileSync(join(scratch, name), bytes);
  await page.waitForSelector('#picture[data-settled=true]');
  assert.deepEqual((await link_state(page)).settings.camera, before);
  assert.ok(await page.isHidden('#busy'));

  // Cancelled at once.
  await page.fill('#film_seconds', '60');
  await page.click('#film_save');
  await page.click('#film_cancel');
  await page.waitForFunction(() => document.getElementById('messages').textContent.includes('cancelled'));
  await page.waitForSelector('#picture[data-settled=true]');
  assert.deepEqual((await link_state(page)).settings.camera, before);
  assert.ok(await page.isVisible('#film_save'));
  no_complaints(complaints);
  await context.close();
});

test('a film of a file has all of its frames, and shows the one before again', async () => {
  const file = join(scratch, 'steps.xyz');
  const frame = (i) => `2\nframe ${i}\nC 0 0 0\nO ${2 + i} 0 0\n`;
  writeFileSync(file, [0, 1, 2, 3].map(frame).join(''));
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  await open_own(page, file, '4 frames');
  await and_settle(page, () => set_value(page, '#player_frame', 2));
  await page.waitForSelector('#player[data-frame="2"]');
  await page.fill('#save_width', '64');
  await page.fill('#save_height', '48');
  await page.selectOption('#film_kind', 'frames');
  assert.ok(await page.isHidden('#film_seconds_row'));
  const { name, bytes } = await film(page);
  assert.equal(name, 'steps.webm');
  assert.deepEqual(block_times(elements(bytes)).map(({ time }) => time), [0, 40, 80, 120]);
  await page.waitForSelector('#player[data-frame="2"]');
  no_complaints(complaints);
  await context.close();
});

test('a film has the colours of the pictures', async () => {
  const file = join(scratch, 'colours.xyz');
  const frame = 'Properties=species:S:1:pos:R:3:color:R:3\nX -2 0 0 1 0 0\nX 0 0 0 0 1 0\nX 2 0 0 0 0 1\n';
  writeFileSync(file, `3\n${frame}3\n${frame}`);
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  await open_own(page, file, '2 frames');
  await and_settle(page, () => set_value(page, '#samples_per_pixel', 1));
  await page.fill('#save_width', '192');
  await page.fill('#save_height', '128');
  await page.selectOption('#film_kind', 'frames');
  const { bytes } = await film(page);
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
  const made = join(scratch, 'colours.webm');
  writeFileSync(made, bytes);
  const probed = JSON.parse(execFileSync('ffprobe', ['-v', 'error', '-show_streams', '-of', 'json', made], { encoding: 'utf8' })).streams[0];
  for (const [name, value] of [['color_space', 'bt709'], ['color_range', 'tv'], ['color_primaries', 'bt709'], ['color_transfer', 'bt709']])
    assert.equal(probed[name], value, name);
  const rgb = (path) =>
    execFileSync('ffmpeg', ['-v', 'error', '-i', path, '-frames:v', '1', '-sws_flags', 'accurate_rnd+full_chroma_int+bilinear', '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-'], { maxBuffer: 1 << 24 });
  const [shown, drawn] = [rgb(made), rgb(await download.path())];
  assert.equal(shown.length, drawn.length);
  // Flat places: edges lose colour to the codec. Another matrix would change pure colours by more than 15.
  const flat = [];
  for (let y = 2; y < 126; ++y)
    for (let x = 2; x < 190; ++x) {
      const value = (dx, dy, k) => drawn[3 * ((y + dy) * 192 + x + dx) + k];
      const around = [0, 1, 2].map((k) => [[0, 0], [2, 0], [-2, 0], [0, 2], [0, -2]].map(([dx, dy]) => value(dx, dy, k)));
      if (around.every((values) => Math.max(...values) - Math.min(...values) < 12)) flat.push([0, 1, 2].map((k) => shown[3 * (y * 192 + x) + k] - value(0, 0, k)));
    }
  assert.ok(flat.length > 5000, `${flat.length}`);
  for (const k of [0, 1, 2]) {
    const mean = flat.reduce((sum, one) => sum + Math.abs(one[k]), 0) / flat.length;
    assert.ok(mean < 2, `channel ${k}: ${mean}`);
  }
  no_complaints(complaints);
  await context.close();
});

test('a wide window has the program’s camera, and so has a tall one', async () => {
  for (const [width, height] of [[1000, 300], [340, 900], [500, 400]]) {
    const { page, context, complaints } = await open_page(kit.browser, kit.server.url, { viewport: { width, height } });
    const seen = await page.$eval('#picture', ({ clientWidth, clientHeight }) => [clientWidth, clientHeight]);
    const report = JSON.parse(execFileSync(process.env.BIHIVE, ['render', 'demo', '-o', join(scratch, 'wide.png'), '--size', seen.join('x'), '--samples', '1', '--json'], { encoding: 'utf8' }));
    // Without the card, which would take a part of a small window.
    await page.evaluate(() => document.getElementById('copy_link').click());
    const { camera } = (await state_of_address(page)).settings;
    for (const member of ['eye', 'look_at', 'fov_deg']) assert.deepEqual(camera[member], report.settings.camera[member], `${member} at ${seen}`);
    no_complaints(complaints);
    await context.close();
  }
});

test('code for a page of one’s own shows the page that is saved beside it', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, { permissions: ['clipboard-read', 'clipboard-write'] });
  await page.click('#copy_embed');
  await page.waitForFunction(() => document.getElementById('messages').textContent.includes('demo.html'));
  const code = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(code, /^<iframe src="demo\.html\?embed=" title="HIV-1 protease with amprenavir · 1HPV · bihive"/);
  await close_card(page);
  no_complaints(complaints);
  await context.close();
});
