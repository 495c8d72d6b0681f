// The page that measures a phone: one file, opened without a server in a browser like a phone's.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { after, before, test } from 'node:test';
import { folder, launch, no_complaints, scratch } from './page_kit.mjs';

const file = join(scratch, 'phone.html');
let browser;
before(async () => {
  // As users get it, where `bihive thesis --page` finds the page's folder.
  execFileSync(process.env.BIHIVE, ['thesis', '--page', file], { env: { ...process.env, BIHIVE_PAGE: folder } });
  browser = await launch();
});
after(() => browser?.close());

async function open_file(query) {
  const context = await browser.newContext({
    viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true, acceptDownloads: true, offline: true,
  });
  context.setDefaultTimeout(600_000);
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (message) => message.type() === 'error' && complaints.push(`console: ${message.text()}`));
  page.on('pageerror', (error) => complaints.push(`script: ${error.message}`));
  context.on('request', (request) => /^(file|data|blob):/.test(request.url()) || complaints.push(`a request: ${request.url()}`));
  await page.goto(`${pathToFileURL(file).href}${query}`);
  await page.waitForSelector('#run:not([disabled])');
  return { context, page, complaints };
}

test('the page for phones is one file that can be sent', () => {
  assert.ok(statSync(file).size < 2e6, `${statSync(file).size} bytes`);
  assert.doesNotMatch(readFileSync(file, 'utf8'), /(src|href)="(?!data:)/);
});

test('the page for phones measures both engines, their heat and the screen, and saves what --device reads', async () => {
  const { context, page, complaints } = await open_file('?minutes=0.1');
  assert.match(await page.textContent('#text'), /^Graphics processor: .*SwiftShader/);
  await page.tap('#run');
  await page.waitForFunction(() => document.querySelector('#text').textContent === 'All is measured.');
  const found = await page.textContent('#found');
  assert.match(found, /By one thread of the processor, the cost of an inner node over that of a sphere test is .+, and that of a leaf over an inner node is .+(\. At these costs BIH 8 wins \d of 9|, so that no winner follows)/);
  assert.match(found, /drawn by software here: no verdict/);
  assert.match(found, /In pictures of the same size the graphics processor draws [\d.e+-]+ times the frames/);
  assert.match(found, /scaled by area to 1136 × 640/);
  assert.match(found, /Frames that this screen showed at 1136 × 640/);
  assert.match(found, /No phone has been measured so far/);
  assert.doesNotMatch(found, /NaN|undefined|Infinity/);
  // The diagram of the engine that is no software, with this device as its point.
  assert.equal(await page.locator('#charts svg .point').count(), 1);
  assert.equal(await page.locator('#rates table').count(), 2);
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await page.screenshot({ path: join(scratch, 'phone-file.png'), fullPage: true });

  const [json] = await Promise.all([page.waitForEvent('download'), page.tap('#json')]);
  const saved = join(scratch, 'bihive-phone.json');
  copyFileSync(await json.path(), saved);
  const result = JSON.parse(readFileSync(saved, 'utf8'));
  assert.deepEqual(result.runs.map(({ engine }) => engine), ['cpu', 'gpu']);
  for (const run of result.runs) {
    assert.equal(run.complete, true);
    assert.equal(run.configurations.length, 54);
    const passes = result.passes.filter(({ engine }) => engine === run.engine);
    assert.equal(run.rounds, passes.length);
    assert.ok(run.configurations.every(({ frame_ms }) => frame_ms.length === passes.length));
  }
  assert.equal(result.shown.configurations.length, 36);

  // A run of ten minutes: the same file, with passes of another minute.
  result.passes = result.passes.flatMap((pass) => [pass, { ...pass, minute: 10, round_ms: 1.5 * pass.round_ms }]);
  writeFileSync(saved, JSON.stringify(result));
  const out = join(scratch, 'phone-report');
  execFileSync(process.env.BIHIVE, ['thesis', 'figure-4.2', '--quick', '--out', out, '--device', saved]);
  const { devices, shown_frames } = JSON.parse(readFileSync(join(out, 'results.json'), 'utf8'));
  assert.deepEqual(devices.map(({ engine, heat }) => [engine, heat.last_minute]), [['cpu', 10], ['gpu', 10]]);
  assert.ok(devices.every(({ heat }) => heat.last_ms > heat.first_ms));
  assert.equal(shown_frames.length, 4);
  no_complaints(complaints);
  await context.close();
});

test('a stopped run shows what was complete', async () => {
  const { context, page, complaints } = await open_file('?minutes=10');
  await page.tap('#run');
  await page.waitForFunction(() => /^Minute 1 of 10: /.test(document.querySelector('#text').textContent));
  await page.tap('#stop');
  await page.waitForFunction(() => /^Stopped/.test(document.querySelector('#text').textContent));
  assert.ok(await page.isVisible('#run'));
  assert.ok(await page.isHidden('#json'), 'no pass was complete');
  no_complaints(complaints);
  await context.close();
});
