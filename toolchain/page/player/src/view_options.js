import { distanceLegend } from './distance/legend.js';
import { element, fixed } from './elements.js';
import { iconButton } from './transport.js';

const axes = ['x', 'y', 'z'];

function checkbox(words, title, act) {
  const input = element('input', { type: 'checkbox', onchange: () => act(input.checked) });
  return { input, label: element('label', { title }, input, ` ${words}`) };
}

function choice(title, options, selected, act) {
  const select = element('select', { title, 'aria-label': title, onchange: () => act(+select.value) },
    ...options.map((name, i) => element('option', { value: String(i) }, name)));
  select.value = String(selected);
  return select;
}

/** The settings of the picture: follow, cut, upward axis, reset. `picture` is undefined without WebGL. */
export class ViewOptions {
  constructor(picture, theme, frame) {
    this.picture = picture;
    this.frame = frame;
    this.root = element('div', { className: 'options' });
    if (picture) this.addPictureOptions();
    this.boxes = element('span', { className: 'boxes' });
    this.root.append(this.boxes);
    const right = element('span', { className: 'right' });
    this.right = right;
    if (picture) right.append(iconButton('reset', 'Reset the view (r)', () => picture.resetView()));
    if (document.fullscreenEnabled) right.append(iconButton('full', 'Full screen (f)', () => this.toggleFull()));
    right.append(iconButton('theme', 'Light or dark (d)', () => theme.toggle()));
    this.root.append(right);
  }

  addPictureOptions() {
    const { picture } = this;
    this.follow = checkbox('Follow', 'Move the camera with the god object', (on) => picture.setFollow(on));
    this.cut = checkbox('Cut', 'Cut the bodies open towards the eye (c)', () => this.applyCut());
    this.both = checkbox('both bodies', 'Cut the moving body, too', () => this.applyCut());
    const eye = picture.eye.clone().sub(picture.target);
    const sizes = axes.map((_, axis) => (axis === picture.up ? -1 : Math.abs(eye.getComponent(axis))));
    this.axis = sizes.indexOf(Math.max(...sizes));
    this.axisChoice = choice('Axis across the cut', axes, this.axis, (axis) => this.setAxis(axis));
    this.slider = element('input', { type: 'range', min: 0, max: 1000, 'aria-label': 'Place of the cut',
      oninput: () => this.applyCut() });
    this.place = element('output', { className: 'place' });
    this.details = element('span', { className: 'details own-keys' },
      this.axisChoice, this.slider, this.place, this.both.label);
    this.distance = checkbox('Distance', 'Colour the god object by its distance to the still body (m)',
      (on) => this.showDistance(on));
    this.legend = distanceLegend(picture.colours, picture.data.still.name);
    this.frame.style.setProperty('--scale', picture.colours.scale.gradient());
    this.legend.hidden = true;
    const names = axes.map((axis) => `${axis} up`);
    const up = choice('Axis that points up', names, picture.up, (axis) => picture.setUp(axis));
    this.root.append(this.follow.label, this.cut.label, this.details, this.distance.label, this.legend, up);
    this.setAxis(this.axis);
  }

  /** Adds a box with words. Returns its input. */
  addBox(words, title, act) {
    const { input, label } = checkbox(words, title, act);
    this.boxes.append(label);
    return input;
  }

  /** Adds a button with words. */
  addButton(words, act) {
    this.right.prepend(element('button', { type: 'button', className: 'text', onclick: act }, words));
  }

  /** Cuts across another axis, at first through the middle of the god object. */
  setAxis(axis) {
    this.axis = axis;
    this.axisChoice.value = String(axis);
    const [low, high] = this.picture.extent(axis);
    const place = this.picture.motions[0].place().getComponent(axis);
    this.slider.value = String(Math.round((1000 * (place - low)) / (high - low || 1)));
    this.applyCut();
  }

  cutAcross(axis, both) {
    this.cut.input.checked = true;
    this.both.input.checked = both;
    this.setAxis(axis);
  }

  toggleCut() {
    this.cut.input.checked = !this.cut.input.checked;
    this.setAxis(this.axis);
  }

  applyCut() {
    const [low, high] = this.picture.extent(this.axis);
    const position = low + (this.slider.valueAsNumber / 1000) * (high - low);
    this.place.textContent = `${fixed(1e3 * position, 1)} mm`;
    this.details.hidden = !this.cut.input.checked;
    this.picture.setCut({
      on: this.cut.input.checked, both: this.both.input.checked, axis: this.axis, position,
    });
  }

  showDistance(on) {
    this.distance.input.checked = on;
    this.legend.hidden = !on;
    this.frame.classList.toggle('by-distance', on);
    this.picture.colours.setOn(on);
  }

  toggleFull() {
    if (document.fullscreenElement) document.exitFullscreen();
    else this.frame.requestFullscreen();
  }
}
