// Undo and redo: buttons and keys over the history of the shown scene.
import { element } from './dom';
import { label_of } from './language';
import { History, type Past, type Snapshot } from './history';
import type { Parameter } from './parameter';
import { speak } from './messages';
import { is_typing } from './typing';
import { words } from './words';

const texts = words.undo;

export interface UndoActions {
  /** Shows this state. */
  restore(state: Snapshot, by: -1 | 1): void;
  /** The history has changed. */
  changed(past: Past): void;
}

const ways = [['undo', -1], ['redo', 1]] as const;

export class Undo {
  private readonly history = new History();
  private labels = new Map<string, string>();
  private acted = false; // the user, since the last state that was noted

  constructor(private readonly actions: UndoActions) {
    for (const [id, by] of ways) element(id).addEventListener('click', () => this.go(by));
    document.addEventListener('keydown', (event) => this.key(event));
    // From a menu of the browser.
    document.addEventListener('beforeinput', (event) => {
      const by = { historyUndo: -1, historyRedo: 1 }[event.inputType] as -1 | 1 | undefined;
      if (!by || is_typing()) return;
      event.preventDefault();
      this.go(by);
    });
    this.show();
  }

  /** The library's table, for the names of what changes. */
  name_by(parameters: Parameter[]): void {
    this.labels = new Map(parameters.map(({ id, label, long_label }) => [id, label_of(id, long_label ?? label ?? id)]));
  }

  /** The next state that is noted is the user's. */
  act(): void {
    this.acted = true;
  }

  /** A scene is shown that has no past, or this one. */
  begin(state: Snapshot, past: Past | null): void {
    this.acted = false;
    if (past) this.history.resume(past);
    else this.history.begin(state);
    this.show();
  }

  /** The shown state, with all that was asked for. */
  note(state: Snapshot): void {
    this.history.note(state, this.acted, performance.now());
    this.acted = false;
    this.show();
  }

  /** The state that restore() was called with could not be shown. */
  take_back(by: -1 | 1): void {
    this.history.go(by === 1 ? -1 : 1);
    this.show();
  }

  private go(by: -1 | 1): void {
    const what = this.words(by);
    const state = this.history.go(by);
    if (!state) return;
    this.acted = false;
    this.show();
    speak(by < 0 ? texts.undone(what) : texts.redone(what));
    this.actions.restore(state, by);
  }

  // What is typed and not taken yet has the browser's undo.
  private key(event: KeyboardEvent): void {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || document.querySelector('dialog[open]')) return;
    const key = event.key.toLowerCase();
    const by = key === 'y' && !event.shiftKey ? 1 : key !== 'z' ? 0 : event.shiftKey ? 1 : -1;
    if (by === 0 || is_typing()) return;
    event.preventDefault();
    this.go(by);
  }

  private words(by: -1 | 1): string {
    const members = this.history.next(by) ?? [];
    const names = members.slice(0, 2).map((member) => texts.members[member] ?? texts.members[member.split('.')[0]!] ?? this.labels.get(member) ?? member.replaceAll('_', ' '));
    return names.join(', ') + (members.length > 2 ? texts.more : '');
  }

  private show(): void {
    for (const [id, by] of ways) {
      const button = element<HTMLButtonElement>(id);
      const able = this.history.next(by) !== null;
      // Disabling it would take the focus of a keyboard away from it.
      button.setAttribute('aria-disabled', String(!able));
      const [name, keys, nothing] = by < 0 ? [texts.undo, 'Ctrl+Z', texts.nothing_to_undo] : [texts.redo, 'Shift+Ctrl+Z', texts.nothing_to_redo];
      button.title = able ? `${name} ${this.words(by)} (${keys})` : nothing;
      button.setAttribute('aria-label', able ? `${name} ${this.words(by)}` : name);
    }
    this.actions.changed(this.history.past);
  }
}
