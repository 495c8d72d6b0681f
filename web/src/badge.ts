// The badge at the top left: what the picture shows.
import { element } from './dom';

/** Messages begin below the badge, which has two lines where its text is long (style.css). */
export function watch_badge(): void {
  const badge = element('badge');
  const { style } = document.documentElement;
  new ResizeObserver(() => {
    if (badge.offsetHeight === 0) style.removeProperty('--below_badge');
    else style.setProperty('--below_badge', `${badge.offsetTop + badge.offsetHeight + 6}px`);
  }).observe(badge);
}
