// Where one looks from: turning, moving and nearing by mouse, touch and keys, and the view that shows everything.
import { MOUSE, PerspectiveCamera, TOUCH, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const kAzimuth = 35 * Math.PI / 180, kElevation = 18 * Math.PI / 180;

export class View {
  constructor(canvas, data, changed) {
    this.camera = new PerspectiveCamera(32, 1, 0.01, 20);
    this.up = new Vector3(...data.up);
    this.right = new Vector3(...data.right);
    this.toward = new Vector3().crossVectors(this.right, this.up);
    this.camera.up.copy(this.up);
    this.points = thinned(data.position, 3000);
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, { enableDamping: true, dampingFactor: 0.12, rotateSpeed: 0.9, minDistance: 0.02, maxDistance: 30 });
    this.controls.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    this.controls.touches = { ONE: TOUCH.ROTATE, TWO: TOUCH.DOLLY_PAN };
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', changed);
    this.untouched = true;
    this.seen = 1;
    // A click that moves nothing leaves it untouched.
    let before = null;
    this.controls.addEventListener('start', () => { before = this.camera.position.clone(); });
    this.controls.addEventListener('end', () => { if (before && !before.equals(this.camera.position)) this.untouched = false; });
  }

  /** `covered`: pixels at the top and the bottom where something lies over the canvas; the model is shown between. */
  resize(width, height, covered) {
    this.camera.aspect = width / height;
    this.seen = Math.max(0.2, 1 - (covered.top + covered.bottom) / height);
    this.camera.setViewOffset(width, height, 0, (covered.bottom - covered.top) / 2, width, height);
    if (this.untouched) this.reset();
    else this.camera.updateProjectionMatrix();
  }

  /** True while the view still moves. Near and far planes close round the model, so that depth is fine. */
  update() {
    const moving = this.controls.update();
    const away = this.camera.position.length();
    this.camera.near = Math.max(away - 1.3, 0.004);
    this.camera.far = away + 1.3;
    this.camera.updateProjectionMatrix();
    return moving;
  }

  /** Whether it looks another way than when this was asked last. */
  moved() {
    const seen = [...this.camera.position.toArray(), ...this.camera.quaternion.toArray()];
    const moved = this.last !== undefined && seen.some((x, i) => Math.abs(x - this.last[i]) > 1e-6);
    this.last = seen;
    return moved;
  }

  reset() {
    const level = new Vector3().addScaledVector(this.toward, Math.cos(kAzimuth)).addScaledVector(this.right, Math.sin(kAzimuth));
    this.lookAlong(level.multiplyScalar(Math.cos(kElevation)).addScaledVector(this.up, Math.sin(kElevation)), this.points);
    this.untouched = true;
  }

  /** So that all of the points show, seen from `direction`. */
  lookAlong(direction, points) {
    const z = direction.clone().normalize(), x = new Vector3().crossVectors(this.up, z).normalize(), y = new Vector3().crossVectors(z, x);
    const across = Math.tan(this.camera.fov * Math.PI / 360), p = new Vector3();
    const centre = new Vector3();
    for (const axis of [x, y, z]) {
      let low = Infinity, high = -Infinity;
      for (const point of points) {
        const at = axis.dot(p.fromArray(point));
        low = Math.min(low, at);
        high = Math.max(high, at);
      }
      centre.addScaledVector(axis, (low + high) / 2);
    }
    let away = 0.05;
    for (const point of points) {
      p.fromArray(point).sub(centre);
      const half = Math.max(Math.abs(p.dot(x)) / this.camera.aspect, Math.abs(p.dot(y)) / this.seen);
      away = Math.max(away, 1.1 * half / across + p.dot(z));
    }
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(z, away);
    this.update();
  }

  /** Nears the points without turning. */
  focus(points) {
    this.untouched = false;
    this.lookAlong(this.camera.position.clone().sub(this.controls.target), points);
  }

  turn(right, up) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(this.up, right);
    const axis = new Vector3().crossVectors(this.up, offset).normalize();
    const turned = offset.clone().applyAxisAngle(axis, -up);
    const polar = turned.angleTo(this.up);
    this.camera.position.copy(this.controls.target).add(polar > 0.05 && polar < Math.PI - 0.05 ? turned : offset);
    this.untouched = false;
    this.update();
  }

  near(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.untouched = false;
    this.update();
  }
}

function thinned(position, most) {
  const count = position.length / 3, step = Math.max(1, Math.floor(count / most)), points = [];
  for (let v = 0; v < count; v += step) points.push(Array.from(position.subarray(3 * v, 3 * v + 3)));
  for (let k = 0; k < 3; ++k) {
    let low = 0, high = 0;
    for (let v = 0; v < count; ++v) {
      if (position[3 * v + k] < position[3 * low + k]) low = v;
      if (position[3 * v + k] > position[3 * high + k]) high = v;
    }
    for (const v of [low, high]) points.push(Array.from(position.subarray(3 * v, 3 * v + 3)));
  }
  return points;
}
