import uPlotStyle from 'uplot/dist/uPlot.min.css';
import style from './style.css';
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
  try {
    if (!hasWebGl()) throw new Error('no WebGL 2');
    const canvas = element('canvas', { className: 'picture', 'aria-label': 'The bodies in 3D' });
    view.append(canvas);
    return new Picture(data, canvas);
  } catch (error) {
    view.replaceChildren(element('p', { className: 'message' },
      'The 3D picture needs WebGL, which this browser does not offer. Allow hardware acceleration, or open the page in ' +
      'another browser. The plots work without it.'));
    return undefined;
  }
}

function firstContact(data) {
  const free = data.statuses.indexOf('free');
  const first = data.replays.map(({ status }) => status.findIndex((s) => s !== free));
  return Math.min(...first.map((i) => (i < 0 ? 0 : i)));
}

/** Applies `#t=1.9&cut=y&both&paused` of the address. */
function applyAddress(clock, options, picture) {
  const wanted = new URLSearchParams(location.hash.slice(1));
  if (wanted.has('t')) clock.seekTime(+wanted.get('t'));
  const axis = ['x', 'y', 'z'].indexOf(wanted.get('cut'));
  if (picture && axis >= 0) {
    options.cut.input.checked = true;
    options.both.input.checked = wanted.has('both');
    options.setAxis(axis);
  }
  if (wanted.has('speed')) clock.setSpeed(+wanted.get('speed'));
  clock.playing = !wanted.has('paused');
}

function run(clock, picture) {
  let before;
  const frame = (now) => {
    clock.advance(Math.min((now - (before ?? now)) / 1000, 0.25));
    before = now;
    picture?.draw();
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}

async function start() {
  document.head.append(element('style', {}, uPlotStyle, style));
  const root = document.getElementById('player');
  const data = await readPageData(document.getElementById('replay-data'));
  const theme = new Theme();
  const clock = new Clock(data.t);
  const view = element('div', { className: 'view' });
  const frame = element('section', { className: 'frame' }, view);
  root.append(frame);
  root.classList.toggle('several', data.replays.length > 1);
  root.style.setProperty('--count', data.replays.length);
  const picture = makePicture(data, view);
  const labels = new Labels(data);
  view.append(labels.root);
  if (picture) view.append(pictureKey(data, picture.stage.gridStep));
  picture?.show(firstContact(data));
  const transport = new Transport(clock, new StatusBand(data, theme).root);
  const options = new ViewOptions(picture, theme, root);
  frame.append(transport.root, options.root);
  const largest = (key) => Math.max(...data.replays.map(({ plots }) => plots[key].values.reduce((a, b) => Math.max(a, b), 0)));
  const plots = new Plots(data, quantities(largest), clock, theme);
  root.append(plots.root);
  for (const shown of [picture, labels, plots]) if (shown) clock.onChange((sample) => shown.show(sample));
  if (picture) {
    const refit = () => {
      picture.resize();
      labels.place(picture.views());
    };
    new ResizeObserver(refit).observe(view);
    theme.onChange(() => picture.setDark(theme.dark));
    picture.setDark(theme.dark);
    refit();
  }
  clock.speed = speedFor(data.t[clock.last] - data.t[0]);
  clock.seekTime(data.t[firstContact(data)] - lead);
  applyAddress(clock, options, picture);
  clock.changed();
  connectKeys({ clock, transport, options, theme, picture });
  window.godobjectPage = { data, clock, picture, theme }; // for tests
  run(clock, picture);
}

start().catch((error) => {
  document.getElementById('player').append(
    `The page cannot be shown: ${error.message}. A current version of Firefox, Chrome, Edge or Safari shows it.`);
  throw error;
});
