// Shared by the tests of the page: the browser, a page that records errors, pictures compared pixel by pixel.
// Environment: PAGE, the folder that scripts/build_web made; BIHIVE and GL_COMPARE, the programs; CHROMIUM, the
// browser; SOURCE, the project; SCRATCH, a folder to write to.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before } from 'node:test';
import { inflateSync } from 'node:zlib';
import { chromium } from 'playwright-core';
import { serve } from './page_server.mjs';

export const folder = process.env.PAGE;
export const source = process.env.SOURCE;
export const scratch = process.env.SCRATCH;

// No sandbox: root and containers cannot have one. Software draws WebGL2.
const flags = [
  '--no-sandbox',
  '--disable-dev-shm-usage',
  '--use-gl=angle',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
];

export const launch = (...more) => chromium.launch({ executablePath: process.env.CHROMIUM, args: [...flags, ...more], timeout: patience });

/** A small window, which the picture fills, and the option for one of this size. */
export const [width, height] = [524, 262];
export const small = { viewport: { width, height } };
export const size = ['--size', `${width}x${height}`];

/** A browser and a server of the page for all tests of a file: {browser, server} once they run. */
export function with_page() {
  const kit = { browser: null, server: null };
  before(async () => {
    kit.browser = await launch();
    kit.server = await serve(folder);
  });
  after(async () => {
    await kit.browser?.close();
    kit.server?.close();
  });
  return kit;
}

/** How long a test waits for what must come: long, for other work may keep the machine busy. */
const patience = 300_000;

// As a user would who looks for a control: opens its card, and the groups around it.
async function unfold_around(locator) {
  if ((await locator.count()) === 0) return;
  await locator.evaluate((found) => {
    const card = found.closest('.card');
    if (card && (card.hidden || document.getElementById('panel').hidden)) document.querySelector(`[data-card="${card.id.slice('card_'.length)}"]`).click();
    // A group itself stays as it is.
    const group = found.localName === 'summary' ? found.parentElement : found;
    for (let box = (group.localName === 'details' ? group.parentElement : group).closest('details'); box; box = box.parentElement.closest('details')) box.open = true;
  });
}

const actions = ['click', 'tap', 'fill', 'check', 'uncheck', 'selectOption', 'focus', 'press', 'isVisible', 'isHidden', 'waitForSelector'];
const of_locators = [...actions.slice(0, -1), 'pressSequentially', 'scrollIntoViewIfNeeded'];

function with_cards_around(locator) {
  const { first, last, nth, locator: inner } = locator;
  const plain_first = first.call(locator);
  for (const action of of_locators) {
    const plain = locator[action].bind(locator);
    locator[action] = async (...all) => {
      await unfold_around(plain_first);
      return plain(...all);
    };
  }
  for (const [name, make] of Object.entries({ first, last, nth, locator: inner })) locator[name] = (...all) => with_cards_around(make.apply(locator, all));
  return locator;
}

/** A page whose actions first open the card of what they act on, so that tests need not say where it is. `by_hand`: without;
 * `unfold`: that alone. */
export function with_cards(page) {
  const find = page.locator.bind(page);
  page.unfold = (selector) => unfold_around(find(selector).first());
  page.by_hand = { locator: find };
  for (const action of actions) {
    const plain = page[action].bind(page);
    page.by_hand[action] = plain;
    page[action] = async (selector, ...more) => {
      await page.unfold(selector);
      return plain(selector, ...more);
    };
  }
  page.locator = (...all) => with_cards_around(find(...all));
  return page;
}

/** No card lies over the picture. */
export const close_card = (page) => page.evaluate(() => document.querySelector('#panel:not([hidden]) #panel_close')?.click());

/** Opens the page and waits for the first whole picture. `complaints` fills with whatever the browser complains of. */
export async function open_page(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 720, height: 480 }, acceptDownloads: true, ...options });
  context.setDefaultTimeout(patience);
  const page = with_cards(await context.newPage());
  const complaints = [];
  page.on('console', (message) => {
    if (message.type() === 'error') complaints.push(`console: ${message.text()}`);
  });
  page.on('pageerror', (error) => complaints.push(`script: ${error.message}`));
  context.on('request', (request) => {
    if (!request.url().startsWith(new URL(url).origin) && !/^(data|blob):/.test(request.url()))
      complaints.push(`a request leaves the origin: ${request.url()}`);
  });
  await page.goto(url);
  await settled(page);
  return { page, context, complaints };
}

/** Waits until all of the picture is drawn. */
export const settled = (page) => page.waitForSelector('#picture[data-settled=true]', { timeout: patience });

/** Opens a file of the user's, and waits until the page says these words of it, and for its picture. */
export async function open_own(page, file, words) {
  await page.setInputFiles('#file', file);
  await page.waitForFunction((text) => document.getElementById('facts').textContent.includes(text), words);
  await settled(page);
}

/** Does something that begins a new picture, and waits for the end of it. */
export async function and_settle(page, work) {
  await page.evaluate(() => (document.getElementById('picture').dataset.settled = 'false'));
  await work();
  await settled(page);
}

/** The words of the errors that are shown; waits for one. */
export async function shown_error(page) {
  await page.waitForSelector('#errors .message');
  return page.textContent('#errors .message p');
}

/** What `bihive render` makes of an input: the bytes of a PNG. */
export function native_picture(input, name, ...options) {
  const file = join(scratch, `${name}.png`);
  execFileSync(process.env.BIHIVE, ['render', input, '-o', file, ...options], { stdio: ['ignore', 'ignore', 'inherit'] });
  return readFileSync(file);
}

/** How far a picture of the page is from the CPU's, pixel by pixel, and whether each that differs lies on an edge: what
 * gl_compare (tests/gl) prints. `settings`: those of the page's link. */
export function agreement(input, name, png, settings, ...options) {
  const file = join(scratch, `${name}.png`);
  writeFileSync(file, png);
  const { eye, look_at, up, fov_deg } = settings.camera;
  const text = execFileSync(process.env.GL_COMPARE, [
    input, file, '--recursion', String(settings.recursion), '--samples', String(settings.samples_per_pixel),
    '--shadows', settings.shadows ? '1' : '0', '--view', settings.view, '--eye', eye.join(), '--look-at', look_at.join(),
    '--up', up.join(), '--fov', String(fov_deg), '--cpu', join(scratch, `${name}-cpu.png`), ...options,
  ]);
  return JSON.parse(text);
}

/** Saves a picture by the page's own button. */
export async function saved_picture(page, width, height) {
  await page.fill('#save_width', String(width));
  await page.fill('#save_height', String(height));
  const [download] = await Promise.all([page.waitForEvent('download', { timeout: patience }), page.click('#save')]);
  return readFileSync(await download.path());
}

/** Two PNGs pixel by pixel, decoded by the browser: {width, height, share}, the share of pixels that differ by more
 * than `by` of 255 in a channel; share 1 where the sizes differ. */
export async function compare(page, a, b, by) {
  return page.evaluate(
    async ([first, second, least]) => {
      const pixels = async (base64) => {
        const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }), { colorSpaceConversion: 'none' });
        const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
        const context = canvas.getContext('2d');
        context.drawImage(bitmap, 0, 0);
        return context.getImageData(0, 0, bitmap.width, bitmap.height);
      };
      const [p, q] = [await pixels(first), await pixels(second)];
      if (p.width !== q.width || p.height !== q.height) return { width: p.width, height: p.height, share: 1 };
      let different = 0;
      for (let i = 0; i < p.data.length; i += 4)
        if ([0, 1, 2].some((k) => Math.abs(p.data[i + k] - q.data[i + k]) > least)) ++different;
      return { width: p.width, height: p.height, share: different / (p.width * p.height) };
    },
    [a.toString('base64'), b.toString('base64'), by],
  );
}

/** A PNG of 8 bits as {width, height, channels, bytes}: its very numbers, as no browser gives those of clear pixels. */
export function decoded(png) {
  const header = { width: png.readUInt32BE(16), height: png.readUInt32BE(20), channels: { 2: 3, 6: 4 }[png[25]] };
  assert.deepEqual([png[24], png[28]], [8, 0], '8 bits, not interlaced');
  const parts = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at))
    if (png.toString('latin1', at + 4, at + 8) === 'IDAT') parts.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
  const packed = inflateSync(Buffer.concat(parts));
  const row = header.width * header.channels;
  const bytes = Buffer.alloc(row * header.height);
  for (let y = 0; y < header.height; ++y)
    for (let i = 0; i < row; ++i) {
      const at = y * row + i;
      const left = i < header.channels ? 0 : bytes[at - header.channels];
      const up = y === 0 ? 0 : bytes[at - row];
      const corner = y === 0 || i < header.channels ? 0 : bytes[at - row - header.channels];
      const [a, b, c] = [Math.abs(up - corner), Math.abs(left - corner), Math.abs(left + up - 2 * corner)];
      const paeth = a <= b && a <= c ? left : b <= c ? up : corner;
      bytes[at] = packed[y * (row + 1) + 1 + i] + [0, left, up, (left + up) >> 1, paeth][packed[y * (row + 1)]];
    }
  return { ...header, bytes };
}

/** Asserts that two PNGs hold the same numbers. */
export function assert_same_picture(png, expected, what) {
  const [a, b] = [decoded(png), decoded(expected)];
  assert.deepEqual([a.width, a.height, a.channels], [b.width, b.height, b.channels], what);
  assert.ok(a.bytes.equals(b.bytes), `${what}: the numbers differ`);
}

/** The picture on the screen, without the controls over it. */
export async function shown_picture(page, canvas) {
  const covers = (visibility) =>
    page.evaluate((value) => {
      for (const cover of document.querySelectorAll('#stage > :not(#picture), #tools, #panel')) cover.style.visibility = value;
    }, visibility);
  await covers('hidden');
  const shown = await page.locator(canvas).screenshot();
  await covers('');
  return shown;
}

/** Moves a slider or types into a number as a user does. */
export async function set_value(page, selector, value) {
  await page.$eval(
    selector,
    (input, to) => {
      input.value = String(to);
      input.dispatchEvent(new Event('input', { bubbles: true }));
      input.dispatchEvent(new Event('change', { bubbles: true }));
    },
    value,
  );
}

/** The state that the page's link holds. */
export async function link_state(page) {
  await page.click('#copy_link');
  return state_of_address(page);
}

/** The same, once somebody has copied it. */
export async function state_of_address(page) {
  await page.waitForFunction(() => location.hash.startsWith('#state='));
  const text = new URL(page.url()).hash.slice('#state='.length);
  return JSON.parse(Buffer.from(text, 'base64url').toString('utf8'));
}

export const no_complaints = (complaints) => assert.deepEqual(complaints, []);
