// Speed of the page in this machine's Chromium: first picture, pictures at rest, frames while the scene turns. Prints
// JSON.
//   node page_times.mjs REPETITIONS
// Environment: BIHIVE, the program, which serves the page; CHROMIUM, the browser. Run in a folder with playwright-core.
import { spawn } from 'node:child_process';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const { chromium } = createRequire(join(process.cwd(), 'package.json'))('playwright-core');
const repetitions = Number(process.argv[2]);
const turning_ms = 3000;
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

// The page as `bihive web` serves it.
const server = spawn(process.env.BIHIVE, ['web', 'demo', '--port', '0', '--no-browser', '--json']);
server.stderr.pipe(process.stderr);
const url = JSON.parse(await new Promise((take) => server.stdout.once('data', (data) => take(String(data))))).url;
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM,
  args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});

// A new visitor each time: nothing is in the browser's cache.
async function visit() {
  const context = await browser.newContext({ viewport: { width: 640, height: 360 } });
  const page = await context.newPage();
  await page.goto(url);
  await settled(page);
  return { context, page };
}
const settled = (page) => page.waitForSelector('#picture[data-settled=true]', { timeout: 120_000 });
async function and_settle(page, work) {
  await page.evaluate(() => (document.getElementById('picture').dataset.settled = 'false'));
  await work();
  await settled(page);
}

const first_picture_ms = [];
for (let i = 0; i < repetitions; ++i) {
  const { context, page } = await visit();
  first_picture_ms.push(await page.evaluate(() => performance.getEntriesByName('first picture')[0].startTime));
  await context.close();
}

// One sample per pixel in the style that both engines draw, turned by a key.
const { context, page } = await visit();
await and_settle(page, () => page.$eval('#style input[value=plain]', (input) => input.click()));
await and_settle(page, () =>
  page.$eval('#samples_per_pixel', (input) => {
    input.value = '1';
    input.dispatchEvent(new Event('input', { bubbles: true }));
    input.dispatchEvent(new Event('change', { bubbles: true }));
  }),
);
const engines = {};
for (const engine of ['cpu', 'gpu']) {
  if (!(await page.isChecked(`#engine input[value=${engine}]`)))
    await and_settle(page, () => page.$eval(`#engine input[value=${engine}]`, (input) => input.click()));
  await page.focus('#picture');
  const at_rest_ms = [];
  for (let i = 0; i < repetitions; ++i) {
    const start = performance.now();
    await and_settle(page, () => page.keyboard.press('ArrowLeft'));
    at_rest_ms.push(performance.now() - start);
  }
  const end = performance.now() + turning_ms;
  while (performance.now() < end) await page.keyboard.press('ArrowLeft');
  engines[engine] = {
    at_rest_ms: median(at_rest_ms),
    size: await page.evaluate(() => {
      const box = document.getElementById('picture').getBoundingClientRect();
      return [box.width, box.height];
    }),
    while_turning: { rate: await page.textContent('#frame_rate'), size: await page.textContent('#badge_frame') },
  };
  await settled(page);
}
await context.close();
const version = browser.version();
await browser.close();
server.kill('SIGINT');
console.log(JSON.stringify({ chromium: version, first_picture_ms, engines }));
