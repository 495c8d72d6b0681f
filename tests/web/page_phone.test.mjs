// The page on a phone: 360 pixels wide, by fingers.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { devices } from 'playwright-core';
import { and_settle, link_state, no_complaints, open_page, scratch, with_page } from './page_kit.mjs';

const kit = with_page();

// Fingers on the picture, each moving along a line, as events of the browser.
async function touch(page, lines) {
  const session = await page.context().newCDPSession(page);
  const points = (share) =>
    lines.map(([x0, y0, x1, y1], id) => ({ id, x: x0 + share * (x1 - x0), y: y0 + share * (y1 - y0) }));
  await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: points(0) });
  for (let i = 1; i <= 5; ++i)
    await session.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: points(i / 5) });
  await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
}

for (const scheme of ['light', 'dark'])
  test(`a phone of 360 pixels, ${scheme}`, async () => {
    const { page, context, complaints } = await open_page(kit.browser, kit.server.url, {
      ...devices['Pixel 7'],
      viewport: { width: 360, height: 740 },
      colorScheme: scheme,
    });
    await page.screenshot({ path: join(scratch, `phone-${scheme}.png`) });
    const width = () => page.evaluate(() => document.documentElement.scrollWidth);
    assert.equal(await width(), 360);
    const state = async () => {
      const found = await link_state(page);
      await page.click('#panel_close');
      return found.settings.camera;
    };
    const away = ({ eye, look_at }) => Math.hypot(...eye.map((value, i) => value - look_at[i]));

    const first = await state();
    await and_settle(page, () => touch(page, [[100, 300, 220, 330]]));
    const turned = await state();
    assert.notDeepEqual(turned.eye, first.eye);
    assert.ok(away(turned) / away(first) > 1 - 1e-6 && away(turned) / away(first) < 2, 'one finger turns, and all stays in view');
    await and_settle(page, () => touch(page, [[150, 300, 90, 240], [210, 360, 270, 420]]));
    const near = await state();
    assert.ok(away(near) < away(turned), 'two fingers apart come closer');
    await and_settle(page, () => touch(page, [[120, 300, 180, 380], [220, 300, 280, 380]]));
    const moved = await state();
    assert.notDeepEqual(moved.look_at, near.look_at);

    // The sheet: everything inside the window, nothing smaller than a fingertip.
    for (const card of await page.$$eval('.card', (all) => all.map(({ id }) => id.slice('card_'.length)))) {
      const by_thumb = page.by_hand.locator(`:is(#bar, #badge, .more_cards [data-card]) [data-card=${card}], #badge[data-card=${card}]`).first();
      if (await by_thumb.isVisible()) await by_thumb.tap();
      else {
        await page.tap('#bar [data-card=more]');
        await page.by_hand.locator(`.more_cards [data-card=${card}]`).tap();
      }
      await page.screenshot({ path: join(scratch, `phone-${scheme}-${card}.png`) });
      assert.equal(await width(), 360);
      const small = await page.evaluate(() =>
        [...document.querySelectorAll(':is(#panel, #bar) :is(button, select, input[type=range], .button)')]
          .filter((element) => element.getClientRects().length > 0 && element.getBoundingClientRect().height < 38)
          .map((element) => element.id || element.textContent),
      );
      assert.deepEqual(small, [], card);
      const outside = await page.evaluate(() =>
        [...document.querySelectorAll('#panel *')]
          .filter((element) => element.getClientRects().length > 0 && element.getBoundingClientRect().right > 361)
          .map((element) => element.outerHTML.slice(0, 80)),
      );
      assert.deepEqual(outside, [], card);
    }
    await page.tap('#thesis_open');
    await page.screenshot({ path: join(scratch, `phone-${scheme}-thesis.png`) });
    assert.equal(await width(), 360);
    no_complaints(complaints);
    await context.close();
  });

for (const scheme of ['light', 'dark'])
  test(`a desktop, ${scheme}`, async () => {
    const { page, context, complaints } = await open_page(kit.browser, kit.server.url, {
      viewport: { width: 1280, height: 800 },
      colorScheme: scheme,
    });
    await page.screenshot({ path: join(scratch, `desktop-${scheme}.png`) });
    no_complaints(complaints);
    await context.close();
  });
