// Round-ended tubes between two points each, all in one draw: skeleton edges, nodes (both ends in one place), contours.
import {
  BufferAttribute, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, ShaderMaterial, Vector2,
} from 'three';

// Sides, and rings as places along the axis with the end that they belong to. A line of few pixels shows no more of it.
const kLine = { sides: 5, rings: [[-1, 0], [0, 0], [0, 1], [1, 1]] };
const kRound = { sides: 8, rings: [[-1, 0], [-0.7, 0], [0, 0], [0, 1], [0.7, 1], [1, 1]] };

// Each vertex is a direction in the tube's frame (across, across, along) and the end that it belongs to.
function capsule({ sides, rings }) {
  const direction = [], end = [], index = [];
  for (const [along, e] of rings) {
    const across = Math.sqrt(1 - along * along);
    for (let i = 0; i < sides; ++i) {
      const angle = 2 * Math.PI * i / sides;
      direction.push(across * Math.cos(angle), across * Math.sin(angle), along);
      end.push(e);
    }
  }
  for (let r = 0; r + 1 < rings.length; ++r) {
    for (let i = 0; i < sides; ++i) {
      const a = r * sides + i, b = r * sides + (i + 1) % sides;
      index.push(a, b, b + sides, a, b + sides, a + sides);
    }
  }
  return { direction: new Float32Array(direction), end: new Float32Array(end), index };
}

const kVertex = /* glsl */`
in vec3 direction; in float end;
in vec3 from; in vec3 to; in vec2 radius; in vec3 fromColor; in vec3 toColor; in float width;
uniform float pixel;      // what a pixel is at distance 1
uniform bool truth;       // radius in model units; else \`width\` in pixels
out vec3 viewNormal; out vec3 viewPosition; out vec3 color;
invariant gl_Position;
void main() {
  vec3 a = (modelViewMatrix * vec4(from, 1.0)).xyz, b = (modelViewMatrix * vec4(to, 1.0)).xyz;
  vec3 axis = b - a;
  float size = length(axis);
  axis = size > 1e-9 ? axis / size : vec3(0.0, 0.0, 1.0);
  vec3 u = normalize(abs(axis.x) < 0.7 ? cross(axis, vec3(1.0, 0.0, 0.0)) : cross(axis, vec3(0.0, 1.0, 0.0)));
  vec3 v = cross(axis, u);
  vec3 centre = mix(a, b, end);
  float dot = pixel * max(-centre.z, 0.0), ball = mix(radius.x, radius.y, end);
  // A line stays within its ball, as far as it still shows.
  float r = truth ? ball : min(0.5 * width * dot, ball > 0.0 ? max(0.8 * ball, 1.2 * dot) : 1e9);
  viewNormal = direction.x * u + direction.y * v + direction.z * axis;
  viewPosition = centre + r * viewNormal;
  color = mix(fromColor, toColor, end);
  gl_Position = projectionMatrix * vec4(viewPosition, 1.0);
}`;

const kFragment = /* glsl */`
precision highp float;
in vec3 viewNormal; in vec3 viewPosition; in vec3 color;
uniform float opacity; uniform bool flatColor;
out vec4 fragment;
void main() {
  vec3 n = normalize(viewNormal);
  float light = 0.72 + 0.34 * dot(n, normalize(vec3(0.25, 0.55, 0.8)));
  float rim = pow(1.0 - abs(dot(n, normalize(-viewPosition))), 2.0);
  fragment = vec4(flatColor ? color : color * light, opacity < 1.0 ? mix(opacity, 1.0, 0.7 * rim) : 1.0);
}`;

export class Tubes {
  /** `options`: truth, opacity, overlay (drawn over everything), flat, line (but few pixels wide), order. */
  constructor({ truth = false, opacity = 1, overlay = false, flat = false, line = false, order = 0 } = {}) {
    const { direction, end, index } = capsule(line ? kLine : kRound);
    this.geometry = new InstancedBufferGeometry();
    this.geometry.setAttribute('direction', new BufferAttribute(direction, 3));
    this.geometry.setAttribute('end', new BufferAttribute(end, 1));
    this.geometry.setIndex(index);
    this.material = new ShaderMaterial({
      glslVersion: GLSL3, vertexShader: kVertex, fragmentShader: kFragment,
      transparent: opacity < 1 || overlay, depthTest: !overlay, depthWrite: opacity >= 1 && !overlay,
      uniforms: { pixel: { value: 0.001 }, truth: { value: truth }, opacity: { value: opacity }, flatColor: { value: flat } },
    });
    this.meshes = [this.material];
    if (opacity < 1) {
      // Depth alone comes first, so that of tubes within each other only the nearest shows.
      const depth = this.material.clone();
      Object.assign(depth, { colorWrite: false, depthWrite: true });
      this.meshes = [depth, this.material];
    }
    this.meshes = this.meshes.map((material, i) => {
      const mesh = new Mesh(this.geometry, material);
      mesh.frustumCulled = false;
      mesh.renderOrder = order + i;
      mesh.visible = false;
      mesh.onBeforeRender = (renderer, _, camera) => {
        const height = renderer.getSize(new Vector2()).y;
        material.uniforms.pixel.value = 2 * Math.tan(camera.fov * Math.PI / 360) / height;
        material.uniformsNeedUpdate = true;
      };
      return mesh;
    });
    this.set([]);
  }

  /** Each: {from, to, radius: [a, b], color: [rgb, rgb] as bytes, width: pixels}. */
  set(pieces) {
    const n = pieces.length;
    const from = new Float32Array(3 * n), to = new Float32Array(3 * n), radius = new Float32Array(2 * n), width = new Float32Array(n);
    const fromColor = new Uint8Array(3 * n), toColor = new Uint8Array(3 * n);
    pieces.forEach((piece, i) => {
      from.set(piece.from, 3 * i);
      to.set(piece.to, 3 * i);
      radius.set(piece.radius ?? [0, 0], 2 * i);
      fromColor.set(piece.color[0], 3 * i);
      toColor.set(piece.color[1], 3 * i);
      width[i] = piece.width ?? 4;
    });
    const put = (name, array, size, bytes = false) => this.geometry.setAttribute(name, new InstancedBufferAttribute(array, size, bytes));
    this.geometry.dispose();
    put('from', from, 3);
    put('to', to, 3);
    put('radius', radius, 2);
    put('fromColor', fromColor, 3, true);
    put('toColor', toColor, 3, true);
    put('width', width, 1);
    this.geometry.instanceCount = n;
    this.empty = n === 0;
  }

  show(on) { for (const mesh of this.meshes) mesh.visible = on && !this.empty; }
}
