// What a trainer provokes, and what answers it: drugs, fluid, drain, shock.
const kinds = [
  { id: 1, name: 'Perforation', size: 'hole, mm', least: 0.1, most: 3, step: 0.1, value: 0.8 },
  { id: 2, name: 'Dissection', size: 'grade', options: ['A', 'B', 'C', 'D', 'E', 'F'], value: 2 },
  { id: 3, name: 'Spasm', size: 'share of the diameter', least: 0, most: 0.98, step: 0.01, value: 0.9 },
  { id: 4, name: 'No-reflow', size: 'share of the flow', least: 0, most: 0.98, step: 0.01, value: 0.9 },
  { id: 5, name: 'Fibrillation' },
  { id: 6, name: 'AV block' },
];

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
    if (welcome.role === 'trainer') this.provoke(console_.group('Provoke'), welcome);
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
    const running = (words, command, rate) => button(words, this.rows.get(command).what, () =>
      this.socket.order(command, this[command].getAttribute('aria-pressed') === 'true' ? 0 : rate));
    this.infuse = running('Fluid 100 mL/min', 'infuse', 100);
    this.drain = running('Drain 100 mL/min', 'drain', 100);
    this.shock = button('Shock 200 J', this.rows.get('shock').what, () => this.socket.order('shock', 200));
    add(this.infuse, this.drain, this.shock);
  }
  provoke(add, welcome) {
    const lesion = this.has.lesions[0];
    const kind = select(kinds.map((one) => one.name)), artery = select(this.has.arteries.map((one) => one.name));
    const place = field(0, 100, 1, 0), number = field(0, 1, 0.1, 0), grade = select(kinds[1].options);
    const where = [labelled('Artery', artery, 'provoke-artery'), labelled('mm from its beginning', place, 'provoke-place')];
    const sizes = [labelled('', number, 'provoke-size'), labelled(kinds[1].size, grade, 'provoke-grade')];
    const chosen = () => kinds[kind.value];
    const show = () => {
      const one = chosen(), at = this.has.arteries[artery.value];
      where.forEach((label) => { label.hidden = one.id > 4; });
      sizes[0].hidden = one.least === undefined;
      sizes[1].hidden = !one.options;
      if (one.least !== undefined) sizes[0].firstChild.textContent = one.size;
      Object.assign(place, { min: Math.ceil(at.from_mm), max: Math.floor(at.to_mm) });
      this.mark(one.id > 4 ? null : { tree_branch: at.tree_branch, mm: Number(place.value) });
    };
    kind.onchange = () => { const one = chosen(); if (one.least !== undefined) Object.assign(number, { min: one.least, max: one.most, step: one.step, value: one.value }); show(); };
    artery.onchange = () => { place.value = Math.round((this.has.arteries[artery.value].from_mm + this.has.arteries[artery.value].to_mm) / 2); show(); };
    place.oninput = show;
    if (lesion) artery.value = lesion.artery, place.value = Math.round(lesion.mm);
    grade.value = kinds[1].value;
    const go = button('Provoke', this.rows.get('provoke').what, () => {
      const one = chosen();
      const size = one.options ? Number(grade.value) : one.least !== undefined ? Number(number.value) : 0;
      this.socket.order('provoke', one.id, Number(artery.value), Number(place.value), size);
    });
    add(labelled('What', kind, 'provoke-what'), ...where);
    add(...sizes, go);
    this.provokes = [kind, artery, place, number, grade, go];
    kind.onchange();
  }
  show(now, welcome) {
    if (!this.has) return;
    const viewer = welcome.role !== 'trainer';
    for (const one of [...this.dose, this.infuse, this.drain, this.shock]) one.disabled = viewer;
    this.infuse.setAttribute('aria-pressed', now.patient.infusion_mL_min > 0);
    this.drain.setAttribute('aria-pressed', now.patient.drain_mL_min > 0);
  }
}
