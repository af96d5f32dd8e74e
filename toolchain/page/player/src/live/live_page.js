import { Vector3 } from 'three';
import { element } from '../elements.js';
import { connectKeys, viewKeys } from '../keyboard.js';
import { pictureKey } from '../labels.js';
import { Theme } from '../theme.js';
import { eachFrame, keepFitted, makePicture } from '../view.js';
import { ViewOptions } from '../view_options.js';
import { Connection } from './connection.js';
import { FrameRate } from './frame_rate.js';
import { Grab } from './grab.js';
import { Hand } from './hand.js';
import { Help } from './help.js';
import { LiveObjects } from './live_objects.js';
import { Notices } from './notices.js';
import { RollingPlots } from './rolling_plots.js';
import { Settings } from './settings.js';
import { SmoothState } from './smooth_state.js';
import { SpaceMouse } from './space_mouse.js';
import { StateLine } from './state_line.js';
import { GamepadRates, KeyRates, Steering } from './steering.js';

const still = { device: [0, 0, 0, 1, 0, 0, 0], god: [0, 0, 0, 1, 0, 0, 0], force: [0, 0, 0], torque: [0, 0, 0] };

/** Returns the lowest place of the moving body along an axis of W if its centre stays above that of the still one [m]. */
function lowestPlace({ still: { low, high }, moving }, up) {
  const diameter = new Vector3(...moving.high).distanceTo(new Vector3(...moving.low));
  return Math.min(low[up], (low[up] + high[up] - diameter) / 2);
}

/** Makes the picture with the objects that only a live page has. Returns nothing without WebGL. */
function makeScene(data, view, theme) {
  const { force, torque } = data.live;
  const picture = makePicture(data, view, {
    count: 1, largest: { force, torque }, lowest: (up) => lowestPlace(data, up),
  });
  if (!picture) return {};
  picture.show([still]);
  view.append(pictureKey(data, picture.stage.gridStep, ['god object', 'contact point']));
  const objects = new LiveObjects(picture, force);
  theme.onChange(() => objects.setDark(theme.dark));
  objects.setDark(theme.dark);
  return { picture, objects };
}

/** Makes the elements of the page. Returns its parts; `picture` and `objects` are undefined without WebGL. */
function makeParts(data, root) {
  const { live } = data;
  const connection = new Connection();
  const send = (message) => connection.send(message);
  const theme = new Theme();
  const view = element('div', { className: 'view' });
  const { picture, objects } = makeScene(data, view, theme);
  const line = new StateLine(live.source, live.hand);
  line.root.classList.toggle('alone', !picture);
  const notices = new Notices(() => send({ type: 'reset' }));
  const help = new Help(live.hand);
  const options = new ViewOptions(picture, theme, root);
  const settings = new Settings(send);
  const plots = new RollingPlots(live.torque, theme);
  view.append(line.root, notices.root, help.root);
  root.classList.add('live');
  root.append(
    element('section', { className: 'frame' }, view, line.line, options.root),
    element('div', { className: 'side' }, settings.root, plots.root));
  return { data, root, connection, theme, view, picture, objects, line, notices, help, options, settings, plots };
}

/** Connects the instruments that move the hand. Returns what moves on with time. */
function connectHand(parts) {
  const { data, connection, picture, view, notices, options } = parts;
  const size = picture.size;
  const hand = new Hand(new Vector3(...data.moving.centre), size, (message) => connection.send(message));
  const mayGrab = () => connection.online && parts.latest.hand !== 'other';
  const grab = new Grab(picture, hand, view, mayGrab);
  const instruments = [new KeyRates(), new GamepadRates()];
  const steering = new Steering(picture, hand, instruments, mayGrab);
  notices.showHint(`Drag ${data.moving.name} to move the hand`);
  hand.onGrab = () => notices.showHint('');
  document.addEventListener('visibilitychange', () => document.hidden && hand.release());
  if (SpaceMouse.isPossible()) options.addButton('Connect SpaceMouse', () => connectSpaceMouse(instruments, notices));
  return { hand, grab, steering };
}

async function connectSpaceMouse(instruments, notices) {
  const mouse = new SpaceMouse();
  try {
    const name = await mouse.connect();
    if (name === undefined) return;
    instruments.push(mouse);
    notices.tell(`${name} moves the hand.`);
  } catch (error) {
    notices.tell(`The SpaceMouse cannot be opened: ${error.message}`);
  }
}

/** Shows or hides the arm by a box and a key. */
function connectArm({ options, objects }) {
  const arm = options.addBox('Arm', 'Show the arm (a)', (on) => objects.showArm(on));
  arm.checked = true;
  return () => arm.click();
}

/** Returns a function that tells if a state shows something else in the picture than the state before. */
function changeOf() {
  let before;
  return ({ device, god, force, torque, points, arm }) => {
    const now = JSON.stringify([device, god, force, torque, points, arm]);
    const changed = now !== before;
    before = now;
    return changed;
  };
}

/** Connects the messages of the server to the parts of the page. */
function connectServer(parts, smooth) {
  const { connection, root, notices, settings, line, plots, objects, hand } = parts;
  const changes = changeOf();
  connection.onState = (state) => {
    if (changes(state)) {
      smooth.take(state, performance.now());
      objects?.show(state);
    }
    parts.latest = state;
    if (smooth.latest) hand?.follow(smooth.latest.device);
    if (state.hand === 'other') hand?.drop();
    line.show(state);
    notices.showFault(state.fault);
    settings.show(state.settings);
    plots.take(state);
  };
  connection.onAnswer = (answer) => {
    if (settings.take(answer) || answer.ok) return;
    notices.tell(answer.text);
    hand?.drop();
  };
  connection.onChange = (online) => {
    root.classList.toggle('offline', !online);
    notices.showConnection(online ? '' : 'No connection to the controller. Trying again every second.');
    if (!online) hand?.drop();
  };
  connection.open();
}

/** Shows a running controller in an element. */
export function startLive(data, root) {
  const parts = makeParts(data, root);
  const { picture, plots, objects, options, help, line, view, theme } = parts;
  const smooth = new SmoothState();
  const keys = { ...viewKeys(parts), h: () => help.toggle(), '?': () => help.toggle() };
  options.addButton('?', () => help.toggle());
  if (picture) {
    keys.a = connectArm(parts);
    if (data.live.hand) Object.assign(parts, connectHand(parts));
    keepFitted(picture, line, view, theme);
  }
  connectKeys(keys);
  connectServer(parts, smooth);
  window.godobjectPage = parts; // for tests
  const rate = new FrameRate(picture, plots);
  eachFrame((seconds) => {
    const now = performance.now();
    rate.advance(seconds); // before the picture is drawn, because another sharpness clears it
    parts.steering?.advance(seconds);
    if (picture) {
      if (smooth.latest && !smooth.settled) picture.show([smooth.at(now)]);
      objects.showBand(parts.grab?.band());
      picture.draw();
    }
    plots.draw(now);
  });
}
