// Distributions as small bar charts (thesis figures 3.8 and 3.9).
import { element, number, percent } from './format.js';

const kBins = 28, kWidth = 320, kHeight = 96, kBase = 80;

function svg(name, attributes, text) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

/** A round number of which some three fit. */
function roundStep(width) {
  const power = 10 ** Math.floor(Math.log10(width / 3));
  return [5, 2, 1].map(f => f * power).find(step => step <= width / 3 * 1.001) ?? power;
}

function shares(values, weights, low, high) {
  const bins = new Float64Array(kBins);
  let total = 0;
  values.forEach((value, i) => {
    if (!Number.isFinite(value)) return;
    const weight = weights ? weights[i] : 1;
    bins[Math.min(kBins - 1, Math.max(0, Math.floor((value - low) / (high - low) * kBins)))] += weight;
    total += weight;
  });
  return bins.map(x => total > 0 ? x / total : 0);
}

function mean(values, weights) {
  let sum = 0, total = 0;
  values.forEach((value, i) => {
    if (!Number.isFinite(value)) return;
    const weight = weights ? weights[i] : 1;
    sum += weight * value;
    total += weight;
  });
  return total > 0 ? sum / total : NaN;
}

/** `before`: the same before refinement, drawn as an outline. `range`: [low, high], else that of the values. */
export function chart({ title, note, values, weights, before, range, color }) {
  const finite = Array.from(before ? [...values, ...before] : values).filter(Number.isFinite);
  const figure = element('figure', { class: 'chart' }, element('figcaption', {}, element('b', {}, title), element('span', {}, note)));
  if (finite.length === 0) return figure;
  let [low, high] = range ?? [finite.reduce((a, b) => Math.min(a, b)), finite.reduce((a, b) => Math.max(a, b))];
  if (!(high > low)) { const half = Math.abs(low) / 10 || 1; low -= half; high += half; }
  const after = shares(Array.from(values), weights, low, high), first = before && shares(Array.from(before), null, low, high);
  const most = Math.max(...after, ...(first ?? [0]));
  const picture = svg('svg', { viewBox: `0 0 ${kWidth} ${kHeight}`, role: 'img', 'aria-label': `Distribution of ${title}` });
  const x = value => (value - low) / (high - low) * kWidth, y = share => kBase - (kBase - 6) * share / most;
  after.forEach((share, i) => {
    const from = low + (high - low) * i / kBins, to = low + (high - low) * (i + 1) / kBins;
    const bar = svg('rect', { x: x(from) + 0.5, y: y(share), width: kWidth / kBins - 1, height: kBase - y(share), rx: 1.5, fill: color((from + to) / 2) });
    bar.append(svg('title', {}, `${number(from)} to ${number(to)}: ${percent(share)}`));
    picture.append(bar);
  });
  if (first) {
    let path = `M0 ${kBase}`;
    first.forEach((share, i) => { path += `V${y(share)}H${(i + 1) * kWidth / kBins}`; });
    picture.append(svg('path', { d: `${path}V${kBase}`, class: 'before' }));
  }
  picture.append(svg('line', { x1: 0, x2: kWidth, y1: kBase, y2: kBase, class: 'axis' }));
  const step = roundStep(high - low);
  for (let tick = Math.ceil(low / step - 1e-9) * step; tick <= high + 1e-9 * step; tick += step) {
    const at = Math.min(kWidth - 1, Math.max(1, x(tick))), anchor = at < 20 ? 'start' : at > kWidth - 20 ? 'end' : 'middle';
    picture.append(svg('text', { x: at, y: kHeight - 2, 'text-anchor': anchor }, number(Number(tick.toPrecision(6)))));
  }
  const middle = mean(values, weights);
  picture.append(svg('line', { x1: x(middle), x2: x(middle), y1: 2, y2: kBase, class: 'mean' }));
  figure.append(picture);
  let words = `mean ${number(middle)}`;
  if (before) words += `, before refinement ${number(mean(before))} (outline)`;
  figure.append(element('p', {}, words));
  return figure;
}
