// The bar below the picture of a file with several frames: time line, play, step, speed and loop.
import { element } from './dom';
import { grouped, words } from './words';
import type { PlayAction, PlayerState } from './protocol';

export class PlayerBar {
  private readonly bar = element('player');
  private readonly toggle = element<HTMLButtonElement>('player_play');
  private readonly line = element<HTMLInputElement>('player_frame');
  private readonly words = element<HTMLOutputElement>('player_words');
  private readonly speed = element<HTMLInputElement>('player_speed');
  private readonly loop = element<HTMLInputElement>('player_loop');

  constructor(private readonly act: (action: PlayAction) => void) {
    this.toggle.addEventListener('click', () => act({ toggle: true }));
    element('player_back').addEventListener('click', () => act({ step: -1 }));
    element('player_on').addEventListener('click', () => act({ step: 1 }));
    this.line.addEventListener('input', () => {
      this.say(Number(this.line.value), Number(this.line.max), null);
      act({ frame: Number(this.line.value) });
    });
    this.speed.addEventListener('change', () => {
      if (this.speed.reportValidity() && this.speed.value !== '') act({ frames_per_second: Number(this.speed.value) });
    });
    this.loop.addEventListener('change', () => act({ loops: this.loop.checked }));
  }

  /** Handles a key; false if there is nothing to play. */
  key(key: string): boolean {
    if (this.bar.hidden) return false;
    if (key === ' ') this.act({ toggle: true });
    else if (key === ',') this.act({ step: -1 });
    else if (key === '.') this.act({ step: 1 });
    else return false;
    return true;
  }

  show(state: PlayerState): void {
    this.bar.hidden = state.frames < 2;
    element('stage').classList.toggle('plays', state.frames > 1);
    if (state.frames < 2) return;
    const word = state.playing ? words.player.pause : words.player.play;
    if (this.toggle.getAttribute('aria-label') !== word) {
      this.toggle.setAttribute('aria-label', word);
      this.toggle.textContent = state.playing ? '❚❚' : '▶';
    }
    this.line.max = String(state.frames - 1);
    this.line.value = String(state.frame);
    this.say(state.frame, state.frames - 1, state.shown ? state.time_ps : null);
    this.bar.dataset['frame'] = state.shown ? String(state.frame) : '';
    if (document.activeElement !== this.speed) this.speed.value = String(state.frames_per_second);
    this.loop.checked = state.loops;
  }

  private say(frame: number, last: number, time_ps: number | null): void {
    const time = time_ps === null ? '' : `, ${+time_ps.toPrecision(6)} ps`;
    this.words.textContent = `${grouped(frame)} / ${grouped(last)}${time}`;
    this.line.setAttribute('aria-valuetext', `${words.player.at(grouped(frame), grouped(last))}${time}`);
  }
}
