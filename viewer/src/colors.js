// Colours: ramps of even steps for values, hues far apart for numbers of nodes and branches.

function srgb(x) {
  const y = x <= 0.0031308 ? 12.92 * x : 1.055 * Math.pow(x, 1 / 2.4) - 0.055;
  return Math.round(255 * Math.min(1, Math.max(0, y)));
}

/** OKLCH (Ottosson 2020) to sRGB bytes; hue in degrees. */
export function oklch(lightness, chroma, hue) {
  const a = chroma * Math.cos(hue * Math.PI / 180), b = chroma * Math.sin(hue * Math.PI / 180);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [srgb(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    srgb(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    srgb(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s)];
}

// Dark to light with a change of hue, so that it reads in grey as well.
const sequential = t => oklch(0.42 + 0.46 * t, 0.12 + 0.05 * Math.sin(Math.PI * t), 285 - 185 * t);
// Blue is low and red is high, as in the thesis's figures.
const blueToRed = t => oklch(0.66 + 0.1 * Math.sin(Math.PI * t), 0.15, 255 - 230 * t);

function table(ramp) { return Array.from({ length: 256 }, (_, i) => ramp(i / 255)); }
const kRamps = { sequential: table(sequential), blueToRed: table(blueToRed) };

export const kGrey = [150, 155, 163];
export const kModes = [
  { id: 'msp', name: 'MSP', title: 'Minimum slice perimeter', ramp: 'sequential' },
  { id: 'error', name: 'Slice error', title: 'Slice error', ramp: 'blueToRed' },
  { id: 'radius', name: 'Radius', title: 'Radius of the inscribed ball', ramp: 'sequential' },
  { id: 'branch', name: 'Branch', title: 'Branches' },
  { id: 'node', name: 'Node', title: 'Nodes' },
  { id: 'part', name: 'Part', title: 'Parts of the surface' },
  { id: 'plain', name: 'Plain', title: '' },
];

export function numberColor(i) { return i < 0 ? kGrey : oklch(0.7 + 0.06 * Math.cos(1.7 * i), 0.14, (i * 137.508 + 30) % 360); }

/** The share of values beyond each end of a scale is 1 %, so that a few outliers do not take all of it. */
export function scaleOf(values) {
  const sorted = Float32Array.from(values).filter(Number.isFinite).sort();
  if (sorted.length === 0) return { low: 0, high: 1 };
  const at = share => sorted[Math.round(share * (sorted.length - 1))];
  let low = at(0.01), high = at(0.99);
  if (!(high > low)) { low = sorted[0]; high = sorted[sorted.length - 1]; }
  return { low, high };
}

export function rampColor(ramp, { low, high }, value) {
  if (!Number.isFinite(value)) return kGrey;
  const t = high > low ? (value - low) / (high - low) : 0.5;
  return kRamps[ramp][Math.round(255 * Math.min(1, Math.max(0, t)))];
}

export function gradient(ramp) {
  const stops = [0, 36, 73, 109, 146, 182, 219, 255].map(i => `rgb(${kRamps[ramp][i].join(' ')})`);
  return `linear-gradient(to right, ${stops.join(', ')})`;
}

/** What a mode shows: values per vertex and per node, and the scale of both. */
export class Painter {
  constructor(data, graph) {
    const perVertex = values => data.node_of_vertex && Float32Array.from(data.node_of_vertex, node => node < 0 ? NaN : values[node]);
    this.graph = graph;
    this.plainNode = [40, 110, 220];
    this.plainVertex = [168, 180, 196];
    this.values = {
      msp: { vertex: data.msp ?? perVertex(graph.msp), node: graph.msp, unit: data.scale },
      error: { vertex: data.slice_error ?? perVertex(graph.error), node: graph.error, unit: 1 },
      radius: { vertex: perVertex(graph.radius), node: graph.radius, unit: data.scale },
      node: { vertex: data.node_of_vertex, node: Int32Array.from({ length: graph.nodeCount }, (_, i) => i) },
      part: { vertex: data.part_of_vertex, node: data.part_of_node },
      branch: { vertex: data.node_of_vertex && data.node_of_vertex.map(node => node < 0 ? -1 : graph.branchOfNode[node]), node: graph.branchOfNode },
    };
    for (const name of ['msp', 'error', 'radius']) this.values[name].scale = scaleOf(this.values[name].vertex ?? this.values[name].node);
  }

  colorOf(mode, value) {
    return mode.ramp ? rampColor(mode.ramp, this.values[mode.id].scale, value) : numberColor(value);
  }

  /** RGB bytes of `count` vertices or nodes. */
  paint(mode, place, count) {
    const bytes = new Uint8Array(3 * count);
    const values = mode.id === 'plain' ? null : this.values[mode.id][place];
    const plain = place === 'node' ? this.plainNode : this.plainVertex;
    for (let i = 0; i < count; ++i) bytes.set(values ? this.colorOf(mode, values[i]) : plain, 3 * i);
    return bytes;
  }

  edgeColor(mode, edge, bytes, end) {
    if (mode.id === 'branch') return numberColor(this.graph.branchOfEdge[edge]);
    const node = this.graph.edge[2 * edge + end];
    return bytes.subarray(3 * node, 3 * node + 3);
  }
}
