import { element, fixed } from '../elements.js';
import { StateLabel } from '../labels.js';
import { motionColours } from '../theme.js';

const hands = { free: 'nobody moves the hand', yours: 'you move the hand', other: 'another viewer moves the hand' };

const pause = 100; // between two texts of the line of numbers [ms]

/** Writes a text only if it changes. */
function write(place, text) {
  if (place.textContent !== text) place.textContent = text;
}

function modeText({ mode, share }) {
  return mode === 'engaging' ? `${mode} ${Math.round(100 * share)} %` : mode;
}

/** The state of the controller: its mode and outcome over the picture, and a line of numbers below it. */
export class StateLine {
  constructor(source, steers) {
    this.steers = steers;
    this.label = new StateLabel(source, motionColours[0]);
    this.mode = element('span', { className: 'mode' });
    this.label.state.before(this.mode);
    this.root = element('div', { className: 'labels' }, this.label.root);
    this.facts = Object.fromEntries(['time', 'speed', 'cycles', 'lost', 'hand', 'viewers'].map((key) =>
      [key, element('span', { className: `fact ${key}` })]));
    this.line = element('div', { className: 'facts' }, ...Object.values(this.facts));
  }

  /** Puts the label into the corner of the view. */
  place([{ width }]) {
    Object.assign(this.label.root.style, { left: '8px', top: '8px', maxWidth: `${width - 16}px` });
  }

  show(state) {
    write(this.mode, modeText(state));
    this.mode.dataset.kind = state.fault ? 'fault' : state.mode === 'running' ? 'running' : 'waiting';
    this.label.show(state.outcome);
    if (performance.now() - (this.wroteAt ?? 0) >= pause) this.showFacts(state);
  }

  showFacts(state) {
    this.wroteAt = performance.now();
    const { time, speed, cycles, lost, hand, viewers } = this.facts;
    write(time, `${fixed(state.t, 1)} s`);
    write(speed, `${fixed(state.speed, 2)} × real time`);
    write(cycles, `${state.cycles.toLocaleString('en')} cycles`);
    write(lost, state.lost ? `${state.lost.toLocaleString('en')} lost` : '');
    write(hand, this.steers ? hands[state.hand] ?? '' : '');
    write(viewers, `${state.viewers} ${state.viewers === 1 ? 'viewer' : 'viewers'}`);
  }
}
