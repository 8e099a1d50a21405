import { Console } from '/console.js';
import { Course } from '/course.js';
import { Emergency } from '/emergency.js';
import { Lesson } from '/lesson.js';
import { Picture } from '/picture.js';
import { Scores } from '/scores.js';
import { Socket } from '/socket.js';
import { Sound } from '/sound.js';
import { drawStrip } from '/strips.js';
import { Timeline, clock } from '/timeline.js';
import { Truth, toolColours } from '/truth.js';
import { fillGlossary } from '/words.js';

const $ = (id) => document.getElementById(id);
const token = new URLSearchParams(location.hash.slice(1)).get('token') ?? sessionStorage.getItem('token') ?? '';
sessionStorage.setItem('token', token);
history.replaceState(null, '', '/'); // not for shoulders, nor for the history

let welcome = null, now = null, console_ = null, emergency = null, ended = null, closed = false, refusedUntil = 0;
let goesTo = null; // the second that the run is going back to, for some seconds
let backAt = null; // the second it has gone back to, until the first numbers from there
let pace = []; // [wall s, simulated s] of the last seconds
const truth = new Truth($('truth'));
const sound = new Sound($('sound'), () => $('stage').focus());
const picture = new Picture($('picture'), () => { $('empty').hidden = true; });
const reference = new Picture($('reference'), () => { $('reference').hidden = false; });

function ask(words, yes) {
  const dialog = $('ask');
  dialog.querySelector('p').textContent = words;
  const [a, b] = dialog.querySelectorAll('button');
  a.onclick = () => { dialog.close(); yes(); };
  b.onclick = () => dialog.close();
  dialog.showModal();
}

const timeline = new Timeline($('events'), $('bar'), (second) =>
  ask(`Go back to ${clock(second)} and go on from there? What came later stays recorded.`, () => {
    goesTo = second;
    socket.order('rewind', second);
    show();
  }));

function noPicture() {
  $('picture').width = $('picture').width; // empty
  $('empty').hidden = false;
}

// Pictures come by a way of their own: one of a time that is given up may come late.
const isOfNow = (data) => backAt === null && !(now && new DataView(data).getFloat64(8, true) > now.s + 0.5);

function refuse(why) {
  goesTo = null;
  $('refused').textContent = why.replace(/^message:\d+: /, '');
  refusedUntil = performance.now() + 5000;
}
setInterval(() => { if (performance.now() > refusedUntil) $('refused').textContent = ''; }, 500);

const trackers = {
  welcome(message) {
    welcome = message;
    $('gone').hidden = true;
    const viewer = message.role !== 'trainer';
    for (const id of ['pause', 'hands', 'end', 'note']) $(id).disabled = viewer;
    $('marks').querySelector('button').disabled = viewer;
    $('copy-link').hidden = viewer;
    document.title = `Ostium: ${message.lesson.title || message.case}`;
    $('title').textContent = message.lesson.title || message.title;
    $('who').textContent = viewer ? 'Viewer' : course.board ? 'Learner' : 'Trainer';
    document.body.classList.toggle('exam', message.lesson.exam);
    lesson.welcome(message);
    showList(false);
    truth.tree = message.tree;
    timeline.clear();
    timeline.enabled = !viewer && message.goes_back;
    $('bar').title = timeline.enabled ? 'Click to go back to that second, and go on from there' : '';
    truth.spheres = truth.middle = truth.mark = null;
    now = null, ended = null, closed = false, pace = [], goesTo = backAt = null;
    $('reference').hidden = true;
    noPicture();
    if (console_) console_.build(message);
    else console_ = new Console($('console-panel'), $('stage'), socket, message);
    emergency = new Emergency(console_, socket, message, (place) => { truth.mark = place; truth.draw(); });
    choose('events');
    $('stage').focus();
    $('tools').tBodies[0].replaceChildren(...message.tools.map((tool, t) => {
      const row = document.createElement('tr');
      for (let i = 0; i < 6; ++i) row.append(document.createElement('td'));
      row.cells[0].textContent = `■ ${tool.name}`;
      row.cells[0].title = tool.title;
      row.cells[0].style.color = toolColours[t % toolColours.length];
      return row;
    }));
    scores.show(welcome, null, null);
  },
  role(message) {
    course.learns = message.role === 'trainer';
    $('who').textContent = course.learns ? 'Learner' : 'Viewer';
  },
  course(message) {
    course.take(message);
    if (welcome && message.at !== null && !message.opening) return; // news of the lesson that is open
    welcome = null;
    if (message.at !== null) course.wait();
    $('gone').hidden = true;
    $('title').textContent = document.title = message.title;
    showList(true);
  },
  ticks(message) { lesson.ticks(message.at); },
  hint(message) { lesson.hint(message); },
  now(message) {
    now = message;
    if (now.s < backAt + 0.5) backAt = null;
    show();
  },
  events(message) { timeline.add(message.events); },
  branch(message) {
    timeline.goneBack(message.from_s);
    ended = goesTo = null;
    backAt = message.from_s;
    noPicture(); // the image held is of a time that is given up
    if (welcome.lesson.title) choose('events'), $('stage').focus(); // the instructions again, and the keys
  },
  scores(message) { if (welcome) scores.show(welcome, ended, message.items); },
  refused(message) { refuse(message.why); },
  ended(message) { ended = message; show(); choose('scores'); if (course.board) $('scores-panel').focus(); },
  reported() { $('report').hidden = false; },
  report(message) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([message.html], { type: 'text/html' }));
    link.download = 'report.html';
    link.click();
  },
};

const socket = new Socket(token, {
  text: (message) => trackers[message.type]?.(message),
  bytes: (data) => {
    const bytes = new Uint8Array(data);
    if (bytes[0] === 1) { if (isOfNow(data)) picture.take(bytes); }
    else if (bytes[0] === 2) reference.take(bytes);
    else if (bytes[0] === 3) truth.take(data);
  },
  gone: () => {
    $('gone').textContent = closed ? 'The session is closed.'
      : course.board ? 'The course is closed, or its program has ended. Nothing is lost: start ostium learn again, and open the new link.'
      : welcome ? 'The connection is gone; trying again …' : 'This link is not (or no longer) valid for this run. Trying again …';
    $('gone').hidden = false;
  },
});

const lesson = new Lesson($('lesson'), $('stage'), socket);
const course = new Course($('course'), socket);
const scores = new Scores($('scores-panel'), lesson, course);

// The list of lessons, or the run.
function showList(listed) {
  const panel = $('course');
  panel.hidden = !listed;
  for (const part of document.querySelectorAll('main, footer, #clock, #state, #help')) part.hidden = listed;
  $('to-lessons').hidden = listed || !course.board || !course.learns;
  if (listed) (panel.querySelector('button.on') ?? panel).focus();
}

const fixed = (value, digits) => value === null || value === undefined ? '–' : value.toFixed(digits);

// How much of a second passes in one; a machine that is too slow says so.
function speedNow() {
  const wall = performance.now() / 1000;
  if (now.paused || ended || now.s < pace.at(-1)?.[1]) pace = [];
  pace = [...pace.filter(([at]) => at > wall - 3), [wall, now.s]];
  return wall > pace[0][0] + 1 ? (now.s - pace[0][1]) / (wall - pace[0][0]) : 1;
}

function show() {
  if (!now || !welcome) return;
  const script = now.hands === 'script';
  $('clock').textContent = clock(now.s);
  const state = ended ? ended.outcome === 'ended' ? 'Ended' : `Ended: ${ended.outcome}` : now.paused ? 'Paused' : 'Running';
  const by = script ? 'the script has the instruments' : now.hands === 'box' ? 'hands at the box' : 'you have the instruments';
  const words = goesTo !== null ? `Going back to ${clock(goesTo)} …` : ended ? state : `${state}, ${by.replace('you', welcome.role === 'trainer' ? 'you' : 'the trainer')}`;
  if ($('state').textContent !== words) $('state').textContent = words;
  $('state').classList.toggle('loud', now.paused || !!ended || goesTo !== null);
  $('pause').textContent = now.paused ? 'Go on' : 'Pause';
  $('pause').disabled = !!ended || welcome.role !== 'trainer';
  $('end').textContent = ended ? course.board ? 'All lessons' : 'Close' : 'End run';
  $('hands').textContent = script ? 'Take over' : 'Hand back';
  $('hands').hidden = now.step < 0;
  const reviewing = now.picture.review_frames > 0;
  const beam = now.arm.fluoroscopy || now.arm.cine;
  $('beam').hidden = !beam || now.paused || reviewing;
  $('beam').lastChild.textContent = now.arm.cine ? ' Cine' : ' X-ray on';
  const waits = now.paused && !ended; // while it does, keys seem dead
  $('held').hidden = !$('beam').hidden || (!$('empty').hidden && !waits);
  $('held').textContent = reviewing ? `cine review ${now.picture.review_frame} of ${now.picture.review_frames}` : waits ? `paused${welcome.role === 'trainer' ? ': press Go on, or P' : ''}` : 'last image held';
  if (now.patient) {
    drawStrip($('ecg'), now.ecg_10uV, -60, 160, '#4fd97f');
    drawStrip($('pressure'), now.line_mmHg, 0, 180, '#ff7a6b');
    $('rate').textContent = now.patient.rate;
    $('mmhg').textContent = now.patient.high_mmHg === null ? '–' : `${now.patient.high_mmHg}/${now.patient.low_mmHg}`;
  }
  $('monitor').hidden = !now.patient;
  sound.show(now, !!ended);
  [...$('tools').tBodies[0].rows].forEach((row, t) => {
    const tool = now.tools[t], cells = row.cells;
    row.className = tool.in ? '' : 'out';
    cells[0].textContent = `■ ${welcome.tools[t].name}${t === now.right_hand && now.hands !== 'script' ? ' R' : ''}`;
    cells[1].textContent = tool.in ? fixed(tool.inserted_mm / 10, 1) : 'out';
    cells[2].textContent = tool.in ? `${Math.round(tool.turned_deg)}°` : '';
    cells[3].textContent = tool.in ? fixed(tool.push_N, 2) : '';
    cells[4].textContent = tool.in ? fixed(tool.wall_N, 2) : '';
    cells[5].textContent = tool.in ? fixed(tool.tip_N, 2) : '';
  });
  const p = now.s > 0 ? now.patient : null, x = now.xray; // before the first step nothing has been measured
  const arm = [['C-arm', now.arm.words], ['field', `${now.arm.field_mm / 10} cm`], ['fluoroscopy', clock(x.fluoroscopy_s)],
    ['cine', `${x.runs} in ${fixed(x.cine_s, 1)} s`], ['dose', `${fixed(x.dap_Gycm2, 2)} Gy cm²`]];
  const numbers = p ? [['gauge', `${fixed(p.gauge_atm, 1)} atm`], ['balloon', `${fixed(p.balloon_mm, 2)} mm`], ['contrast', `${fixed(p.contrast_mL, 1)} mL`], ['ACT', `${fixed(p.act_s, 0)} s`],
    ['ST', `${fixed(p.ST_mV, 2)} mV`], ['flow', p.flow_share === null ? '–' : `${Math.round(100 * p.flow_share)} %`], ['lesion', `${fixed(p.lesion_mld_mm, 2)} mm`], ['tear hazard', fixed(p.hazard, 3)], ...arm] : arm;
  if (p?.second_balloon_mm > 0) numbers.splice(2, 0, ['second gauge', `${fixed(p.second_gauge_atm, 1)} atm`], ['second balloon', `${fixed(p.second_balloon_mm, 2)} mm`]);
  if (p?.pericardium_mL > 0) numbers.unshift(['pericardium', `${p.pericardium_mL} mL`], ['its pressure', `${fixed(p.pericardium_mmHg, 1)} mmHg`]);
  if (p?.leak_mL_s > 0.005) numbers.unshift(['leak', `${fixed(p.leak_mL_s, 2)} mL/s`]);
  if (p?.awake === 0) numbers.unshift(['patient', 'does not answer']);
  if (p?.rhythm > 0) numbers.unshift(['rhythm', ['sinus', 'AV block', 'fibrillation', 'asystole'][p.rhythm]]);
  const speed = speedNow();
  if (speed < 0.9) numbers.push(['speed', `${Math.round(100 * speed)} %`]);
  $('numbers').replaceChildren(...numbers.map(([name, value]) => {
    const pair = document.createElement('div'), dt = document.createElement('dt'), dd = document.createElement('dd');
    dt.textContent = name;
    dd.textContent = value;
    pair.append(dt, dd);
    return pair;
  }));
  $('step').textContent = script && now.step >= 0 ? welcome.steps[now.step] ?? '' : now.refused >= 0 && now.in_its_way >= 0
    ? `${welcome.tools[now.refused].name} cannot enter: ${welcome.tools[now.in_its_way].name} is in its place` : '';
  if (!now.reference) $('reference').hidden = true;
  timeline.tick(now.s);
  console_.show(now, welcome);
  emergency.show(now, welcome);
}

const tabs = ['events', 'console', 'scores'];
function choose(name) {
  for (const one of tabs) {
    $(`tab-${one}`).setAttribute('aria-selected', one === name);
    $(`tab-${one}`).tabIndex = one === name ? 0 : -1;
    $(`${one}-panel`).hidden = one !== name;
  }
}
tabs.forEach((name, i) => {
  $(`tab-${name}`).onclick = () => choose(name);
  $(`tab-${name}`).onkeydown = (event) => {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!by) return;
    const next = tabs[(i + by + tabs.length) % tabs.length];
    choose(next);
    $(`tab-${next}`).focus();
  };
});
$('pause').onclick = (event) => {
  socket.order('pause');
  // After the mouse the keys are the picture's again, or the next Space would press this button, not the pedal.
  if (event.detail > 0) $('stage').focus();
};
$('hands').onclick = () => {
  const take = now?.hands === 'script';
  socket.order(take ? 'take_over' : 'hand_back');
  if (take) { choose('console'); $('stage').focus(); }
};
$('end').onclick = () => {
  if (ended && course.board) return socket.order('course');
  ask(ended ? 'Close the session?' : 'End the run?', () => { closed = !!ended; socket.order('end'); });
};
$('to-lessons').onclick = () => (ended || !welcome?.lesson.needed.length ? socket.order('course')
  : ask('Leave this attempt? It is kept, and can go on from here later.', () => socket.order('course')));
$('words').onclick = () => { fillGlossary($('glossary').querySelector('tbody')); $('glossary').showModal(); };
$('glossary').querySelector('button').onclick = () => $('glossary').close();
$('report').onclick = () => socket.order('report');
$('marks').onsubmit = (event) => {
  event.preventDefault();
  socket.send({ do: 'mark', text: $('note').value });
  $('note').value = '';
};
$('truth-follow').onclick = () => {
  truth.follow = !truth.follow;
  $('truth-follow').setAttribute('aria-pressed', truth.follow);
};
$('copy-link').onclick = () => navigator.clipboard.writeText(location.origin + '/' + welcome.viewer_link);
$('help').onclick = () => {
  const table = $('keys').querySelector('tbody');
  console_?.help(table, now?.step >= 0);
  if (!$('hint').hidden) {
    const line = table.insertRow(0);
    line.insertCell().textContent = 'Q';
    line.insertCell().textContent = 'hint: how the expert does what comes next';
  }
  $('keys').showModal();
};
$('keys').querySelector('button').onclick = () => $('keys').close();
$('legend').append('wall force 0', document.createElement('i'), '0.3 N and more');
