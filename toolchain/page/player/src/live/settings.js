import { element } from '../elements.js';
import { Quantity } from './setting_slider.js';

function switchButton(words, act) {
  const input = element('input', { type: 'checkbox', onchange: () => act(input.checked) });
  return { input, label: element('label', {}, input, ` ${words}`) };
}

/** The settings of the controller, which the server may refuse to change. `send(message)` sends to the server. */
export class Settings {
  constructor(send) {
    this.send = send;
    this.solvers = element('div', { className: 'solvers', role: 'group', 'aria-label': 'Solver' });
    this.friction = switchButton('Friction', (on) => this.set({ friction: on }));
    this.stiffness = new Quantity('Stiffness', 'N/m', 0, (value) => this.set({ stiffness: value }));
    this.damping = new Quantity('Damping', 'Ns/m', 1, (value) => this.set({ damping: value }));
    this.limit = element('p', { className: 'limit' });
    this.refusal = element('span');
    this.anyway = element('button', { type: 'button', className: 'wide', onclick: () => this.tryAnyway() },
      'Try in simulation anyway');
    this.answer = element('div', { className: 'refusal', role: 'alert', hidden: true }, this.refusal, this.anyway);
    this.root = element('section', { className: 'settings', hidden: true, 'aria-label': 'Settings' },
      element('div', { className: 'row' }, this.solvers, this.friction.label),
      this.stiffness.root, this.damping.root, this.limit, this.answer);
  }

  /** Asks the server for a change. */
  set(change) {
    this.asked = change;
    this.answer.hidden = true;
    this.send({ type: 'set', ...change });
  }

  tryAnyway() {
    this.set({ ...this.asked, beyond: true });
  }

  /** Shows the server's answer. Returns false if it belongs to no setting that was asked for. */
  take({ ok, text }) {
    if (!this.asked) return false;
    const { stiffness, damping, beyond } = this.asked;
    this.refusal.textContent = text ?? '';
    this.answer.hidden = ok;
    this.anyway.hidden = beyond === true || (stiffness === undefined && damping === undefined);
    if (ok) this.asked = undefined;
    this.stiffness.settle();
    this.damping.settle();
    this.shown = undefined; // a refused switch goes back
    return true;
  }

  show(settings) {
    this.root.hidden = !settings;
    const text = JSON.stringify(settings);
    if (!settings || text === this.shown) return;
    this.shown = text;
    this.showSolvers(settings);
    this.friction.label.hidden = !settings.has_friction;
    this.friction.input.checked = settings.friction;
    this.stiffness.show(settings.stiffness, settings.boundary);
    this.damping.show(settings.damping, null);
    this.showLimit(settings);
  }

  showSolvers({ solver, solvers }) {
    if (this.solvers.children.length !== solvers.length) {
      this.solvers.replaceChildren(...solvers.map((name) =>
        element('button', { type: 'button', onclick: () => this.set({ solver: name }) }, name)));
    }
    for (const button of this.solvers.children) {
      const on = button.textContent === solver;
      button.classList.toggle('on', on);
      button.setAttribute('aria-pressed', String(on));
    }
  }

  showLimit({ boundary, beyond }) {
    const limit = boundary === null ? '' : `${Math.round(boundary).toLocaleString('en')} N/m`;
    this.limit.classList.toggle('beyond', beyond);
    this.limit.textContent = beyond ? `Beyond the stability boundary${limit && ` of ${limit}`}: the hand may shake.` :
      limit && `Stable up to ${limit}.`;
  }
}
