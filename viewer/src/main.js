import { Bender } from './bend.js';
import { chart } from './charts.js';
import { gradient, kModes, numberColor, Painter, rampColor } from './colors.js';
import { readData } from './data.js';
import { count, element, number } from './format.js';
import { Graph } from './graph.js';
import { Stage } from './stage.js';
import { Surface } from './surface.js';
import { BranchTable } from './table.js';
import { facts, kKinds, remarks } from './words.js';

const $ = selector => document.querySelector(selector);
const kLayers = [
  ['surface', 'Surface'], ['skeleton', 'Skeleton'], ['radius', 'Skeleton with radius'], ['mesh', 'Skeleton mesh'],
  ['slice', 'Slice of the picked vertex'], ['marks', 'Marked places'],
];
const kReach = { mouse: 10, pen: 16, touch: 24 };  // pixels from the skeleton that still mean it

class App {
  constructor() {
    this.data = readData();
    this.surface = new Surface(this.data);
    this.graph = new Graph(this.data);
    this.painter = new Painter(this.data, this.graph);
    this.stage = new Stage($('#canvas'), this.data, this.surface, this.graph);
    this.picked = { branch: -1, node: -1, vertex: -1 };
    this.measuring = false;
    this.ends = [];
    this.measured = null;
    this.table = new BranchTable(this.graph, { pick: branch => this.pickBranch(branch), hover: branch => this.hover(branch) });
    this.fillTitle();
    this.fillView();
    this.fillBend();
    this.fillCharts();
    this.fillReport();
    this.listen();
    this.theme(matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');
    this.colorBy(this.painter.values.msp.vertex ? 'msp' : 'radius');
    this.tab('show');
  }

  fillTitle() {
    $('#title h1').textContent = this.data.title;
    const first = remarks(this.data.report)[0], all = remarks(this.data.report);
    const worst = ['bad', 'fair', 'good', 'note'].find(level => all.some(remark => remark.level === level));
    const rest = all.filter(remark => remark !== first && (remark.level === 'bad' || remark.level === 'fair')).length;
    $('#verdict').append(element('span', {}, first.title), rest > 0 ? element('span', { class: 'rest' }, `, ${count(rest, 'remark')}`) : '');
    $('#verdict').dataset.level = worst;
    $('#verdict').addEventListener('click', () => this.tab('report'));
  }

  fillView() {
    const available = { mesh: this.data.skeleton_mesh !== null, slice: this.data.slice_normal !== null, marks: this.data.places.length > 0 };
    kLayers.forEach(([id, name], i) => {
      const box = element('input', { type: 'checkbox', 'data-layer': id, checked: this.stage.layers[id], disabled: available[id] === false, onchange: event => this.stage.show(id, event.target.checked) });
      const label = element('label', { class: 'switch' }, box, element('span', {}, name), element('kbd', {}, String(i + 1)));
      label.hidden = available[id] === false;
      $('#layers').append(label);
    });
    this.modes = kModes.filter(({ id }) => id !== 'part' || this.data.part_of_vertex);
    for (const { id, name } of this.modes)
      $('#modes').append(element('button', { type: 'button', role: 'radio', 'data-mode': id, 'aria-checked': 'false', onclick: () => this.colorBy(id) }, name));
    $('#opacity').addEventListener('input', event => this.opacity(event.target.value / 100));
    this.opacity($('#opacity').value / 100);
    for (const [name, value] of facts(this.data.report, this.surface, this.graph, this.data.scale)) $('#facts').append(element('dt', {}, name), element('dd', {}, value));
  }

  fillBend() {
    if (!this.data.rig || !this.data.node_of_vertex) return;
    this.bender = new Bender(this.data, this.surface, this.graph);
    $('#bend').hidden = false;
    $('#joint').append(...this.bender.names.map((name, j) => element('option', { value: String(j) }, name)));
    const shown = () => this.bender.turns[$('#joint').value];
    $('#joint').addEventListener('change', () => { $('#axis').value = shown().axis; $('#angle').value = shown().angle; this.mark(); });
    for (const id of ['axis', 'angle'])
      $(`#${id}`).addEventListener('input', () => this.bend(Number($('#joint').value), $('#axis').value, Number($('#angle').value)));
    $('#straight').addEventListener('click', () => { $('#angle').value = 0; this.bender.straighten(); this.bent(); });
  }

  bend(joint, axis, angle) {
    this.bender.turn(joint, axis, angle);
    this.bent();
  }

  // The slice is that of the surface at rest.
  bent() {
    this.slice = null;
    this.stage.showSlice(null, null, null);
    this.stage.moved();
    this.mark();
  }

  // The branch where the joint is.
  mark() {
    const node = this.data.rig.nodes[$('#joint').value];
    this.stage.pick({ branch: this.graph.branchOfNode[node], node });
  }

  fillCharts() {
    const { data, graph, painter } = this, unit = data.scale, toModel = values => values && values.map(x => unit * x);
    const color = id => value => `rgb(${rampColor(kModes.find(m => m.id === id).ramp, painter.values[id].scale, value / (painter.values[id].unit)).join(' ')})`;
    const edgeLength = Float32Array.from({ length: graph.edgeCount }, (_, e) => unit * graph.neighbours[graph.edge[2 * e]].find(n => n.edge === e).length);
    const edgeRadius = Float32Array.from({ length: graph.edgeCount }, (_, e) => unit * (graph.radius[graph.edge[2 * e]] + graph.radius[graph.edge[2 * e + 1]]) / 2);
    const charts = [];
    if (data.msp) charts.push({ title: 'Minimum slice perimeter', note: 'of the vertices', values: toModel(data.msp), before: toModel(data.initial_msp), color: color('msp') });
    if (data.slice_error) charts.push({ title: 'Slice error', note: 'of the vertices', values: data.slice_error, before: data.initial_slice_error, range: [0, 1], color: color('error') });
    charts.push({ title: 'Radius', note: 'along the skeleton', values: edgeRadius, weights: edgeLength, color: color('radius') });
    charts.push({ title: 'Length', note: 'of the branches', values: graph.branches.map(b => b.length), color: () => 'var(--note)' });
    this.makeCharts = () => { $('[data-panel="charts"]').append(...charts.map(chart)); this.makeCharts = () => {}; };
  }

  fillReport() {
    const panel = $('[data-panel="report"]');
    for (const { level, title, text } of remarks(this.data.report)) panel.append(element('div', { class: 'remark', 'data-level': level }, element('b', {}, title), element('p', {}, text)));
    if (this.data.places.length === 0) return;
    panel.append(element('h2', {}, 'Marked places'));
    for (const places of this.data.places) {
      let turn = 0;
      const show = () => { this.lookAt(places.at[turn % places.at.length]); ++turn; };
      panel.append(element('button', { class: 'place', type: 'button', onclick: show }, element('span', {}, places.text), element('span', {}, count(places.count, 'place'))));
    }
    this.stage.showMarks(this.data.places.flatMap(places => places.at));
  }

  listen() {
    const canvas = $('#canvas');
    let down = null;
    canvas.addEventListener('pointerdown', event => { down = { x: event.clientX, y: event.clientY, more: down !== null && event.pointerType === 'touch' && !event.isPrimary }; $('#tip').hidden = true; });
    canvas.addEventListener('pointerup', event => {
      const still = down && !down.more && Math.hypot(event.clientX - down.x, event.clientY - down.y) < (event.pointerType === 'touch' ? 10 : 4);
      down = null;
      if (still && event.button === 0) this.click(event);
    });
    canvas.addEventListener('pointercancel', () => { down = null; });
    canvas.addEventListener('pointermove', event => { if (event.buttons === 0 && event.pointerType !== 'touch') this.pointLater(event); });
    canvas.addEventListener('pointerleave', () => { this.pointer = null; this.point(null); });
    canvas.addEventListener('webglcontextlost', event => { event.preventDefault(); this.say('The graphics card lost the picture; reload the page.'); });
    $('#reset').addEventListener('click', () => this.reset());
    $('#measure').addEventListener('click', () => this.measure(!this.measuring));
    $('#theme').addEventListener('click', () => this.theme(this.themeName === 'dark' ? 'light' : 'dark'));
    $('#help').addEventListener('click', () => $('#keys').showModal());
    $('#fold').addEventListener('click', () => this.fold(!$('#app').classList.contains('folded')));
    document.querySelectorAll('[role="tab"]').forEach(tab => tab.addEventListener('click', () => { this.tab(tab.dataset.tab); this.fold(false); }));
    document.addEventListener('keydown', event => this.key(event));
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || $('#keys').open) return;
    const target = event.target instanceof Element ? event.target : document.body;
    const typing = target.matches('input[type="search"], input[type="number"]');
    if (typing) { if (event.key === 'Escape') target.blur(); return; }
    const turn = 0.12, view = this.stage.view, slides = target.matches('input[type="range"], [role="tab"]');
    const actions = {
      ArrowLeft: () => view.turn(-turn, 0), ArrowRight: () => view.turn(turn, 0), ArrowUp: () => view.turn(0, turn), ArrowDown: () => view.turn(0, -turn),
      '+': () => view.near(0.85), '=': () => view.near(0.85), '-': () => view.near(1 / 0.85),
      r: () => this.reset(), Home: () => this.reset(), f: () => this.focus(), m: () => this.measure(!this.measuring),
      c: () => this.nextMode(), t: () => this.theme(this.themeName === 'dark' ? 'light' : 'dark'), '?': () => $('#keys').showModal(),
      Escape: () => this.clear(), '[': () => this.pickBranch(this.table.neighbour(this.picked.branch, -1)), ']': () => this.pickBranch(this.table.neighbour(this.picked.branch, 1)),
    };
    kLayers.forEach(([id], i) => { actions[i + 1] = () => this.toggle(id); });
    const action = actions[event.key] ?? actions[event.key.toLowerCase()];
    if (!action || (slides && event.key.startsWith('Arrow'))) return;
    event.preventDefault();
    action();
    this.stage.draw();
  }

  // What is beneath the pointer.
  find(event) {
    const box = $('#canvas').getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top;
    const point = this.stage.skeletonAt(x, y, kReach[event.pointerType] ?? kReach.mouse);
    return { x, y, point, hit: point ? null : this.stage.surfaceAt(x, y) };
  }

  pointLater(event) {
    const waiting = this.pointer;
    this.pointer = { clientX: event.clientX, clientY: event.clientY, pointerType: event.pointerType };
    if (waiting) return;
    requestAnimationFrame(() => { const at = this.pointer; this.pointer = null; if (at) this.point(this.find(at)); });
  }

  point(found) {
    const tip = $('#tip'), canvas = $('#canvas'), { graph, data } = this;
    const vertex = found?.hit?.vertex ?? -1, node = found?.point?.node ?? (vertex >= 0 && data.node_of_vertex ? data.node_of_vertex[vertex] : -1);
    const branch = found?.point && found.point.edge >= 0 ? graph.branchOfEdge[found.point.edge] : node >= 0 ? graph.branchOfNode[node] : -1;
    canvas.classList.toggle('over', found?.point != null);
    this.hover(found?.point ? branch : -1);
    tip.hidden = !found || (node < 0 && vertex < 0);
    if (tip.hidden) return;
    const lines = [];
    if (branch >= 0) lines.push(`Branch ${branch}, length ${number(graph.branches[branch].length)}`);
    if (found.point) lines.push(`Radius ${number(data.scale * found.point.radius)}`, `MSP ${number(data.scale * graph.msp[node])}`);
    else {
      if (node >= 0) lines.push(`Radius ${number(data.scale * graph.radius[node])}`);
      if (data.msp) lines.push(`MSP ${number(data.scale * data.msp[vertex])}`);
    }
    tip.textContent = lines.join('\n');
    const width = this.stage.canvas.clientWidth;
    tip.style.left = `${Math.min(found.x + 14, width - tip.offsetWidth - 6)}px`;
    tip.style.top = `${Math.max(6, found.y - tip.offsetHeight - 10)}px`;
  }

  hover(branch) {
    if (branch === this.stage.picked.hover) return;
    this.stage.pick({ hover: branch });
  }

  click(event) {
    const { point, hit } = this.find(event);
    if (this.measuring) {
      const node = hit && this.data.node_of_vertex ? this.data.node_of_vertex[hit.vertex] : -1;
      const end = point ?? (node >= 0 ? this.graph.pointAtNode(node) : null);
      if (end) this.addEnd(end);
    } else if (point) this.pickPoint(point);
    else if (hit) this.pickVertex(hit.vertex);
    else this.clear();
  }

  pickPoint(point) {
    const branch = point.edge >= 0 ? this.graph.branchOfEdge[point.edge] : this.graph.branchOfNode[point.node];
    this.showPicked({ branch, node: point.node, vertex: -1 });
  }

  pickBranch(branch) { if (branch >= 0) this.showPicked({ branch, node: -1, vertex: -1 }); }

  pickVertex(vertex) {
    const node = this.data.node_of_vertex ? this.data.node_of_vertex[vertex] : -1;
    this.showPicked({ branch: node >= 0 ? this.graph.branchOfNode[node] : -1, node, vertex });
  }

  showPicked(picked) {
    this.picked = picked;
    if (this.measuring) this.measure(false);
    this.ends = [];
    this.measured = null;
    this.slice = null;
    if (picked.vertex >= 0 && this.data.slice_normal) {
      const v = picked.vertex, normal = Array.from(this.data.slice_normal.subarray(3 * v, 3 * v + 3));
      if (normal.some(x => x !== 0)) this.slice = this.surface.slice(v, normal);
      this.stage.showSlice(this.slice?.points ?? null, normal, Array.from(this.surface.position.subarray(3 * v, 3 * v + 3)));
    } else this.stage.showSlice(null, null, null);
    this.stage.showWay([], []);
    this.stage.pick({ branch: picked.branch, node: picked.node });
    this.table.mark(picked.branch);
    this.showCard();
  }

  clear() {
    this.measure(false);
    this.showPicked({ branch: -1, node: -1, vertex: -1 });
  }

  measure(on) {
    if (on === this.measuring) return;
    this.measuring = on;
    $('#measure').setAttribute('aria-pressed', String(on));
    $('#canvas').classList.toggle('measuring', on);
    if (on) {
      this.showPickedNothing();
      this.showCard();
    } else if (this.measured === null) {
      this.ends = [];
      this.stage.showWay([], []);
      this.showCard();
    }
  }

  showPickedNothing() {
    this.picked = { branch: -1, node: -1, vertex: -1 };
    this.ends = [];
    this.measured = null;
    this.stage.showWay([], []);
    this.stage.showSlice(null, null, null);
    this.stage.pick({ branch: -1, node: -1 });
    this.table.mark(-1);
  }

  addEnd(end) {
    if (this.ends.length === 2) this.ends = [];
    this.ends.push(end);
    this.measured = this.ends.length === 2 ? this.graph.way(...this.ends) : null;
    this.stage.showWay(this.ends.map(e => e.at), this.measured?.points ?? []);
    this.showCard();
  }

  card(title, kind, pairs) {
    const list = element('dl', { class: 'pairs' });
    for (const pair of pairs) list.append(...(pair === null ? [element('div', { class: 'gap' })] : [element('dt', {}, pair[0]), element('dd', {}, pair[1])]));
    const close = element('button', { class: 'close', type: 'button', 'aria-label': 'Close', onclick: () => this.clear() }, '×');
    $('#card').replaceChildren(element('h2', {}, title), element('p', { class: 'kind' }, kind), list, close);
    $('#card').hidden = false;
  }

  showCard() {
    const { picked, graph, data, ends, measured } = this, unit = data.scale;
    if (this.measuring || ends.length > 0) {
      if (ends.length < 2) this.card('Measure', ends.length === 0 ? 'Pick the first point on the skeleton.' : 'Pick the second point.', []);
      else if (measured === null) this.card('Measure', 'The two points are on separate pieces.', []);
      else this.card('Measure', 'along the skeleton', [['Length', number(measured.length)], ['Straight', number(measured.straight)], ['Mean radius', number(measured.meanRadius)], ['Least radius', number(measured.leastRadius)]]);
      return;
    }
    const branch = graph.branches[picked.branch], pairs = [];
    if (!branch && picked.vertex < 0 && picked.node < 0) { $('#card').hidden = true; return; }
    if (branch) pairs.push(['Length', number(branch.length)], ['Mean radius', number(branch.meanRadius)], ['Least radius', number(branch.leastRadius)], ['Mean MSP', number(branch.meanMsp)]);
    if (picked.node >= 0) pairs.push(null, ['Node', String(picked.node)], ['Radius', number(unit * graph.radius[picked.node])], ['MSP', number(unit * graph.msp[picked.node])], ['Slice error', number(graph.error[picked.node])]);
    if (picked.vertex >= 0) {
      pairs.push(null, ['Vertex', String(picked.vertex)]);
      if (data.part_of_vertex) pairs.push(['Part', String(data.part_of_vertex[picked.vertex])]);
      if (this.bender) pairs.push(['Follows', this.bender.names[this.bender.strongest(picked.vertex)]]);
      if (data.msp) pairs.push(['MSP', number(unit * data.msp[picked.vertex])]);
      if (data.slice_error) pairs.push(['Slice error', number(data.slice_error[picked.vertex])]);
      if (this.slice) pairs.push(['This slice', number(unit * this.slice.perimeter)]);
    }
    this.card(branch ? `Branch ${branch.index}` : picked.node >= 0 ? `Node ${picked.node}` : `Vertex ${picked.vertex}`, branch ? kKinds[branch.kind] : 'belongs to no branch', pairs);
  }

  focus() {
    const branch = this.graph.branches[this.picked.branch];
    if (!branch) return;
    const points = [];
    for (const v of branch.nodes) for (let k = 0; k < 3; ++k) for (const sign of [-1, 1]) {
      const point = Array.from(this.graph.position.subarray(3 * v, 3 * v + 3));
      point[k] += sign * 1.5 * this.graph.radius[v];
      points.push(point);
    }
    this.stage.view.focus(points);
    this.stage.draw();
  }

  lookAt(at) {
    const points = [];
    for (let k = 0; k < 3; ++k) for (const sign of [-0.12, 0.12]) points.push(at.map((x, i) => x + (i === k ? sign : 0)));
    this.stage.view.focus(points);
    this.stage.draw();
  }

  reset() { this.stage.view.reset(); this.stage.draw(); }

  toggle(layer) {
    const box = $(`[data-layer="${layer}"]`);
    if (!box.disabled) box.click();
  }

  opacity(value) { this.stage.ghost.opacity(value); this.stage.draw(); }

  nextMode() {
    const at = this.modes.findIndex(mode => mode.id === this.mode.id);
    this.colorBy(this.modes[(at + 1) % this.modes.length].id);
  }

  colorBy(id) {
    this.mode = kModes.find(mode => mode.id === id);
    document.querySelectorAll('[data-mode]').forEach(button => button.setAttribute('aria-checked', String(button.dataset.mode === id)));
    this.stage.paint(this.painter, this.mode);
    this.showLegend();
  }

  showLegend() {
    const { mode, painter, graph } = this, legend = $('#legend');
    legend.hidden = mode.id === 'plain';
    if (mode.ramp) {
      const { scale, unit } = painter.values[mode.id];
      legend.replaceChildren(element('b', {}, mode.title), element('div', { class: 'bar', style: `background:${gradient(mode.ramp)}` }),
        element('div', { class: 'ends' }, ...[0, 0.5, 1].map(t => element('span', {}, number(Number((unit * (scale.low + t * (scale.high - scale.low))).toPrecision(3)))))));
    } else if (mode.id !== 'plain') {
      const all = mode.id === 'branch' ? graph.branches.length : mode.id === 'part' ? 1 + Math.max(...this.data.part_of_vertex) : graph.nodeCount, some = Math.min(all, 12);
      legend.replaceChildren(element('b', {}, mode.title), element('div', { class: 'swatches' }, ...Array.from({ length: some }, (_, i) => element('i', { style: `background:rgb(${numberColor(i).join(' ')})` }))),
        element('div', { class: 'ends' }, element('span', {}, '0'), element('span', {}, all > some ? `${some - 1} and on, to ${all - 1}` : String(all - 1))));
    }
  }

  theme(name) {
    this.themeName = name;
    document.documentElement.dataset.theme = name;
    this.painter.plainVertex = name === 'dark' ? [150, 164, 184] : [168, 180, 196];
    if (this.mode) this.stage.paint(this.painter, this.mode);
    this.stage.background(getComputedStyle(document.documentElement).getPropertyValue('--stage').trim());
  }

  tab(name) {
    document.querySelectorAll('[role="tab"]').forEach(tab => tab.setAttribute('aria-selected', String(tab.dataset.tab === name)));
    document.querySelectorAll('[data-panel]').forEach(panel => { panel.hidden = panel.dataset.panel !== name; });
    if (name === 'charts') this.makeCharts();
    if (name === 'branches') this.table.mark(this.picked.branch);
  }

  fold(on) {
    $('#app').classList.toggle('folded', on);
    $('#fold').setAttribute('aria-expanded', String(!on));
  }

  say(text) {
    $('#message').textContent = text;
    $('#message').hidden = false;
  }
}

function start() {
  try {
    const app = new App();
    // For scripts that drive the page; viewer/README.md names what they may rely on.
    window.mspskel = {
      nodeCount: app.graph.nodeCount,
      branchCount: app.graph.branches.length,
      project: node => app.stage.project(app.graph.position.subarray(3 * node, 3 * node + 3)),
      projectVertex: vertex => app.stage.project(app.surface.position.subarray(3 * vertex, 3 * vertex + 3)),
      jointNames: app.bender?.names ?? [],
      jointParents: app.bender?.parents ?? [],
      vertexCount: app.surface.vertexCount,
      bend: (joint, axis, degrees) => app.bend(joint, axis, degrees),
      position: vertex => Array.from(app.surface.position.subarray(3 * vertex, 3 * vertex + 3)),
      joint: vertex => app.bender.strongest(vertex),
      part: vertex => app.data.part_of_vertex[vertex],
      branchNodes: branch => Array.from(app.graph.branches[branch].nodes),
      state: () => ({
        picked: { ...app.picked }, mode: app.mode.id, layers: { ...app.stage.layers }, measuring: app.measuring, measured: app.measured && { length: app.measured.length, straight: app.measured.straight },
        slice: app.slice ? app.slice.perimeter * app.data.scale : null, theme: app.themeName, frames: app.stage.frames, hasty: app.stage.hasty, facesDrawn: app.stage.ghost.front.geometry.index.count / 3, camera: app.stage.view.camera.position.toArray(),
      }),
    };
  } catch (error) {
    console.error(error);
    $('#message').textContent = `This page needs WebGL 2, which the browser does not offer here. ${error.message}`;
    $('#message').hidden = false;
  }
}

start();
