// A lesson beside the picture: goal, instructions that tick themselves, hints.
import { keyName } from '/console.js';
import { clock } from '/timeline.js';

const signs = { done: '✔', next: '▸', open: '○', plain: '·' };
const names = { done: 'done', next: 'next', open: 'not yet', plain: '' };

export class Lesson {
  constructor(panel, stage, socket) {
    this.panel = panel;
    this.socket = socket;
    this.hintWords = panel.querySelector('#hint-words');
    this.hintButton = panel.querySelector('#hint');
    this.hintButton.onclick = () => this.ask();
    stage.addEventListener('keydown', (event) => {
      if (keyName(event) === 'Q' && !event.ctrlKey && !event.metaKey && !event.altKey && !event.repeat) this.ask();
    });
    this.words = null;
  }
  ask() { if (this.words && !this.hintButton.hidden) this.socket.order('hint'); }
  welcome(message) {
    const lesson = this.words = message.lesson;
    this.panel.hidden = !lesson.title;
    this.panel.querySelector('h2').textContent = lesson.title;
    this.panel.querySelector('p').textContent = `Goal: ${lesson.goal}`;
    this.hintWords.textContent = '';
    this.hintButton.hidden = message.role !== 'trainer' || !lesson.needed.length || !lesson.instructions.some((one) => one.hints);
    this.at = lesson.instructions.map(() => null);
    this.show();
  }
  ticks(at) {
    if (at.some((second, i) => second !== null && this.at[i] === null)) this.hintWords.textContent = '';
    this.at = at;
    this.show();
  }
  hint(message) {
    this.hintWords.textContent = message.words + (message.more ? ' (Once more: what the expert does then.)' : '');
    this.hintWords.scrollIntoView({ block: 'nearest' });
  }
  // What comes next is the first that is not ticked; once all are, the last words.
  state(i) {
    const all = this.words.instructions, open = all.findIndex((one, k) => one.ticks && this.at[k] === null);
    if (i === (open < 0 ? all.length - 1 : open) && this.at[i] === null) return 'next';
    return !all[i].ticks ? 'plain' : this.at[i] !== null ? 'done' : 'open';
  }
  show() {
    this.panel.querySelector('ol').replaceChildren(...this.words.instructions.map((one, i) => {
      const row = document.createElement('li'), sign = document.createElement('span'), state = this.state(i);
      sign.textContent = signs[state];
      sign.className = 'sign';
      if (names[state]) { sign.setAttribute('role', 'img'); sign.setAttribute('aria-label', names[state]); }
      row.className = state;
      row.append(sign, Object.assign(document.createElement('span'), { textContent: one.text }));
      if (state === 'done') row.title = one.text; // shown in one line
      return row;
    }));
    this.panel.querySelector('li.next')?.scrollIntoView({ block: 'nearest' });
  }
  // What was expected of the instructions, and what happened: [sign, words] each.
  account() {
    return this.words.instructions.map((one, i) => [this.state(i), one.text, this.at[i], one.ticks]).filter(([, , , ticks]) => ticks)
      .map(([state, text, second]) => [state === 'done' ? '✔' : '–', `${text} ${state === 'done' ? `(done at ${clock(second)})` : '(did not happen)'}`]);
  }
}
