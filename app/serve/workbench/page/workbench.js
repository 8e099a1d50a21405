import { Body, lengthOf, nearestSphere, sphereAt } from '/body.js';
import { Lesions } from '/lesions.js';
import { Socket } from '/socket.js';

const $ = (id) => document.getElementById(id);
const token = new URLSearchParams(location.hash.slice(1)).get('token') ?? sessionStorage.getItem('token') ?? '';
sessionStorage.setItem('token', token);
history.replaceState(null, '', '/'); // not for shoulders, nor for the history

let draft = null, edits = false, busy = '', closed = false, refusedUntil = 0;
const body = new Body($('wall'), $('courses'), {
  chosen: (vessel, mm) => choose(vessel, mm),
  wallChosen: (p) => chooseWall(p),
  moved: (vessel, sphere, p) => order('move', { vessel, sphere, p_mm: p, reach_mm: $('reach').valueAsNumber || 0 }),
  turned: () => showAngles(),
});

function order(what, more = {}) { socket.send({ do: what, ...more }); }

function made(tag, words, ...children) {
  const element = document.createElement(tag);
  if (words) element.textContent = words;
  element.append(...children);
  return element;
}

function refuse(why) {
  $('refused').textContent = why.replace(/^message:\d+: /, '');
  refusedUntil = performance.now() + 12000;
}
setInterval(() => { if (performance.now() > refusedUntil) $('refused').textContent = ''; }, 500);

// --- Tabs
const tabs = ['vessels', 'lesions', 'case', 'checks'];
function openTab(name) {
  for (const tab of tabs) {
    $(`tab-${tab}`).setAttribute('aria-selected', tab === name);
    $(`tab-${tab}`).tabIndex = tab === name ? 0 : -1;
    $(`${tab}-panel`).hidden = tab !== name;
  }
}
tabs.forEach((tab, i) => {
  $(`tab-${tab}`).onclick = () => openTab(tab);
  $(`tab-${tab}`).onkeydown = (e) => {
    const to = { ArrowLeft: i - 1, ArrowRight: i + 1 }[e.key];
    if (to === undefined || !tabs[to]) return;
    openTab(tabs[to]);
    $(`tab-${tabs[to]}`).focus();
  };
});

// --- The chosen place
function choose(vessel, mm, look = false) {
  body.chosen = { vessel, mm };
  body.wallPoint = null;
  fillSide(vessel);
  if (look) body.centre(sphereAt(draft.vessels[vessel], nearestSphere(draft.vessels[vessel], mm)).p, 5);
  showChosen();
  body.draw();
}

// Contrast goes where the chosen vessel is.
function fillSide(vessel) {
  for (let v = vessel; v >= 0; v = draft.vessels[v].parent) {
    const names = draft.branches.filter((b) => b.vessel === v).map((b) => b.name);
    if (names.includes('RCA')) $('fill').value = 'right';
    else if (['LM', 'LAD', 'LCx'].some((name) => names.includes(name))) $('fill').value = 'left';
    else continue;
    return;
  }
}

function chooseWall(p) {
  body.chosen = null;
  body.wallPoint = p;
  showChosen();
  body.draw();
}

const chosenBranch = () => body.chosen && body.branchAt(body.chosen.vessel, body.chosen.mm);

function showChosen() {
  $('on-vessel').hidden = !body.chosen;
  $('on-wall').hidden = !body.wallPoint || !draft.imported;
  for (const row of $('branches').children) row.setAttribute('aria-selected', chosenBranch()?.name === row.dataset.name);
  if (body.wallPoint) $('chosen-words').textContent = `Wall at ${body.wallPoint.map((x) => x.toFixed(1)).join(', ')} mm`;
  if (!body.chosen) {
    if (!body.wallPoint) $('chosen-words').textContent = 'Click a vessel, or choose one above.';
    return;
  }
  const { vessel, mm } = body.chosen, branch = chosenBranch(), from = branch?.from_mm ?? 0;
  const sphere = sphereAt(draft.vessels[vessel], nearestSphere(draft.vessels[vessel], mm));
  $('chosen-words').textContent = `${branch?.name ?? 'vessel'}: ${(2 * sphere.radius).toFixed(2)} mm wide there`;
  $('at').value = (mm - from).toFixed(1);
  $('at').max = ((branch?.to_mm ?? lengthOf(draft.vessels[vessel])) - from).toFixed(1);
  $('name').value = branch?.name ?? '';
  ['x', 'y', 'z'].forEach((axis, i) => { $(axis).value = sphere.p[i].toFixed(2); });
  $('parent').replaceChildren(...draft.vessels.map((_, v) => [v, draft.branches.find((b) => b.vessel === v)?.name])
    .filter(([v, name]) => name && v !== vessel).map(([v, name]) => {
      const option = made('option', name);
      option.value = v;
      return option;
    }));
  if (draft.vessels[vessel].parent >= 0) $('parent').value = draft.vessels[vessel].parent;
}

$('at').onchange = () => {
  const branch = chosenBranch();
  if (branch && Number.isFinite($('at').valueAsNumber))
    choose(body.chosen.vessel, Math.max(branch.from_mm, Math.min(branch.to_mm, branch.from_mm + $('at').valueAsNumber)));
};
const chosenMm = () => body.chosen.mm - (chosenBranch()?.from_mm ?? 0);
const chosenPoint = () => sphereAt(draft.vessels[body.chosen.vessel], nearestSphere(draft.vessels[body.chosen.vessel], body.chosen.mm)).p;
$('lesion-here').onclick = () => {
  const length = 10, branch = chosenBranch();
  const from = Math.max(0, Math.min(chosenMm() - length / 2, branch.to_mm - branch.from_mm - length));
  order('lesion_add', { lesion: { branch: branch.name, from_mm: Math.round(10 * from) / 10, length_mm: length, stenosis_percent: 70, shape: 'concentric', calcified: false } });
  openTab('lesions');
};
$('entry-here').onclick = () => order('entry', { p_mm: chosenPoint() });
$('rename').onclick = () => order('rename', { branch: chosenBranch().name, name: $('name').value.trim() });
$('divide').onclick = () => order('split', { branch: chosenBranch().name, mm: chosenMm(), name: $('name').value.trim() });
$('move').onclick = () => order('move', { vessel: body.chosen.vessel, sphere: nearestSphere(draft.vessels[body.chosen.vessel], body.chosen.mm),
  p_mm: ['x', 'y', 'z'].map((axis) => $(axis).valueAsNumber), reach_mm: $('reach').valueAsNumber || 0 });
$('drag').onclick = () => {
  body.drags = !body.drags;
  $('drag').setAttribute('aria-pressed', body.drags);
  $('courses').classList.toggle('drags', body.drags);
};
$('centre').onclick = () => order('centre', { vessel: body.chosen.vessel, from_mm: 0, to_mm: lengthOf(draft.vessels[body.chosen.vessel]) });
$('end-here').onclick = () => order('end', { vessel: body.chosen.vessel, mm: body.chosen.mm });
$('remove').onclick = () => order('remove', { vessel: body.chosen.vessel });
$('join').onclick = () => order('join', { vessel: body.chosen.vessel, to: Number($('parent').value) });
$('add').onclick = () => order('add', { p_mm: body.wallPoint, name: $('new-name').value.trim() });

// --- Lists
function fillBranches() {
  $('branches').replaceChildren(...draft.branches.map((branch) => {
    const vessel = draft.vessels[branch.vessel], middle = (branch.from_mm + branch.to_mm) / 2;
    const row = made('div', '', made('b', branch.name), made('span', `${(branch.to_mm - branch.from_mm).toFixed(0)} mm`),
      made('span', `${(2 * sphereAt(vessel, nearestSphere(vessel, middle)).radius).toFixed(1)} mm wide`));
    row.dataset.name = branch.name;
    row.setAttribute('role', 'option');
    row.onclick = () => choose(branch.vessel, middle, true);
    return row;
  }));
}
$('branches').onkeydown = (e) => {
  const step = { ArrowDown: 1, ArrowUp: -1 }[e.key];
  if (!step) return;
  e.preventDefault();
  const at = draft.branches.findIndex((b) => b.name === chosenBranch()?.name), next = draft.branches[Math.max(0, Math.min(draft.branches.length - 1, at + step))];
  choose(next.vessel, (next.from_mm + next.to_mm) / 2, true);
  $('branches').querySelector('[aria-selected=true]')?.scrollIntoView({ block: 'nearest' });
};

function listed(list, none, entries) {
  list.replaceChildren(...(entries.length ? entries : [made('li', '', made('span', none))]));
}

function fillChecks() {
  const named = (v) => draft.branches.find((b) => b.vessel === v)?.name ?? `vessel ${v}`;
  listed($('faults'), draft.imported ? 'None: every sphere lies in the lumen and fills it.' : 'This case\'s vessels are made from their courses.', draft.faults.map((fault) => {
    const go = made('button', `${named(fault.vessel)}, ${fault.from_mm.toFixed(1)} to ${fault.to_mm.toFixed(1)} mm: ${fault.words}, by ${fault.worst_mm.toFixed(2)} mm`);
    go.onclick = () => choose(fault.vessel, fault.worst_at_mm, true);
    return made('li', '', go);
  }));
  listed($('mends'), 'Nothing.', draft.mends.map((mend) => {
    if (!mend.places.length) return made('li', '', made('span', mend.words));
    const go = made('button', mend.words);
    let at = 0;
    go.onclick = () => {
      const p = mend.places[at++ % mend.places.length];
      body.centre(p, 5);
      chooseWall(p);
    };
    return made('li', '', go);
  }));
  $('tab-checks').textContent = draft.faults.length ? `Checks (${draft.faults.length})` : 'Checks';
}

function fillViews() {
  listed($('views'), 'None yet: turn the picture, give it a name, and keep it.', (draft.case.views ?? []).map((view, i) => {
    const go = made('button', `${view.name}: ${angles(view.lao_deg, view.cran_deg)}`), gone = made('button', 'Remove');
    go.onclick = () => body.look(view.lao_deg, view.cran_deg);
    gone.disabled = !edits;
    gone.onclick = () => order('set', { key: 'views', value: draft.case.views.filter((_, k) => k !== i) });
    return made('li', '', go, gone);
  }));
}

function fillCase() {
  $('drawn').hidden = draft.imported;
  for (const input of document.querySelectorAll('[data-key]')) {
    const value = input.dataset.key.split('.').reduce((at, key) => at?.[key], draft.case);
    if (input !== document.activeElement) input.value = value ?? '';
    input.disabled = !edits;
    input.onchange = () => order('set', { key: input.dataset.key, value: input.type === 'number' ? input.valueAsNumber : input.value });
  }
}

// --- The C-arm
const angles = (lao, cran) => `${lao < 0 ? 'RAO' : 'LAO'} ${Math.abs(Math.round(lao))} ${cran < 0 ? 'CAU' : 'CRA'} ${Math.abs(Math.round(cran))}`;
function showAngles() {
  if (document.activeElement !== $('lao')) $('lao').value = Math.round(body.camera.lao);
  if (document.activeElement !== $('cran')) $('cran').value = Math.round(body.camera.cran);
}
$('lao').onchange = $('cran').onchange = () => body.look($('lao').valueAsNumber || 0, $('cran').valueAsNumber || 0);
$('xray-here').onclick = () => order('xray', { lao_deg: Math.round(body.camera.lao), cran_deg: Math.round(body.camera.cran), fill: $('fill').value });
$('xray-away').onclick = () => { $('xray').hidden = true; };
$('keep-view').onclick = () => order('set', { key: 'views', value: [...(draft.case.views ?? []),
  { name: $('view-name').value.trim(), lao_deg: Math.round(body.camera.lao), cran_deg: Math.round(body.camera.cran) }] });
$('show-spheres').onchange = () => { body.spheres = $('show-spheres').checked; body.draw(); };
$('show-names').onchange = () => { body.names = $('show-names').checked; body.draw(); };

async function takeXray(bytes) {
  const view = new DataView(bytes), picture = await createImageBitmap(new Blob([bytes.slice(16)], { type: 'image/jpeg' }));
  const canvas = $('xray').querySelector('canvas');
  canvas.width = picture.width, canvas.height = picture.height;
  canvas.getContext('2d').drawImage(picture, 0, 0);
  $('xray').querySelector('figcaption').textContent = angles(view.getFloat32(8, true), view.getFloat32(12, true));
  $('xray').hidden = false;
}

// --- Files
$('undo').onclick = () => order('undo');
$('redo').onclick = () => order('redo');
$('save').onclick = () => order('save');
$('try').onclick = () => order('try');
$('save-as').onclick = () => {
  const [yes, no] = $('ask-name').querySelectorAll('button');
  yes.onclick = () => {
    if (!$('save-name').value.trim()) return;
    $('ask-name').close();
    order('save_as', { name: $('save-name').value.trim() });
  };
  $('save-name').onkeydown = (e) => { if (e.key === 'Enter') yes.click(); };
  no.onclick = () => $('ask-name').close();
  $('save-name').value = '';
  $('ask-name').showModal();
};
$('close').onclick = () => {
  if (!draft.changed) return order('close');
  const [yes, no] = $('ask-close').querySelectorAll('button');
  yes.onclick = () => { $('ask-close').close(); order('close', { unsaved: true }); };
  no.onclick = () => $('ask-close').close();
  $('ask-close').showModal();
};
document.addEventListener('keydown', (e) => {
  if (!(e.ctrlKey || e.metaKey) || e.target.matches('input, textarea')) return;
  const what = { z: e.shiftKey ? 'redo' : 'undo', y: 'redo', s: 'save' }[e.key.toLowerCase()];
  if (what) { e.preventDefault(); order(what); }
});

function showState() {
  $('state').textContent = busy || (draft?.changed ? 'not saved' : 'saved');
  $('state').classList.toggle('loud', Boolean(busy || draft?.changed));
}

const trackers = {
  role(message) {
    edits = message.role === 'editor';
    lesions.edits = edits;
    $('who').textContent = edits ? 'Editor' : 'Viewer';
    for (const button of document.querySelectorAll('header button, #chosen button, #keep-view, #xray-here')) button.disabled = !edits;
  },
  draft(message) {
    draft = message;
    document.title = `Ostium: ${message.case.title}`;
    $('title').textContent = message.case.title;
    $('title').title = message.file;
    for (const only of document.querySelectorAll('.imported')) only.hidden = !message.imported;
    body.take(message);
    fillBranches();
    fillChecks();
    fillViews();
    fillCase();
    lesions.take(message);
    showChosen();
    showAngles();
    for (const way of ['undo', 'redo']) {
      $(way).disabled = !edits || !message[way];
      $(way).title = message[way];
    }
    $('save').disabled = !edits || !message.changed;
    busy = '';
    showState();
  },
  busy(message) { busy = message.words; showState(); },
  idle() { busy = ''; showState(); },
  refused(message) { busy = ''; showState(); refuse(message.why); },
  session(message) {
    busy = '';
    showState();
    const link = made('a', 'Open the session');
    link.href = message.link;
    link.target = '_blank';
    $('refused').replaceChildren('A session on the case as it is now: ', link);
    refusedUntil = performance.now() + 600000;
    link.focus();
  },
  closed() { closed = true; gone('The workbench is closed.'); },
};

function gone(words) {
  $('gone').textContent = words;
  $('gone').hidden = false;
}

const socket = new Socket(token, {
  text: (message) => { $('gone').hidden = true; trackers[message.type]?.(message); },
  bytes: (bytes) => {
    const kind = new DataView(bytes).getUint8(0);
    if (kind === 4) { body.wall.take(bytes); $('no-wall').hidden = true; body.draw(); }
    if (kind === 5) takeXray(bytes);
  },
  gone: () => gone(closed ? 'The workbench is closed.' : 'The workbench is not there; trying again …'),
});
const lesions = new Lesions($('lesions-panel'), socket, (place) => {
  const branch = draft.branches.find((b) => b.name === place.branch);
  if (branch) choose(branch.vessel, branch.from_mm + place.from_mm + place.length_mm / 2, true);
});
