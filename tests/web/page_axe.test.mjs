// axe-core finds nothing to complain of: each card open, on four sizes of screen, in both themes and with forced colours.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import { no_complaints, open_page, with_page } from './page_kit.mjs';

const kit = with_page();
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const sizes = [
  [320, 640],
  [390, 844],
  [1280, 800],
  [2560, 1440],
];

/** What axe finds on the page as it is: a line for each element. */
async function found_by_axe(page) {
  const results = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }));
  return results.violations.flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.target.join(' ')}: ${node.failureSummary.replace(/\s+/g, ' ')}`));
}

for (const [name, media] of [
  ['light', { colorScheme: 'light' }],
  ['dark', { colorScheme: 'dark' }],
  ['forced colours', { colorScheme: 'dark', forcedColors: 'active' }],
])
  test(`nothing is found: ${name}`, async () => {
    const { page, context, complaints } = await open_page(kit.browser, kit.server.url, { viewport: { width: 390, height: 844 }, ...media });
    await page.evaluate(axe);
    // A fault that it must find.
    await page.evaluate(() => document.getElementById('bar').append(Object.assign(document.createElement('button'), { id: 'planted' })));
    assert.match((await found_by_axe(page)).join(), /button-name: #planted/);
    await page.evaluate(() => document.getElementById('planted').remove());
    const found = [];
    for (const [width, height] of sizes) {
      await page.setViewportSize({ width, height });
      const look = async (what) => found.push(...(await found_by_axe(page)).map((line) => `${width}x${height}, ${what}: ${line}`));
      await look('no card');
      for (const card of await page.$$eval('[data-card]', (all) => all.map((one) => one.dataset.card))) {
        await page.evaluate((which) => {
          const button = document.querySelector(`[data-card="${which}"]`);
          if (button.getAttribute('aria-expanded') !== 'true') button.click();
          // All that the card holds.
          for (const fold of document.querySelectorAll(`#card_${which} details`)) fold.open = true;
        }, card);
        assert.ok(await page.by_hand.isVisible(`#card_${card}`), card);
        await look(card);
      }
      await page.keyboard.press('Escape');
    }
    assert.deepEqual(found, []);
    no_complaints(complaints);
    await context.close();
  });
