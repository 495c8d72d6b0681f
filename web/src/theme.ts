// Light and dark: the system's choice, or the user's choice, which this browser remembers.
import { RadioGroup } from './dom';
import { remember, remembered } from './remembered';

const key = 'bihive-theme';

const system_is_dark = matchMedia('(prefers-color-scheme: dark)');

export function is_dark(): boolean {
  const theme = document.documentElement.dataset['theme'];
  return theme ? theme === 'dark' : system_is_dark.matches;
}

/** `changed`: between light and dark, by the user or the system. */
export function start_theme(changed: () => void): void {
  const apply = (theme: string) => {
    if (theme === 'light' || theme === 'dark') document.documentElement.dataset['theme'] = theme;
    else delete document.documentElement.dataset['theme'];
  };
  const group = new RadioGroup('theme', (theme) => {
    apply(theme);
    remember(key, theme);
    changed();
  });
  system_is_dark.addEventListener('change', changed);
  const theme = remembered(key) ?? 'auto';
  group.value = theme;
  apply(theme);
}
