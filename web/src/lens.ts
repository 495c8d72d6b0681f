// The panel's controls of the lens: angle, aperture and focus.
import { element } from './dom';
import { Field, readable } from './field';
import type { Changes, Settings } from './protocol';
import { Slider } from './slider';

const readable_or_empty = (value: number) => (value === 0 ? '' : readable(value));
const number_or_0 = (text: string) => Math.max(0, Number(text) || 0);

export class LensControls {
  private readonly fov: Slider;
  private readonly aperture: Field<number>;
  private readonly focus = element<HTMLSelectElement>('focus');
  private readonly focus_distance: Field<number>;
  private readonly focus_on: Field<string>;
  private shown: Settings | null = null;

  constructor(private readonly change: (changes: Changes) => void) {
    this.fov = new Slider('fov', (value) => `${+value.toFixed(1)}°`, (fov_deg) => change({ camera: { fov_deg } }));
    this.aperture = new Field('aperture', readable_or_empty, number_or_0, (aperture) => this.open_lens(aperture));
    this.focus.addEventListener('change', () => this.choose_focus());
    this.focus_distance = new Field('focus_distance', readable_or_empty, number_or_0, (focus) =>
      change({ focus_on: '', camera: { focus } }),
    );
    this.focus_on = new Field('focus_on', String, (text) => text, (focus_on) => change({ focus_on }));
  }

  // Depth of field needs many samples everywhere, so it ends the user's choice of more samples on edges.
  private open_lens(aperture: number): void {
    const opens = aperture > 0 && this.shown?.camera.aperture === 0;
    const on_edges = this.shown?.samples_auto && this.shown.set.includes('samples_auto');
    this.change({ camera: { aperture }, ...(opens && on_edges ? { samples_auto: false } : {}) });
  }

  private choose_focus(): void {
    this.show_focus(this.focus.value);
    if (this.focus.value === 'auto') this.change({ focus_on: '', camera: { focus: 0 } });
    else element(this.focus.value === 'distance' ? 'focus_distance' : 'focus_on').focus();
  }

  private show_focus(kind: string): void {
    element('focus_distance_row').hidden = kind !== 'distance';
    element('focus_on_row').hidden = kind !== 'spheres';
  }

  show(settings: Settings): void {
    this.shown = settings;
    const { camera, focus_on } = settings;
    const parallel = camera.projection === 'orthographic';
    this.fov.value = camera.fov_deg;
    this.fov.disabled = parallel;
    this.aperture.value = camera.aperture;
    this.aperture.disabled = parallel;
    this.focus.disabled = camera.aperture === 0;
    this.focus_distance.value = camera.focus;
    this.focus_on.value = focus_on;
    // A choice still without its distance or spheres stays.
    const waits = [this.focus, element('focus_distance'), element('focus_on')].includes(document.activeElement as HTMLElement);
    if (waits) return;
    this.focus.value = focus_on !== '' ? 'spheres' : camera.focus > 0 ? 'distance' : 'auto';
    this.show_focus(this.focus.value);
  }
}
