// Light and dark: the system's choice, or the user's choice, which this browser remembers.
import { RadioGroup } from './dom';

const key = 'bihive-theme';

export function start_theme(): void {
  const apply = (theme: string) => {
    if (theme === 'light' || theme === 'dark') document.documentElement.dataset['theme'] = theme;
    else delete document.documentElement.dataset['theme'];
  };
  // If the browser forbids storage, the choice lasts as long as the page.
  const storage = (work: (store: Storage) => string | null | void) => {
    try {
      return work(localStorage);
    } catch {
      return null;
    }
  };
  const group = new RadioGroup('theme', (theme) => {
    apply(theme);
    storage((store) => store.setItem(key, theme));
  });
  const theme = storage((store) => store.getItem(key)) ?? 'auto';
  group.value = theme;
  apply(theme);
}
