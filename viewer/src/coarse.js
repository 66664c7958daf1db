// A coarser copy of a surface, for frames that have to be quick.

/**
 * About so many vertices: those in one cell of a grid become one, in their middle. {position, normal, face, from}; `from` has
 * for each vertex of the surface the one that it became.
 */
export function coarsened(surface, vertices) {
  const p = surface.position, cell = Math.sqrt(area(surface) / vertices), cells = new Map();
  const from = new Int32Array(surface.vertexCount), key = x => Math.floor(x / cell) + 32768;
  for (let v = 0; v < from.length; ++v) {
    const at = (key(p[3 * v]) * 65536 + key(p[3 * v + 1])) * 65536 + key(p[3 * v + 2]);
    if (!cells.has(at)) cells.set(at, cells.size);
    from[v] = cells.get(at);
  }
  const position = averaged(p, from, cells.size, 3), normal = averaged(surface.normal, from, cells.size, 3);
  for (let v = 0; v < normal.length; v += 3) {
    const length = Math.hypot(normal[v], normal[v + 1], normal[v + 2]) || 1;
    for (let k = 0; k < 3; ++k) normal[v + k] /= length;
  }
  const face = [];
  for (let i = 0; i < surface.face.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map(k => from[surface.face[i + k]]);
    if (a !== b && b !== c && c !== a) face.push(a, b, c);
  }
  return { position, normal, face: Uint32Array.from(face), from };
}

/** The means of `width` values a vertex over the vertices that became one. */
export function averaged(values, from, count, width) {
  const sum = new Float32Array(width * count), share = new Float32Array(count);
  for (let v = 0; v < from.length; ++v) {
    ++share[from[v]];
    for (let k = 0; k < width; ++k) sum[width * from[v] + k] += values[width * v + k];
  }
  for (let i = 0; i < sum.length; ++i) sum[i] /= share[Math.floor(i / width)];
  return sum;
}

function area(surface) {
  const p = surface.position;
  let sum = 0;
  for (let i = 0; i < surface.face.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map(k => 3 * surface.face[i + k]);
    const u = [0, 1, 2].map(k => p[b + k] - p[a + k]), v = [0, 1, 2].map(k => p[c + k] - p[a + k]);
    sum += Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
  }
  return sum;
}
