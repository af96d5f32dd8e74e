import { element } from '../elements.js';

const brief = 5000; // a passing notice stays as long [ms]

/** Notices over the picture: a fault with its reset, the lost connection, a hint, an answer of the server. */
export class Notices {
  constructor(reset) {
    const notice = (className, ...children) =>
      element('div', { className: `notice ${className}`, hidden: true, role: 'status' }, ...children);
    this.faultText = element('span');
    const button = element('button', { type: 'button', className: 'wide', onclick: reset }, 'Reset');
    this.fault = notice('fault', this.faultText, button);
    this.connection = notice('connection');
    this.answer = notice('answer');
    this.hint = notice('hint');
    this.root = element('div', { className: 'notices' }, this.connection, this.fault, this.answer, this.hint);
  }

  showFault(text) {
    if (this.faultText.textContent === text && this.fault.hidden === !text) return;
    this.faultText.textContent = text;
    this.fault.hidden = !text;
  }

  showConnection(text) {
    this.connection.textContent = text;
    this.connection.hidden = !text;
  }

  showHint(text) {
    this.hint.textContent = text;
    this.hint.hidden = !text;
  }

  /** Shows a text for some seconds. */
  tell(text) {
    this.answer.textContent = text;
    this.answer.hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => (this.answer.hidden = true), brief);
  }
}
