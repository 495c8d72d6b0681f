// The panel's groups light, lines, lens and labels: controls for the settings that add something to plain rays.
import { element } from './dom';
import type { Changes, Settings } from './protocol';
import { Slider } from './slider';

/** A field whose empty text is null. `parse` gives undefined where the text is no value. */
class Field<T> {
  private readonly input: HTMLInputElement;

  constructor(
    id: string,
    private readonly words: (value: T) => string,
    parse: (text: string) => T | undefined,
    on_change: (value: T) => void,
  ) {
    this.input = element<HTMLInputElement>(id);
    this.input.addEventListener('change', () => {
      if (!this.input.reportValidity()) return;
      const value = parse(this.input.value.trim());
      if (value !== undefined) on_change(value);
    });
  }

  /** What the user is writing stays. */
  set value(value: T) {
    if (document.activeElement !== this.input) this.input.value = this.words(value);
  }

  set disabled(disabled: boolean) {
    this.input.disabled = disabled;
  }
}

const number_or_null = (text: string) => (text === '' ? null : Number(text) > 0 ? Number(text) : undefined);
const number_or_0 = (text: string) => Math.max(0, Number(text) || 0);
const readable = (value: number) => (value === 0 ? '' : String(+value.toPrecision(6)));

// The boxes that are nothing but a setting.
const boxes = ['shadows', 'ao', 'samples_auto', 'legend', 'axes', 'scale_bar'] as const;

const lens_samples = 64; // with fewer, the places on the lens show one by one

export class EffectControls {
  private readonly light_points: Slider;
  private readonly ao_distance: Field<number | null>;
  private readonly ao_directions: Slider;
  private readonly fog: Slider;
  private readonly opacity_rule = element<HTMLSelectElement>('opacity_rule');
  private readonly outline_px: Slider;
  private readonly fov: Slider;
  private readonly aperture: Field<number>;
  private readonly focus = element<HTMLSelectElement>('focus');
  private readonly focus_distance: Field<number>;
  private readonly focus_on: Field<string>;
  private readonly exposure: Slider;
  private readonly tone = element<HTMLSelectElement>('tone');
  private readonly title: Field<string>;
  private readonly length_unit: Field<string | null>;
  private shown: Settings | null = null;

  constructor(private readonly change: (changes: Changes) => void) {
    for (const id of boxes) {
      const box = element<HTMLInputElement>(id);
      box.addEventListener('change', () => change({ [id]: box.checked }));
    }
    this.light_points = new Slider('light_points', String, (light_points) => change({ light_points }));
    this.ao_distance = new Field('ao_distance', (value) => readable(value ?? 0), number_or_null, (ao_distance) => change({ ao_distance }));
    this.ao_directions = new Slider('ao_directions', String, (ao_directions) => change({ ao_directions }));
    this.fog = new Slider('fog', (value) => `${Math.round(100 * value)} %`, (fog) => change({ fog }));
    this.opacity_rule.addEventListener('change', () =>
      change({ opacity_rule: this.opacity_rule.value as Settings['opacity_rule'] }),
    );
    this.outline_px = new Slider('outline_px', (value) => (value === 0 ? 'none' : `${value} px`), (outline_px) => change({ outline_px }));
    this.fov = new Slider('fov', (value) => `${+value.toFixed(1)}°`, (fov_deg) => change({ camera: { fov_deg } }));
    this.aperture = new Field('aperture', readable, number_or_0, (aperture) => this.open_lens(aperture));
    this.focus.addEventListener('change', () => this.choose_focus());
    this.focus_distance = new Field('focus_distance', readable, number_or_0, (focus) => change({ focus_on: '', camera: { focus } }));
    this.focus_on = new Field('focus_on', String, (text) => text, (focus_on) => change({ focus_on }));
    this.exposure = new Slider('exposure', (value) => (value > 0 ? `+${value}` : String(value)), (exposure) => change({ exposure }));
    this.tone.addEventListener('change', () => change({ tone: this.tone.value as Settings['tone'] }));
    this.title = new Field('title', String, (text) => text, (title) => change({ title }));
    this.length_unit = new Field('length_unit', (value) => value ?? '', (text) => text || null, (length_unit) => change({ length_unit }));
  }

  // Depth of field needs many samples everywhere.
  private open_lens(aperture: number): void {
    const opens = aperture > 0 && this.shown?.camera.aperture === 0;
    const samples_per_pixel = Math.max(this.shown?.samples_per_pixel ?? 0, lens_samples);
    this.change({ camera: { aperture }, ...(opens ? { samples_auto: false, samples_per_pixel } : {}) });
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
    for (const id of boxes) element<HTMLInputElement>(id).checked = settings[id];
    const gpu = settings.engine === 'gpu';
    element<HTMLInputElement>('samples_auto').disabled = gpu;
    element('samples_auto_note').hidden = !gpu;
    this.light_points.value = settings.light_points;
    this.light_points.disabled = !settings.shadows;
    this.ao_distance.value = settings.ao_distance;
    this.ao_distance.disabled = !settings.ao;
    this.ao_directions.value = settings.ao_directions;
    this.ao_directions.disabled = !settings.ao;
    this.fog.value = settings.fog;
    this.opacity_rule.value = settings.opacity_rule;
    this.outline_px.value = settings.outline_px;
    this.exposure.value = settings.exposure;
    this.tone.value = settings.tone;
    this.title.value = settings.title;
    this.length_unit.value = settings.length_unit;
    this.length_unit.disabled = !settings.scale_bar;
    this.show_lens(settings);
    const parallel = settings.camera.projection === 'orthographic';
    element<HTMLInputElement>('scale_bar').disabled = !parallel && !settings.scale_bar;
    element('scale_bar_note').hidden = parallel;
  }

  private show_lens({ camera, focus_on }: Settings): void {
    const parallel = camera.projection === 'orthographic';
    this.fov.value = camera.fov_deg;
    this.fov.disabled = parallel;
    this.aperture.value = camera.aperture;
    this.aperture.disabled = parallel;
    this.focus.disabled = camera.aperture === 0;
    this.focus_distance.value = camera.focus;
    this.focus_on.value = focus_on;
    // A choice that waits for its distance or its spheres stays.
    const waits = [this.focus, element('focus_distance'), element('focus_on')].includes(document.activeElement as HTMLElement);
    if (waits) return;
    this.focus.value = focus_on !== '' ? 'spheres' : camera.focus > 0 ? 'distance' : 'auto';
    this.show_focus(this.focus.value);
  }
}
