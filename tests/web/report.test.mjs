// The report of `bihive thesis` in a real browser, on a desktop and on a phone.
// Environment: REPORT, the path of report.html; CHROMIUM, the browser's.
import assert from 'node:assert/strict';
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const report = process.env.REPORT;
const windows = {
  desktop: { viewport: { width: 1280, height: 900 }, colorScheme: 'light' },
  phone: { viewport: { width: 360, height: 740 }, colorScheme: 'dark', isMobile: true, hasTouch: true, deviceScaleFactor: 2 },
};
// A picture with a larger share of one colour is almost blank. (A tree of one leaf is drawn with two colours.)
const largestShare = 0.99;
// The least height of a chart's text that can be read on a phone, in CSS pixels.
const leastTextHeight = 8;

// No sandbox: root and containers cannot have one. Shared memory is small or missing there too.
let browser;
before(async () => {
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM, args: ['--no-sandbox', '--disable-dev-shm-usage'] });
});
after(() => browser?.close());

// Runs inside the page: collects its content and its faults.
async function look({ width, largestShare, leastTextHeight }) {
  const faults = [];
  const check = (good, fault) => good || faults.push(fault);
  const nameOf = (element) => element.closest('figure')?.querySelector('figcaption')?.textContent ?? element.tagName;
  const root = document.documentElement;

  // Nothing is wider than the window.
  check(root.scrollWidth <= width, `the page is ${root.scrollWidth} wide in a window of ${width}`);
  // What is folded too.
  for (const folded of document.querySelectorAll('details')) folded.open = true;
  check(root.scrollWidth <= width, `the page is ${root.scrollWidth} wide in a window of ${width} when all is unfolded`);
  // Every column of a table is in sight: on a phone a row is a card, and each of its cells has the column's name.
  for (const cell of document.querySelectorAll('.cards tbody > tr > *')) {
    const box = cell.getBoundingClientRect();
    check(box.right <= width + 1, `a cell leaves the window: ${cell.textContent.slice(0, 60)}`);
    if (width < 500 && cell.tagName === 'TD' && cell.textContent.trim() !== '') {
      check(cell.dataset.label, `a cell without its column's name: ${cell.textContent.slice(0, 60)}`);
      check(getComputedStyle(cell, '::before').content.includes(cell.dataset.label), `no name before: ${cell.textContent.slice(0, 60)}`);
    }
  }

  // Every chart and drawing has marks that can be seen.
  const drawings = [...document.querySelectorAll('figure > svg')];
  for (const svg of drawings) {
    const isChart = svg.classList.contains('bihive-chart');
    const marks = [...svg.querySelectorAll(isChart ? '.mark' : 'rect, path, circle, line, polygon')];
    const seen = marks.filter((mark) => {
      const box = mark.getBoundingClientRect();
      return box.width > 0 && box.height > 0;
    });
    check(seen.length > 0, `no marks in "${nameOf(svg)}"`);
    const text = svg.querySelector('text');
    if (isChart && text) check(text.getBoundingClientRect().height >= leastTextHeight, `tiny text in "${nameOf(svg)}"`);
  }

  // Every picture is there and shows something.
  const pictures = [...document.querySelectorAll('figure > img')];
  for (const image of pictures) {
    check(image.alt.trim() !== '', `no alternative text of "${nameOf(image)}"`);
    await image.decode().catch(() => {});
    if (!image.naturalWidth) {
      faults.push(`a picture is not loaded: "${nameOf(image)}"`);
      continue;
    }
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const pixels = new Uint32Array(context.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
    const counts = new Map();
    for (const pixel of pixels) counts.set(pixel, (counts.get(pixel) ?? 0) + 1);
    const share = Math.max(...counts.values()) / pixels.length;
    check(share <= largestShare, `a picture with ${share} of one colour: "${nameOf(image)}"`);
  }

  // Each claim leads to its experiment, and has a sign and words.
  const claims = [...document.querySelectorAll('#claims .claims tbody tr')];
  for (const claim of claims) {
    const link = claim.querySelector('a');
    check(link && document.getElementById(link.hash.slice(1)), `a claim leads nowhere: ${claim.textContent}`);
    const verdict = claim.cells[1];
    check(verdict.querySelector('.sign') && verdict.textContent.trim().length > 5, `a claim without a verdict: ${claim.textContent}`);
  }

  // Green is what agrees with the text alone: nothing set, fitted or read.
  const colours = ['agrees', 'set', 'fitted', 'unlike', 'differs'].map((state) => {
    const sign = document.querySelector(`#claims td .sign.${state}`);
    return sign && getComputedStyle(sign).color;
  });
  const shown = colours.filter(Boolean);
  check(new Set(shown).size === shown.length, `two states share a colour: ${colours}`);
  const experiments = document.querySelectorAll('section[id]').length - 3; // the claims, this run, and other devices
  return { claims: claims.length, faults, drawings: drawings.length, pictures: pictures.length, experiments };
}

// Opens the file in a window; errors of the browser also count as faults.
async function inspect(file, window) {
  const context = await browser.newContext(window);
  context.setDefaultTimeout(300_000); // other work may keep the machine busy
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (message) => message.type() === 'error' && complaints.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`script: ${error.message}`));
  page.on('request', (request) => {
    if (!/^(file|data):/.test(request.url())) complaints.push(`a request leaves the file: ${request.url()}`);
  });
  await page.goto(pathToFileURL(file).href, { waitUntil: 'load' });
  const found = await page.evaluate(look, { width: window.viewport.width, largestShare, leastTextHeight });
  await context.close();
  return { ...found, faults: [...complaints, ...found.faults] };
}

const results = JSON.parse(readFileSync(join(dirname(report), 'results.json'), 'utf8'));
const picturesIn = (part) =>
  part === null || typeof part !== 'object' ? 0 : part.picture_hash ? 1 : Object.values(part).reduce((sum, one) => sum + picturesIn(one), 0);
const pictures = results.experiments.reduce((sum, experiment) => sum + picturesIn(experiment.data), 0);

for (const [name, window] of Object.entries(windows))
  test(`the report on a ${name}`, async () => {
    const found = await inspect(report, window);
    assert.deepEqual(found.faults, []);
    assert.equal(found.experiments, results.experiments.length);
    assert.equal(found.claims, results.claims.length);
    assert.ok(found.claims > 60);
    assert.equal(found.pictures, pictures + 6); // six on the first page again
    assert.equal(found.drawings, 8); // the diagram twice, and three charts each of Figures 4.4 and 4.5
  });

// A report that is damaged on purpose: each damage must be found.
const html = readFileSync(report, 'utf8');
const blank =
  'data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==';
const damages = {
  'a blank picture': [/src="data:image\/png;base64,[^"]*"/, `src="${blank}"`, /a picture with 1 of one colour/],
  'a broken picture': [/src="data:image\/png;base64,[^"]*"/, 'src="data:image/png;base64,AAAA"', /not loaded/],
  'a chart without marks': [/class="mark/g, 'class="none', /no marks/],
  'something too wide': ['<main>', '<main><div style="width:2000px">wide</div>', /wide in a window of 360/],
  'a request': ['</main>', '<img src="http://127.0.0.1:9/a.png"></main>', /leaves the file/],
  'an error': ['</main>', '<script>console.error("bad")</script></main>', /console: bad/],
  'a claim that leads nowhere': [/(id="claims"[\s\S]*?)href="#/, (all, before) => `${before}href="#no-`, /a claim leads nowhere/],
  'a fit that looks like agreement': ['--fitted: #8cc3ee', '--fitted: #7fd898', /share a colour/],
  'a cell without its name': [/data-label="Verdict"/g, 'data-other="Verdict"', /without its column's name/],
};
for (const [name, [what, instead, fault]] of Object.entries(damages))
  test(`the test finds ${name}`, async () => {
    const damaged = html.replace(what, typeof instead === 'function' ? instead : () => instead);
    assert.ok(damaged !== html, 'nothing to damage');
    const file = join(dirname(report), 'damaged.html');
    writeFileSync(file, damaged);
    const { faults } = await inspect(file, windows.phone);
    rmSync(file);
    assert.match(faults.join('\n'), fault);
  });
