// Events as they come, as a list and on the bar of the run's time.
const signs = { critical: ['✖', 'critical error'], error: ['▲', 'error'], mark: ['⚑', 'mark'], step: ['›', 'step'], event: ['·', 'event'] };

export const clock = (s) => `${Math.floor(s / 60)}:${String(Math.floor(s % 60)).padStart(2, '0')}`;

export class Timeline {
  constructor(list, bar, ask) {
    this.list = list;
    this.bar = bar;
    this.moments = [];
    this.last = 0;
    this.now = 0;
    this.chosen = null;
    this.held = null;
    this.branches = [];
    this.enabled = false;
    bar.addEventListener('pointermove', (e) => { this.choose(this.second(e)); });
    // Under the mouse the bar stands still, while time goes on.
    bar.addEventListener('pointerenter', () => { this.held = this.span(); });
    bar.addEventListener('pointerleave', () => { this.held = null; this.choose(null); });
    bar.addEventListener('click', (e) => { if (this.enabled) ask(this.second(e)); });
    bar.addEventListener('keydown', (e) => {
      const by = { ArrowLeft: -1, ArrowRight: 1, PageDown: -10, PageUp: 10, Home: -1e9, End: 1e9 }[e.key];
      if (by) this.choose(Math.max(0, Math.min(Math.floor(this.now), (this.chosen ?? Math.floor(this.now)) + by)));
      else if (e.key === 'Enter' && this.chosen !== null && this.enabled) ask(this.chosen);
      else return;
      e.preventDefault();
    });
    new ResizeObserver(() => this.draw()).observe(bar);
  }
  second(e) {
    const box = this.bar.getBoundingClientRect();
    return Math.max(0, Math.min(Math.floor(this.now), Math.round((e.clientX - box.left) / box.width * this.span())));
  }
  span() { return this.held ?? Math.max(20, this.now * 1.02); }
  choose(second) {
    this.chosen = second;
    this.draw();
  }
  clear() {
    this.moments = [];
    this.last = 0;
    this.branches = [];
    this.list.replaceChildren();
  }
  add(events) {
    for (const event of events) {
      if (event.n <= this.last) continue;
      this.last = event.n;
      this.moments.push(event);
      const item = document.createElement('li'), time = document.createElement('time'), sign = document.createElement('span'), words = document.createElement('span');
      time.textContent = clock(event.s);
      [sign.textContent, sign.title] = signs[event.kind] ?? signs.event;
      sign.setAttribute('aria-label', sign.title);
      sign.setAttribute('role', 'img');
      words.textContent = event.words;
      item.className = event.kind;
      item.append(time, sign, words);
      this.list.prepend(item);
      while (this.list.childElementCount > 400) this.list.lastChild.remove();
    }
    this.draw();
  }
  goneBack(second) {
    this.branches.push(second);
    this.moments = this.moments.filter((m) => m.s <= second);
    for (const item of [...this.list.children]) item.remove();
    const kept = this.moments;
    this.moments = [];
    this.last = 0;
    this.add(kept);
  }
  tick(second) {
    this.now = second;
    this.bar.setAttribute('aria-valuemax', Math.floor(second));
    this.bar.setAttribute('aria-valuenow', this.chosen ?? Math.floor(second));
    this.bar.setAttribute('aria-valuetext', clock(this.chosen ?? second));
    this.draw();
  }
  draw() {
    const bar = this.bar, ratio = devicePixelRatio || 1, width = bar.clientWidth, height = bar.clientHeight;
    if (!width) return;
    bar.width = Math.round(width * ratio);
    bar.height = Math.round(height * ratio);
    const pen = bar.getContext('2d'), x = (s) => width * s / this.span();
    pen.scale(ratio, ratio);
    pen.fillStyle = '#11151a';
    pen.fillRect(0, 0, width, height);
    pen.fillStyle = '#24303a';
    pen.fillRect(0, height - 16, x(this.now), 10);
    const colours = { critical: '#ff7a6b', error: '#f2b84b', mark: '#6cc6ff' };
    for (const m of this.moments) {
      const colour = colours[m.kind];
      pen.fillStyle = colour ?? '#3d4953';
      if (m.kind === 'critical') pen.fillRect(x(m.s) - 2, 2, 4, height - 8);
      else if (colour) pen.fillRect(x(m.s) - 1, 8, 2, height - 14);
      else pen.fillRect(x(m.s), height - 16, 1, 10);
    }
    pen.strokeStyle = '#b58cff';
    for (const s of this.branches) { pen.beginPath(); pen.moveTo(x(s), 2); pen.lineTo(x(s) + 6, 8); pen.lineTo(x(s), 14); pen.stroke(); }
    pen.fillStyle = '#dbe2e8';
    pen.fillRect(x(this.now) - 1, height - 19, 2, 16);
    if (this.chosen !== null) {
      pen.fillRect(x(this.chosen), 0, 1, height);
      pen.font = '11px sans-serif';
      pen.fillText(clock(this.chosen), Math.min(x(this.chosen) + 4, width - 34), 11);
    }
  }
}
