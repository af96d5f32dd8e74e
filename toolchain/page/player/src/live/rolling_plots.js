import { element } from '../elements.js';
import { PlotFigure, depthRange, inUnit } from '../plot_figure.js';
import { quantities } from '../quantities.js';
import { motionColours } from '../theme.js';
import { History } from './history.js';

const seconds = 10;
const red = '#dc2626';
const tops = [1, 1.5, 2, 3, 5, 7.5, 10];
// The least height of a plot in its unit, so that it does not magnify noise.
const least = { force: 1, stretch: 0.1, depth: 0.1, contacts: 2, late: 10, energy: 1 };

/** Returns a number of `tops` times a power of ten that is not below a size, so that an axis seldom changes. */
function roundTop(size) {
  if (!(size > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(size));
  return power * tops.find((top) => top * power >= size * 0.9999);
}

/** Returns a function that gives the range of a quantity: from below zero only if it has been there. */
function calmRange(key) {
  return (plot, low, high) => {
    const top = Math.max(roundTop(high), least[key] ?? 0);
    return [-roundTop(-low), top > 0 ? top : 1];
  };
}

/** Returns a range that shows depths near zero, unless all are far from it. */
function calmDepth(plot, low, high) {
  const [bottom, top] = depthRange(plot, low, high);
  return [-roundTop(-(high < bottom ? low : bottom)), Math.max(roundTop(top), 0.1 * least.depth)];
}

function wholeDecades(plot, low, high) {
  if (low === null) return [1, 1000]; // nothing to show yet
  const bottom = 10 ** Math.floor(Math.log10(low));
  return [bottom, Math.max(10 ** Math.ceil(Math.log10(high)), 10 * bottom)];
}

/** Returns the plotted quantities of a running controller. */
function plotted(largestTorque) {
  const live = [
    {
      key: 'late', name: 'Lateness', unit: 'µs', scale: 1e6, digits: 1,
      hint: 'Time from the planned start of a cycle to its start. Zero in virtual time.',
    },
    {
      key: 'energy', name: 'Energy absorbed', unit: 'mJ', scale: 1e3, digits: 1,
      hint: 'Energy that the rendered torques have absorbed from arm and hand. Below zero they have given energy.',
    },
  ];
  const ranges = { time: wholeDecades, depth: calmDepth };
  return [...quantities(largestTorque), ...live].map((quantity) =>
    ({ ...quantity, range: ranges[quantity.key] ?? calmRange(quantity.key) }));
}

/** Plots of the last seconds. Each keeps the extremes of all cycles between two states. */
export class RollingPlots {
  constructor(largestTorque, theme) {
    this.figures = plotted(largestTorque).map((quantity) => this.makeFigure(quantity, theme));
    this.history = new History(this.figures.map(({ quantity }) => quantity.key), seconds);
    this.root = element('div', { className: 'plots' }, ...this.figures.map(({ root }) => root));
    this.interval = 33; // from one drawing to the next [ms]
    this.drawnAt = 0;
    new ResizeObserver(() => this.fit()).observe(this.root);
    this.visible = new Set();
    const watch = new IntersectionObserver((entries) => entries.forEach(({ target, isIntersecting }) =>
      this.visible[isIntersecting ? 'add' : 'delete'](target)));
    for (const { root } of this.figures) watch.observe(root);
  }

  makeFigure(quantity, theme) {
    const [stroke] = motionColours;
    const inside = quantity.key === 'depth' ? [{ stroke: red, width: 2 }] : [];
    return new PlotFigure(quantity, theme, {
      names: ['latest'], colours: [stroke],
      x: { values: (_, ticks) => ticks.map((t) => (t === 0 ? 'now' : `${+t.toFixed(3)} s`)) },
      xScale: { range: [-seconds, 0] },
      series: [{ stroke }, { stroke }, ...inside],
      bands: [{ series: [2, 1], fill: `${stroke}55` }],
    });
  }

  /** Returns the times before now and the extremes of a quantity in its unit; of the depth also those above zero. */
  table(quantity) {
    const { t, low, high } = this.history;
    const now = t.at(-1) ?? 0;
    const highest = inUnit(quantity, high[quantity.key]);
    const inside = quantity.key === 'depth' ? [Array.from(highest, (v) => (v > 0 ? v : null))] : [];
    return [Float64Array.from(t, (time) => time - now), inUnit(quantity, low[quantity.key]), highest, ...inside];
  }

  fit() {
    for (const figure of this.figures) figure.fit(() => this.table(figure.quantity));
  }

  take(state) {
    this.history.take(state.t, state.plots);
    this.latest = state.plots;
  }

  /** Draws the plots that are on the screen if there is news and the last time is long enough ago. `now`: [ms] */
  draw(now) {
    if (!this.latest || now - this.drawnAt < this.interval) return;
    this.drawnAt = now;
    for (const figure of this.figures) {
      if (!this.visible.has(figure.root)) continue;
      figure.plot?.setData(this.table(figure.quantity));
      figure.write([this.latest[figure.quantity.key][0]]);
    }
    this.latest = undefined;
  }
}
