// The skeleton as a graph: branches with their measures, and the way between two of its points.

const kNone = -1;

function distance(p, a, b) {
  return Math.hypot(p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]);
}

export class Graph {
  /** `unit`: model units of a length 1. */
  constructor(data) {
    this.position = data.node_position;
    this.radius = data.node_radius;
    this.msp = data.node_msp;
    this.error = data.node_error;
    this.edge = data.edge;
    this.unit = data.scale;
    this.nodeCount = this.radius.length;
    this.edgeCount = this.edge.length / 2;
    this.buildNeighbours();
    this.buildBranches(data.branch_node, data.branch_begin);
  }

  buildNeighbours() {
    this.neighbours = Array.from({ length: this.nodeCount }, () => []);
    for (let e = 0; e < this.edgeCount; ++e) {
      const a = this.edge[2 * e], b = this.edge[2 * e + 1], length = distance(this.position, a, b);
      this.neighbours[a].push({ node: b, edge: e, length });
      this.neighbours[b].push({ node: a, edge: e, length });
    }
  }

  degree(node) { return this.neighbours[node].length; }

  buildBranches(nodes, begin) {
    this.branches = [];
    this.branchOfEdge = new Int32Array(this.edgeCount).fill(kNone);
    this.branchOfNode = new Int32Array(this.nodeCount).fill(kNone);
    for (let i = 0; i + 1 < begin.length; ++i) this.branches.push(this.measure(i, nodes.subarray(begin[i], begin[i + 1])));
  }

  measure(index, nodes) {
    let length = 0, area = 0, least = Infinity, mspArea = 0;
    const edges = [];
    for (const node of nodes) {
      least = Math.min(least, this.radius[node]);
      if (this.branchOfNode[node] === kNone) this.branchOfNode[node] = index;
    }
    for (let i = 0; i + 1 < nodes.length; ++i) {
      const a = nodes[i], b = nodes[i + 1];
      const step = this.neighbours[a].find(n => n.node === b);
      this.branchOfEdge[step.edge] = index;
      edges.push(step.edge);
      length += step.length;
      area += step.length * (this.radius[a] + this.radius[b]) / 2;
      mspArea += step.length * (this.msp[a] + this.msp[b]) / 2;
    }
    const first = nodes[0], last = nodes[nodes.length - 1];
    const ends = (this.degree(first) === 1) + (this.degree(last) === 1);
    const kind = first === last ? 'loop' : ['link', 'end', 'whole'][ends];
    return {
      index, nodes, edges, kind,
      length: this.unit * length,
      meanRadius: this.unit * (length > 0 ? area / length : this.radius[first]),
      leastRadius: this.unit * least,
      meanMsp: this.unit * (length > 0 ? mspArea / length : this.msp[first]),
    };
  }

  counts() {
    const seen = new Uint8Array(this.nodeCount);
    let pieces = 0, ends = 0, joints = 0;
    for (let v = 0; v < this.nodeCount; ++v) {
      if (this.degree(v) === 1) ++ends;
      if (this.degree(v) > 2) ++joints;
      if (seen[v]) continue;
      ++pieces;
      const stack = [v];
      seen[v] = 1;
      while (stack.length) for (const { node } of this.neighbours[stack.pop()]) if (!seen[node]) { seen[node] = 1; stack.push(node); }
    }
    const length = this.branches.reduce((sum, b) => sum + b.length, 0);
    return { pieces, ends, joints, loops: this.edgeCount - this.nodeCount + pieces, length };
  }

  /** A point on an edge, t from its first to its second node. */
  pointAt(edge, t) {
    const a = this.edge[2 * edge], b = this.edge[2 * edge + 1], p = this.position;
    return {
      edge, t,
      at: [0, 1, 2].map(k => p[3 * a + k] + t * (p[3 * b + k] - p[3 * a + k])),
      radius: this.radius[a] + t * (this.radius[b] - this.radius[a]),
      node: t < 0.5 ? a : b,
    };
  }

  pointAtNode(node) {
    const step = this.neighbours[node][0];
    if (step === undefined)
      return { edge: kNone, t: 0, at: Array.from(this.position.subarray(3 * node, 3 * node + 3)), radius: this.radius[node], node };
    return this.pointAt(step.edge, this.edge[2 * step.edge] === node ? 0 : 1);
  }

  /** The shortest way along the skeleton; null between separate pieces. Lengths in model units. */
  way(from, to) {
    if (from.edge === kNone || to.edge === kNone) return from.node === to.node ? this.wayThrough(from, [], to) : null;
    const lengthOf = e => distance(this.position, this.edge[2 * e], this.edge[2 * e + 1]);
    const best = { length: from.edge === to.edge ? Math.abs(from.t - to.t) * lengthOf(from.edge) : Infinity, nodes: [] };
    const { cost, before } = this.search(from, lengthOf(from.edge));
    for (const [end, share] of [[0, to.t], [1, 1 - to.t]]) {
      const node = this.edge[2 * to.edge + end], length = cost[node] + share * lengthOf(to.edge);
      if (length >= best.length) continue;
      best.length = length;
      best.nodes = [];
      for (let v = node; v !== kNone; v = before[v]) best.nodes.unshift(v);
    }
    return best.length < Infinity ? this.wayThrough(from, best.nodes, to) : null;
  }

  search(from, edgeLength) {
    const cost = new Float64Array(this.nodeCount).fill(Infinity), before = new Int32Array(this.nodeCount).fill(kNone);
    const queue = new Queue();
    for (const [end, share] of [[0, from.t], [1, 1 - from.t]]) {
      const node = this.edge[2 * from.edge + end];
      cost[node] = share * edgeLength;
      queue.push(cost[node], node);
    }
    for (let top = queue.pop(); top !== undefined; top = queue.pop()) {
      if (top.key > cost[top.node]) continue;
      for (const { node, length } of this.neighbours[top.node]) {
        if (top.key + length >= cost[node]) continue;
        cost[node] = top.key + length;
        before[node] = top.node;
        queue.push(cost[node], node);
      }
    }
    return { cost, before };
  }

  wayThrough(from, nodes, to) {
    const points = [from, ...nodes.map(v => ({ at: Array.from(this.position.subarray(3 * v, 3 * v + 3)), radius: this.radius[v] })), to];
    let length = 0, area = 0, least = Infinity;
    points.forEach((point, i) => {
      least = Math.min(least, point.radius);
      if (i === 0) return;
      const step = Math.hypot(...point.at.map((x, k) => x - points[i - 1].at[k]));
      length += step;
      area += step * (point.radius + points[i - 1].radius) / 2;
    });
    const straight = Math.hypot(...to.at.map((x, k) => x - from.at[k]));
    return {
      points: points.map(p => p.at),
      length: this.unit * length,
      straight: this.unit * straight,
      leastRadius: this.unit * least,
      meanRadius: this.unit * (length > 0 ? area / length : from.radius),
    };
  }
}

/** A binary heap, least key first. */
class Queue {
  constructor() { this.items = []; }
  push(key, node) {
    const items = this.items;
    let i = items.push({ key, node }) - 1;
    for (; i > 0; i = (i - 1) >> 1) {
      const up = (i - 1) >> 1;
      if (items[up].key <= items[i].key) break;
      [items[up], items[i]] = [items[i], items[up]];
    }
  }
  pop() {
    const items = this.items, top = items[0], last = items.pop();
    if (items.length === 0) return top;
    items[0] = last;
    for (let i = 0; ;) {
      let least = i;
      for (const child of [2 * i + 1, 2 * i + 2]) if (child < items.length && items[child].key < items[least].key) least = child;
      if (least === i) return top;
      [items[least], items[i]] = [items[i], items[least]];
      i = least;
    }
  }
}
