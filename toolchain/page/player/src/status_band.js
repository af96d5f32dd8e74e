import { element } from './elements.js';

/** The states of all cycles as coloured bands above the scrub bar, one band for each replay. */
export class StatusBand {
  constructor(data, theme) {
    this.data = data;
    this.theme = theme;
    this.root = element('canvas', { className: 'band' });
    theme.onChange(() => this.draw());
    new ResizeObserver(() => this.draw()).observe(this.root);
  }

  draw() {
    const { root, data } = this;
    const width = Math.round(root.clientWidth * devicePixelRatio);
    const height = Math.round(root.clientHeight * devicePixelRatio);
    if (!width || !height) return;
    root.width = width;
    root.height = height;
    const context = root.getContext('2d');
    const colours = data.statuses.map((status) => this.theme.colour(`--${status.replace('_', '-')}`) || '#888');
    const count = data.t.length;
    const span = data.t[count - 1] - data.t[0] || 1;
    const x = (i) => ((data.t[i] - data.t[0]) / span) * width;
    data.replays.forEach(({ status }, r) => {
      const top = Math.round((r * height) / data.replays.length);
      const bottom = Math.round(((r + 1) * height) / data.replays.length) - (r + 1 < data.replays.length ? 1 : 0);
      for (let i = 0, begin = 0; i < count; ++i) {
        if (i + 1 < count && status[i + 1] === status[i]) continue;
        context.fillStyle = colours[status[i]];
        const end = i + 1 < count ? x(i + 1) : width;
        context.fillRect(x(begin), top, Math.max(end - x(begin), devicePixelRatio), bottom - top);
        begin = i + 1;
      }
    });
  }
}
