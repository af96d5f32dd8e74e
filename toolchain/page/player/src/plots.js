import { element } from './elements.js';
import { PlotFigure, inUnit } from './plot_figure.js';
import { motionColours } from './theme.js';

const red = '#dc2626';

/** Returns the times of the points of a plot: two for each sample if the page stores extremes of buckets. */
function plotTimes(data) {
  if (data.bucket === 1) return data.t;
  const times = new Float64Array(2 * data.t.length);
  for (let i = 0; i < data.t.length; ++i) {
    const next = i + 1 < data.t.length ? data.t[i + 1] : data.t[i] + (data.t[i] - data.t[Math.max(i - 1, 0)]);
    times[2 * i] = data.t[i];
    times[2 * i + 1] = (data.t[i] + next) / 2;
  }
  return times;
}

/** Returns the numbers above zero with their neighbours, so that a single one is seen, too; null in place of others. */
function aboveZero(numbers) {
  return Array.from(numbers, (v, i) => (v > 0 || numbers[i - 1] > 0 || numbers[i + 1] > 0 ? v : null));
}

/** Plots of all quantities over time, with one curve for each replay and a line at the time that is shown. */
export class Plots {
  constructor(data, quantities, clock, theme) {
    this.data = data;
    this.clock = clock;
    this.times = plotTimes(data);
    this.entries = quantities.map((quantity) => this.makeEntry(quantity, theme));
    this.root = element('div', { className: 'plots' }, ...this.entries.map(({ figure }) => figure.root));
    new ResizeObserver(() => this.resize()).observe(this.root);
  }

  makeEntry(quantity, theme) {
    const colours = this.data.replays.map((_, i) => motionColours[i]);
    const entry = { line: element('div', { className: 'now' }) };
    entry.figure = new PlotFigure(quantity, theme, {
      names: this.data.replays.map(({ name }) => name), colours,
      x: { values: (_, ticks) => ticks.map((t) => `${+t.toFixed(6)} s`) },
      hooks: { draw: [() => this.placeLine(entry)] },
      series: [...colours, ...(quantity.key === 'depth' ? colours.map(() => red) : [])].map((stroke) => ({ stroke })),
    });
    return entry;
  }

  /** Returns the times and the numbers of a quantity, one row for each replay; of the depth also those above zero. */
  table(quantity) {
    const rows = this.data.replays.map(({ plots }) => {
      const { extremes, values } = plots[quantity.key];
      return inUnit(quantity, extremes ?? values);
    });
    return [this.times, ...rows, ...(quantity.key === 'depth' ? rows.map(aboveZero) : [])];
  }

  resize() {
    for (const { figure, line } of this.entries) {
      const isNew = !figure.plot;
      figure.fit(() => this.table(figure.quantity));
      if (isNew && figure.plot) this.seekIn(figure.plot, line);
    }
    this.show(this.clock.sample);
  }

  /** A click or a drag in a plot seeks. */
  seekIn(plot, line) {
    plot.over.append(line);
    const seek = (event) => {
      const left = event.clientX - plot.over.getBoundingClientRect().left;
      this.clock.seekTime(plot.posToVal(left, 'x'));
    };
    plot.over.addEventListener('pointerdown', (event) => {
      plot.over.setPointerCapture(event.pointerId);
      seek(event);
    });
    plot.over.addEventListener('pointermove', (event) => event.buttons & 1 && seek(event));
  }

  /** Moves the lines to a sample and writes its numbers. */
  show(sample) {
    for (const entry of this.entries) {
      entry.figure.write(this.data.replays.map(({ plots }) => plots[entry.figure.quantity.key].values[sample]));
      this.placeLine(entry);
    }
  }

  placeLine({ figure, line }) {
    if (!figure?.plot) return;
    line.style.transform = `translateX(${figure.plot.valToPos(this.data.t[this.clock.sample], 'x')}px)`;
  }
}
