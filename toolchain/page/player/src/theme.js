/** Light and dark: the system's wish until the viewer chooses. Listeners are called after each change. */
export class Theme {
  constructor() {
    this.listeners = [];
    this.system = matchMedia('(prefers-color-scheme: dark)');
    this.system.addEventListener('change', () => this.chosen === undefined && this.apply());
    this.apply();
  }

  get dark() {
    return this.chosen ?? this.system.matches;
  }

  onChange(listener) {
    this.listeners.push(listener);
  }

  toggle() {
    this.chosen = !this.dark;
    this.apply();
  }

  apply() {
    document.documentElement.dataset.theme = this.dark ? 'dark' : 'light';
    for (const listener of this.listeners) listener();
  }

  /** Returns a colour of the style sheet. */
  colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  }
}

/** The colours of god objects, one for each motion; readable on light and dark ground. */
export const motionColours = ['#3b82f6', '#a855f7', '#0d9488'];
