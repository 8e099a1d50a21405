// The operator's console: buttons, and the keys of the console's table while the picture has the focus.
const names = { ArrowLeft: 'Left', ArrowRight: 'Right', ArrowUp: 'Up', ArrowDown: 'Down', ' ': 'Space' };
// The browser's own: Tab and Escape leave the picture, Ctrl and a letter are its commands.
const skips = (key) => key.key === 'Tab' || key.key === 'Escape' || (key.ctrl && key.key.length === 1);

export function keyName(event) {
  if (event.key === 'Shift') return event.code === 'ShiftRight' ? 'Right Shift' : 'Left Shift';
  return names[event.key] ?? (event.key.length === 1 ? event.key.toUpperCase() : event.key);
}

function button(words, title, press) {
  const made = document.createElement('button');
  made.textContent = words;
  made.title = title;
  made.onclick = press;
  return made;
}

export class Console {
  constructor(panel, stage, socket, welcome) {
    this.panel = panel;
    this.socket = socket;
    this.rows = new Map(welcome.console.rows.map((row) => [row.do, row]));
    this.keys = welcome.console.keys;
    this.down = [];
    this.tableMoves = 0;
    this.build(welcome);
    this.listen(stage);
  }
  group(title) {
    const set = document.createElement('fieldset'), legend = document.createElement('legend');
    legend.textContent = title;
    set.append(legend);
    this.panel.append(set);
    return (...items) => {
      const row = document.createElement('div');
      row.className = 'row';
      row.append(...items);
      set.append(row);
    };
  }
  press(words, command, ...values) {
    return this.mark(button(words, this.rows.get(command).what, () => this.socket.order(command, ...values)), command);
  }
  // While it is held, by mouse or by key.
  hold(words, command, value = 1) {
    const made = button(words, this.rows.get(command).what + ', while held', null);
    const set = (to) => { made.classList.toggle('held', to !== 0); this.socket.order(command, to); };
    made.addEventListener('pointerdown', (e) => { made.setPointerCapture(e.pointerId); set(value); });
    for (const end of ['pointerup', 'pointercancel']) made.addEventListener(end, () => set(0));
    made.addEventListener('keydown', (e) => { if ((e.key === ' ' || e.key === 'Enter') && !e.repeat) set(value); });
    made.addEventListener('keyup', (e) => { if (e.key === ' ' || e.key === 'Enter') set(0); });
    made.addEventListener('blur', () => { if (made.classList.contains('held')) set(0); });
    return this.mark(made, command);
  }
  mark(made, command) {
    this.watched.push([made, this.rows.get(command)]);
    return made;
  }
  range(words, least, most, step, value, change) {
    const label = document.createElement('label'), input = document.createElement('input');
    Object.assign(input, { type: 'range', min: least, max: most, step, value });
    input.oninput = () => change(Number(input.value));
    label.append(words, input);
    return label;
  }
  build(welcome) {
    this.panel.replaceChildren();
    this.watched = [];
    let add = this.group('Pedals');
    add(this.hold('Fluoroscopy', 'fluoroscopy'), this.hold('Cine', 'cine'), this.press('Reference', 'reference'));
    add = this.group('C-arm and table');
    add(...welcome.views.map((view, i) => { const b = this.press(view.name, 'view', i + 1); b.title = view.angles; return b; }).slice(0, 8));
    add(this.press('LAO', 'turn_arm', 5, 0), this.press('RAO', 'turn_arm', -5, 0), this.press('CRA', 'turn_arm', 0, 5),
      this.press('CAU', 'turn_arm', 0, -5));
    add(this.press('Table ◂', 'move_table', 10, 0, 0), this.press('▸', 'move_table', -10, 0, 0), this.press('▴', 'move_table', 0, 10, 0),
      this.press('▾', 'move_table', 0, -10, 0), this.press('Zoom', 'next_field'));
    add = this.group('Picture');
    this.rates = [3.75, 7.5, 15, 30].map((rate) => this.press(`${rate}/s`, 'frame_rate', rate));
    add(...this.rates);
    this.roadmap = button('Roadmap', this.rows.get('roadmap').what, () => this.socket.order('roadmap', this.roadmap.getAttribute('aria-pressed') === 'true' ? 0 : 1));
    add(this.roadmap, this.press('Review cine', 'review', 1), this.press('◂', 'review_step', -1), this.press('▸', 'review_step', 1), this.press('Live', 'review', 0));
    const shutter = { side: 0.5, head: 0.5 }, sends = () => this.socket.order('shutters', shutter.side, shutter.side, shutter.head, shutter.head);
    add(this.range('Shutters, sides', 0.05, 0.5, 0.01, 0.5, (v) => { shutter.side = v; sends(); }),
      this.range('top, bottom', 0.05, 0.5, 0.01, 0.5, (v) => { shutter.head = v; sends(); }));
    const look = { level: 0.5, width: 1 };
    add(this.range('Gamma', 0.3, 3, 0.05, 1, (v) => this.socket.order('gamma', v)),
      this.range('Level', 0.05, 0.95, 0.01, 0.5, (v) => { look.level = v; this.socket.order('window', look.level, look.width); }),
      this.range('Width', 0.1, 1, 0.01, 1, (v) => { look.width = v; this.socket.order('window', look.level, look.width); }));
    if (welcome.has_patient) {
      add = this.group('Drugs');
      add(this.press('Heparin 5000 U', 'heparin', 5000), this.press('Nitrate 200 µg', 'nitrate', 200), this.press('Adenosine 100 µg', 'adenosine', 100));
      add = this.group('Syringe and indeflator');
      add(this.hold('Contrast', 'contrast'), this.hold('Saline', 'saline'), this.hold('Draw back', 'aspirate'), this.hold('Vacuum', 'vacuum'));
      add(this.press('−1 atm', 'change_gauge', -1), this.press('+1 atm', 'change_gauge', 1), this.press('Release', 'gauge', 0));
      this.second = document.createElement('span');
      this.second.append('second balloon ', this.press('−1 atm', 'change_second_gauge', -1), this.press('+1 atm', 'change_second_gauge', 1), this.press('Release', 'second_gauge', 0));
      add(this.second);
    }
    add = this.group('Hands');
    add(this.hold('Guide in', 'guide_feed', 1), this.hold('out', 'guide_feed', -1), this.hold('⟳', 'guide_turn', 1), this.hold('⟲', 'guide_turn', -1));
    this.right = document.createElement('span');
    add(this.hold('Tool in', 'device_feed', 1), this.hold('out', 'device_feed', -1), this.hold('⟳', 'device_turn', 1), this.hold('⟲', 'device_turn', -1),
      this.press('Next tool', 'next_device'), this.right);
  }
  listen(stage) {
    const find = (event) => {
      const name = keyName(event);
      return this.keys.find((key) => key.key === name && !skips(key) && (this.rows.get(key.do).held || key.ctrl === event.ctrlKey));
    };
    const level = (command) => this.socket.order(command, this.down.findLast((key) => key.do === command)?.values[0] ?? 0);
    stage.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') return stage.blur();
      const key = find(event);
      if (!key || event.metaKey || event.altKey) return;
      event.preventDefault();
      // A table is far to move by taps: held, its key moves it ten times a second.
      if (event.repeat && (key.do !== 'move_table' || event.timeStamp < this.tableMoves)) return;
      if (key.do === 'move_table') this.tableMoves = event.timeStamp + 100;
      if (!this.rows.get(key.do).held) return this.socket.order(key.do, ...key.values);
      this.down.push(key);
      level(key.do);
    });
    stage.addEventListener('keyup', (event) => {
      const key = find(event);
      if (!key || !this.rows.get(key.do).held) return;
      this.down = this.down.filter((other) => other !== key);
      level(key.do);
    });
    stage.addEventListener('blur', () => {
      const commands = new Set(this.down.map((key) => key.do));
      this.down = [];
      commands.forEach(level);
    });
    stage.addEventListener('pointerdown', () => stage.focus());
    stage.addEventListener('wheel', (event) => { event.preventDefault(); if (Math.abs(event.deltaY) > 20) this.socket.order('next_field'); }, { passive: false });
    // Dragged with the middle button, the table follows the picture.
    stage.addEventListener('pointermove', (event) => {
      if (!(event.buttons & 4)) return;
      const mm = (this.field ?? 200) / stage.clientWidth * 0.7;
      this.socket.order('move_table', -mm * event.movementX, mm * event.movementY, 0);
    });
  }
  show(now, welcome) {
    const viewer = welcome.role !== 'trainer';
    for (const [made, row] of this.watched) made.disabled = viewer || (row.needs === 'hands' && now.hands === 'script');
    this.roadmap.disabled = viewer;
    this.roadmap.setAttribute('aria-pressed', now.picture.roadmap);
    this.rates.forEach((made, i) => made.classList.toggle('on', now.picture.rate === [3.75, 7.5, 15, 30][i]));
    if (this.second) this.second.hidden = !(now.patient?.second_balloon_mm > 0);
    this.right.textContent = now.right_hand >= 0 ? `right hand: ${welcome.tools[now.right_hand].name}` : '';
    this.field = now.arm.field_mm;
  }
  // `hands`: whether there is a script to take over from.
  help(table, hands) {
    table.replaceChildren();
    for (const row of this.rows.values()) {
      if (!hands && ['take_over', 'hand_back'].includes(row.do)) continue;
      const keys = this.keys.filter((key) => key.do === row.do && !skips(key)).map((key) => (key.ctrl ? 'Ctrl+' : '') + key.key);
      if (!keys.length) continue;
      const line = table.insertRow();
      line.insertCell().textContent = keys.join('  ');
      line.insertCell().textContent = row.what;
    }
  }
}
