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

  // Nothing is wider than the window; wider things scroll inside their own box.
  check(root.scrollWidth <= width, `the page is ${root.scrollWidth} wide in a window of ${width}`);
  for (const box of document.querySelectorAll('.scroll'))
    check(box.getBoundingClientRect().right <= width, `a table's box leaves the window: ${box.ariaLabel}`);

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

  // The contents lead to the sections, and show each experiment's state by a colour and a word.
  const entries = [...document.querySelectorAll('.contents li')];
  for (const entry of entries) {
    const link = entry.querySelector('a');
    check(document.getElementById(link.hash.slice(1)), `the contents lead nowhere: ${link.hash}`);
    const states = ['agrees', 'differs', 'inconsistent', 'undecided', 'inferred', 'check', 'open'];
    check(states.includes(entry.className), `no state of ${link.hash}`);
    check(entry.querySelector('.state').textContent.trim() !== '', `no words on ${link.hash}`);
  }

  // Each claim of the page of verdicts leads to its figure, and has a colour and a word.
  const claims = [...document.querySelectorAll('#verdicts tbody tr')];
  for (const claim of claims) {
    const link = claim.querySelector('a');
    check(link && document.getElementById(link.hash.slice(1)), `a claim leads nowhere: ${claim.textContent}`);
    check(claim.className !== '' && claim.cells[1].textContent.trim() !== '', `a claim without a verdict: ${claim.textContent}`);
  }

  // Green is what agrees with the text alone: nothing inferred, no check of our own.
  const papers = ['agrees', 'inferred', 'check', 'differs'].map((state) => {
    const row = document.querySelector(`section tr.${state}`);
    return row && getComputedStyle(row).backgroundColor;
  });
  const shown = papers.filter(Boolean);
  check(new Set(shown).size === shown.length, `two states share a colour: ${papers}`);
  return { claims: claims.length, faults, drawings: drawings.length, pictures: pictures.length, entries: entries.length };
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
const files = results.experiments.flatMap((experiment) => experiment.illustrations.map((each) => each.file));

for (const [name, window] of Object.entries(windows))
  test(`the report on a ${name}`, async () => {
    const found = await inspect(report, window);
    assert.deepEqual(found.faults, []);
    assert.equal(found.entries, results.experiments.length);
    assert.equal(found.claims, results.verdicts.length);
    assert.ok(found.claims > 0);
    assert.equal(found.drawings, files.filter((file) => file.endsWith('.svg')).length);
    assert.equal(found.pictures, files.filter((file) => file.endsWith('.png')).length);
    assert.ok(found.drawings > 0 && found.pictures > 0);
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
  'a dead link': ['href="#', 'href="#no-', /lead nowhere/],
  'a claim that leads nowhere': [/(id="verdicts"[\s\S]*?)href="#/, (all, before) => `${before}href="#no-`, /a claim leads nowhere/],
  'a check that looks like agreement': ['--check-paper: #24223a', '--check-paper: #17301e', /share a colour/],
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
