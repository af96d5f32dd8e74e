/** Returns the keys of the view's options. */
export function viewKeys({ options, theme, picture }) {
  return {
    f: () => options.toggleFull(),
    d: () => theme.toggle(),
    r: () => picture?.resetView(),
    c: () => picture && options.toggleCut(),
    m: () => picture && options.showDistance(!picture.colours.on),
  };
}

/** Returns the keys of a page of replays. */
export function replayKeys({ clock, transport, ...view }) {
  return {
    ' ': () => clock.toggle(),
    ArrowLeft: (event) => clock.step(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => clock.step(event.shiftKey ? 10 : 1),
    ArrowUp: () => transport.changeSpeed(1),
    ArrowDown: () => transport.changeSpeed(-1),
    Home: () => clock.seekSample(0),
    End: () => clock.seekSample(clock.last),
    l: () => transport.toggleLoop(),
    ...viewKeys(view),
  };
}

/** Tells if a key goes to an element that has keys of its own, or to the browser. */
export function isTaken(event) {
  return event.target instanceof HTMLSelectElement || event.target.closest?.('.own-keys') || event.ctrlKey ||
    event.metaKey || event.altKey;
}

/** Calls the action of each key that is pressed. A list of choices keeps its own keys. */
export function connectKeys(actions) {
  addEventListener('keydown', (event) => {
    const act = actions[event.key];
    if (!act || isTaken(event)) return;
    event.preventDefault();
    act(event);
  });
}
