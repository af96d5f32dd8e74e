import { applyAddress } from './address.js';
import { Clock } from './clock.js';
import { element } from './elements.js';
import { connectKeys, replayKeys } from './keyboard.js';
import { Labels, pictureKey } from './labels.js';
import { Plots } from './plots.js';
import { quantities } from './quantities.js';
import { largestLoads, lowestPlace, statesAt } from './replay_states.js';
import { StatusBand } from './status_band.js';
import { Theme } from './theme.js';
import { Transport, speedFor } from './transport.js';
import { eachFrame, keepFitted, makePicture } from './view.js';
import { ViewOptions } from './view_options.js';

const lead = 0.15; // the page opens this long before the first contact [s]

/** Returns the first sample in which something holds a god object; 0 if there is none. */
function firstContact(data) {
  const free = data.statuses.indexOf('free');
  const first = data.replays.map(({ status }) => status.findIndex((s) => s !== free));
  return Math.min(...first.map((i) => (i < 0 ? 0 : i)));
}

/** Returns the largest value of a plotted quantity in all replays. */
function largestValue(data, key) {
  return Math.max(...data.replays.map(({ plots }) => plots[key].values.reduce((a, b) => Math.max(a, b), 0)));
}

/** Returns the plotted quantities. */
function plotted(data) {
  const all = quantities(largestValue(data, 'torque'));
  return all.filter(({ key }) => key !== 'time' || largestValue(data, 'time') > 0); // a run in virtual time has none
}

/** Makes the elements of the page. Returns its parts; `picture` is undefined without WebGL. */
function makeParts(data, root) {
  const theme = new Theme();
  const clock = new Clock(data.t);
  const view = element('div', { className: 'view' });
  const frame = element('section', { className: 'frame' }, view);
  root.append(frame);
  root.classList.toggle('several', data.replays.length > 1);
  root.style.setProperty('--count', data.replays.length);
  const picture = makePicture(data, view, {
    count: data.replays.length, largest: largestLoads(data), lowest: (up) => lowestPlace(data, up),
  });
  picture?.show(statesAt(data, firstContact(data)));
  const labels = new Labels(data);
  labels.root.classList.toggle('alone', !picture);
  view.append(labels.root);
  if (picture) view.append(pictureKey(data, picture.stage.gridStep, data.replays.length === 1 ? ['god object'] : []));
  const transport = new Transport(clock, new StatusBand(data, theme).root);
  const options = new ViewOptions(picture, theme, root);
  const plots = new Plots(data, plotted(data), clock, theme);
  frame.append(transport.root, options.root);
  root.append(plots.root);
  return { theme, clock, view, picture, labels, transport, options, plots };
}

/** Plays the replays of a page in an element. */
export function startReplay(data, root) {
  const parts = makeParts(data, root);
  const { theme, clock, view, picture, labels, options, plots } = parts;
  for (const shown of [labels, plots]) clock.onChange((sample) => shown.show(sample));
  if (picture) {
    clock.onChange((sample) => picture.show(statesAt(data, sample)));
    keepFitted(picture, labels, view, theme);
  }
  clock.setSpeed(speedFor(data.t[clock.last] - data.t[0]));
  clock.seekTime(data.t[firstContact(data)] - lead);
  applyAddress(clock, options, picture);
  clock.changed();
  connectKeys(replayKeys(parts));
  window.godobjectPage = { data, clock, picture }; // for tests
  eachFrame((seconds) => {
    clock.advance(seconds);
    picture?.draw();
  });
}
