// What is drawn: layers, colours, what is picked or measured. Draws only when something changes.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, MeshBasicMaterial, Scene, ShapeUtils, Vector2, Vector3, WebGLRenderer } from 'three';
import { View } from './camera.js';
import { Ghost, SkeletonMesh } from './ghost.js';
import { Tubes } from './tubes.js';

const kOrder = { inside: 0, ball: 3, ghost: 10, slice: 15, over: 20 };
export const kAccent = [240, 120, 20], kMark = [225, 40, 60];
const kHover = [255, 255, 255];
const kSlow = 50, kRest = 150;  // milliseconds a frame; without movement before all is drawn finely again
const kJoined = 3;  // edges of a branch

// Without a graphics card every sample of a pixel costs processor time, so that smooth edges halve the frame rate.
function drawsInSoftware() {
  const context = document.createElement('canvas').getContext('webgl2');
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  const software = !!names && /swiftshader|llvmpipe|software/i.test(context.getParameter(names.UNMASKED_RENDERER_WEBGL));
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return software;
}

export class Stage {
  constructor(canvas, data, surface, graph) {
    Object.assign(this, { canvas, surface, graph, frames: 0, pending: false });
    this.layers = { surface: true, skeleton: true, radius: false, mesh: false, slice: true, marks: true };
    this.software = drawsInSoftware();
    Object.assign(this, { slow: this.software, pace: 0, time: 0, moves: false, hasty: false, rest: 0 });
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.software, powerPreference: 'high-performance' });
    this.scene = new Scene();
    this.view = new View(canvas, data, () => this.draw());
    this.ghost = new Ghost(surface, kOrder.ghost);
    this.skeletonMesh = data.skeleton_mesh && new SkeletonMesh(data.skeleton_mesh, surface, kOrder.inside);
    this.lines = new Tubes({ line: true, order: kOrder.inside });
    this.hastyLines = new Tubes({ line: true, order: kOrder.inside });
    this.knots = new Tubes({ order: kOrder.inside });
    this.balls = new Tubes({ truth: true, opacity: 0.3, order: kOrder.ball });
    this.contour = new Tubes({ overlay: true, flat: true, order: kOrder.slice + 1 });
    this.way = new Tubes({ overlay: true, flat: true, order: kOrder.over });
    this.marks = new Tubes({ overlay: true, flat: true, order: kOrder.over + 1 });
    this.disc = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ color: new Color(0xf07814), opacity: 0.28, transparent: true, side: DoubleSide, depthTest: false, depthWrite: false }));
    this.disc.renderOrder = kOrder.slice;
    this.disc.visible = false;
    const tubes = [this.lines, this.hastyLines, this.knots, this.balls, this.contour, this.way, this.marks];
    this.scene.add(...this.ghost.meshes, ...tubes.flatMap(t => t.meshes), this.disc);
    if (this.skeletonMesh) this.scene.add(this.skeletonMesh.mesh);
    this.picked = { branch: -1, hover: -1, node: -1 };
    const observer = new ResizeObserver(() => this.resize());
    for (const changing of [canvas.parentElement, ...['title', 'card', 'legend'].map(id => document.getElementById(id))]) observer.observe(changing);
    this.resize();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(this.software ? 1 : Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.view.resize(width, height, this.covered(width, height));
    this.draw();
  }

  /** Strips of the canvas that the page's title, card and legend cover, where they span its width. */
  covered(width, height) {
    const strips = { top: 0, bottom: 0 }, origin = this.canvas.getBoundingClientRect().top;
    for (const id of ['title', 'card', 'legend']) {
      const { left, right, top, bottom } = document.getElementById(id).getBoundingClientRect();
      if (right - left < 0.9 * width) continue;
      if (id === 'title') strips.top = bottom - origin;
      else strips.bottom = Math.max(strips.bottom, height - (top - origin));
    }
    return strips;
  }

  background(css) { this.renderer.setClearColor(new Color(css), 1); this.draw(); }

  draw() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(time => {
      this.pending = false;
      if (this.view.update()) this.draw();
      this.hurry(time);
      this.renderer.render(this.scene, this.view.camera);
      ++this.frames;
    });
  }

  /** While the view moves too slowly, a coarser surface and skeleton are drawn; the fine ones come back when it rests. */
  hurry(time) {
    const moves = this.view.moved();
    if (moves && this.moves) this.pace += 0.3 * (time - this.time - this.pace);
    if (this.pace > kSlow) this.slow = true;
    Object.assign(this, { moves, time });
    if (this.hasty !== (moves && this.slow)) {
      this.hasty = moves && this.slow;
      this.ghost.haste(this.hasty);
      this.showLines();
    }
    if (!this.hasty) return;
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.draw(), kRest);
  }

  show(layer, on) {
    this.layers[layer] = on;
    this.apply();
  }

  apply() {
    const on = this.layers;
    this.ghost.show(on.surface);
    this.skeletonMesh?.show(on.mesh);
    this.showLines();
    this.knots.show(on.skeleton);
    this.balls.show(on.radius);
    this.contour.show(on.slice);
    this.disc.visible = on.slice && !this.contour.empty;
    this.way.show(true);
    this.marks.show(on.marks);
    this.draw();
  }

  showLines() {
    this.lines.show(this.layers.skeleton && !this.hasty);
    this.hastyLines.show(this.layers.skeleton && this.hasty);
  }

  paint(painter, mode) {
    this.nodeColors = painter.paint(mode, 'node', this.graph.nodeCount);
    this.painter = painter;
    this.mode = mode;
    const vertexColors = painter.paint(mode, 'vertex', this.surface.vertexCount);
    this.ghost.paint(vertexColors);
    this.skeletonMesh?.paint(vertexColors);
    this.layTubes();
    this.apply();
  }

  /** After the surface's and the skeleton's positions have changed. */
  moved() {
    this.ghost.moved();
    this.layTubes();
    this.apply();
  }

  /** The branch that is picked, the one that is pointed at, the node that is picked; -1: none. */
  pick(picked) {
    Object.assign(this.picked, picked);
    this.layTubes();
    this.apply();
  }

  layTubes() {
    const { graph, picked } = this, lines = [], knots = [], balls = [];
    const at = v => graph.position.subarray(3 * v, 3 * v + 3), nodeColor = v => this.nodeColors.subarray(3 * v, 3 * v + 3);
    for (let e = 0; e < graph.edgeCount; ++e) {
      const a = graph.edge[2 * e], b = graph.edge[2 * e + 1], branch = graph.branchOfEdge[e];
      let color = [0, 1].map(end => this.painter.edgeColor(this.mode, e, this.nodeColors, end));
      if (branch === picked.branch) color = [kAccent, kAccent];
      else if (branch === picked.hover) color = [kHover, kHover];
      const width = branch === picked.branch || branch === picked.hover ? 8 : 5;
      lines[e] = { from: at(a), to: at(b), radius: [graph.radius[a], graph.radius[b]], color, width };
      balls.push({ from: at(a), to: at(b), radius: [graph.radius[a], graph.radius[b]], color });
    }
    for (let v = 0; v < graph.nodeCount; ++v) {
      if (graph.degree(v) !== 2 || this.mode.id === 'node' || v === picked.node)
        knots.push({ from: at(v), to: at(v), color: v === picked.node ? [kAccent, kAccent] : [nodeColor(v), nodeColor(v)], width: v === picked.node ? 15 : graph.degree(v) === 2 ? 8 : 10 });
      if (graph.degree(v) === 0) balls.push({ from: at(v), to: at(v), radius: [graph.radius[v], graph.radius[v]], color: [nodeColor(v), nodeColor(v)] });
    }
    this.lines.set(lines);
    this.hastyLines.set(this.longer(lines));
    this.knots.set(knots);
    this.balls.set(balls);
  }

  /** The lines of the edges, joined along each branch to longer ones. */
  longer(lines) {
    const { graph } = this, longer = [];
    // What a line of the edge has at this node of it.
    const at = (edge, node) => { const line = lines[edge], k = graph.edge[2 * edge] === node ? 0 : 1; return { place: k === 0 ? line.from : line.to, radius: line.radius[k], color: line.color[k], width: line.width }; };
    for (const { nodes, edges } of graph.branches) {
      for (let i = 0; i < edges.length; i += kJoined) {
        const last = Math.min(i + kJoined, edges.length), a = at(edges[i], nodes[i]), b = at(edges[last - 1], nodes[last]);
        longer.push({ from: a.place, to: b.place, radius: [a.radius, b.radius], color: [a.color, b.color], width: a.width });
      }
    }
    return longer;
  }

  /** A closed contour with its plane's normal and the vertex that it goes through; null: none. */
  showSlice(points, normal, through) {
    const color = [kAccent, kAccent], pieces = [];
    (points ?? []).forEach((from, i) => pieces.push({ from, to: points[(i + 1) % points.length], color, width: 3.5 }));
    if (through) pieces.push({ from: through, to: through, color, width: 11 });
    this.contour.set(pieces);
    if (points) this.fillDisc(points, normal);
    else this.disc.geometry.setIndex([]);
    this.apply();
  }

  fillDisc(points, normal) {
    const n = new Vector3(...normal), u = new Vector3(Math.abs(n.x) < 0.7 ? 1 : 0, Math.abs(n.x) < 0.7 ? 0 : 1, 0).cross(n).normalize(), v = n.clone().cross(u);
    const flat = points.map(p => new Vector2(u.dot(new Vector3(...p)), v.dot(new Vector3(...p))));
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(points.flat()), 3));
    geometry.setIndex(ShapeUtils.triangulateShape(flat, []).flat());
    this.disc.geometry.dispose();
    this.disc.geometry = geometry;
  }

  showWay(ends, points) {
    const color = [kAccent, kAccent], pieces = ends.map(at => ({ from: at, to: at, color, width: 15 }));
    for (let i = 0; i + 1 < points.length; ++i) pieces.push({ from: points[i], to: points[i + 1], color, width: 6 });
    this.way.set(pieces);
    this.apply();
  }

  showMarks(positions) {
    this.marks.set(positions.map(at => ({ from: at, to: at, color: [kMark, kMark], width: 11 })));
    this.apply();
  }

  /** Pixels from the canvas's upper left corner, and whether the point is before the camera. */
  project(at) {
    const p = new Vector3(...at).project(this.view.camera);
    return { x: (p.x + 1) / 2 * this.canvas.clientWidth, y: (1 - p.y) / 2 * this.canvas.clientHeight, seen: p.z > -1 && p.z < 1 };
  }

  ray(x, y) {
    const camera = this.view.camera;
    camera.updateMatrixWorld();
    const through = new Vector3(2 * x / this.canvas.clientWidth - 1, 1 - 2 * y / this.canvas.clientHeight, 0.5).unproject(camera);
    const direction = through.sub(camera.position).normalize();
    return { origin: camera.position.toArray(), direction: direction.toArray() };
  }

  /** The point of the skeleton within so many pixels; null if there is none. */
  skeletonAt(x, y, reach) {
    if (!this.layers.skeleton) return null;
    const { graph } = this, screen = [];
    for (let v = 0; v < graph.nodeCount; ++v) screen.push(this.project(graph.position.subarray(3 * v, 3 * v + 3)));
    let best = reach, found = null;
    for (let e = 0; e < graph.edgeCount; ++e) {
      const a = screen[graph.edge[2 * e]], b = screen[graph.edge[2 * e + 1]];
      if (!a.seen || !b.seen) continue;
      const dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
      const t = square > 0 ? Math.min(1, Math.max(0, ((x - a.x) * dx + (y - a.y) * dy) / square)) : 0;
      const away = Math.hypot(a.x + t * dx - x, a.y + t * dy - y);
      if (away < best) { best = away; found = graph.pointAt(e, t); }
    }
    screen.forEach((s, v) => {
      if (graph.degree(v) === 0 && s.seen && Math.hypot(s.x - x, s.y - y) < best) found = graph.pointAtNode(v);
    });
    return found;
  }

  surfaceAt(x, y) {
    if (!this.layers.surface) return null;
    const { origin, direction } = this.ray(x, y);
    return this.surface.cast(origin, direction);
  }
}
