// The connection to the run: comes back by itself, and says that it is here, so that held keys are let go when it is not.
export class Socket {
  constructor(token, listeners) {
    this.token = token;
    this.listeners = listeners;
    this.wait = 300;
    this.open();
    setInterval(() => this.send({ do: 'here' }), 300);
  }
  open() {
    const socket = new WebSocket(`ws://${location.host}/socket`);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => socket.send(JSON.stringify({ do: 'hello', token: this.token }));
    socket.onmessage = (event) => {
      this.wait = 300;
      if (typeof event.data === 'string') this.listeners.text(JSON.parse(event.data));
      else this.listeners.bytes(event.data);
    };
    socket.onclose = () => {
      this.listeners.gone();
      setTimeout(() => this.open(), this.wait);
      this.wait = Math.min(2 * this.wait, 4000);
    };
    this.socket = socket;
  }
  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
  order(command, ...values) {
    this.send(values.length ? { do: command, values } : { do: command });
  }
}
