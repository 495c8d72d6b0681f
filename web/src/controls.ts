// The panel's controls for settings: they show them, and report the user's changes.
import { CellControls } from './cell';
import { add_options, element, made, RadioGroup } from './dom';
import { label_of } from './language';
import { LensControls } from './lens';
import { ParameterControls } from './parameter_controls';
import type { Camera, Changes, Choices, EngineName, Facts, Move, Settings } from './protocol';
import type { ViewName } from './settings';
import { Slider } from './slider';

export interface ControlActions {
  change(changes: Changes): void;
  move(move: Move): void;
}

// A limit of the tree on a slider: 0 is the engine's choice.
const limit_words = (value: number) => (value === 0 ? 'auto' : value === Infinity ? 'none' : String(value));
const limit_of = (value: Settings['max_prims']) => (value === null ? 0 : value === 'unlimited' ? Infinity : value);

export class Controls {
  private readonly engine: RadioGroup;
  private readonly view = element<HTMLSelectElement>('view');
  private readonly parameters: ParameterControls;
  private readonly lens: LensControls;
  private readonly cell: CellControls;
  private readonly projection = element<HTMLSelectElement>('projection');
  private readonly max_prims: Slider;
  private readonly max_depth: Slider;
  private shown: Settings | null = null;

  constructor(private readonly actions: ControlActions) {
    const { change } = actions;
    this.engine = new RadioGroup('engine', (value) => this.set_engine(value as EngineName));
    this.view.addEventListener('change', () => this.set_view(this.view.value as ViewName));
    this.parameters = new ParameterControls(change);
    this.lens = new LensControls(change);
    this.cell = new CellControls(change);
    this.max_prims = new Slider('max_prims', limit_words, (value) => change({ max_prims: value || null }));
    this.max_depth = new Slider('max_depth', limit_words, (value) => change({ max_depth: value || null }));
    // Only a perspective camera has a lens.
    this.projection.addEventListener('change', () => {
      const projection = this.projection.value as Camera['projection'];
      change({ camera: projection === 'orthographic' ? { projection, aperture: 0 } : { projection } });
    });
    element('home').addEventListener('click', () => actions.move({ kind: 'home' }));
  }

  move(move: Move): void {
    this.actions.move(move);
  }

  get settings(): Settings | null {
    return this.shown;
  }

  // Only the CPU engine draws the tree, so a choice of one of them changes the other.
  set_engine(engine: EngineName): void {
    this.actions.change(engine === 'gpu' && this.shown?.view === 'tree' ? { engine, view: 'shaded' } : { engine });
  }

  set_view(view: ViewName): void {
    this.actions.change(view === 'tree' ? { view, engine: 'cpu' } : { view });
  }

  /** The view of this number in the list, from 1; false if there is none. */
  set_view_at(number: number): boolean {
    const view = this.view.options[number - 1]?.value;
    if (view !== undefined) this.set_view(view as ViewName);
    return view !== undefined;
  }

  /** The library's tables. */
  build({ settings, views, projections, sides }: Choices): void {
    this.parameters.build(settings);
    add_options(this.view, views.map(({ name, label }) => ({ name, label: label_of(`view.${name}`, label) })));
    add_options(this.projection, projections.map((name) => ({ name, label: label_of(`projection.${name}`, name) })));
    for (const side of sides) {
      const button = made('button', { type: 'button', 'data-side': side }, label_of(`side.${side}`, side.charAt(0).toUpperCase() + side.slice(1)));
      button.addEventListener('click', () => this.actions.move({ kind: 'look_from', side }));
      element('home').before(button);
    }
  }

  /** The scene's properties. */
  show_facts(facts: Facts): void {
    this.cell.show_facts(facts);
  }

  /** Shows settings that come from the worker; a slider being dragged is left alone. */
  show(settings: Settings): void {
    this.shown = settings;
    this.engine.value = settings.engine;
    this.view.value = settings.view;
    this.parameters.show(settings);
    this.lens.show(settings);
    this.cell.show(settings);
    this.projection.value = settings.camera.projection;
    this.max_prims.value = limit_of(settings.max_prims);
    this.max_depth.value = limit_of(settings.max_depth);
  }
}
