import { element } from './elements.js';
import { statusText } from './quantities.js';
import { replayColours } from './theme.js';

/** Names and states of the replays, over their views. */
export class Labels {
  constructor(data) {
    this.data = data;
    this.root = element('div', { className: 'labels' });
    this.items = data.replays.map(({ name }, i) => {
      const state = element('span', { className: 'state' });
      const words = element('span', { className: 'words' });
      const label = element('div', { className: 'label' },
        element('span', { className: 'name' }, `replay ${name}`), state, words);
      label.style.setProperty('--colour', replayColours[i]);
      this.root.append(label);
      return { label, state, words };
    });
  }

  /** Puts each label into the corner of its view. */
  place(views) {
    views.forEach(({ left, top, width }, i) => {
      const { style } = this.items[i].label;
      Object.assign(style, { left: `${left + 8}px`, top: `${top + 8}px`, maxWidth: `${width - 16}px` });
    });
  }

  show(sample) {
    this.items.forEach(({ label, state, words }, i) => {
      const status = this.data.statuses[this.data.replays[i].status[sample]];
      if (label.dataset.status === status) return;
      label.dataset.status = status;
      state.textContent = status;
      state.style.setProperty('--state', `var(--${status.replace('_', '-')})`);
      words.textContent = statusText(status);
    });
  }
}

/** Returns the key to colours and lengths in the picture. */
export function pictureKey(data, gridStep) {
  const entry = (className, words) => element('span', { className: `key ${className}` }, words);
  const millimetres = +(1e3 * gridStep).toPrecision(3);
  return element('div', { className: 'keys' },
    entry('hand', 'hand'),
    ...(data.replays.length === 1 ? [entry('god', 'god object')] : []),
    entry('force', 'force'),
    entry('torque', 'torque'),
    ...(data.workspace ? [entry('workspace', 'workspace')] : []),
    entry('grid', `grid ${millimetres} mm`));
}
