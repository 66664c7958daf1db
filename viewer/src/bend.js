// Joints that bend the surface and its skeleton: linear blend skinning, as rig/rig.h has it.

function rotation([x, y, z], degrees) {
  const t = degrees * Math.PI / 180, c = Math.cos(t), s = Math.sin(t), d = 1 - c;
  return [c + x * x * d, x * y * d - z * s, x * z * d + y * s, y * x * d + z * s, c + y * y * d, y * z * d - x * s, z * x * d - y * s, z * y * d + x * s, c + z * z * d];
}
function product(a, b) {
  return Array.from({ length: 9 }, (_, i) => [0, 1, 2].reduce((sum, k) => sum + a[3 * Math.floor(i / 3) + k] * b[3 * k + i % 3], 0));
}
function applied(m, v) { return [0, 1, 2].map(i => m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2]); }

const kSmoothing = 8;  // rounds
const kAxes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

export class Bender {
  constructor(data, surface, graph) {
    const { names, parents, at } = data.rig;
    Object.assign(this, { surface, graph, names, parents, at, joint: data.rig_joint, weight: data.rig_weight });
    this.rest = surface.position.slice();
    this.nodeRest = graph.position.slice();
    this.turns = names.map(() => ({ axis: 'x', angle: 0 }));
    this.nodeWeights = this.meanWeights(data.node_of_vertex);
  }

  // Of each node what its vertices follow on average; nodes without vertices follow their neighbours. Then neighbours
  // are averaged, so that the skeleton bends smoothly.
  meanWeights(nodeOfVertex) {
    const joints = this.names.length, count = this.graph.nodeCount, own = n => sums.subarray(joints * n, joints * (n + 1));
    let sums = new Float32Array(joints * count);
    const known = new Uint8Array(count);
    nodeOfVertex.forEach((node, v) => {
      if (node < 0) return;
      known[node] = 1;
      for (let k = 4 * v; k < 4 * v + 4; ++k) sums[joints * node + this.joint[k]] += this.weight[k];
    });
    const scale = weights => { const sum = weights.reduce((a, b) => a + b, 0) || 1; weights.forEach((w, j) => { weights[j] = w / sum; }); };
    for (let n = 0; n < count; ++n) scale(own(n));
    const mean = (n, nodes, to) => { for (const m of nodes) own(m).forEach((w, j) => { to[j] += w; }); scale(to); };
    for (let open = [...known.keys()].filter(n => !known[n]), left; open.length > 0; open = left) {
      const found = open.map(n => this.graph.neighbours[n].map(x => x.node).filter(m => known[m]));
      left = open.filter((n, i) => found[i].length === 0);
      if (left.length === open.length) { for (const n of left) own(n)[0] = 1; break; }
      open.forEach((n, i) => { if (found[i].length > 0) mean(n, found[i], own(n)); });
      open.forEach((n, i) => { if (found[i].length > 0) known[n] = 1; });
    }
    for (let round = 0; round < kSmoothing; ++round) {
      const next = new Float32Array(sums.length);
      for (let n = 0; n < count; ++n) mean(n, [n, ...this.graph.neighbours[n].map(x => x.node)], next.subarray(joints * n, joints * (n + 1)));
      sums = next;
    }
    return Array.from({ length: count }, (_, n) => Array.from(own(n).entries()).filter(([, w]) => w > 0));
  }

  /** Turns a joint, and what hangs on it, from how it was at rest; others stay as they are turned. */
  turn(joint, axis, angle) {
    this.turns[joint] = { axis, angle };
    this.move();
  }

  straighten() {
    this.turns = this.names.map(() => ({ axis: 'x', angle: 0 }));
    this.move();
  }

  /** The joint that a vertex follows most. */
  strongest(vertex) { return this.joint[4 * vertex]; }

  poses() {
    const poses = [];
    this.parents.forEach((parent, j) => {
      const { axis, angle } = this.turns[j], own = rotation(kAxes[axis], angle);
      if (parent < 0) { poses.push({ turn: own, at: this.at[j] }); return; }
      const above = poses[parent], step = applied(above.turn, this.at[j].map((x, k) => x - this.at[parent][k]));
      poses.push({ turn: product(above.turn, own), at: step.map((x, k) => x + above.at[k]) });
    });
    // p -> turn p + shift
    return poses.map(({ turn, at }, j) => ({ turn, shift: applied(turn, this.at[j]).map((x, k) => at[k] - x) }));
  }

  move() {
    const poses = this.poses();
    const place = (rest, to, i, weights) => {
      let x = 0, y = 0, z = 0;
      for (const [j, w] of weights) {
        const { turn: m, shift } = poses[j], a = rest[3 * i], b = rest[3 * i + 1], c = rest[3 * i + 2];
        x += w * (m[0] * a + m[1] * b + m[2] * c + shift[0]);
        y += w * (m[3] * a + m[4] * b + m[5] * c + shift[1]);
        z += w * (m[6] * a + m[7] * b + m[8] * c + shift[2]);
      }
      to[3 * i] = x; to[3 * i + 1] = y; to[3 * i + 2] = z;
    };
    const weights = Array.from({ length: 4 }, () => [0, 0]);
    for (let v = 0; v < this.surface.vertexCount; ++v) {
      for (let k = 0; k < 4; ++k) { weights[k][0] = this.joint[4 * v + k]; weights[k][1] = this.weight[4 * v + k]; }
      place(this.rest, this.surface.position, v, weights);
    }
    this.nodeWeights.forEach((own, n) => place(this.nodeRest, this.graph.position, n, own));
    this.surface.normal.set(this.surface.vertexNormals());
  }
}
