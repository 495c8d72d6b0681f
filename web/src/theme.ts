// Light and dark: the system's choice, or the user's choice, which this browser remembers.
import { RadioGroup } from './dom';
import { remember, remembered } from './remembered';

const key = 'bihive-theme';

export function start_theme(): void {
  const apply = (theme: string) => {
    if (theme === 'light' || theme === 'dark') document.documentElement.dataset['theme'] = theme;
    else delete document.documentElement.dataset['theme'];
  };
  const group = new RadioGroup('theme', (theme) => {
    apply(theme);
    remember(key, theme);
  });
  const theme = remembered(key) ?? 'auto';
  group.value = theme;
  apply(theme);
}
