// The scoring list as it fills, and at the end of a lesson the verdict: what was expected, and what happened.
import { clock } from '/timeline.js';

export class Scores {
  // `course`: where lessons are chosen; its board is null where there is none.
  constructor(panel, lesson, course) {
    this.panel = panel;
    this.lesson = lesson;
    this.course = course;
  }
  add(tag, words) {
    const element = document.createElement(tag);
    element.textContent = words;
    this.made.push(element);
    return element;
  }
  rows(className, rows) {
    const list = this.add('ul', '');
    list.className = className;
    for (const [kind, ...words] of rows) {
      const row = document.createElement('li');
      row.className = kind;
      for (const word of words) row.append(Object.assign(document.createElement('span'), { textContent: word }));
      list.append(row);
    }
    return list;
  }
  // Whether the lesson is done, what is missing, and what to do next.
  verdict(welcome, items) {
    const missed = welcome.lesson.needed.filter((i) => items[i].holds !== true);
    this.add('h2', missed.length ? 'Not yet' : 'Passed');
    for (const i of missed) {
      const item = welcome.scoring.items[i], step = item.kind === 'step';
      const came = step ? 'not done' : items[i].holds === null ? 'cannot be told' : 'happened';
      this.add('p', `${item.what}: ${came}${items[i].value ? ` (${items[i].value})` : ''}. ${step ? 'Expected' : 'This counts'}: ${item.when}.`).className = 'missed';
    }
    if (missed.length) this.add('p', 'To mend it, choose an earlier second on the bar below and press Go on; or begin anew.').className = 'next';
    if (this.course.board) {
      const row = this.add('div', '');
      row.className = 'row';
      row.append(...this.course.choices(!missed.length));
    }
    const told = this.lesson.account();
    if (!told.length) return;
    this.add('h3', 'instructions');
    this.rows('told', told.map(([sign, words]) => [sign === '✔' ? 'yes' : 'open', sign, words]));
  }
  show(welcome, ended, items) {
    this.made = [];
    if (ended && items && welcome.lesson.needed.length) this.verdict(welcome, items);
    this.add('p', `${welcome.scoring.title}. ${welcome.scoring.note}`);
    let phase = null, list = null;
    welcome.scoring.items.forEach((item, i) => {
      if (item.phase !== phase) { phase = item.phase; this.add('h3', phase); list = this.rows('', []); }
      const score = items?.[i], row = document.createElement('li');
      const holds = score ? score.holds : null;
      // An error that has not come yet, and a step that may still come, are open until the end.
      const missed = ended && item.kind === 'step' && welcome.lesson.needed.includes(i) && !holds; // as the verdict says
      const open = !missed && (holds === null || (!ended && (item.kind === 'step' ? !holds : holds)));
      const needed = !welcome.lesson.needed.length || welcome.lesson.needed.includes(i);
      row.className = open ? 'open' : holds ? 'yes' : needed ? 'no' : 'aside';
      const sign = open ? '○' : holds ? '✔' : item.kind === 'step' ? '–' : needed ? '✖' : '▲';
      const came_s = item.kind === 'step' || !holds; // of what did not happen there is no moment
      const when = came_s && score?.at_s?.length ? score.at_s.slice(0, 3).map(clock).join(' ') + (score.at_s.length > 3 ? ` … ${score.at_s.length} times` : '') : score?.value ?? '';
      const came = open || (item.kind === 'step' && holds) ? '' : item.kind === 'step' ? ': not done' : holds ? ': did not happen' : ': happened';
      const what = open && item.kind !== 'step' ? `Must not happen: ${item.what}` : item.what;
      const means = ended && !open && !holds && !needed ? `. This counts: ${item.when}. It may happen in a lesson that is passed` : '';
      for (const words of [sign, what + came + means, when]) row.append(Object.assign(document.createElement('span'), { textContent: words }));
      row.title = item.when;
      list.append(row);
    });
    if (ended) {
      const numbers = this.add('details', ''), table = document.createElement('table');
      numbers.append(Object.assign(document.createElement('summary'), { textContent: 'numbers of the run' }), table);
      for (const metric of ended.metrics) {
        const row = table.insertRow();
        row.insertCell().textContent = metric.name.replaceAll('_', ' ');
        row.insertCell().textContent = metric.words;
      }
    }
    this.panel.replaceChildren(...this.made);
  }
}
