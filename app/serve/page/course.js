// The list of a course's lessons: what has been done, what comes next, and what must hold.
import { clock } from '/timeline.js';

function made(tag, words, ...children) {
  const element = document.createElement(tag);
  if (words) element.textContent = words;
  element.append(...children);
  return element;
}

const how = { goOn: 0, afresh: 1, shown: 2 };

function attemptWords(one) {
  const hints = one.hints ? `, ${one.hints} hint${one.hints === 1 ? '' : 's'}` : '';
  const came = one.done ? 'passed' : one.missed.length ? `not yet: ${one.missed.join('; ')}` : 'left before its end';
  return `Attempt ${one.number}: ${came}${one.ended ? ` (${clock(one.seconds)}${hints})` : ''}`;
}

export class Course {
  constructor(panel, socket) {
    this.panel = panel;
    this.socket = socket;
    this.board = null;
    this.learns = false; // a viewer looks on
    this.chosen = {}; // instruments, by lesson and tool
  }
  open(lesson, way) {
    const set = Object.entries(this.chosen[lesson] ?? {}).map(([tool, instrument]) => `${tool}=${instrument}`);
    this.socket.send({ do: 'lesson', values: [lesson, way], ...(set.length ? { set } : {}) });
  }
  // What a lesson is: a sign and a word, so that no colour has to tell.
  state(i) {
    const lesson = this.board.lessons[i];
    return lesson.done ? ['✔', 'passed'] : lesson.locked ? ['–', 'locked'] : i === this.board.next ? ['▸', 'next'] : ['○', 'open'];
  }
  button(words, lesson, way) {
    const button = made('button', words);
    button.setAttribute('aria-label', `${words}: ${this.board.lessons[lesson].title}`);
    button.disabled = !this.learns;
    button.onclick = () => this.open(lesson, way);
    return button;
  }
  lesson(i) {
    const lesson = this.board.lessons[i], [sign, word] = this.state(i);
    const details = made('details'), summary = made('summary', '', made('span', sign), made('b', `${i + 1}. ${lesson.title}`), made('small', word));
    summary.firstChild.setAttribute('aria-hidden', 'true');
    summary.firstChild.className = 'sign';
    details.className = word;
    details.open = i === this.board.next;
    details.append(summary, made('p', lesson.goal), made('small', 'To pass:'));
    details.append(made('ul', '', ...(lesson.must_hold.length ? lesson.must_hold : ['Come to its end.']).map((words) => made('li', words))));
    if (lesson.attempts.length) details.append(made('small', 'Attempts:'));
    if (lesson.attempts.length) details.append(made('ul', '', ...lesson.attempts.map((one) => made('li', attemptWords(one)))));
    if (lesson.tools.length) details.append(made('small', 'Instruments:'), this.shelf(i));
    const row = made('div');
    row.className = 'row';
    if (lesson.locked) row.append(made('small', `Opens when lesson ${i} is passed.`));
    else {
      if (lesson.goes_on) row.append(this.button('Go on', i, how.goOn), this.button('New attempt', i, how.afresh));
      else row.append(this.button(lesson.attempts.length ? 'New attempt' : 'Begin', i, how.afresh));
      if (!lesson.exam) row.append(this.button('Watch the expert', i, how.shown));
    }
    if (i === this.board.next) row.firstChild.classList.add('on');
    details.append(row);
    return made('li', '', details);
  }
  // What the procedure takes, and what else of its kind there is.
  shelf(i) {
    const row = made('div');
    row.className = 'row';
    for (const tool of this.board.lessons[i].tools) {
      const select = made('select', '', ...[...new Set([tool.instrument, ...tool.others])].map((one) => made('option', one)));
      select.value = this.chosen[i]?.[tool.name] ?? tool.instrument;
      select.disabled = !this.learns;
      select.onchange = () => {
        this.chosen[i] = { ...this.chosen[i], [tool.name]: select.value };
        if (select.value === tool.instrument) delete this.chosen[i][tool.name];
      };
      row.append(made('label', `${tool.name} `, select));
    }
    return row;
  }
  // Whose arteries they are.
  person() {
    const number = document.createElement('input'), take = made('button', 'Take'), row = made('div', '', made('label', 'Person ', number), take,
      made('small', 'Another number is another person, with arteries, plaque and heart of their own; empty: as each case has it.'));
    number.type = 'number', number.min = 0, number.max = 1000000, number.step = 1;
    number.value = this.board.person ?? '';
    row.className = 'row', row.id = 'person';
    take.disabled = number.disabled = !this.learns;
    take.onclick = () => this.socket.order('person', ...(number.value === '' ? [] : [number.valueAsNumber]));
    return row;
  }
  take(board) {
    this.board = board;
    const done = board.lessons.filter((one) => one.done).length, close = made('button', 'Close the course');
    close.id = 'close-course';
    close.disabled = !this.learns;
    close.onclick = () => this.socket.order('close');
    const problem = made('p', board.problem);
    problem.setAttribute('role', 'alert');
    problem.hidden = !board.problem;
    this.panel.replaceChildren(made('h2', board.title), problem, made('p', `${done} of ${board.lessons.length} lessons passed. Every attempt is kept.`), ...(board.chooses_person ? [this.person()] : []),
      made('ol', '', ...board.lessons.map((_, i) => this.lesson(i))), close, made('p', board.note));
  }
  // Opening takes seconds: the patient is built.
  wait() {
    this.panel.replaceChildren(made('h2', this.board.lessons[this.board.at].title), made('p', 'The patient is being made ready …'));
    this.panel.lastChild.setAttribute('role', 'status');
  }
  // What is to be done next, as buttons of a verdict.
  choices(passed) {
    const at = this.board.at, next = at + 1 < this.board.lessons.length;
    const list = made('button', 'All lessons');
    list.onclick = () => this.socket.order('course');
    list.disabled = !this.learns;
    const again = this.button(passed ? 'Once more' : 'New attempt', at, how.afresh);
    const out = passed && next ? [this.button(`Next: ${this.board.lessons[at + 1].title}`, at + 1, how.goOn), again] : [again];
    out[0].classList.add('on');
    out[0].id = passed && next ? 'next-lesson' : 'again';
    return [...out, list];
  }
}
