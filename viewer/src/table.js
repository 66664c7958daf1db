// The table of branches: sorts by its heads, filters by words and length, picks and is picked.
import { numberColor } from './colors.js';
import { count, element, number } from './format.js';

const kColumns = [
  { key: 'index', name: 'Branch' },
  { key: 'length', name: 'Length' },
  { key: 'meanRadius', name: 'Mean radius' },
  { key: 'leastRadius', name: 'Least' },
];

export class BranchTable {
  /** `pick(branch)` and `hover(branch)`; -1: none. */
  constructor(graph, { pick, hover }) {
    this.branches = graph.branches;
    this.sort = { key: 'length', down: true };
    this.body = document.querySelector('#branches tbody');
    this.words = document.getElementById('filter');
    this.shortest = document.getElementById('shortest');
    this.pick = pick;
    this.rows = this.branches.map(branch => this.row(branch, hover));
    const head = document.querySelector('#branches thead tr');
    this.heads = kColumns.map(({ key, name }) => element('th', { scope: 'col' },
      element('button', { type: 'button', onclick: () => this.sortBy(key), title: key === 'leastRadius' ? 'Least radius' : name }, name)));
    head.append(...this.heads);
    this.words.addEventListener('input', () => this.show());
    this.shortest.addEventListener('input', () => this.show());
    this.show();
  }

  row(branch, hover) {
    const color = `rgb(${numberColor(branch.index).join(' ')})`;
    const first = element('td', {}, element('i', { style: `background:${color}` }), String(branch.index), element('small', {}, branch.kind));
    const row = element('tr', { 'data-branch': branch.index, tabindex: 0, 'aria-selected': 'false' }, first,
      ...['length', 'meanRadius', 'leastRadius'].map(key => element('td', {}, number(branch[key]))));
    row.addEventListener('click', () => this.pick(branch.index));
    row.addEventListener('keydown', event => { if (event.key === 'Enter' || event.key === ' ') { event.preventDefault(); this.pick(branch.index); } });
    row.addEventListener('pointerenter', () => hover(branch.index));
    row.addEventListener('pointerleave', () => hover(-1));
    return row;
  }

  sortBy(key) {
    this.sort = { key, down: this.sort.key === key ? !this.sort.down : key !== 'index' };
    this.show();
  }

  passes(branch) {
    const least = Number(this.shortest.value);
    if (least > 0 && branch.length < least) return false;
    const words = this.words.value.trim().toLowerCase().split(/[\s,]+/).filter(Boolean);
    return words.length === 0 || words.some(word => /^\d+$/.test(word) ? branch.index === Number(word) : branch.kind.startsWith(word));
  }

  show() {
    const { key, down } = this.sort;
    const shown = this.branches.filter(branch => this.passes(branch)).sort((a, b) => (down ? b[key] - a[key] : a[key] - b[key]) || a.index - b.index);
    this.body.replaceChildren(...shown.map(branch => this.rows[branch.index]));
    document.getElementById('branch-count').textContent = shown.length === this.branches.length
      ? count(shown.length, 'branch', 'branches') : `${shown.length} of ${count(this.branches.length, 'branch', 'branches')}`;
    this.heads.forEach((head, i) => {
      if (kColumns[i].key === key) head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
      else head.removeAttribute('aria-sort');
    });
    this.order = shown.map(branch => branch.index);
  }

  mark(picked) {
    this.rows.forEach((row, i) => row.setAttribute('aria-selected', String(i === picked)));
    this.rows[picked]?.scrollIntoView({ block: 'nearest' });
  }

  /** The branch so many rows after this one. */
  neighbour(branch, step) {
    const n = this.order.length, at = this.order.indexOf(branch);
    return n === 0 ? -1 : this.order[at < 0 ? (step > 0 ? 0 : n - 1) : (at + step + n) % n];
  }
}
