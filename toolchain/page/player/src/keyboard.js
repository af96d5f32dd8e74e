/** Connects keys to the player. A list of choices keeps its own keys. */
export function connectKeys({ clock, transport, options, theme, picture }) {
  const actions = {
    ' ': () => clock.toggle(),
    ArrowLeft: (event) => clock.step(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => clock.step(event.shiftKey ? 10 : 1),
    ArrowUp: () => transport.changeSpeed(1),
    ArrowDown: () => transport.changeSpeed(-1),
    Home: () => clock.seekSample(0),
    End: () => clock.seekSample(clock.last),
    l: () => transport.toggleLoop(),
    f: () => options.toggleFull(),
    d: () => theme.toggle(),
    r: () => picture?.resetView(),
    c: () => picture && options.toggleCut(),
  };
  addEventListener('keydown', (event) => {
    const act = actions[event.key];
    const taken = event.target instanceof HTMLSelectElement || event.target.closest?.('.details');
    if (!act || taken || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act(event);
  });
}
