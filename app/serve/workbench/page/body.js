// The vessels in three dimensions, seen as by a C-arm's detector: what is dragged turns the C-arm.
import { Wall } from '/wall.js';

const degree = Math.PI / 180;

// Patient: x left, y head, z front, mm. From the front, left is right on the screen, and the head is up.
export class Camera {
  constructor() {
    this.lao = 40; // degrees
    this.cran = 0;
    this.scale = 1.6; // pixels per mm
    this.middle = [0, 0, 0];
    this.width = this.height = 1;
  }
  rows() {
    const ct = Math.cos(this.lao * degree), st = -Math.sin(this.lao * degree), cp = Math.cos(this.cran * degree), sp = Math.sin(this.cran * degree);
    return [[ct, 0, st], [sp * st, cp, -sp * ct], [-cp * st, sp, cp * ct]];
  }
  columns() {
    const [a, b, c] = this.rows();
    return [a[0], b[0], c[0], a[1], b[1], c[1], a[2], b[2], c[2]];
  }
  begin() { this.now = this.rows(); }
  // On the canvas; the third is how near it is, in mm.
  place(p, i = 0) {
    const q = [p[i] - this.middle[0], p[i + 1] - this.middle[1], p[i + 2] - this.middle[2]];
    const [x, y, z] = this.now.map((row) => row[0] * q[0] + row[1] * q[1] + row[2] * q[2]);
    return [this.width / 2 + this.scale * x, this.height / 2 - this.scale * y, z];
  }
  // What a move on the canvas is in the patient, mm, in the plane of the canvas.
  moved(dx, dy) {
    const [a, b] = this.rows();
    return [0, 1, 2].map((i) => (a[i] * dx - b[i] * dy) / this.scale);
  }
}

const clamp = (x, least, most) => Math.max(least, Math.min(most, x));
export const sphereAt = (vessel, k) => ({ p: vessel.spheres.slice(5 * k, 5 * k + 3), radius: vessel.spheres[5 * k + 3], mm: vessel.spheres[5 * k + 4] });
export const lengthOf = (vessel) => vessel.spheres[vessel.spheres.length - 1];
export function nearestSphere(vessel, mm) {
  let best = 0;
  for (let k = 0; 5 * k < vessel.spheres.length; ++k) if (Math.abs(vessel.spheres[5 * k + 4] - mm) < Math.abs(vessel.spheres[5 * best + 4] - mm)) best = k;
  return best;
}

export class Body {
  constructor(wallCanvas, canvas, listeners) {
    this.wall = new Wall(wallCanvas);
    this.canvas = canvas;
    this.camera = new Camera();
    this.listeners = listeners; // chosen(vessel, mm), wallChosen(p), moved(vessel, sphere, p), turned()
    this.draft = null;
    this.chosen = null; // {vessel, mm}
    this.wallPoint = null;
    this.drags = false; // the chosen sphere, instead of the view
    this.spheres = false;
    this.names = true;
    this.listen();
    new ResizeObserver(() => this.draw()).observe(canvas);
  }
  listen() {
    let last = null, from = null, dragged = null;
    this.canvas.addEventListener('pointerdown', (e) => {
      last = from = e;
      this.canvas.setPointerCapture(e.pointerId);
      if (this.drags && this.chosen) dragged = sphereAt(this.draft.vessels[this.chosen.vessel], nearestSphere(this.draft.vessels[this.chosen.vessel], this.chosen.mm)).p;
    });
    this.canvas.addEventListener('pointermove', (e) => {
      if (!last) return;
      const dx = e.clientX - last.clientX, dy = e.clientY - last.clientY;
      last = e;
      if (dragged) {
        dragged = dragged.map((x, i) => x + this.camera.moved(dx, dy)[i]);
        this.ghost = dragged;
        this.draw();
      } else this.turn(-0.45 * dx, 0.45 * dy);
    });
    this.canvas.addEventListener('pointerup', (e) => {
      const still = from && Math.hypot(e.clientX - from.clientX, e.clientY - from.clientY) < 4;
      this.ghost = last = from = null;
      if (dragged && !still) {
        const { vessel, mm } = this.chosen;
        this.listeners.moved(vessel, nearestSphere(this.draft.vessels[vessel], mm), dragged);
      } else if (still) this.choose(e.offsetX, e.offsetY);
      dragged = null;
      this.draw();
    });
    this.canvas.addEventListener('wheel', (e) => { e.preventDefault(); this.zoom(e.deltaY < 0 ? 1.15 : 1 / 1.15); }, { passive: false });
    this.canvas.addEventListener('keydown', (e) => {
      const turns = { ArrowLeft: [5, 0], ArrowRight: [-5, 0], ArrowUp: [0, -5], ArrowDown: [0, 5] };
      if (turns[e.key]) this.turn(...turns[e.key]);
      else if (e.key === '+') this.zoom(1.15);
      else if (e.key === '-') this.zoom(1 / 1.15);
      else return;
      e.preventDefault();
    });
  }
  turn(lao, cran) {
    this.look(this.camera.lao + lao, this.camera.cran + cran);
  }
  look(lao, cran) {
    this.camera.lao = clamp(lao, -120, 120);
    this.camera.cran = clamp(cran, -55, 55);
    this.draw();
    this.listeners.turned();
  }
  zoom(by) {
    this.camera.scale = clamp(this.camera.scale * by, 0.3, 60);
    this.draw();
  }
  centre(p, scale = 0) {
    this.camera.middle = p;
    this.camera.scale = Math.max(this.camera.scale, scale);
    this.draw();
  }
  // The coronary arteries, where there are some, or all of it fits the canvas.
  fit() {
    const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9], { branches, vessels } = this.draft;
    const heart = new Set(branches.filter((b) => ['LM', 'LAD', 'LCx', 'RCA'].includes(b.name)).map((b) => b.vessel));
    vessels.forEach((vessel, v) => { if (heart.has(vessel.parent) && vessel.parent > 0) heart.add(v); });
    for (const vessel of heart.size ? [...heart].map((v) => vessels[v]) : vessels)
      for (let k = 0; k < vessel.spheres.length; k += 5)
        for (let i = 0; i < 3; ++i) {
          low[i] = Math.min(low[i], vessel.spheres[k + i] - vessel.spheres[k + 3]);
          high[i] = Math.max(high[i], vessel.spheres[k + i] + vessel.spheres[k + 3]);
        }
    this.camera.middle = low.map((x, i) => (x + high[i]) / 2);
    const wide = Math.max(high[0] - low[0], high[2] - low[2], 1), tall = Math.max(high[1] - low[1], 1);
    this.camera.scale = clamp(0.92 * Math.min(this.canvas.clientWidth / wide, this.canvas.clientHeight / tall), 0.3, 60);
  }
  take(draft) {
    const first = !this.draft;
    this.draft = draft;
    if (first) this.fit();
    if (this.chosen && !draft.vessels[this.chosen.vessel]) this.chosen = null;
    this.draw();
  }
  choose(x, y) {
    const near = 12; // pixels
    let best = null;
    this.camera.begin();
    this.draft.vessels.forEach((vessel, v) => {
      for (let k = 0; k < vessel.spheres.length; k += 5) {
        const [px, py] = this.camera.place(vessel.spheres, k), away = Math.hypot(px - x, py - y);
        if (away < near && (!best || away < best.away)) best = { away, vessel: v, mm: vessel.spheres[k + 4] };
      }
    });
    if (best) return this.listeners.chosen(best.vessel, best.mm);
    const p = this.wall.hit(this.camera, x, y);
    if (p) this.listeners.wallChosen(p);
  }
  // A branch's name, or where it has none, nothing.
  branchAt(vessel, mm) {
    const own = this.draft.branches.filter((b) => b.vessel === vessel);
    return own.find((b) => mm >= b.from_mm - 1e-3 && mm <= b.to_mm + 1e-3) ?? own[0];
  }
  size() {
    const ratio = devicePixelRatio || 1, width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    for (const canvas of [this.canvas, this.wall.canvas]) {
      if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
      if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
    }
    this.camera.width = width, this.camera.height = height;
    return ratio;
  }
  draw() {
    if (!this.draft || !this.canvas.clientWidth) return;
    const ratio = this.size(), pen = this.canvas.getContext('2d');
    this.camera.begin();
    this.wall.draw(this.camera);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, this.camera.width, this.camera.height);
    pen.lineJoin = pen.lineCap = 'round';
    this.draft.vessels.forEach((vessel, v) => this.course(pen, vessel, v));
    this.faults(pen);
    this.lesions(pen);
    if (this.names) for (const branch of this.draft.branches) this.label(pen, branch);
    this.entry(pen);
    this.selection(pen);
  }
  stretch(pen, vessel, from, to) {
    pen.beginPath();
    let begun = false;
    for (let k = 0; k < vessel.spheres.length; k += 5) {
      if (vessel.spheres[k + 4] < from - 1e-3 || vessel.spheres[k + 4] > to + 1e-3) continue;
      const [x, y] = this.camera.place(vessel.spheres, k);
      begun ? pen.lineTo(x, y) : pen.moveTo(x, y);
      begun = true;
    }
    pen.stroke();
  }
  course(pen, vessel, v) {
    const chosen = this.chosen && this.chosen.vessel === v;
    pen.strokeStyle = chosen ? '#6cc6ff' : 'rgb(226 170 160 / .75)';
    pen.lineWidth = chosen ? 2 : 1.1;
    this.stretch(pen, vessel, 0, Infinity);
    if (!this.spheres) return;
    pen.strokeStyle = chosen ? 'rgb(108 198 255 / .5)' : 'rgb(226 170 160 / .25)';
    pen.lineWidth = 0.8;
    for (let k = 0, last = -1e9; k < vessel.spheres.length; k += 5) {
      if (vessel.spheres[k + 4] - last < 0.8 * vessel.spheres[k + 3]) continue;
      last = vessel.spheres[k + 4];
      const [x, y] = this.camera.place(vessel.spheres, k);
      pen.beginPath(); pen.arc(x, y, this.camera.scale * vessel.spheres[k + 3], 0, 7); pen.stroke();
    }
  }
  faults(pen) {
    pen.strokeStyle = '#ff7a6b';
    pen.lineWidth = 4;
    pen.setLineDash([2, 5]);
    for (const fault of this.draft.faults) this.stretch(pen, this.draft.vessels[fault.vessel], fault.from_mm - 0.3, fault.to_mm + 0.3);
    pen.setLineDash([]);
  }
  lesions(pen) {
    pen.strokeStyle = 'rgb(242 184 75 / .8)';
    pen.lineWidth = 5;
    for (const lesion of this.draft.lesions) {
      const branch = this.draft.branches.find((b) => b.name === lesion.branch);
      if (branch) this.stretch(pen, this.draft.vessels[branch.vessel], branch.from_mm + lesion.from_mm, branch.from_mm + lesion.from_mm + lesion.length_mm);
    }
  }
  label(pen, branch) {
    const vessel = this.draft.vessels[branch.vessel], sphere = sphereAt(vessel, nearestSphere(vessel, (branch.from_mm + branch.to_mm) / 2));
    const [x, y] = this.camera.place(sphere.p);
    pen.font = '12px sans-serif';
    pen.fillStyle = 'rgb(240 220 215 / .9)';
    pen.fillText(branch.name, x + 5, y - 5);
  }
  entry(pen) {
    const { p, along } = this.draft.entry;
    const [x, y] = this.camera.place(p), [ax, ay] = this.camera.place(p.map((q, i) => q - 25 * along[i]));
    pen.strokeStyle = pen.fillStyle = '#4fd97f';
    pen.lineWidth = 2;
    pen.beginPath(); pen.moveTo(ax, ay); pen.lineTo(x, y); pen.stroke();
    pen.beginPath(); pen.arc(x, y, 4, 0, 7); pen.fill();
    pen.fillText('entry', ax + 5, ay + 4);
  }
  ring(pen, p, radius) {
    const [x, y] = this.camera.place(p);
    pen.beginPath(); pen.arc(x, y, Math.max(6, this.camera.scale * radius), 0, 7); pen.stroke();
  }
  selection(pen) {
    pen.strokeStyle = '#fff';
    pen.lineWidth = 1.6;
    if (this.wallPoint) {
      const [x, y] = this.camera.place(this.wallPoint);
      pen.beginPath(); pen.moveTo(x - 7, y); pen.lineTo(x + 7, y); pen.moveTo(x, y - 7); pen.lineTo(x, y + 7); pen.stroke();
    }
    if (!this.chosen) return;
    const vessel = this.draft.vessels[this.chosen.vessel], sphere = sphereAt(vessel, nearestSphere(vessel, this.chosen.mm));
    this.ring(pen, this.ghost ?? sphere.p, sphere.radius);
  }
}
