// Lesions as forms: each change is sent as it is made, and refused where it cannot be.
const numbers = [ // key, words, step, what is there without it
  ['from_mm', 'from, mm', 0.5], ['length_mm', 'length, mm', 0.5], ['stenosis_percent', 'stenosis, %', 1],
  ['side_deg', 'side, ° (0: heart)', 5], ['calcium_arc_deg', 'calcium, °', 5], ['calcium_thickness_mm', 'calcium thick, mm', 0.1],
  ['calcium_length_mm', 'calcium long, mm', 0.5], ['hardness', 'hardness', 0.1]];
const needed = new Set(['from_mm', 'length_mm', 'stenosis_percent']);

function made(tag, words, ...children) {
  const element = document.createElement(tag);
  if (words) element.textContent = words;
  element.append(...children);
  return element;
}

function field(words, input) {
  return made('label', words + ' ', input);
}

function choice(values, value) {
  const select = made('select', '', ...values.map((one) => made('option', one)));
  select.value = value;
  return select;
}

export class Lesions {
  constructor(panel, socket, show) {
    this.panel = panel;
    this.socket = socket;
    this.show = show; // a lesion's place
    this.edits = false;
  }
  take(draft) {
    const focus = this.panel.contains(document.activeElement) ? document.activeElement.dataset.is : null;
    this.draft = draft;
    const names = draft.branches.map((b) => b.name), lesions = draft.case.lesions;
    this.panel.replaceChildren(...(lesions.length ? [] : [made('p', 'No lesion. Choose a place on a vessel, then "Lesion here".')]),
      ...lesions.map((lesion, i) => this.form(lesion, i, names)));
    if (focus) this.panel.querySelector(`[data-is="${focus}"]`)?.focus();
  }
  form(lesion, i, names) {
    const set = (change) => {
      const next = { ...lesion, ...change };
      for (const key of Object.keys(next)) if (next[key] === undefined) delete next[key];
      if (next.shape !== 'eccentric') delete next.side_deg;
      this.socket.send({ do: 'lesion_change', lesion_number: i, lesion: next });
    };
    const wire = (input, key, read) => {
      input.dataset.is = `${i}-${key}`;
      input.disabled = !this.edits || (key === 'side_deg' && lesion.shape !== 'eccentric');
      input.onchange = () => set({ [key]: read(input) });
      return input;
    };
    const grid = made('div');
    grid.className = 'grid';
    grid.append(field('branch', wire(choice(names, lesion.branch), 'branch', (one) => one.value)));
    for (const [key, words, step] of numbers) {
      const input = document.createElement('input');
      input.type = 'number';
      input.step = step;
      input.value = lesion[key] ?? '';
      if (!needed.has(key)) input.placeholder = key === 'side_deg' && lesion.shape !== 'eccentric' ? '–' : 'usual';
      grid.append(field(key === 'from_mm' && lesion.at_branch ? `from ${lesion.at_branch}, mm` : words,
        wire(input, key, (one) => (one.value === '' ? (needed.has(key) ? lesion[key] : undefined) : one.valueAsNumber))));
    }
    grid.append(field('shape', wire(choice(['concentric', 'eccentric'], lesion.shape), 'shape', (one) => one.value)),
      field('calcified', wire(choice(['false', 'true'], String(lesion.calcified)), 'calcified', (one) => one.value === 'true')));
    const go = made('button', 'Show'), gone = made('button', 'Remove');
    go.onclick = () => this.show(this.draft.lesions[i]);
    gone.onclick = () => this.socket.send({ do: 'lesion_remove', lesion_number: i });
    gone.disabled = !this.edits;
    go.setAttribute('aria-label', `Show lesion ${i + 1}`), gone.setAttribute('aria-label', `Remove lesion ${i + 1}`);
    const row = made('div', '', go, gone);
    row.className = 'row';
    return made('fieldset', '', made('legend', `${i + 1}. ${lesion.branch}, ${lesion.stenosis_percent} %`), grid, row);
  }
}
