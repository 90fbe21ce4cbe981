// Speaking to the robot: while the button (or V) is held, what the microphone hears goes to the console, which recognises it.

const HEARD_HZ = 16000, PIECE = 4096, TAIL_MS = 350; // what is recognised; samples at a time; a word's end after the button is let go

const microphone = {
  held: false, opening: false, stream: null, context: null, left: new Float32Array(0), at: 0,

  async press() {
    if (this.held || this.opening || !page.steers) return;
    this.held = this.opening = true;
    $("mic").classList.add("on");
    try {
      if (!navigator.mediaDevices) throw new Error("this browser gives a page no microphone");
      this.stream = await navigator.mediaDevices.getUserMedia({ audio: { channelCount: 1, echoCancellation: false, noiseSuppression: false, autoGainControl: false } });
      this.context = new AudioContext();
      const node = this.context.createScriptProcessor(PIECE, 1, 1);
      this.at = 0;
      this.left = new Float32Array(0);
      if (!link.send({ talk: "begin" })) throw new Error("there is no connection");
      node.onaudioprocess = (event) => this.piece(event.inputBuffer.getChannelData(0), this.context ? this.context.sampleRate : 0);
      this.context.createMediaStreamSource(this.stream).connect(node);
      node.connect(this.context.destination); // which plays nothing: a node that leads nowhere is not run
      $("mic").classList.add("hears");
    } catch (error) {
      panels.answer({ out: `Nothing can be said here: ${error.message}` });
      this.held = false;
      this.close();
    }
    this.opening = false;
    if (!this.held) this.let_go();
  },

  release() {
    if (!this.held) return;
    this.held = false;
    if (!this.opening) this.let_go();
  },

  let_go() {
    $("mic").classList.remove("on");
    if (this.context) setTimeout(() => { if (!this.held) { this.close(); link.send({ talk: "end" }); } }, TAIL_MS);
  },

  close() {
    $("mic").classList.remove("on", "hears");
    if (this.stream) this.stream.getTracks().forEach((track) => track.stop());
    if (this.context) this.context.close();
    this.stream = this.context = null;
  },

  // Each sample that is sent is the mean of those of its time: microphones have 44.1 or 48 kHz.
  piece(samples, rate_hz) {
    const all = new Float32Array(this.left.length + samples.length), step = rate_hz / HEARD_HZ, out = [];
    if (!step) return;
    all.set(this.left);
    all.set(samples, this.left.length);
    let at = this.at;
    for (; at + step <= all.length; at += step) {
      let sum = 0, count = 0;
      for (let k = Math.floor(at); k < Math.max(Math.floor(at) + 1, Math.floor(at + step)); k++) { sum += all[k]; count++; }
      out.push(Math.max(-1, Math.min(1, sum / count)) * 32767);
    }
    const whole = Math.floor(at);
    this.left = all.slice(whole);
    this.at = at - whole;
    if (!out.length) return;
    const bytes = new Uint8Array(Int16Array.from(out).buffer);
    let text = "";
    for (const byte of bytes) text += String.fromCharCode(byte);
    link.send({ sound: btoa(text) });
  },
};
