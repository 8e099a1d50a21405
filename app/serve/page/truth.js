// Vessels and instruments in three dimensions, which the operator does not see.
const toolColours = ['#d9dee3', '#9fe3ff', '#c6f08d', '#ffc9f0', '#ffe9a8'];

function forceColour(base, newton) {
  if (newton < 0.02) return base;
  const part = Math.min(1, newton / 0.3);
  return `rgb(255, ${Math.round(211 - 152 * part)}, ${Math.round(77 - 29 * part)})`;
}

// mm
function lengthOf(tool) {
  let sum = 0;
  for (let i = 4; i < tool.length; i += 4) sum += Math.hypot(tool[i] - tool[i - 4], tool[i + 1] - tool[i - 3], tool[i + 2] - tool[i - 2]);
  return sum;
}

export class Truth {
  constructor(canvas) {
    this.canvas = canvas;
    this.turn = -0.7; // as from LAO 40: from there the arch lies open
    this.tilt = 0.1;
    this.scale = 2.2; // pixels per mm
    this.follow = true;
    this.middle = null;
    this.tree = [];
    this.mark = null; // a place that is shown: {tree_branch, mm}
    let last = null;
    canvas.addEventListener('pointerdown', (e) => { last = e; canvas.setPointerCapture(e.pointerId); });
    canvas.addEventListener('pointerup', () => { last = null; });
    canvas.addEventListener('pointermove', (e) => {
      if (!last) return;
      this.spin((e.clientX - last.clientX) * 0.008, (e.clientY - last.clientY) * 0.008);
      last = e;
    });
    canvas.addEventListener('wheel', (e) => { e.preventDefault(); this.zoom(e.deltaY < 0 ? 1.15 : 1 / 1.15); }, { passive: false });
    canvas.addEventListener('keydown', (e) => {
      const turns = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
      if (turns[e.key]) this.spin(...turns[e.key]);
      else if (e.key === '+') this.zoom(1.15);
      else if (e.key === '-') this.zoom(1 / 1.15);
      else return;
      e.preventDefault();
    });
    new ResizeObserver(() => this.draw()).observe(canvas);
  }
  spin(turn, tilt) {
    this.turn += turn;
    this.tilt = Math.max(-1.5, Math.min(1.5, this.tilt + tilt));
    this.draw();
  }
  zoom(by) {
    this.scale = Math.max(0.4, Math.min(40, this.scale * by));
    this.draw();
  }
  take(bytes) {
    const view = new DataView(bytes);
    let at = 16;
    const count = () => { const n = view.getUint32(at, true); at += 4; return n; };
    const floats = (n) => { const out = new Float32Array(bytes.slice(at, at + 4 * n)); at += 4 * n; return out; };
    this.tools = [];
    for (let t = count(); t > 0; --t) this.tools.push(floats(4 * count()));
    this.spheres = floats(3 * count());
    this.draw();
  }
  // The tip that is followed: of the last tool, but for one that is 15 cm and more behind the deepest (drawn out, or on
  // its way in).
  tip() {
    const tools = this.tools.filter((tool) => tool.length >= 4), long = tools.map(lengthOf), most = Math.max(...long);
    const tool = tools.findLast((_, i) => long[i] > most - 150);
    return tool ? Array.from(tool.slice(tool.length - 4, tool.length - 1)) : null;
  }
  aim() {
    let tip = this.tip();
    if (!tip) tip = [this.spheres[0], this.spheres[1], this.spheres[2]];
    if (!this.middle) this.middle = tip;
    if (this.follow) this.middle = this.middle.map((m, i) => m + 0.15 * (tip[i] - m));
  }
  ring(pen, place) {
    const branch = this.mark && this.tree[this.mark.tree_branch];
    if (!branch) return;
    let first = 0;
    for (const other of this.tree.slice(0, this.mark.tree_branch)) first += other.s_mm.length;
    let k = branch.s_mm.findIndex((s) => s >= this.mark.mm);
    if (k < 0) k = branch.s_mm.length - 1;
    const [x, y] = place(this.spheres, 3 * (first + k));
    pen.strokeStyle = '#f2b84b';
    pen.lineWidth = 2;
    pen.beginPath(); pen.arc(x, y, Math.max(7, 1.6 * this.scale * branch.radius_mm[k]), 0, 7); pen.stroke();
  }
  draw() {
    if (!this.spheres || !this.spheres.length) return;
    const canvas = this.canvas, ratio = devicePixelRatio || 1;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (!width || !height) return;
    if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
    if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
    this.aim();
    const pen = canvas.getContext('2d');
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    pen.lineCap = pen.lineJoin = 'round';
    const ct = Math.cos(this.turn), st = Math.sin(this.turn), cp = Math.cos(this.tilt), sp = Math.sin(this.tilt);
    // Patient: x left, y head, z front. Seen from the front: left is right on the screen, the head is up.
    const place = (p, i) => {
      const x = p[i] - this.middle[0], y = p[i + 1] - this.middle[1], z = p[i + 2] - this.middle[2];
      const xr = ct * x + st * z, zr = -st * x + ct * z, yr = cp * y - sp * zr;
      return [width / 2 + this.scale * xr, height / 2 - this.scale * yr];
    };
    let first = 0;
    for (const layer of ['tube', 'line']) {
      first = 0;
      for (const branch of this.tree) {
        const n = branch.radius_mm.length;
        if (layer === 'tube') {
          for (let k = 0; k + 1 < n; ++k) {
            const [ax, ay] = place(this.spheres, 3 * (first + k)), [bx, by] = place(this.spheres, 3 * (first + k + 1));
            const wide = 2 * this.scale * branch.radius_mm[k];
            if (Math.max(ax, bx) < -wide || Math.min(ax, bx) > width + wide || Math.max(ay, by) < -wide || Math.min(ay, by) > height + wide) continue;
            pen.strokeStyle = branch.radius_mm[k] > 4 ? 'rgb(150 60 60 / .10)' : 'rgb(214 84 84 / .20)';
            pen.lineWidth = Math.max(1, wide);
            pen.beginPath(); pen.moveTo(ax, ay); pen.lineTo(bx, by); pen.stroke();
          }
        } else {
          pen.strokeStyle = 'rgb(240 140 140 / .4)';
          pen.lineWidth = 0.7;
          pen.beginPath();
          for (let k = 0; k < n; ++k) { const [x, y] = place(this.spheres, 3 * (first + k)); k ? pen.lineTo(x, y) : pen.moveTo(x, y); }
          pen.stroke();
          if (n > 3 && branch.radius_mm[0] < 4 && this.scale > 3) {
            const [x, y] = place(this.spheres, 3 * (first + (n >> 1)));
            pen.fillStyle = 'rgb(230 190 190 / .75)';
            pen.font = '11px sans-serif';
            pen.fillText(branch.name, x + 4, y - 4);
          }
        }
        first += n;
      }
    }
    this.ring(pen, place);
    this.tools.forEach((tool, t) => {
      const base = toolColours[t % toolColours.length];
      for (let i = 0; i + 8 <= tool.length; i += 4) {
        const newton = Math.max(tool[i + 3], tool[i + 7]);
        const [ax, ay] = place(tool, i), [bx, by] = place(tool, i + 4);
        pen.strokeStyle = forceColour(base, newton);
        pen.lineWidth = newton >= 0.02 ? 4 : t === 0 ? 3 : 1.8;
        pen.beginPath(); pen.moveTo(ax, ay); pen.lineTo(bx, by); pen.stroke();
      }
    });
  }
}
export { toolColours };
