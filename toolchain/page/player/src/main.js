import uPlotStyle from 'uplot/dist/uPlot.min.css';
import style from './style.css';
import { applyAddress } from './address.js';
import { Clock } from './clock.js';
import { element } from './elements.js';
import { connectKeys } from './keyboard.js';
import { Labels, pictureKey } from './labels.js';
import { readPageData } from './page_data.js';
import { Picture } from './picture.js';
import { Plots } from './plots.js';
import { quantities } from './quantities.js';
import { StatusBand } from './status_band.js';
import { Theme } from './theme.js';
import { Transport, speedFor } from './transport.js';
import { ViewOptions } from './view_options.js';

const lead = 0.15; // the page opens this long before the first contact [s]

function hasWebGl() {
  const canvas = document.createElement('canvas');
  return Boolean(canvas.getContext('webgl2'));
}

/** Returns the picture, or undefined with a message on the page. */
function makePicture(data, view) {
  if (!hasWebGl()) {
    view.append(element('p', { className: 'message' },
      'The 3D picture needs WebGL 2, which this browser does not offer. Allow hardware acceleration, or open the ' +
      'page in another browser. The plots work without it.'));
    return undefined;
  }
  const canvas = element('canvas', { className: 'picture', 'aria-label': 'The bodies in 3D' });
  view.append(canvas);
  return new Picture(data, canvas);
}

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

/** Fits the picture and its labels to their element, now and whenever its size changes. */
function keepFitted(picture, labels, view) {
  const fit = () => {
    picture.resize();
    labels.place(picture.views());
  };
  new ResizeObserver(fit).observe(view);
  fit();
}

/** Calls `advance` with the time since the last picture [s], for each picture of the screen. */
function eachFrame(advance) {
  let before;
  const frame = (now) => {
    advance(Math.min((now - (before ?? now)) / 1000, 0.25));
    before = now;
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
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
  const picture = makePicture(data, view);
  picture?.show(firstContact(data));
  const labels = new Labels(data);
  labels.root.classList.toggle('alone', !picture);
  view.append(labels.root);
  if (picture) view.append(pictureKey(data, picture.stage.gridStep));
  const transport = new Transport(clock, new StatusBand(data, theme).root);
  const options = new ViewOptions(picture, theme, root);
  const plots = new Plots(data, quantities((key) => largestValue(data, key)), clock, theme);
  frame.append(transport.root, options.root);
  root.append(plots.root);
  return { theme, clock, view, picture, labels, transport, options, plots };
}

async function start() {
  document.head.append(element('style', {}, uPlotStyle, style));
  const data = await readPageData(document.getElementById('replay-data'));
  const parts = makeParts(data, document.getElementById('player'));
  const { theme, clock, view, picture, labels, options, plots } = parts;
  for (const shown of [picture, labels, plots]) if (shown) clock.onChange((sample) => shown.show(sample));
  if (picture) {
    keepFitted(picture, labels, view);
    theme.onChange(() => picture.setDark(theme.dark));
    picture.setDark(theme.dark);
  }
  clock.setSpeed(speedFor(data.t[clock.last] - data.t[0]));
  clock.seekTime(data.t[firstContact(data)] - lead);
  applyAddress(clock, options, picture);
  clock.changed();
  connectKeys(parts);
  window.godobjectPage = { data, clock, picture }; // for tests
  eachFrame((seconds) => {
    clock.advance(seconds);
    picture?.draw();
  });
}

start().catch((error) => {
  document.getElementById('player').append(
    `The page cannot be shown: ${error.message}. A current version of Firefox, Chrome, Edge or Safari shows it.`);
  throw error;
});
