// The connection to the server that the page came from: it comes back by itself.

const AGAIN_MS = [300, 700, 1500, 3000];
const SILENT_MS = 25000;

class Link {
  constructor(token, { taken, changed }) {
    Object.assign(this, { token, taken, changed, tries: 0, open: false, refused: false });
    this.connect();
  }

  connect() {
    const socket = this.socket = new WebSocket(`ws://${location.host}/`);
    socket.onopen = () => { socket.send(JSON.stringify({ token: this.token })); };
    socket.onmessage = (event) => {
      if (!this.open) { this.open = true; this.tries = 0; this.changed(); }
      this.taken(JSON.parse(event.data));
    };
    socket.onclose = (event) => {
      this.open = false;
      this.refused = event.code === 4401;
      this.changed();
      if (!this.refused) setTimeout(() => this.connect(), AGAIN_MS[Math.min(this.tries++, AGAIN_MS.length - 1)]);
    };
  }

  send(wish) {
    if (!this.open || this.socket.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(wish));
    return true;
  }
}
