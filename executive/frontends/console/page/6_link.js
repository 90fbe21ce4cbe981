// The connection to the server that the page came from: it comes back by itself.
// Neither side tells the token; each shows the other that it knows it (proof.py).

const AGAIN_MS = [300, 700, 1500, 3000];

const hex = (bytes) => Array.from(new Uint8Array(bytes), (byte) => byte.toString(16).padStart(2, "0")).join("");

async function proof(token, who, asked, own) {
  const text = new TextEncoder(), how = { name: "HMAC", hash: "SHA-256" };
  const key = await crypto.subtle.importKey("raw", text.encode(token || "-"), how, false, ["sign"]);
  return hex(await crypto.subtle.sign("HMAC", key, text.encode([who, location.host, asked, own].join("\n"))));
}

class Link {
  constructor(token, { taken, changed }) {
    Object.assign(this, { token, taken, changed, tries: 0, open: false, refused: false });
    this.connect();
  }

  connect() {
    const socket = this.socket = new WebSocket(`ws://${location.host}/`);
    const nonces = { own: hex(crypto.getRandomValues(new Uint8Array(16))), asked: "" };
    let before = Promise.resolve(); // a code takes a moment; what comes meanwhile waits
    socket.onmessage = (event) => {
      before = before.then(() => this.heard(socket, nonces, JSON.parse(event.data))).catch(console.error);
    };
    socket.onclose = (event) => {
      this.open = false;
      this.refused = event.code === 4401;
      this.changed();
      if (!this.refused) setTimeout(() => this.connect(), AGAIN_MS[Math.min(this.tries++, AGAIN_MS.length - 1)]);
    };
  }

  async heard(socket, nonces, news) {
    if (socket !== this.socket) return;
    if (this.open) { this.taken(news); return; }
    if (!nonces.asked && typeof news.nonce === "string") {
      nonces.asked = news.nonce;
      socket.send(JSON.stringify({ nonce: nonces.own, proof: await proof(this.token, "page", nonces.asked, nonces.own) }));
    } else if (nonces.asked && news.proof === await proof(this.token, "console", nonces.own, nonces.asked)) {
      this.open = true; this.tries = 0; this.changed();
    } else {
      socket.close(); // somebody else's server
    }
  }

  send(wish) {
    if (!this.open || this.socket.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(wish));
    return true;
  }
}
