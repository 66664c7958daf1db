// The surface: normals, the face beneath the pointer, and the slice through a vertex.

export class Surface {
  constructor(data) {
    this.position = data.position;
    this.face = data.face;
    this.vertexCount = this.position.length / 3;
    this.faceCount = this.face.length / 3;
    this.normal = this.vertexNormals();
    this.twin = null;
  }

  // Weighted by face area.
  vertexNormals() {
    const p = this.position, normal = new Float32Array(p.length);
    for (let i = 0; i < this.face.length; i += 3) {
      const a = 3 * this.face[i], b = 3 * this.face[i + 1], c = 3 * this.face[i + 2];
      const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
      const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
      const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
      for (const v of [a, b, c]) for (let k = 0; k < 3; ++k) normal[v + k] += n[k];
    }
    for (let v = 0; v < normal.length; v += 3) {
      const length = Math.hypot(normal[v], normal[v + 1], normal[v + 2]) || 1;
      for (let k = 0; k < 3; ++k) normal[v + k] /= length;
    }
    return normal;
  }

  /** The first face that the ray meets from in front: {face, vertex, distance}, the vertex being the nearest corner. */
  cast(origin, direction) {
    const p = this.position, [ox, oy, oz] = origin, [dx, dy, dz] = direction;
    let best = Infinity, face = -1;
    for (let i = 0; i < this.face.length; i += 3) {
      const a = 3 * this.face[i], b = 3 * this.face[i + 1], c = 3 * this.face[i + 2];
      const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
      const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
      const hx = dy * vz - dz * vy, hy = dz * vx - dx * vz, hz = dx * vy - dy * vx;
      const det = ux * hx + uy * hy + uz * hz;
      if (det <= 1e-14) continue;
      const sx = ox - p[a], sy = oy - p[a + 1], sz = oz - p[a + 2];
      const s = (sx * hx + sy * hy + sz * hz) / det;
      if (s < 0 || s > 1) continue;
      const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
      const t = (dx * qx + dy * qy + dz * qz) / det;
      if (t < 0 || s + t > 1) continue;
      const far = (vx * qx + vy * qy + vz * qz) / det;
      if (far > 0 && far < best) { best = far; face = i / 3; }
    }
    if (face < 0) return null;
    const hit = origin.map((x, k) => x + best * direction[k]);
    const away = v => Math.hypot(...hit.map((x, k) => x - p[3 * v + k]));
    const corners = Array.from(this.face.subarray(3 * face, 3 * face + 3)).sort((a, b) => away(a) - away(b));
    return { face, vertex: corners[0], distance: best };
  }

  // The half-edge 3f + k runs from corner k of face f to the next one.
  buildTwins() {
    const face = this.face, count = face.length, begin = new Int32Array(this.vertexCount + 1);
    for (let h = 0; h < count; ++h) ++begin[face[h] + 1];
    for (let v = 0; v < this.vertexCount; ++v) begin[v + 1] += begin[v];
    this.outgoing = new Int32Array(count);
    const at = begin.slice();
    for (let h = 0; h < count; ++h) this.outgoing[at[face[h]]++] = h;
    this.outgoingBegin = begin;
    this.twin = new Int32Array(count).fill(-1);
    for (let h = 0; h < count; ++h) {
      const a = face[h], b = face[next(h)];
      for (let i = begin[b]; i < begin[b + 1]; ++i) if (face[next(this.outgoing[i])] === a) { this.twin[h] = this.outgoing[i]; break; }
    }
  }

  /**
   * The shortest closed contour through the vertex in the plane with this normal that bounds material: {points,
   * perimeter}; null if there is none.
   */
  slice(vertex, normal) {
    if (this.twin === null) this.buildTwins();
    const p = this.position, n = normal;
    const height = v => n[0] * (p[3 * v] - p[3 * vertex]) + n[1] * (p[3 * v + 1] - p[3 * vertex + 1]) + n[2] * (p[3 * v + 2] - p[3 * vertex + 2]);
    const positive = v => v === vertex || height(v) >= 0;
    let best = null;
    for (let i = this.outgoingBegin[vertex]; i < this.outgoingBegin[vertex + 1]; ++i) {
      const start = this.twin[this.outgoing[i]];
      if (start < 0 || positive(this.face[start])) continue;
      const contour = this.walk(start, height, positive, vertex, n);
      if (contour && contour.area > 0 && (best === null || contour.perimeter < best.perimeter)) best = contour;
    }
    return best;
  }

  // From half-edge to half-edge, each from the negative side to the positive one, as slice/trace_contour.h does.
  walk(start, height, positive, vertex, n) {
    const points = [], p = this.position, face = this.face;
    for (let h = start, steps = 0; steps < face.length; ++steps) {
      const a = face[h], b = face[next(h)], low = height(a), high = b === vertex ? 0 : height(b);
      const t = high > low ? Math.min(1, Math.max(0, low / (low - high))) : 1;
      points.push([0, 1, 2].map(k => p[3 * a + k] + t * (p[3 * b + k] - p[3 * a + k])));
      h = this.twin[positive(face[previous(h)]) ? previous(h) : next(h)];
      if (h < 0) return null;
      if (h === start) return measureContour(points, n);
    }
    return null;
  }
}

function next(h) { return h % 3 === 2 ? h - 2 : h + 1; }
function previous(h) { return h % 3 === 0 ? h + 2 : h - 1; }

// The walk keeps the surface's outside on its right, so that it runs clockwise round material.
function measureContour(points, n) {
  let perimeter = 0, area = 0;
  const o = points[0];
  points.forEach((a, i) => {
    const b = points[(i + 1) % points.length];
    const u = a.map((x, k) => x - o[k]), v = b.map((x, k) => x - o[k]);
    perimeter += Math.hypot(...a.map((x, k) => x - b[k]));
    area -= 0.5 * (n[0] * (u[1] * v[2] - u[2] * v[1]) + n[1] * (u[2] * v[0] - u[0] * v[2]) + n[2] * (u[0] * v[1] - u[1] * v[0]));
  });
  return { points, perimeter, area };
}
