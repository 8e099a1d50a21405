// What a lab sounds like: a tone at each R wave, an alarm, a hum while the beam is on. Off until the button is pressed.
const strip_s = 5, R_10uV = 50, refractory_s = 0.25, alarm_every_s = 4;

export class Sound {
  // `pressed`: is called after a pointer pressed the button, which had taken the focus from the picture.
  constructor(button, pressed) {
    this.button = button;
    button.onclick = (event) => {
      this.on = !this.on;
      button.setAttribute('aria-pressed', this.on);
      this.on ? this.begin() : this.end();
      if (event.detail > 0) pressed();
    };
  }
  begin() {
    this.audio ??= new AudioContext();
    this.audio.resume();
    this.last_R_s = this.alarmed_s = -Infinity;
  }
  end() {
    this.hum(false);
    this.audio.suspend();
  }
  tone(hertz, seconds, volume, after_s = 0) {
    const voice = this.audio.createOscillator(), gain = this.audio.createGain(), begin = this.audio.currentTime + after_s;
    voice.frequency.value = hertz;
    gain.gain.setValueAtTime(0, begin);
    gain.gain.linearRampToValueAtTime(volume, begin + 0.005); // no clicks
    gain.gain.setValueAtTime(volume, begin + seconds - 0.01);
    gain.gain.linearRampToValueAtTime(0, begin + seconds);
    voice.connect(gain).connect(this.audio.destination);
    voice.start(begin);
    voice.stop(begin + seconds);
  }
  hum(on) {
    if (!!this.humming === on) return;
    if (!on) {
      this.humming.stop();
      this.humming = null;
      return;
    }
    const gain = this.audio.createGain();
    gain.gain.value = 0.02;
    this.humming = this.audio.createOscillator();
    this.humming.frequency.value = 150;
    this.humming.connect(gain).connect(this.audio.destination);
    this.humming.start();
  }
  // The time of the newest R wave in lead II.
  newest_R(now) {
    const trace = now.ecg_10uV ?? [];
    for (let i = trace.length - 2; i > 0; --i)
      if (trace[i] > R_10uV && trace[i] >= trace[i - 1] && trace[i] >= trace[i + 1])
        return now.s - strip_s * (trace.length - 1 - i) / trace.length;
    return -Infinity;
  }
  show(now, ended) {
    if (!this.on) return;
    const running = !now.paused && !ended;
    this.hum(running && (now.arm.fluoroscopy || now.arm.cine));
    if (!running || !now.patient) return;
    if (now.s < this.last_R_s) this.last_R_s = this.alarmed_s = -Infinity; // gone back
    const R_s = this.newest_R(now), p = now.patient, beats = p.rhythm < 2;
    if (beats && R_s > this.last_R_s + refractory_s) {
      if (now.s - R_s < 0.5) {
        this.tone(880, 0.07, 0.08);
        this.button.dataset.tones = Number(this.button.dataset.tones ?? 0) + 1;
      }
      this.last_R_s = R_s;
    }
    if ((!beats || (p.systolic_mmHg < 80)) && now.s > this.alarmed_s + alarm_every_s) {
      [0, 0.2, 0.4].forEach((after_s) => this.tone(660, 0.12, 0.12, after_s));
      this.alarmed_s = now.s;
    }
  }
}
