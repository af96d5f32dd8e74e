import { element } from '../elements.js';

const steps = 1000; // of a slider

/** A number with a slider, of which a part may lie beyond a boundary. `act(value)` is called when it was chosen. */
export class Quantity {
  constructor(name, unit, digits, act) {
    this.digits = digits;
    this.act = act;
    this.slider = element('input', {
      type: 'range', min: 0, max: steps, 'aria-label': name, className: 'own-keys',
      oninput: () => this.drag(), onchange: () => this.choose(this.number.valueAsNumber),
    });
    this.number = element('input', {
      type: 'number', min: 0, step: 'any', 'aria-label': `${name}, ${unit}`, className: 'own-keys',
      oninput: () => (this.isEdited = true), onchange: () => this.choose(this.number.valueAsNumber),
    });
    this.track = element('div', { className: 'bounded' }, this.slider);
    this.root = element('div', { className: 'row quantity' }, element('span', { className: 'quantity-name' }, name),
      this.track, this.number, element('span', { className: 'unit' }, unit));
  }

  drag() {
    this.isEdited = true;
    this.number.value = ((this.slider.valueAsNumber / steps) * this.top).toFixed(this.digits);
  }

  choose(value) {
    this.isEdited = false;
    if (!(value >= 0)) {
      this.write();
      return;
    }
    this.slider.value = String((steps * value) / this.top);
    this.act(value);
  }

  /** Shows the server's number again after its answer, unless the viewer already writes another one. */
  settle() {
    if (!this.isEdited) this.write();
  }

  /** Shows the present number and the boundary, or null, in the same unit. */
  show(value, boundary) {
    this.value = value;
    const least = 1.02 * Math.max(value, boundary ?? 0);
    if (!(this.top >= least)) this.top = Math.max(1.5 * (boundary ?? 0), 2 * value, 10 ** -this.digits);
    this.track.style.setProperty('--boundary', String(boundary === null ? 1 : boundary / this.top));
    this.track.classList.toggle('has-boundary', boundary !== null);
    if (!this.isEdited && document.activeElement !== this.number) this.write();
  }

  write() {
    this.number.value = this.value.toFixed(this.digits);
    this.slider.value = String((steps * this.value) / this.top);
  }
}
