const slow = 35; // a mean time between pictures above this makes the page simpler [ms]
const fast = 20; // one below this makes it finer again [ms]
const checked = 1; // time of a mean [s]
// From fine to simple: time between two drawings of the plots [ms], pixels of the picture by those of the screen.
const levels = [[33, 1], [66, 1], [130, 1], [200, 0.8], [200, 0.65], [200, 0.5]];

/** Makes the page simpler while the machine draws it too slowly, and finer when it has time. */
export class FrameRate {
  constructor(picture, plots) {
    this.picture = picture;
    this.plots = plots;
    this.level = 0;
    this.patience = 4; // means in a row that are fast, before the page becomes finer
    this.restart();
  }

  restart() {
    this.time = 0;
    this.pictures = 0;
  }

  /** Takes the time since the last picture [s]. */
  advance(seconds) {
    this.time += seconds;
    this.pictures += 1;
    if (this.time < checked) return;
    const mean = (1000 * this.time) / this.pictures;
    this.restart();
    this.fastMeans = mean < fast ? (this.fastMeans ?? 0) + 1 : 0;
    if (mean > slow && this.level < levels.length - 1) {
      this.patience *= 2;
      this.choose(this.level + 1);
    } else if (this.fastMeans >= this.patience && this.level > 0) this.choose(this.level - 1);
  }

  choose(level) {
    this.level = level;
    this.fastMeans = 0;
    const [interval, sharpness] = levels[level];
    this.plots.interval = interval;
    this.picture?.setSharpness(sharpness);
  }
}
