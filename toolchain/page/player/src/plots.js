import uPlot from 'uplot';
import { element, fixed } from './elements.js';
import { replayColours } from './theme.js';

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

/** Returns a scale's range that shows depths near zero: the stored band below it is far larger. */
function depthRange(plot, low, high) {
  const inside = Math.max(high, 0);
  return [Math.max(low * 1.05, -Math.max(1.5 * inside, -low / 5)), Math.max(1.15 * inside, -low / 15)];
}

function moveLine(plot, line, time) {
  line.style.transform = `translateX(${plot.valToPos(time, 'x')}px)`;
}

/** Returns the powers of ten on a logarithmic axis. */
function decades(plot, axis, low, high) {
  const powers = [];
  for (let e = Math.ceil(Math.log10(low) - 1e-9); 10 ** e <= high * 1.0001; ++e) powers.push(10 ** e);
  return powers;
}

/** Plots of all quantities over time, with one curve for each replay and a line at the time that is shown. */
export class Plots {
  constructor(data, quantities, clock, theme) {
    this.data = data;
    this.clock = clock;
    this.theme = theme;
    this.times = plotTimes(data);
    this.root = element('div', { className: 'plots' });
    this.plots = quantities.map((quantity) => this.makePlot(quantity));
    theme.onChange(() => this.plots.forEach(({ plot }) => plot?.redraw(false)));
    new ResizeObserver(() => this.resize()).observe(this.root);
  }

  makePlot(quantity) {
    const values = this.data.replays.map((_, i) => {
      const value = element('span', { className: 'value', title: this.data.replays[i].name });
      value.style.setProperty('--colour', replayColours[i]);
      return value;
    });
    const unit = element('span', { className: 'unit' }, quantity.unit);
    const head = element('div', { className: 'plot-head', title: quantity.hint ?? '' },
      element('span', { className: 'plot-name' }, quantity.name), ...values, unit);
    const box = element('div', { className: 'plot-box' });
    this.root.append(element('figure', { className: 'plot' }, head, box));
    return { quantity, values, box };
  }

  /** Returns the numbers of a quantity in its unit, one row for each replay; of the depth also those above zero. */
  series({ key, scale, logarithmic }) {
    const rows = this.data.replays.map(({ plots }) => {
      const numbers = Float64Array.from(plots[key].extremes ?? plots[key].values, (v) => v * scale);
      return logarithmic ? numbers.map((v) => Math.max(v, 0.1)) : numbers;
    });
    return key === 'depth' ? [...rows, ...rows.map(aboveZero)] : rows;
  }

  /** Returns the colours of the rows of `series`. */
  strokes({ key }) {
    const colours = this.data.replays.map((_, i) => replayColours[i]);
    return key === 'depth' ? [...colours, ...colours.map(() => red)] : colours;
  }

  options(quantity, width, height) {
    const axis = {
      stroke: () => this.theme.colour('--muted'), font: '11px system-ui, sans-serif',
      grid: { stroke: () => this.theme.colour('--line'), width: 1 }, ticks: { show: false },
    };
    return {
      width, height, padding: [6, 14, 0, 0], legend: { show: false },
      cursor: { drag: { x: false, y: false }, points: { show: false }, x: false, y: false },
      scales: { x: { time: false }, y: this.scale(quantity) },
      axes: [
        { ...axis, size: 22, space: 50, values: (_, ticks) => ticks.map((t) => `${+t.toFixed(6)} s`) },
        {
          ...axis, size: 46, space: 22, ...(quantity.logarithmic ? { splits: decades } : {}),
          values: (_, ticks) => ticks.map((v) => (v === null ? '' : `${+v.toPrecision(6)}`)),
        },
      ],
      hooks: { draw: [() => this.placeLine(quantity)] },
      series: [{}, ...this.strokes(quantity).map((stroke) => ({
        stroke, width: 1.4, points: { show: false },
        paths: quantity.stepped ? uPlot.paths.stepped({ align: 1 }) : undefined,
      }))],
    };
  }

  scale({ key, logarithmic }) {
    if (logarithmic) return { distr: 3 };
    if (key === 'depth') return { range: depthRange };
    return { range: (_, low, high) => [0, high > 0 ? high * 1.08 : 1] };
  }

  resize() {
    for (const entry of this.plots) {
      const { clientWidth: width, clientHeight: height } = entry.box;
      if (width < 50 || height < 40) continue;
      if (entry.plot) entry.plot.setSize({ width, height });
      else this.build(entry, width, height);
    }
    this.show(this.clock.sample);
  }

  build(entry, width, height) {
    const table = [this.times, ...this.series(entry.quantity)];
    entry.plot = new uPlot(this.options(entry.quantity, width, height), table, entry.box);
    entry.line = element('div', { className: 'now' });
    entry.plot.over.append(entry.line);
    const seek = (event) => {
      const left = event.clientX - entry.plot.over.getBoundingClientRect().left;
      this.clock.seekTime(entry.plot.posToVal(left, 'x'));
    };
    entry.plot.over.addEventListener('pointerdown', (event) => {
      entry.plot.over.setPointerCapture(event.pointerId);
      seek(event);
    });
    entry.plot.over.addEventListener('pointermove', (event) => event.buttons & 1 && seek(event));
  }

  /** Moves the lines to a sample and writes its numbers. */
  show(sample) {
    for (const { quantity, values, plot, line } of this.plots) {
      values.forEach((value, i) => {
        const number = this.data.replays[i].plots[quantity.key].values[sample] * quantity.scale;
        value.textContent = fixed(number, quantity.digits);
        value.classList.toggle('inside', quantity.key === 'depth' && number > 0);
      });
      if (line) moveLine(plot, line, this.data.t[sample]);
    }
  }

  placeLine(quantity) {
    const { plot, line } = this.plots.find((entry) => entry.quantity === quantity);
    if (line) moveLine(plot, line, this.data.t[this.clock.sample]);
  }
}
