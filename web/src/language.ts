// The language of the page. English is in index.html and words.ts; the others are modules that are loaded on demand
// (languages/*.ts). What a catalogue lacks stays English, and so do messages of the library and what files say.
import { element, made } from './dom';
import { remember, remembered } from './remembered';
import { words, type Words } from './words';

type Partly<T> = T extends (...of: never[]) => unknown ? T : T extends object ? { [Key in keyof T]?: Partly<T[Key]> } : T;

export interface Catalogue {
  /** Texts of index.html by what they are in English, with single blanks; one that means something else there as "text@id" of the element around it. */
  page: Record<string, string>;
  words: Partly<Words>;
  /** Labels of the library's tables: a parameter's by its id, others as "kind.name" (label_of()). */
  labels: Record<string, string>;
  /** Help texts of these tables by the parameter's id, of reading as "reading.id". */
  help: Record<string, string>;
  /** Styles by their names: what they are called, and how they look. */
  styles: Record<string, [name: string, description: string]>;
}

const key = 'bihive-language';

/** Names of languages in themselves; none but English was proofread. */
export const languages: Record<string, string> = { en: 'English', de: 'Deutsch', es: 'Español', pt: 'Português', zh: '中文' };

const catalogues: Record<string, () => Promise<{ default: Catalogue }>> = {
  de: () => import('./languages/de'),
  es: () => import('./languages/es'),
  pt: () => import('./languages/pt'),
  zh: () => import('./languages/zh'),
};

const known = (tag: string | null | undefined) => {
  const language = tag?.toLowerCase().split('-')[0] ?? '';
  return language in languages ? language : undefined;
};

// The address, else the user's choice, else the browser's first one that there is.
const wanted = () =>
  known(new URLSearchParams(location.search).get('lang')) ?? known(remembered(key)) ?? navigator.languages.map(known).find(Boolean) ?? 'en';

export let language = 'en';
let { labels, help, styles }: Pick<Catalogue, 'labels' | 'help' | 'styles'> = { labels: {}, help: {}, styles: {} };

/** The label of a parameter, or of a choice by "kind.name", in the page's language. */
export const label_of = (id: string, english: string): string => labels[id] ?? english;

/** The help text of a parameter, in the page's language. */
export const help_of = (id: string, english: string): string => help[id] ?? english;

/** Name and description of a style, in the page's language. */
export const style_in_words = (name: string, description: string): [string, string] => styles[name] ?? [name, description];

/** The control: the page is loaded again in the chosen language, and a reload brings back what it shows. */
export function start_language(): void {
  const list = element<HTMLSelectElement>('language');
  list.append(...Object.entries(languages).map(([value, name]) => made('option', { value, lang: value }, name)));
  list.value = language;
  list.addEventListener('change', () => {
    remember(key, list.value);
    const address = new URL(location.href);
    address.searchParams.delete('lang');
    if (address.href === location.href) location.reload();
    else location.replace(address);
  });
}

function merge(into: Record<string, unknown>, from: Record<string, unknown>): void {
  for (const [name, value] of Object.entries(from))
    if (value && typeof value === 'object') merge(into[name] as Record<string, unknown>, value as Record<string, unknown>);
    else into[name] = value;
}

const attributes = ['aria-label', 'aria-roledescription', 'title', 'placeholder', 'alt', 'data-title'];

function translate_page(texts: Record<string, string>): void {
  const translated = (text: string, around?: string) => {
    const english = text.replace(/\s+/g, ' ').trim();
    return texts[`${english}@${around}`] ?? texts[english];
  };
  const walk = (root: Node) => {
    const nodes = document.createTreeWalker(root, NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT);
    for (let node = nodes.nextNode(); node; node = nodes.nextNode()) {
      if (node instanceof HTMLTemplateElement) walk(node.content);
      if (node instanceof Element) {
        for (const name of attributes) {
          const text = translated(node.getAttribute(name) ?? '');
          if (text !== undefined) node.setAttribute(name, text);
        }
        continue;
      }
      const english = node.textContent ?? '';
      const text = translated(english, node.parentElement?.closest('[id]')?.id);
      if (text !== undefined) node.textContent = english.replace(/\S[\s\S]*\S|\S/, () => text);
    }
  };
  walk(document.body);
}

// Before any other module of the page runs: their first words are in its language.
const load = catalogues[wanted()];
if (load) {
  try {
    const { default: catalogue } = await load();
    language = wanted();
    ({ labels, help, styles } = catalogue);
    merge(words, catalogue.words);
    translate_page(catalogue.page);
    document.documentElement.lang = language;
  } catch {
    // English then: the page that is one file has no others.
  }
}
