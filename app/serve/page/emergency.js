// What a trainer provokes, and what answers it: drugs, fluid, drain, shock, compressions, pacemaker.
const grades = ['A', 'B', 'C', 'D', 'E', 'F']; // of a dissection

function labelled(words, input, id) {
  const label = document.createElement('label');
  input.id = id;
  label.append(words, input);
  return label;
}

function select(options) {
  const made = document.createElement('select');
  options.forEach((words, i) => made.append(new Option(words, i)));
  return made;
}

function field(least, most, step, value) {
  return Object.assign(document.createElement('input'), { type: 'number', min: least, max: most, step, value });
}

function button(words, title, press) {
  return Object.assign(document.createElement('button'), { textContent: words, title, onclick: press });
}

export class Emergency {
  // `mark(place)`: shows a place on the vessels, null: none.
  constructor(console_, socket, welcome, mark) {
    this.socket = socket;
    this.rows = console_.rows;
    this.has = welcome.emergency;
    this.mark = mark;
    if (!this.has) return;
    this.treat(console_.group('Emergency'));
    if (welcome.role === 'trainer' && !welcome.lesson.title) this.provoke(console_.group('Provoke'));
  }
  treat(add) {
    const drug = select(this.has.drugs.map((one) => one.name)), dose = field(0, 0, 'any', 0), unit = document.createElement('span');
    const choose = () => {
      const one = this.has.drugs[drug.value];
      Object.assign(dose, { min: one.least, max: one.most, value: one.least });
      unit.textContent = one.unit === 'ug' ? 'µg' : one.unit;
      drug.title = `${one.title}: ${one.least} to ${one.most} ${unit.textContent}`;
    };
    drug.onchange = choose;
    choose();
    this.dose = [drug, dose, button('Give', this.rows.get('give').what, () => this.socket.order('give', Number(drug.value), Number(dose.value)))];
    add(labelled('Drug', drug, 'drug'), labelled('Dose', dose, 'dose'), unit, this.dose[2]);
    const running = (words, command, on, off = [0]) => button(words, this.rows.get(command).what, () =>
      this.socket.order(command, ...(this[command].getAttribute('aria-pressed') === 'true' ? off : on)));
    this.infuse = running('Fluid 100 mL/min', 'infuse', [100]);
    this.drain = running('Drain 100 mL/min', 'drain', [100]);
    this.shock = button('Shock 200 J', this.rows.get('shock').what, () => this.socket.order('shock', 200));
    this.compress = running('Compress 110/min', 'compress', [110]);
    this.pace = running('Pace 80/min, 3 mA', 'pace', [80, 3], [80, 0]);
    add(this.infuse, this.drain, this.shock, this.compress, this.pace);
    this.breath = [['Breathe in, hold', 1], ['Breathe out, hold', 2], ['Breathe', 0]].map(([words, asked]) =>
      button(words, this.rows.get('breath').what, () => this.socket.order('breath', asked)));
    if (this.has.breathes) add(...this.breath);
  }
  provoke(add) {
    const lesion = this.has.lesions[0];
    const kinds = this.has.provocables;
    const kind = select(kinds.map((one) => one.name)), artery = select(this.has.arteries.map((one) => one.name));
    const place = field(0, 100, 1, 0), number = field(0, 1, 'any', 0), grade = select(grades);
    const where = [labelled('Artery', artery, 'provoke-artery'), labelled('mm from its beginning', place, 'provoke-place')];
    const sizes = [labelled('', number, 'provoke-size'), labelled('grade', grade, 'provoke-grade')];
    const chosen = () => kinds[kind.value];
    const show = () => {
      const one = chosen(), at = this.has.arteries[artery.value];
      where.forEach((label) => { label.hidden = !one.has_place; });
      sizes[0].hidden = !one.size || one.size === 'grade';
      sizes[1].hidden = one.size !== 'grade';
      sizes[0].firstChild.textContent = one.size ?? '';
      Object.assign(place, { min: Math.ceil(at.from_mm), max: Math.floor(at.to_mm) });
      this.mark(one.has_place ? { tree_branch: at.tree_branch, mm: Number(place.value) } : null);
    };
    kind.onchange = () => {
      const one = chosen();
      Object.assign(number, { min: one.least, max: one.most, value: one.usual });
      grade.value = one.usual;
      show();
    };
    artery.onchange = () => { place.value = Math.round((this.has.arteries[artery.value].from_mm + this.has.arteries[artery.value].to_mm) / 2); show(); };
    place.oninput = show;
    if (lesion) artery.value = lesion.artery, place.value = Math.round(lesion.mm);
    const go = button('Provoke', this.rows.get('provoke').what, () => {
      const one = chosen(), size = one.size === 'grade' ? grade.value : one.size ? number.value : 0;
      this.socket.order('provoke', one.what, Number(artery.value), Number(place.value), Number(size));
    });
    add(labelled('What', kind, 'provoke-what'), ...where);
    add(...sizes, go);
    kind.onchange();
  }
  show(now, welcome) {
    if (!this.has) return;
    const viewer = welcome.role !== 'trainer';
    for (const one of [...this.dose, this.infuse, this.drain, this.shock, this.compress, this.pace, ...this.breath]) one.disabled = viewer;
    this.infuse.setAttribute('aria-pressed', now.patient.infusion_mL_min > 0);
    this.drain.setAttribute('aria-pressed', now.patient.drain_mL_min > 0);
    this.compress.setAttribute('aria-pressed', now.patient.compressions_1_min > 0);
    this.pace.setAttribute('aria-pressed', now.patient.pacing_mA > 0);
  }
}
