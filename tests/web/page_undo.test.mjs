// Undo and redo, and what a reload of the page brings back.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { and_settle, link_state, no_complaints, open_own, open_page, scratch, set_value, settled, shown_picture, small, with_cards, with_page } from './page_kit.mjs';

const kit = with_page();
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

// Two changes in a second may be one step.
const apart = async (page, work) => {
  await pause(1100);
  await and_settle(page, work);
};
const enabled = async (page, id) => (await page.getAttribute(`#${id}`, 'aria-disabled')) === 'false';
const choices = async (page) => {
  const { settings, look } = await link_state(page);
  return { settings, look };
};

// Three spheres: two of A, one of B.
const own_file = join(scratch, 'three.csv');
writeFileSync(own_file, 'x,y,z,r,kind\n0,0,0,1,A\n3,0,0,1,A\n0,3,0,1,B\n');

test('undo and redo bring back every state, and the picture of it', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  const states = [await choices(page)];
  const pictures = [await shown_picture(page, '#cpu_canvas')];
  const steps = [
    () => page.click('#style label:has(input[value=studio])'),
    async () => {
      await page.focus('#picture');
      await page.keyboard.press('ArrowLeft');
    },
    () => set_value(page, '#recursion', 2),
    () => page.selectOption('#background', 'none'),
    () => page.click('[data-side=top]'),
  ];
  for (const step of steps) {
    await apart(page, step);
    states.push(await choices(page));
    pictures.push(await shown_picture(page, '#cpu_canvas'));
  }
  assert.equal(new Set(states.map((state) => JSON.stringify(state))).size, steps.length + 1);
  assert.ok(!(await enabled(page, 'redo')), 'nothing was undone');
  await page.focus('#picture');
  for (let i = steps.length - 1; i >= 0; --i) {
    await and_settle(page, () => page.keyboard.press('Control+z'));
    assert.deepEqual(await choices(page), states[i], `undone: ${i}`);
    assert.ok((await shown_picture(page, '#cpu_canvas')).equals(pictures[i]), `the picture of state ${i}`);
  }
  assert.ok(!(await enabled(page, 'undo')), 'this is where it began');
  assert.equal(await page.inputValue('#recursion'), String(states[0].settings.recursion), 'controls follow');
  for (let i = 1; i <= steps.length; ++i) {
    await and_settle(page, () => (i % 2 ? page.keyboard.press('Control+Shift+Z') : page.click('#redo')));
    assert.deepEqual(await choices(page), states[i], `redone: ${i}`);
  }
  assert.ok(!(await enabled(page, 'redo')));
  no_complaints(complaints);
  await context.close();
});

test('a drag is one step, a new change ends redo, and a second scene has its own past', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  const first = await choices(page);
  await and_settle(page, async () => {
    await page.mouse.move(100, 100);
    await page.mouse.down();
    for (let i = 1; i <= 8; ++i) await page.mouse.move(100 + 10 * i, 100);
    await page.mouse.up();
  });
  assert.notDeepEqual((await choices(page)).settings.camera.eye, first.settings.camera.eye);
  await and_settle(page, () => page.click('#undo'));
  assert.deepEqual(await choices(page), first);
  assert.ok(await enabled(page, 'redo'));
  await apart(page, () => set_value(page, '#recursion', 3));
  assert.ok(!(await enabled(page, 'redo')));
  await and_settle(page, () => page.selectOption('#built_in', 'four-spheres'));
  assert.ok(!(await enabled(page, 'undo')), 'undo does not go back into another scene');
  no_complaints(complaints);
  await context.close();
});

// It once changed the text of a row without the page noticing.
test('the key undoes what is typed first, then what was chosen', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  await open_own(page, own_file, '3 spheres');
  await page.click('#look_add');
  const [select, action] = [page.locator('.look_row .select'), page.locator('.look_row .action')];
  await apart(page, async () => {
    await select.fill('kind B');
    await action.selectOption('hide');
  });
  await page.waitForFunction(() => document.querySelector('.look_row .words')?.textContent === '1 sphere');
  await select.pressSequentially(' or');
  await page.keyboard.press('Control+z');
  assert.equal(await select.count(), 1, 'the row is still there');
  assert.ok((await select.inputValue()).startsWith('kind B'));
  assert.deepEqual((await choices(page)).look.rows, [{ select: 'kind B', action: 'hide', value: '' }]);
  // Without the focus anywhere, a browser undoes in any field.
  await select.fill('kind B');
  await page.evaluate(() => document.activeElement.blur());
  await and_settle(page, () => page.keyboard.press('Control+z'));
  assert.deepEqual((await choices(page)).look.rows, []);
  assert.equal(await select.count(), 0);
  await and_settle(page, () => page.keyboard.press('Control+y'));
  assert.equal(await select.inputValue(), 'kind B');
  assert.equal(await page.textContent('.look_row .words'), '1 sphere');
  assert.deepEqual(await page.$$eval('#errors .message', (all) => all.map((one) => one.textContent)), []);
  no_complaints(complaints);
  await context.close();
});

test('another radius is undone by reading the file again', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  await open_own(page, own_file, '3 spheres');
  const before = await shown_picture(page, '#cpu_canvas');
  await apart(page, () => set_value(page, '#radius_scale', 2));
  await page.waitForFunction(() => document.getElementById('undo').getAttribute('aria-disabled') === 'false');
  await settled(page);
  assert.ok(!(await shown_picture(page, '#cpu_canvas')).equals(before));
  await and_settle(page, () => page.click('#undo'));
  assert.equal(await page.inputValue('#radius_scale'), '');
  assert.ok((await shown_picture(page, '#cpu_canvas')).equals(before));
  await and_settle(page, () => page.click('#redo'));
  assert.equal(await page.inputValue('#radius_scale'), '2');
  no_complaints(complaints);
  await context.close();
});

const reloaded = async (page) => {
  await pause(1000); // the page writes after a rest
  await page.reload();
  await settled(page);
};

test('a reload brings back the file, the state and the history, until it is forgotten', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  await open_own(page, own_file, '3 spheres');
  await apart(page, () => page.click('#style label:has(input[value=flat])'));
  await apart(page, () => page.click('[data-side=left]'));
  const before = await shown_picture(page, '#cpu_canvas');
  await reloaded(page);
  assert.match(await page.textContent('#facts'), /^three\.csv: 3 spheres/);
  assert.ok((await shown_picture(page, '#cpu_canvas')).equals(before));
  assert.match(await page.textContent('#kept'), /three\.csv/);
  await and_settle(page, () => page.click('#undo'));
  await and_settle(page, () => page.click('#undo'));
  assert.ok(!(await enabled(page, 'undo')));
  assert.equal((await choices(page)).look.style, '');
  await and_settle(page, () => page.click('#redo'));

  // Another tab knows nothing of it.
  const other = await context.newPage();
  await other.goto(kit.server.url);
  await settled(other);
  assert.doesNotMatch(await other.textContent('#facts'), /three/);
  await other.close();

  await page.click('#forget');
  await page.waitForFunction(() => document.getElementById('kept').textContent.startsWith('Nothing'));
  await apart(page, () => page.click('[data-side=front]'));
  const left = await page.evaluate(async () => {
    const request = indexedDB.open('bihive');
    await new Promise((done) => (request.onsuccess = done));
    const stores = request.result.transaction(['states', 'files']);
    const keys = (name) => new Promise((done) => (stores.objectStore(name).getAllKeys().onsuccess = ({ target }) => done(target.result)));
    return [...(await keys('states')), ...(await keys('files'))];
  });
  assert.deepEqual(left, []);
  // The link of link_state() asks for the file.
  await page.goto(kit.server.url);
  await settled(page);
  assert.doesNotMatch(await page.textContent('#facts'), /three/);
  no_complaints(complaints);
  await context.close();
});

test('files that were opened before can be opened again, in another tab too, until they are forgotten', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  const file = (name, text) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
  assert.ok(await page.evaluate(() => document.querySelector('#card_open .recent').parentElement.hidden), 'none yet');
  await open_own(page, file('one.xyz', '1\na <b>title</b>\nC 0 0 0\n'), '1 sphere');
  await open_own(page, file('two.csv', 'x,y,z,r\n0,0,0,1\n3,0,0,1\n'), '2 spheres');
  await open_own(page, own_file, '3 spheres');
  const listed = (from, card = 'open') => from.$$eval(`#card_${card} .recent li`, (all) => all.map((one) => one.innerText.replace(/\s+/g, ' ').trim()));
  await page.unfold('#card_open .recent');
  assert.deepEqual(await listed(page), ['two.csv 1 kB ×', 'a <b>title</b> one.xyz · 1 kB ×'], 'the newest first, without the one that is shown');

  const other = with_cards(await context.newPage());
  await other.goto(kit.server.url);
  await settled(other);
  await other.unfold('#card_open .recent');
  assert.equal((await listed(other)).length, 3);
  await other.unfold('#card_scene .recent');
  assert.equal((await listed(other, 'scene')).length, 3, 'below what the scene is, too');
  await and_settle(other, () => other.click('#card_scene .recent_open >> text=two.csv'));
  assert.match(await other.textContent('#facts'), /^two\.csv: 2 spheres/);
  await other.click('#card_open .recent [aria-label="Forget one.xyz"]');
  await other.waitForFunction(() => !document.querySelector('#card_open .recent').textContent.includes('one.xyz'));
  assert.equal(await other.evaluate(() => document.activeElement.closest('.recent') !== null), true, 'the focus stays in the list');

  await other.click('#forget');
  await other.waitForFunction(() => document.getElementById('kept').textContent.startsWith('Nothing'));
  assert.deepEqual(await listed(other), []);
  // Another radius reads it again, and does not keep it.
  await apart(other, () => set_value(other, '#radius_scale', 2));
  const left = await other.evaluate(async () => {
    const request = indexedDB.open('bihive recent');
    await new Promise((done) => (request.onsuccess = done));
    const all = request.result.transaction('files').objectStore('files').getAllKeys();
    return new Promise((done) => (all.onsuccess = () => done(all.result)));
  });
  assert.deepEqual(left, []);
  no_complaints(complaints);
  await context.close();
});

test('the link to the controls does not load another scene', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, small);
  await open_own(page, own_file, '3 spheres');
  await page.focus('.skip');
  await page.keyboard.press('Enter');
  await pause(1500);
  assert.match(await page.textContent('#facts'), /3 spheres/);
  no_complaints(complaints);
  await context.close();
});
