// The cards of controls: one at a time, at the right of a wide window, in a sheet of three heights at the bottom of a narrow one.
// The picture takes what the sheet leaves (cards.css). Escape closes a card, and so does a click on the picture beside it.
import { element } from './dom';
import { words } from './words';

type Height = 'peek' | 'half' | 'whole';
const heights: Height[] = ['peek', 'half', 'whole'];

const first_px = 24, next_px = 90; // a finger on the sheet's head moves it by a height
const stay = ['measure', 'show', 'cut']; // beside which the picture is clicked

export class Cards {
  private readonly panel = element('panel');
  private readonly tall = element<HTMLButtonElement>('panel_tall');
  private readonly narrow = matchMedia('(max-width: 520px), (max-width: 760px) and (orientation: portrait)'); // as in cards.css
  private readonly buttons = [...document.querySelectorAll<HTMLButtonElement>('[data-card]')];
  private name: string | null = null;
  private opener: HTMLElement | null = null;
  private height: Height = 'half';

  /** `changed`: another card is open, or none. */
  constructor(private readonly changed: (name: string | null) => void) {
    for (const button of this.buttons)
      button.addEventListener('click', () => {
        const name = button.dataset['card']!;
        if (this.name === name) this.close();
        else this.show(name, button);
      });
    element('panel_close').addEventListener('click', () => this.close());
    this.tall.addEventListener('click', () => this.set_height(this.height === 'whole' ? 'half' : 'whole'));
    // Before the picture takes the key to clear its pins.
    addEventListener('keydown', (event) => this.escape(event), { capture: true });
    this.listen_for_fingers(element('panel_head'));
    this.set_height('half');
  }

  get shown(): string | null {
    return this.name;
  }

  show(name: string, opener: HTMLElement | null = null): void {
    const card = element(`card_${name}`);
    this.name = name;
    if (!opener?.closest('#panel')) this.opener = opener ?? this.button(name) ?? null;
    for (const other of document.querySelectorAll<HTMLElement>('.card')) other.hidden = other !== card;
    element('panel_title').textContent = this.button(name)?.dataset['title'] ?? this.button(name)?.textContent ?? '';
    element('panel_body').scrollTop = 0;
    this.panel.hidden = false;
    if (this.height === 'peek') this.set_height('half');
    this.mark();
  }

  close(): void {
    const had_focus = this.panel.contains(document.activeElement);
    this.name = null;
    this.panel.hidden = true;
    this.mark();
    if (had_focus) (this.opener ?? element('bar')).focus();
  }

  /** A click on the picture: true if it has closed a card, and means nothing else. */
  dismiss(): boolean {
    if (this.name === null || this.narrow.matches || stay.includes(this.name)) return false;
    this.close();
    return true;
  }

  private button(name: string): HTMLButtonElement | undefined {
    return this.buttons.find(({ dataset }) => dataset['card'] === name);
  }

  private mark(): void {
    for (const button of this.buttons) button.setAttribute('aria-expanded', String(button.dataset['card'] === this.name));
    const { dataset } = document.documentElement;
    dataset['panel'] = this.name === null ? 'closed' : this.height;
    this.changed(this.name);
  }

  private set_height(height: Height): void {
    this.height = height;
    this.tall.setAttribute('aria-pressed', String(height === 'whole'));
    this.tall.title = height === 'whole' ? words.heights.half : words.heights.whole;
    this.mark();
  }

  private escape(event: KeyboardEvent): void {
    if (event.key !== 'Escape' || this.name === null || document.querySelector('dialog[open]')) return;
    event.preventDefault();
    event.stopPropagation();
    this.close();
  }

  private listen_for_fingers(head: HTMLElement): void {
    let from_y: number | null = null;
    let dragged = false;
    head.addEventListener('pointerdown', (event) => {
      if (!this.narrow.matches || (event.target as HTMLElement).closest('button')) return;
      from_y = event.clientY;
      dragged = false;
      head.setPointerCapture(event.pointerId);
    });
    head.addEventListener('pointermove', ({ clientY }) => {
      if (from_y === null || Math.abs(clientY - from_y) < (dragged ? next_px : first_px)) return;
      const next = heights.indexOf(this.height) + (clientY < from_y ? 1 : -1);
      from_y = clientY;
      dragged = true;
      if (next < 0) return this.close();
      if (heights[next]) this.set_height(heights[next]);
    });
    for (const end of ['pointerup', 'pointercancel'] as const)
      head.addEventListener(end, () => {
        if (from_y !== null && !dragged && end === 'pointerup') this.set_height(this.height === 'peek' ? 'half' : 'peek');
        from_y = null;
      });
  }
}
