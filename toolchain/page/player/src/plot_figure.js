import uPlot from 'uplot';
import { element, fixed } from './elements.js';

/** Returns a scale's range that shows depths near zero: the stored band below it is far larger. */
export function depthRange(plot, low, high) {
  const inside = Math.max(high, 0);
  return [Math.max(low * 1.05, -Math.max(1.5 * inside, -low / 5)), Math.max(1.15 * inside, -low / 15)];
}

function plainRange(plot, low, high) {
  return [Math.min(low * 1.08, 0), high > 0 ? high * 1.08 : 1];
}

/** Returns the powers of ten on a logarithmic axis. */
function decades(plot, axis, low, high) {
  const powers = [];
  for (let e = Math.ceil(Math.log10(low) - 1e-9); 10 ** e <= high * 1.0001; ++e) powers.push(10 ** e);
  return powers;
}

function scaleOf({ key, logarithmic, range }) {
  if (logarithmic) return { distr: 3, ...(range ? { range } : {}) };
  return { range: range ?? (key === 'depth' ? depthRange : plainRange) };
}

/** Returns numbers in the unit of a quantity; on a logarithmic axis without zero. Unknown ones (null) stay a gap. */
export function inUnit({ scale, logarithmic }, numbers) {
  const scaled = (v) => (logarithmic ? Math.max(v * scale, 0.1) : v * scale);
  return Array.from(numbers, (v) => (v === null ? null : scaled(v)));
}

function tickText(v) {
  if (v === null) return '';
  return v >= 1e5 ? `${+(v / 1e3).toPrecision(6)}k` : `${+v.toPrecision(6)}`;
}

/** A plot of a quantity over time below its name and its present values. */
export class PlotFigure {
  /**
   * `curves`: `names` and `colours` of the values; `series`, `bands` and the time axis `x` of uPlot; `xScale` and
   * `hooks` may be missing.
   */
  constructor(quantity, theme, curves) {
    this.quantity = quantity;
    this.theme = theme;
    this.curves = curves;
    this.values = curves.names.map((name, i) => {
      const value = element('span', { className: 'value', title: name });
      value.style.setProperty('--colour', curves.colours[i]);
      return value;
    });
    const head = element('div', { className: 'plot-head', title: quantity.hint ?? '' },
      element('span', { className: 'plot-name' }, quantity.name), ...this.values,
      element('span', { className: 'unit' }, quantity.unit));
    this.box = element('div', { className: 'plot-box' });
    this.root = element('figure', { className: 'plot' }, head, this.box);
    theme.onChange(() => this.plot?.redraw(false));
  }

  options(width, height) {
    const { quantity, curves } = this;
    const axis = {
      stroke: () => this.theme.colour('--muted'), font: '11px system-ui, sans-serif',
      grid: { stroke: () => this.theme.colour('--line'), width: 1 }, ticks: { show: false },
    };
    return {
      width, height, padding: [6, 14, 0, 0], legend: { show: false },
      cursor: { drag: { x: false, y: false }, points: { show: false }, x: false, y: false },
      scales: { x: { time: false, ...curves.xScale }, y: scaleOf(quantity) },
      axes: [
        { ...axis, size: 22, space: 50, ...curves.x },
        {
          ...axis, size: 46, space: 22, ...(quantity.logarithmic ? { splits: decades } : {}),
          values: (_, ticks) => ticks.map(tickText),
        },
      ],
      hooks: curves.hooks ?? {},
      series: [{}, ...curves.series.map((series) => ({
        width: 1.4, points: { show: false },
        paths: quantity.stepped ? uPlot.paths.stepped({ align: 1 }) : undefined, ...series,
      }))],
      bands: curves.bands ?? [],
    };
  }

  /** Fits the plot to its box; makes it of `table` (times and the numbers of each series) the first time. */
  fit(table) {
    const { clientWidth: width, clientHeight: height } = this.box;
    if (width < 50 || height < 40) return;
    if (this.plot) this.plot.setSize({ width, height });
    else this.plot = new uPlot(this.options(width, height), table(), this.box);
  }

  /** Writes a value for each name, in SI units. */
  write(numbers) {
    const { key, scale, digits } = this.quantity;
    this.values.forEach((value, i) => {
      value.textContent = Number.isFinite(numbers[i]) ? fixed(numbers[i] * scale, digits) : '–';
      value.classList.toggle('inside', key === 'depth' && numbers[i] > 0);
    });
  }
}
