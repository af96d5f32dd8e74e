const slow = 28; // a mean time between pictures above this costs sharpness [ms]
const checked = 20; // pictures of a mean

/** Makes the picture coarser while the machine draws it too slowly. */
export class FrameRate {
  constructor(picture) {
    this.picture = picture;
    this.sum = 0;
    this.count = 0;
  }

  /** Takes the time since the last picture [s]. */
  advance(seconds) {
    this.sum += 1000 * seconds;
    this.count += 1;
    if (this.count < checked) return;
    if (this.sum / this.count > slow) this.picture.coarsen();
    this.sum = 0;
    this.count = 0;
  }
}
