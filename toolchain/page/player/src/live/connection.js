const retry = 1000; // from the end of a connection to the next attempt [ms]
const silence = 3000; // without a state: the controller is taken for lost [ms]

/** Returns the address of the socket of the server that sent this page, with the page's token. */
function socketAddress() {
  return `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/socket${location.search}`;
}

/** The socket to the server. It begins again by itself. `onState`, `onAnswer` and `onChange` take one listener each. */
export class Connection {
  constructor() {
    this.online = undefined; // not known yet
    setInterval(() => this.online && performance.now() - this.heard > silence && this.setOnline(false), 500);
  }

  open() {
    this.socket = new WebSocket(socketAddress(), 'godobject-live');
    this.socket.addEventListener('message', ({ data }) => this.receive(JSON.parse(data)));
    this.socket.addEventListener('close', () => {
      this.setOnline(false);
      setTimeout(() => this.open(), retry);
    });
  }

  receive(message) {
    if (message.type === 'answer') this.onAnswer(message);
    if (message.type !== 'state') return;
    this.heard = performance.now();
    this.setOnline(true);
    this.onState(message);
  }

  setOnline(online) {
    if (this.online === online) return;
    this.online = online;
    this.onChange(online);
  }

  /** Sends a message, or drops it without a connection. */
  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
}
