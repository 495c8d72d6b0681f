// Frames per second that the page shows in this machine's Chromium: what the dialog's "Frames shown" measures, saved as
// its user would save it.
//   node shown_frames.mjs FILE.json [--quick]
// Environment: BIHIVE, the program, which serves the page; CHROMIUM, the browser. Run in a folder with playwright-core.
import { spawn } from 'node:child_process';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const { chromium } = createRequire(join(process.cwd(), 'package.json'))('playwright-core');
const [, , file, quick] = process.argv;
const server = spawn(process.env.BIHIVE, ['web', 'scenario1', '--port', '0', '--no-browser', '--json']);
server.stderr.pipe(process.stderr);
try {
  const url = new URL(JSON.parse(await new Promise((take) => server.stdout.once('data', (data) => take(String(data))))).url);
  if (quick) url.searchParams.set('quick', '');
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM,
    args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
  try {
    // The picture has at least the size of the frames.
    const page = await browser.newPage({ viewport: { width: 1600, height: 720 } });
    await page.goto(String(url));
    await page.waitForSelector('#picture[data-settled=true]', { timeout: 120_000 });
    await page.$eval('#thesis_open', (button) => button.click()); // its card is closed
    await page.click('#thesis_shown');
    await page.waitForSelector('#thesis_json:not([hidden])', { timeout: 600_000 });
    const words = await page.textContent('#thesis_text');
    if (!/^36 measurements/.test(words)) throw new Error(words);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#thesis_json')]);
    await download.saveAs(file);
  } finally {
    await browser.close();
  }
} finally {
  server.kill('SIGINT');
}
