// The page in other languages: catalogues against the English texts, and the page itself.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { test } from 'node:test';
import { no_complaints, open_page, scratch, settled, small, with_page } from './page_kit.mjs';

const kit = with_page();
const source = process.env.SOURCE;
const languages = ['de', 'es', 'pt', 'zh'];
const english_enough = 0.01; // of the keys may stay English; they are printed

const { buildSync } = createRequire(join(source, 'web/package.json'))('esbuild');
async function module_of(file) {
  const { outputFiles } = buildSync({ entryPoints: [join(source, 'web/src', file)], bundle: true, format: 'esm', write: false });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString('base64')}`);
}

// What index.html says, as language.ts looks it up. Names of the program, of options and of formats are the same everywhere.
const same_everywhere = (text) => !/\p{L}{2}/u.test(text) || /^(bihive.*|GPU|CPU|\w+_\w+|from:.*|at:.*|resname.*|chain A.*|element C.*|within.*|clip|Film|Zoom|Auto|\{ \})$/.test(text);
const texts_of_page = (page) =>
  page.evaluate(async () => {
    const html = new DOMParser().parseFromString(await (await fetch('index.html')).text(), 'text/html');
    const found = new Set();
    const walk = (root) => {
      for (const node of root.childNodes) {
        if (node.nodeType === Node.TEXT_NODE) found.add(node.textContent);
        if (node.nodeType !== Node.ELEMENT_NODE || ['NOSCRIPT', 'SCRIPT'].includes(node.nodeName)) continue;
        for (const name of ['aria-label', 'aria-roledescription', 'title', 'placeholder', 'alt', 'data-title'])
          if (node.hasAttribute(name)) found.add(node.getAttribute(name));
        walk(node.content ?? node);
      }
    };
    walk(html.body);
    return [...found].map((text) => text.replace(/\s+/g, ' ').trim()).filter(Boolean);
  });

// Rows of the library's table that have controls: "id", "id.value" and the like; and those of reading, whose help is shown.
function labels_of_table() {
  const text = readFileSync(join(source, 'src/bihive/settings/picture_parameters.cpp'), 'utf8');
  const wanted = [], known = [], help = [];
  for (const row of text.split(/\.id = /).slice(1)) {
    const id = row.match(/^"(\w+)"/)[1];
    const names = row.match(/\.names = "([^"]*)"/)?.[1].split('|') ?? [];
    const keys = [id, ...(row.includes('.choice_labels') ? names.map((name) => `${id}.${name}`) : [])];
    known.push(...keys, `${id}.note`, `${id}.empty`);
    if (!row.includes('.label = ') || row.includes('.in_window = false')) continue;
    wanted.push(...keys);
    if (row.includes('.empty_means = ')) wanted.push(`${id}.empty`);
    help.push(id);
  }
  const reading = readFileSync(join(source, 'src/bihive/io/reading_settings.cpp'), 'utf8');
  for (const row of reading.split(/\.id = /).slice(1)) if (row.includes('.label = ')) help.push(`reading.${row.match(/^"(\w+)"/)[1]}`);
  assert.ok(wanted.length > 40 && help.length > 40, `${wanted.length}, ${help.length}`);
  return { wanted, known, help };
}

const style_names = () => readdirSync(join(source, 'data/styles')).map((file) => file.replace('.json', ''));

test('catalogues translate what there is, and nothing else', async (t) => {
  const { words } = await module_of('words.ts');
  const { page, context } = await open_page(kit.browser, kit.server.url, small);
  const texts = await texts_of_page(page);
  await context.close();
  assert.ok(texts.length > 150, `${texts.length}`);
  const table = labels_of_table();
  for (const language of languages) {
    const { default: catalogue } = await module_of(`languages/${language}.ts`);
    const missing = [];
    let keys = 0;
    const check = (path, has, is_wanted) => {
      ++keys;
      if (!has && is_wanted) missing.push(path);
    };
    const unknown = Object.keys(catalogue.page).filter((text) => !texts.includes(text.replace(/@\w+$/, '')));
    assert.deepEqual(unknown, [], `${language}: index.html does not say so`);
    for (const text of texts) check(`page: ${text}`, text in catalogue.page, !same_everywhere(text));
    const compare = (english, other, path) => {
      for (const name of Object.keys(other)) assert.ok(name in english, `${language}: words${path}.${name} is not in words.ts`);
      for (const [name, value] of Object.entries(english)) {
        const translated = other[name];
        if (typeof value === 'object' && translated !== undefined) compare(value, translated, `${path}.${name}`);
        else check(`words${path}.${name}`, translated !== undefined, true);
        if (translated === undefined) continue;
        assert.equal(typeof translated, typeof value, `${language}: words${path}.${name}`);
        if (typeof value === 'function') assert.ok(translated.length <= value.length, `${language}: words${path}.${name}`);
      }
    };
    compare(words, catalogue.words, '');
    const of_library = /^(view|projection|side|reading|action)\./;
    const stale = Object.keys(catalogue.labels).filter((key) => !of_library.test(key) && !table.known.includes(key));
    assert.deepEqual(stale, [], `${language}: no row of the table`);
    for (const key of table.wanted) check(`labels.${key}`, key in catalogue.labels, true);
    for (const [kind, there_are] of [['help', table.help], ['styles', style_names()]]) {
      assert.deepEqual(Object.keys(catalogue[kind]).filter((key) => !there_are.includes(key)), [], `${language}: ${kind} of nothing`);
      for (const key of there_are) check(`${kind}.${key}`, key in catalogue[kind], true);
    }
    t.diagnostic(`${language}: ${missing.length} of ${keys} stay English${missing.map((key) => `\n  ${key}`).join('')}`);
    assert.ok(missing.length <= english_enough * keys, `${language}: ${missing.length} of ${keys}`);
  }
});

test('the browser, the address and the control choose the language', async () => {
  const { page, context, complaints } = await open_page(kit.browser, kit.server.url, { ...small, locale: 'de-CH' });
  const shown = () => page.evaluate(() => [document.documentElement.lang, document.querySelector('[data-card=save]').textContent, document.querySelector('label[for=shadows]').textContent]);
  assert.deepEqual(await shown(), ['de', 'Speichern', 'Schatten']);
  assert.match(await page.textContent('#badge_more'), /Atome/);
  assert.equal(await page.getAttribute('#picture', 'aria-roledescription'), 'Szene');
  assert.deepEqual(await page.$$eval('#theme span', (all) => all.map(({ textContent }) => textContent)), ['Auto', 'Hell', 'Dunkel']);
  assert.equal(await page.textContent('#light_group h3'), 'Licht');
  // Help texts, styles, and what the dialog of the thesis says by itself.
  assert.equal(await page.getAttribute('#shadows', 'title'), 'Kugeln werfen Schatten');
  assert.match(await page.getAttribute('#radius_scale', 'title'), /Faktor/);
  const tiles = await page.$$eval('#style label', (all) => all.map((label) => [label.querySelector('input').value, label.textContent, label.title]));
  assert.deepEqual(tiles.find(([name]) => name === 'licorice').slice(1), ['Lakritz', 'Stäbe mit runden Enden für die Bindungen zwischen Atomen']);
  assert.match(await page.textContent('#thesis p'), /^\s*Abbildung 4\.4: .* max_prims: 54 Anordnungen/);
  assert.equal(await page.textContent('#thesis_run'), 'Messen');
  // The address comes first.
  await page.goto(`${kit.server.url}?lang=es`);
  await settled(page);
  assert.deepEqual(await shown(), ['es', 'Guardar', 'Sombras']);
  // A choice stays, and forgets the address.
  await page.evaluate(() => {
    const list = document.getElementById('language');
    list.value = 'zh';
    list.dispatchEvent(new Event('change', { bubbles: true }));
  });
  await page.waitForURL((url) => !url.search.includes('lang'));
  await page.waitForFunction(() => document.documentElement.lang === 'zh');
  await settled(page);
  assert.deepEqual(await shown(), ['zh', '保存', '阴影']);
  assert.equal(await page.inputValue('#language'), 'zh');
  await page.screenshot({ path: join(scratch, 'chinese.png') });
  no_complaints(complaints);
  await context.close();
});

test('English readers, and those of a language that there is not, download no other', async () => {
  for (const locale of ['en-GB', 'fi']) {
    const context = await kit.browser.newContext({ ...small, locale });
    const page = await context.newPage();
    const asked = [];
    page.on('request', (request) => asked.push(request.url()));
    await page.goto(kit.server.url);
    await settled(page);
    assert.deepEqual(asked.filter((url) => url.includes('languages')), [], locale);
    assert.equal(await page.textContent('[data-card=save]'), 'Save');
    await context.close();
  }
});
