import { element } from './elements.js';
import { icon } from './icons.js';

export const speeds = [0.1, 0.25, 0.5, 1, 2];

/** Returns the speed at which a motion takes eight seconds or a little longer. */
export function speedFor(seconds) {
  return speeds.filter((speed) => speed > 0.2 && speed <= 1 && seconds / speed >= 8).at(-1) ?? 0.25;
}

export function iconButton(name, words, act) {
  const button = element('button', { type: 'button', title: words, 'aria-label': words, onclick: act });
  button.append(icon(name));
  return button;
}

/** The buttons, the scrub bar and the time. */
export class Transport {
  constructor(clock, band) {
    this.clock = clock;
    this.play = iconButton('play', 'Play or pause (space)', () => clock.toggle());
    this.play.classList.add('play');
    this.loop = iconButton('loop', 'Play again at the end (l)', () => this.toggleLoop());
    this.scrub = element('input', {
      type: 'range', min: 0, max: clock.last, step: 1, value: 0, 'aria-label': 'Time',
      oninput: () => clock.seekSample(this.scrub.valueAsNumber),
    });
    this.time = element('output', { className: 'time' });
    this.speed = element('select', {
      title: 'Speed (arrow up, arrow down)', 'aria-label': 'Speed', onchange: () => clock.setSpeed(+this.speed.value),
    }, ...speeds.map((speed) => element('option', { value: String(speed) }, `${speed}×`)));
    const end = clock.times[clock.last].toFixed(3);
    this.end = element('span', { className: 'end' }, ` / ${end} s`);
    this.root = element('div', { className: 'transport' }, this.play,
      iconButton('back', 'One cycle back (arrow left)', () => clock.step(-1)),
      iconButton('forward', 'One cycle on (arrow right)', () => clock.step(1)),
      element('div', { className: 'track' }, band, this.scrub),
      element('span', { className: 'times' }, this.time, this.end), this.speed, this.loop);
    clock.onChange(() => this.show());
  }

  toggleLoop() {
    this.clock.loops = !this.clock.loops;
    this.loop.classList.toggle('on', this.clock.loops);
    this.loop.setAttribute('aria-pressed', String(this.clock.loops));
  }

  changeSpeed(by) {
    const at = speeds.indexOf(this.clock.speed) + by;
    if (at >= 0 && at < speeds.length) this.clock.setSpeed(speeds[at]);
  }

  show() {
    const { clock } = this;
    if (this.playing !== clock.playing) {
      this.playing = clock.playing;
      this.play.replaceChildren(icon(clock.playing ? 'pause' : 'play'));
    }
    this.scrub.value = clock.sample;
    this.time.textContent = clock.times[clock.sample].toFixed(3);
    this.speed.value = String(clock.speed);
  }
}
