// The surface as a ghost: its front alone, clearer where one looks straight through it; and the skeleton mesh.
import { BufferAttribute, BufferGeometry, DoubleSide, FrontSide, GLSL3, Mesh, ShaderMaterial } from 'three';
import { averaged, coarsened } from './coarse.js';

const kVertex = /* glsl */`
in vec3 tint;
out vec3 viewNormal; out vec3 viewPosition; out vec3 color;
invariant gl_Position;
void main() {
  vec4 p = modelViewMatrix * vec4(position, 1.0);
  viewPosition = p.xyz;
  viewNormal = normalMatrix * normal;
  color = tint;
  gl_Position = projectionMatrix * p;
}`;

// Where the face and the smooth normal differ by a sharp edge, the face's own normal is right.
const kFragment = /* glsl */`
precision highp float;
in vec3 viewNormal; in vec3 viewPosition; in vec3 color;
uniform float opacity; uniform bool creased;
out vec4 fragment;
void main() {
  vec3 face = normalize(cross(dFdx(viewPosition), dFdy(viewPosition)));
  vec3 smoothed = normalize(viewNormal);
  vec3 n = creased || dot(face, smoothed) < 0.8 ? face : smoothed;
  float light = 0.66 + 0.4 * dot(n, normalize(vec3(0.25, 0.55, 0.8)));
  float rim = pow(1.0 - abs(dot(n, normalize(-viewPosition))), 2.2);
  fragment = vec4(color * light, mix(opacity, 1.0, opacity >= 1.0 ? 1.0 : 0.75 * rim));
}`;

function material(options, opacity, creased) {
  return new ShaderMaterial({
    glslVersion: GLSL3, vertexShader: kVertex, fragmentShader: kFragment,
    uniforms: { opacity: { value: opacity }, creased: { value: creased } }, ...options,
  });
}

function geometry(position, normal, face) {
  const made = new BufferGeometry();
  made.setAttribute('position', new BufferAttribute(position, 3));
  made.setAttribute('normal', new BufferAttribute(normal, 3));
  made.setAttribute('tint', new BufferAttribute(new Uint8Array(position.length), 3, true));
  made.setIndex(new BufferAttribute(new Uint32Array(face.buffer, face.byteOffset, face.length), 1));
  return made;
}

function paint(made, bytes) {
  made.getAttribute('tint').array.set(bytes);
  made.getAttribute('tint').needsUpdate = true;
}

// Vertices of the coarser surface, and how many more the surface must have for it to be worth while.
const kCoarse = 2500, kWorthWhile = 2;

/**
 * Drawn after everything that lies inside, twice: depth alone, then colour where it is the nearest. In haste a coarser surface
 * stands in for a fine one.
 */
export class Ghost {
  constructor(surface, order) {
    this.geometry = geometry(surface.position, surface.normal, surface.face);
    this.surface = surface;
    this.colors = null;
    this.coarse = null;
    this.hasty = false;
    this.depth = new Mesh(this.geometry, material({ side: FrontSide, colorWrite: false, transparent: true }, 1, false));
    this.front = new Mesh(this.geometry, material({ side: FrontSide, transparent: true, depthWrite: false }, 0.3, false));
    this.depth.renderOrder = order;
    this.front.renderOrder = order + 1;
    this.meshes = [this.depth, this.front];
  }
  paint(bytes) {
    paint(this.geometry, bytes);
    this.colors = bytes.slice();
    if (this.coarse) this.paintCoarse();
  }
  paintCoarse() { paint(this.coarse, averaged(this.colors, this.from, this.coarse.getAttribute('position').count, 3)); }
  haste(on) {
    const wanted = on && this.surface.vertexCount > kWorthWhile * kCoarse;
    if (wanted === this.hasty) return;
    if (wanted && !this.coarse) {
      const made = coarsened(this.surface, kCoarse);
      this.coarse = geometry(made.position, made.normal, made.face);
      this.from = made.from;
      this.paintCoarse();
    }
    this.hasty = wanted;
    for (const mesh of this.meshes) mesh.geometry = wanted ? this.coarse : this.geometry;
  }
  /** After the surface's positions and normals have changed. */
  moved() {
    for (const name of ['position', 'normal']) this.geometry.getAttribute(name).needsUpdate = true;
    const hasty = this.hasty;
    this.haste(false);
    this.coarse = null;  // of the surface as it was
    this.haste(hasty);
  }
  opacity(value) { this.front.material.uniforms.opacity.value = value; }
  show(on) { for (const mesh of this.meshes) mesh.visible = on; }
}

export class SkeletonMesh {
  constructor(position, surface, order) {
    this.geometry = geometry(position, surface.normal, surface.face);
    this.mesh = new Mesh(this.geometry, material({ side: DoubleSide }, 1, true));
    this.mesh.renderOrder = order;
    this.mesh.visible = false;
  }
  paint(bytes) { paint(this.geometry, bytes); }
  show(on) { this.mesh.visible = on; }
}
