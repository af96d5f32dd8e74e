// The element that holds the 3D picture.
import { element } from './elements.js';
import { Picture } from './picture.js';

const softwareRenderers = /swiftshader|llvmpipe|softpipe|basic render/i;

/** Tells if the browser has WebGL 2, and if the processor draws in place of a graphics card. */
function webGl() {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (!gl) return { exists: false };
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const name = gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return { exists: true, isSoftware: softwareRenderers.test(name) };
}

/** Returns the picture, or undefined with a message on the page. `settings`: see `Picture`. */
export function makePicture(data, view, settings) {
  const { exists, isSoftware } = webGl();
  if (!exists) {
    view.append(element('p', { className: 'message' },
      'The 3D picture needs WebGL 2, which this browser does not offer. Allow hardware acceleration, or open the ' +
      'page in another browser. The plots work without it.'));
    return undefined;
  }
  const canvas = element('canvas', { className: 'picture', 'aria-label': 'The bodies in 3D' });
  view.append(canvas);
  return new Picture(data, canvas, { ...settings, smoothEdges: !isSoftware }); // smooth edges take thrice the time
}

/** Fits the picture and its labels to their element, now and whenever its size changes, and follows the theme. */
export function keepFitted(picture, labels, view, theme) {
  const fit = () => {
    picture.resize();
    labels.place(picture.views());
  };
  new ResizeObserver(fit).observe(view);
  fit();
  theme.onChange(() => picture.setDark(theme.dark));
  picture.setDark(theme.dark);
}

/** Calls `advance` with the time since the last picture [s], for each picture of the screen. */
export function eachFrame(advance) {
  let before;
  const frame = (now) => {
    advance(Math.min((now - (before ?? now)) / 1000, 0.25));
    before = now;
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}
