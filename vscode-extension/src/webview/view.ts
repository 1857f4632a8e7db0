// The path in three dimensions, with the tool on it.
import * as three from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/examples/jsm/lines/LineSegmentsGeometry.js';
import type { Machine, Summary } from '../messages';
import { MachineModel } from './machine';
import { type Path, RAPID, START, cuts, kindOf } from './path';

export type Side = 'iso' | 'top' | 'front' | 'right';

const SIDES: Record<Side, [number, number, number]> = { iso: [1, -1, 0.8], top: [0, -1e-4, 1], front: [0, -1, 0], right: [1, 0, 0] };

/** How near a click must be to the path, in pixels. */
const NEAR = 12;

export class View {
  private readonly renderer: three.WebGLRenderer;
  private readonly world = new three.Scene();
  private readonly camera = new three.OrthographicCamera(-1, 1, 1, -1, -1e6, 1e6);
  private readonly controls: OrbitControls;
  private readonly feeds = new three.LineSegments(new three.BufferGeometry(), new three.LineBasicMaterial({ vertexColors: true }));
  private readonly rapids = new three.LineSegments(new three.BufferGeometry(), new three.LineDashedMaterial({ color: 0x8a8a8a, dashSize: 2, gapSize: 1.5 }));
  private readonly other = new three.LineSegments(new three.BufferGeometry(), new three.LineDashedMaterial({ depthWrite: false }));
  private readonly normals = new three.LineSegments(new three.BufferGeometry(), new three.LineBasicMaterial({ color: 0x999933, transparent: true, opacity: 0.8 }));
  private readonly chosen = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 4, depthTest: false }));
  private readonly tool = new three.Group();
  /** All that moves with the part; it stands still unless the machine is shown. */
  private readonly part = new three.Group();
  private model: MachineModel | undefined;
  private machine: { machine: Machine; summary: Summary } | undefined;
  private diameter: number | null = null;
  private withMachine = false;
  private foreground = new three.Color(0x333333);
  private at = 0;
  private path: Path | undefined;
  private size = 1;
  /** The size of what is looked at, mm. */
  private shownSize = 1;
  private shownBox: three.Box3 | undefined;
  private waiting = false;

  constructor(private readonly canvas: HTMLCanvasElement) {
    // colours are drawn as the legend shows them
    three.ColorManagement.enabled = false;
    this.renderer = new three.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.outputColorSpace = three.LinearSRGBColorSpace;
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener('change', () => this.draw());
    this.chosen.renderOrder = 2;
    // where both go the same way, the program is seen
    this.other.renderOrder = -1;
    for (const lines of [this.rapids, this.feeds, this.other, this.normals, this.chosen]) {
      lines.frustumCulled = false;
      this.part.add(lines);
    }
    this.part.add(this.tool);
    this.part.matrixAutoUpdate = false;
    this.world.add(this.part, new three.AmbientLight(0xffffff, 1.2), light(1, -1, 2), light(-1, 1, 1));
    new ResizeObserver(() => this.fitCanvas()).observe(canvas.parentElement!);
  }

  /** The colours of the page, from the theme. */
  theme(background: string, foreground: string): void {
    this.renderer.setClearColor(new three.Color(background));
    this.foreground = new three.Color(foreground);
    this.chosen.material.color = this.foreground;
    (this.other.material as three.LineDashedMaterial).color = this.foreground;
    this.rebuild();
    this.draw();
  }

  /** Shows a path; `fresh`: also looks at all of it. */
  show(path: Path, colours: Float32Array, summary: Summary, fresh: boolean): void {
    this.path = path;
    this.diameter = summary.tool?.diameter ?? null;
    this.machine = summary.machine ? { machine: summary.machine, summary } : undefined;
    this.at = Math.min(this.at, Math.max(path.count - 1, 0));
    const box = new three.Box3().setFromArray(cuts(path));
    this.size = Math.max(box.getSize(new three.Vector3()).length(), 1);
    fill(this.feeds, path, colours, (kind) => kind !== RAPID);
    fill(this.rapids, path, undefined, (kind) => kind === RAPID);
    const dashes = this.rapids.material as three.LineDashedMaterial;
    dashes.dashSize = this.size / 60;
    dashes.gapSize = this.size / 90;
    this.rapids.computeLineDistances();
    this.normals.geometry.setAttribute('position', new three.BufferAttribute(bristles(path, this.size), 3));
    this.rebuild();
    if (fresh) this.look('iso');
    this.draw();
  }

  /** New colours for the same path. */
  paint(colours: Float32Array): void {
    if (this.path) fill(this.feeds, this.path, colours, (kind) => kind !== RAPID);
    this.draw();
  }

  /** A second path over the first; undefined removes it. */
  compare(other: Path | undefined): void {
    if (other && this.path) {
      fill(this.other, other, undefined, (kind) => kind !== RAPID);
      const [from, to] = [other.origin, this.path.origin];
      this.other.position.set(from[0] - to[0], from[1] - to[1], from[2] - to[2]);
      const dashes = this.other.material as three.LineDashedMaterial;
      dashes.dashSize = dashes.gapSize = this.size / 120;
      this.other.computeLineDistances();
    }
    this.other.visible = other !== undefined;
    this.draw();
  }

  toggle(what: 'rapids' | 'normals' | 'tool', on: boolean): void {
    this[what].visible = on;
    this.draw();
  }

  /** Shows the machine, whose axes move the part, or the part alone. Says what is wrong where the machine cannot be drawn. */
  showMachine(on: boolean): void {
    this.withMachine = on;
    this.rebuild();
    this.look('iso');
  }

  /** What a viewer should know of the machine that is drawn. */
  machineRemark(): string | undefined {
    if (!this.withMachine || !this.machine) return undefined;
    if (!this.model?.setUp) return 'The machine is not drawn: the positions of its axes are not known anywhere in this program.';
    const { others } = this.model.setUp;
    if (others > 0) return `At ${others < 0.01 ? 'less than 1' : Math.round(100 * others)} % of the cuts the program uses another tool length or work offset: there the spindle is drawn as for the others.`;
    return undefined;
  }

  private rebuild(): void {
    if (this.model) this.world.remove(this.model.group);
    this.model?.dispose();
    this.model = undefined;
    this.part.matrix.identity();
    this.part.matrixWorldNeedsUpdate = true;
    this.makeTool();
    if (!this.withMachine || !this.machine || !this.path) return;
    this.model = new MachineModel(this.machine.machine, this.path, this.machine.summary, this.size, this.foreground);
    if (this.model.setUp) this.world.add(this.model.group);
    this.model.place(this.at, this.part);
    if (this.model.setUp) this.makeTool(this.model.tool);
  }

  /** Puts the tool on a vertex, or at a share of the way to the next one, and marks the block that leads there. */
  place(from: number, share = 0): void {
    const path = this.path;
    if (!path || from >= path.count) return;
    this.at = from;
    this.model?.place(from, this.part, share);
    const at = share > 0 ? from + 1 : from;
    const between = (values: Float32Array) => new three.Vector3().fromArray(values, 3 * from).lerp(new three.Vector3().fromArray(values, 3 * at), share);
    this.tool.position.copy(between(path.tip));
    this.tool.quaternion.setFromUnitVectors(new three.Vector3(0, 0, 1), between(path.axis).normalize());
    const line = path.line[at];
    let first = at;
    while (first > 0 && kindOf(path, first) !== START && path.line[first - 1] === line) first -= 1;
    let last = at;
    while (last + 1 < path.count && path.line[last + 1] === line && kindOf(path, last + 1) !== START) last += 1;
    if (first > 0 && kindOf(path, first) !== START) first -= 1;
    const points: number[] = [];
    for (let i = first; i < last; i += 1) points.push(...path.tip.subarray(3 * i, 3 * i + 6));
    this.chosen.geometry.dispose();
    this.chosen.geometry = new LineSegmentsGeometry().setPositions(points);
    this.chosen.visible = points.length > 0;
    this.draw();
  }

  /** The vertex nearest to a place on the canvas, if one is near. */
  pick(x: number, y: number): number | undefined {
    const path = this.path;
    if (!path) return undefined;
    const { width, height } = this.canvas.getBoundingClientRect();
    const matrix = new three.Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse).multiply(this.part.matrixWorld);
    const [a, b] = [new three.Vector3(), new three.Vector3()];
    const project = (at: number, into: three.Vector3) => {
      into.fromArray(path.tip, 3 * at).applyMatrix4(matrix);
      into.set((into.x * 0.5 + 0.5) * width, (0.5 - into.y * 0.5) * height, into.z);
    };
    let best: number | undefined;
    let least = NEAR;
    for (let at = 0; at < path.count; at += 1) {
      project(at, b);
      if (at > 0 && kindOf(path, at) !== START && (kindOf(path, at) !== RAPID || this.rapids.visible)) {
        const off = distance(x, y, a, b);
        if (off < least) [least, best] = [off, at];
      }
      a.copy(b);
    }
    return best;
  }

  /** Looks at all of the path from one side. */
  look(side: Side): void {
    const box = new three.Box3();
    let size = this.size;
    if (this.model?.setUp) {
      box.copy(this.model.extent(this.part));
      this.model.place(this.at, this.part);
      size = box.getSize(new three.Vector3()).length();
    } else if (this.path) box.setFromArray(cuts(this.path));
    this.shownSize = size;
    this.shownBox = this.model?.setUp ? box : undefined;
    const centre = box.isEmpty() ? new three.Vector3() : box.getCenter(new three.Vector3());
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).add(new three.Vector3(...SIDES[side]).normalize().multiplyScalar(size));
    this.camera.zoom = 1;
    this.controls.update();
    this.fitCanvas();
  }

  /** Turns and zooms by keys; false for a key that means nothing here. */
  key(key: string): boolean {
    const step = Math.PI / 18;
    const turns: Record<string, [number, number]> = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
    const turn = turns[key];
    if (turn) {
      // Y of spherical coordinates is up
      const off = this.camera.position.clone().sub(this.controls.target);
      const round = new three.Spherical().setFromVector3(new three.Vector3(off.x, off.z, -off.y));
      round.theta += turn[0];
      round.phi += turn[1];
      round.makeSafe();
      const back = new three.Vector3().setFromSpherical(round);
      this.camera.position.copy(this.controls.target).add(new three.Vector3(back.x, -back.z, back.y));
      this.controls.update();
    } else if (key === '+' || key === '=' || key === '-') {
      this.camera.zoom *= key === '-' ? 1 / 1.2 : 1.2;
      this.camera.updateProjectionMatrix();
    } else if (key === 'Home') this.look('iso');
    else return false;
    this.draw();
    return true;
  }

  /** Half of the shorter side of a picture that holds a box as it is seen now. */
  private halfSeen(box: three.Box3, wide: number): number {
    this.camera.updateMatrixWorld();
    const seen = new three.Box3();
    for (const x of [box.min.x, box.max.x]) for (const y of [box.min.y, box.max.y]) for (const z of [box.min.z, box.max.z]) seen.expandByPoint(new three.Vector3(x, y, z).applyMatrix4(this.camera.matrixWorldInverse));
    const [across, high] = [Math.max(-seen.min.x, seen.max.x), Math.max(-seen.min.y, seen.max.y)];
    return 1.05 * (wide > 1 ? Math.max(high, across / wide) : Math.max(across, high * wide));
  }

  private fitCanvas(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement!;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(clientWidth, clientHeight, false);
    const wide = clientWidth / clientHeight;
    const half = this.shownBox ? this.halfSeen(this.shownBox, wide) : this.shownSize * 0.55;
    Object.assign(this.camera, { left: -half * Math.max(wide, 1), right: half * Math.max(wide, 1), top: half / Math.min(wide, 1), bottom: -half / Math.min(wide, 1) });
    this.camera.near = -100 * this.shownSize;
    this.camera.far = 100 * this.shownSize;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** The tool; with a machine it reaches to the spindle. */
  private makeTool(reach?: { length: number; size: number }): void {
    this.tool.clear();
    const size = reach?.size ?? this.size;
    // a tool larger than what is cut would hide it: then, and where none is declared, a slim cone shows tip and axis
    const diameter = this.diameter !== null && this.diameter < 0.4 * size ? this.diameter : null;
    const radius = diameter === null ? size / 150 : diameter / 2;
    const length = reach?.length ?? Math.max(size / 4, 4 * radius);
    const shape = diameter === null ? new three.ConeGeometry(radius * 2, length, 24) : new three.CylinderGeometry(radius, radius, length, 32);
    // a cone whose tip is the tool tip, or a cylinder that stands on it: +Z is away from the part
    if (diameter === null) shape.rotateX(-Math.PI / 2);
    else shape.rotateX(Math.PI / 2);
    shape.translate(0, 0, length / 2);
    this.tool.add(new three.Mesh(shape, new three.MeshPhongMaterial({ color: 0x9aa7b0, transparent: true, opacity: 0.55, side: three.DoubleSide })));
  }

  private draw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.renderer.render(this.world, this.camera);
    });
  }
}

function light(x: number, y: number, z: number): three.DirectionalLight {
  const lamp = new three.DirectionalLight(0xffffff, 1.5);
  lamp.position.set(x, y, z);
  return lamp;
}

/** Joins neighbours of the wanted kind; colours are those of the later one. */
function fill(lines: three.LineSegments, path: Path, colours: Float32Array | undefined, wanted: (kind: number) => boolean): void {
  let count = 0;
  for (let at = 1; at < path.count; at += 1) if (kindOf(path, at) !== START && wanted(kindOf(path, at))) count += 1;
  const positions = new Float32Array(6 * count);
  const painted = colours ? new Float32Array(6 * count) : undefined;
  let next = 0;
  for (let at = 1; at < path.count; at += 1) {
    if (kindOf(path, at) === START || !wanted(kindOf(path, at))) continue;
    positions.set(path.tip.subarray(3 * at - 3, 3 * at + 3), next);
    if (colours && painted) {
      painted.set(colours.subarray(3 * at, 3 * at + 3), next);
      painted.set(colours.subarray(3 * at, 3 * at + 3), next + 3);
    }
    next += 6;
  }
  lines.geometry.dispose();
  lines.geometry = new three.BufferGeometry().setAttribute('position', new three.BufferAttribute(positions, 3));
  if (painted) lines.geometry.setAttribute('color', new three.BufferAttribute(painted, 3));
}

/** Short lines along the tool axis at some of the cuts, evenly along the path. */
function bristles(path: Path, size: number): Float32Array {
  const points: number[] = [];
  let way = 0;
  let next = 0;
  let total = 0;
  const step = (at: number) => Math.hypot(...[0, 1, 2].map((k) => path.tip[3 * at + k]! - path.tip[3 * at - 3 + k]!));
  for (let at = 1; at < path.count; at += 1) if (kindOf(path, at) !== START && kindOf(path, at) !== RAPID) total += step(at);
  for (let at = 1; at < path.count; at += 1) {
    if (kindOf(path, at) === START || kindOf(path, at) === RAPID) continue;
    way += step(at);
    if (way < next) continue;
    next = way + total / 400;
    for (const reach of [0, 0.05 * size]) for (let k = 0; k < 3; k += 1) points.push(path.tip[3 * at + k]! + reach * path.axis[3 * at + k]!);
  }
  return new Float32Array(points);
}

/** Distance of a point from the segment between two projected points, pixels. */
function distance(x: number, y: number, a: three.Vector3, b: three.Vector3): number {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const length2 = dx * dx + dy * dy;
  const share = length2 > 0 ? Math.min(1, Math.max(0, ((x - a.x) * dx + (y - a.y) * dy) / length2)) : 0;
  return Math.hypot(x - a.x - share * dx, y - a.y - share * dy);
}
