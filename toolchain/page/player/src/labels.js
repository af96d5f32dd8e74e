import { element } from './elements.js';
import { statusText } from './quantities.js';
import { motionColours } from './theme.js';

/** A name in the colour of its god object, and the status of a cycle in words. */
export class StateLabel {
  constructor(name, colour) {
    this.state = element('span', { className: 'state' });
    this.words = element('span', { className: 'words' });
    this.root = element('div', { className: 'label' },
      element('span', { className: 'name' }, name), this.state, this.words);
    this.root.style.setProperty('--colour', colour);
  }

  show(status) {
    if (this.root.dataset.status === status) return;
    this.root.dataset.status = status;
    this.state.textContent = status;
    this.state.style.setProperty('--state', `var(--${status.replace('_', '-')})`);
    this.words.textContent = statusText(status);
  }
}

/** Names and states of the replays, over their views. */
export class Labels {
  constructor(data) {
    this.data = data;
    this.items = data.replays.map(({ name }, i) => new StateLabel(`replay ${name}`, motionColours[i]));
    this.root = element('div', { className: 'labels' }, ...this.items.map(({ root }) => root));
  }

  /** Puts each label into the corner of its view. */
  place(views) {
    views.forEach(({ left, top, width }, i) => {
      const { style } = this.items[i].root;
      Object.assign(style, { left: `${left + 8}px`, top: `${top + 8}px`, maxWidth: `${width - 16}px` });
    });
  }

  show(sample) {
    this.items.forEach((item, i) => item.show(this.data.statuses[this.data.replays[i].status[sample]]));
  }
}

/** Returns the key to colours and lengths in the picture. `more`: names of other things that are shown. */
export function pictureKey(data, gridStep, more) {
  const entry = (words, text = words) =>
    element('span', { className: `key ${words.replace(' ', '-')}` }, text);
  const millimetres = +(1e3 * gridStep).toPrecision(3);
  return element('div', { className: 'keys' },
    ...['hand', ...more, 'force', 'torque', ...(data.workspace ? ['workspace'] : [])].map((words) => entry(words)),
    entry('grid', `grid ${millimetres} mm`));
}
