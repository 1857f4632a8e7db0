// The machine around the path, as a sketch: a table under the part, a slide on a rail for each linear axis, a bearing for each rotary
// one, and the spindle. The sizes are chosen for the eye; positions, directions and motions are those of the machine file.
import * as three from 'three';
import type { AxisSketch, Machine, Summary } from '../messages';
import { type SetUp, bodyAt, carried, jointsAt, setUp } from './chain';
import { FEED, type Path, cuts, kindOf } from './path';

/** Beyond this share of its travel an axis is near its end. */
const NEAR_END = 0.02;
const STEEL = 0x8795a1;
/** Okabe and Ito: one colour for each letter's kind. */
const LINEAR = [0x0072b2, 0x009e73, 0x56b4e9, 0x44aa99];
const ROTARY = [0xe69f00, 0xcc79a7, 0x999933];
const ALARM = 0xd55e00;

interface Body {
  index: number;
  group: three.Group;
  materials: three.MeshPhongMaterial[];
  colour: number;
}

export class MachineModel {
  /** Everything but the part. */
  readonly group = new three.Group();
  private readonly bodies: Body[] = [];
  /** What moves with the axis before: rails, by index of their axis. */
  private readonly rails: { index: number; group: three.Group }[] = [];
  readonly setUp: SetUp | undefined;
  /** From the tip to the spindle, and the size that bodies are drawn for, mm. */
  tool = { length: 1, size: 1 };
  private readonly axes: AxisSketch[];
  private readonly table: number;
  private middle: number[] = [];
  private readonly down = new three.Vector3();

  constructor(
    machine: Machine,
    private readonly path: Path,
    summary: Summary,
    private size: number,
    private readonly ink: three.Color,
  ) {
    this.axes = machine.axes;
    this.table = carried(this.axes);
    const home = this.homeAxis();
    this.setUp = home && setUp(path, this.axes, home.clone().multiplyScalar(-(summary.tool?.length ?? 0)));
    if (!home || !this.setUp) return;
    this.down.copy(home).negate();
    this.size = this.sizeOf(summary.tool?.length ?? 0);
    this.middle = this.axes.map((axis, k) => (axis.rotary ? 0 : mean(this.used(k, true))));
    this.build(home, summary.tool?.length ?? 0);
  }

  /** Puts part and bodies where the axes are at a vertex, or behind it; false where the axes are not known there. */
  place(at: number, part: three.Object3D, share = 0): boolean {
    const joints = this.setUp && jointsAt(this.path, at, share);
    this.group.visible = joints !== undefined;
    if (!joints || !this.setUp) return false;
    part.matrix.copy(this.partAt(joints));
    part.matrixWorldNeedsUpdate = true;
    for (const { index, group, materials, colour } of this.bodies) {
      move(group, bodyAt(this.axes, joints, index));
      const axis = this.axes[index];
      for (const material of materials) material.color.set(axis && atEnd(axis, joints[index]!) ? ALARM : colour);
    }
    for (const { index, group } of this.rails) move(group, this.before(joints, index));
    return true;
  }

  /** A box around the whole machine over the path. */
  extent(part: three.Object3D): three.Box3 {
    const box = new three.Box3();
    const step = Math.max(1, Math.floor(this.path.count / 24));
    const cutting = hasFeed(this.path);
    for (let at = 0; at < this.path.count; at += step) {
      if (cutting && kindOf(this.path, at) !== FEED) continue;
      if (!this.place(at, part)) continue;
      this.group.updateMatrixWorld(true);
      for (const { group } of [...this.bodies, ...this.rails]) box.expandByObject(group);
    }
    return box;
  }

  dispose(): void {
    this.group.traverse((object) => {
      if (object instanceof three.Mesh || object instanceof three.Sprite || object instanceof three.LineSegments) {
        object.geometry.dispose();
        const material = object.material as three.SpriteMaterial;
        material.map?.dispose();
        material.dispose();
      }
    });
    this.group.clear();
  }

  private partAt(joints: number[]): three.Matrix4 {
    const frame = this.table > 0 ? bodyAt(this.axes, joints, 0) : new three.Matrix4();
    return frame.multiply(new three.Matrix4().makeTranslation(this.setUp!.offset));
  }

  /** The pose of what carries axis `index`. */
  private before(joints: number[], index: number): three.Matrix4 {
    const next = index < this.table ? index + 1 : index - 1;
    if (index < this.table ? next >= this.table : next < this.table) return new three.Matrix4();
    return bodyAt(this.axes, joints, next);
  }

  /** The tool axis with all axes at zero, from the first vertex where they are known. */
  private homeAxis(): three.Vector3 | undefined {
    for (let at = 0; at < this.path.count; at += 1) {
      const joints = jointsAt(this.path, at);
      if (!joints) continue;
      // the part's frame, and from there through the head: A^-1 of all rotations
      const all = this.table > 0 ? bodyAt(this.axes, joints, 0) : new three.Matrix4();
      const head = this.axes.length > this.table ? bodyAt(this.axes, joints, this.axes.length - 1).invert() : new three.Matrix4();
      return new three.Vector3().fromArray(this.path.axis, 3 * at).transformDirection(all).transformDirection(head);
    }
    return undefined;
  }

  /** The pose of a body where each linear axis is in the middle of its cuts, and each rotary one at zero. */
  private middleOf(index: number): three.Matrix4 {
    return bodyAt(this.axes, this.middle, index);
  }

  /** How large to draw bodies: as the part, and as its distance from the rotary axes and the tool demand. */
  private sizeOf(toolLength: number): number {
    const centre = new three.Box3().setFromArray(cuts(this.path)).getCenter(new three.Vector3()).add(this.setUp!.offset);
    const distances = this.axes.filter((axis) => axis.rotary && axis.table).map((axis) => centre.distanceTo(new three.Vector3(...axis.point)));
    return Math.max(this.size, 1.6 * Math.max(0, ...distances), 1.5 * toolLength);
  }

  private build(up: three.Vector3, toolLength: number): void {
    const { offset, tip } = this.setUp!;
    const tips = cuts(this.path);
    // the part in the frame of its table, and a disc under it
    const part = new three.Box3().setFromArray(tips).translate(offset);
    const turning = this.axes.slice(0, this.table).find((axis) => axis.rotary && parallel(axis, up));
    const centre = part.getCenter(new three.Vector3());
    if (turning) {
      const point = new three.Vector3(...turning.point);
      centre.sub(point).projectOnVector(up).add(point);
    }
    let reach = 0;
    for (let k = 0; k < tips.length; k += 3) {
      const off = new three.Vector3().fromArray(tips, k).add(offset).sub(centre);
      reach = Math.max(reach, off.projectOnPlane(up).length());
    }
    const radius = Math.max(1.15 * reach, 0.3 * this.size);
    const lowest = lowestAlong(part, up);
    const thick = 0.06 * this.size;
    const top = centre.clone().add(up.clone().multiplyScalar(lowest - centre.dot(up) - 0.02 * this.size));
    const plate = this.body(this.table > 0 ? 0 : -1, turning ? this.colour(this.axes.indexOf(turning)) : STEEL);
    const rest = top.clone().add(up.clone().multiplyScalar(-thick / 2));
    // a lathe has no table
    if (this.axes.length > 2) this.add(plate, turning ? new three.CylinderGeometry(radius, radius, thick, 64) : new three.BoxGeometry(1.9 * radius, thick, 1.9 * radius), new three.Vector3(0, 1, 0), up, rest);
    if (turning) {
      // a mark on the rim, so that a turn is seen
      const across = new three.Vector3(1, 0, 0).projectOnPlane(up).normalize();
      const rim = rest.clone().add(across.clone().multiplyScalar(radius));
      this.add(plate, new three.BoxGeometry(0.12 * radius, 1.6 * thick, 0.12 * radius), new three.Vector3(0, 1, 0), up, rim, STEEL);
      plate.group.add(label(turning.letter, rim.clone().add(across.multiplyScalar(0.16 * radius)), this.size, this.ink));
    }
    // the other axes of the table, from the part down to the bed
    let level = thick;
    for (let k = 0; k < this.table; k += 1) {
      const axis = this.axes[k]!;
      if (axis === turning) continue;
      const place = top.clone().add(up.clone().multiplyScalar(-level));
      if (axis.rotary) {
        this.bearing(k, axis, centre, 1.25 * radius, 0.09 * this.size, rest.clone().addScaledVector(up, -0.9 * thick));
      } else {
        place.add(up.clone().multiplyScalar(-0.09 * this.size)).applyMatrix4(this.middleOf(0));
        this.slide(k, axis, place.applyMatrix4(this.middleOf(k).invert()), 0.5 * radius, 2.3 * radius);
        level += 0.2 * this.size;
      }
    }
    // the head, from the spindle up, as it stands where each axis is in the middle of its cuts: bodies are put there
    const last = this.axes.length - 1;
    const spindle = this.body(last >= this.table ? last : -1, STEEL);
    const length = Math.max(toolLength, 0.15 * this.size);
    this.tool = { length, size: this.size };
    const nose = tip.clone().add(up.clone().multiplyScalar(length));
    // it reaches to the pivot of the head
    const pivots = this.axes.slice(this.table).flatMap((axis) => (axis.rotary ? [this.nearSpindle(axis, tip, up).sub(tip).dot(up)] : []));
    const long = Math.max(0.22 * this.size, ...pivots.map((pivot) => pivot - length));
    const wide = 0.07 * this.size;
    this.add(spindle, new three.CylinderGeometry(wide, 0.6 * wide, long, 32), new three.Vector3(0, 1, 0), up, nose.clone().add(up.clone().multiplyScalar(long / 2)));
    let height = length + long;
    for (let k = last; k >= this.table; k -= 1) {
      const axis = this.axes[k]!;
      if (axis.rotary) {
        const pivot = this.nearSpindle(axis, tip, up);
        if (parallel(axis, up)) {
          this.ring(k, axis, pivot.add(up.clone().multiplyScalar(tip.dot(up) + height + 0.04 * this.size - pivot.dot(up))), 0.11 * this.size, 0.08 * this.size);
          height += 0.1 * this.size;
        } else {
          this.bearing(k, axis, pivot, 0.16 * this.size, 0.07 * this.size);
          height = Math.max(height, pivot.sub(tip).dot(up) + 0.08 * this.size);
        }
      } else {
        const place = tip.clone().add(up.clone().multiplyScalar(height + 0.06 * this.size)).applyMatrix4(this.middleOf(last));
        this.slide(k, axis, place.applyMatrix4(this.middleOf(k).invert()), 0.12 * this.size);
        // the next slide stands above the end of a rail that leads up
        const steep = new three.Vector3(...axis.direction).dot(up) * axis.sign;
        const ends = this.used(k).map((value) => steep * (value - this.middle[k]!));
        height += 0.14 * this.size + Math.max(0, ...ends);
      }
    }
  }

  /** The point on the line of a rotary axis that is nearest to the line of the spindle. */
  private nearSpindle(axis: AxisSketch, tip: three.Vector3, up: three.Vector3): three.Vector3 {
    const direction = new three.Vector3(...axis.direction).normalize();
    const point = new three.Vector3(...axis.point);
    const between = tip.clone().sub(point);
    const skew = direction.dot(up);
    const share = parallel(axis, up) ? between.dot(direction) : (between.dot(direction) - skew * between.dot(up)) / (1 - skew * skew);
    return point.addScaledVector(direction, share);
  }

  /** A rotary axis along the tool: a ring about its line. */
  private ring(index: number, axis: AxisSketch, middle: three.Vector3, radius: number, long: number): void {
    const body = this.body(index, this.colour(index));
    const direction = new three.Vector3(...axis.direction).normalize();
    this.add(body, new three.CylinderGeometry(radius, radius, long, 32), new three.Vector3(0, 1, 0), direction, middle);
    const across = new three.Vector3(1, 0, 0).projectOnPlane(direction).normalize();
    this.add(body, new three.BoxGeometry(0.4 * radius, long, 0.3 * radius), new three.Vector3(0, 1, 0), direction, middle.clone().add(across.clone().multiplyScalar(radius)), STEEL);
    body.group.add(label(axis.letter, middle.clone().add(across.multiplyScalar(1.7 * radius)), this.size, this.ink));
  }

  /** A rotary axis that is not along the tool: two bearings on its line, on both sides of the place nearest to `about`. */
  private bearing(index: number, axis: AxisSketch, about: three.Vector3, reach: number, radius: number, under?: three.Vector3): void {
    const direction = new three.Vector3(...axis.direction).normalize();
    const point = new three.Vector3(...axis.point);
    const middle = about.clone().sub(point).projectOnVector(direction).add(point);
    const body = this.body(index, this.colour(index));
    const side = this.down.clone().projectOnPlane(direction).normalize();
    // the cradle between them, under the table
    const bar = 0.35 * radius;
    const hang = under ? under.clone().sub(middle).projectOnPlane(direction) : new three.Vector3();
    const deep = hang.length();
    if (under) this.add(body, new three.BoxGeometry(bar, 2 * reach, bar), new three.Vector3(0, 1, 0), direction, middle.clone().add(hang));
    for (const sense of [-1, 1]) {
      const end = middle.clone().add(direction.clone().multiplyScalar(sense * reach));
      this.add(body, new three.CylinderGeometry(radius, radius, 0.8 * radius, 32), new three.Vector3(0, 1, 0), direction, end);
      if (under && deep > bar) this.add(body, new three.BoxGeometry(bar, deep, bar), new three.Vector3(0, 1, 0), hang, end.clone().addScaledVector(hang, 0.5));
      // a key on the bearing, so that a turn is seen
      this.add(body, new three.BoxGeometry(0.3 * radius, 0.9 * radius, 0.5 * radius), new three.Vector3(0, 1, 0), direction, end.clone().add(side.clone().multiplyScalar(radius)), STEEL);
      if (sense > 0) body.group.add(label(axis.letter, end.clone().add(direction.clone().multiplyScalar(1.6 * radius)), this.size, this.ink));
    }
  }

  /** A linear axis: a slide, and its rail, as long as the travel that the program uses and `beyond`. */
  private slide(index: number, axis: AxisSketch, at: three.Vector3, wide: number, beyond = wide): void {
    const direction = new three.Vector3(...axis.direction).normalize();
    const [low, high] = this.used(index);
    const body = this.body(index, this.colour(index));
    const thick = 0.09 * this.size;
    const square = new three.BoxGeometry(wide, thick, wide);
    this.add(body, square, new three.Vector3(0, 1, 0), Math.abs(direction.dot(this.down)) > 0.9 ? new three.Vector3(0, 1, 0) : this.down, at);
    const rail = new three.Group();
    // in the frame of the rail the slide is at sense * value
    const sense = axis.sign * (index < this.table ? -1 : 1);
    const long = high - low + beyond;
    const bar = new three.Mesh(new three.BoxGeometry(0.025 * this.size, long, 0.025 * this.size), steel());
    bar.quaternion.setFromUnitVectors(new three.Vector3(0, 1, 0), direction);
    bar.position.copy(at).add(direction.clone().multiplyScalar(sense * (low + high) * 0.5));
    rail.add(bar, label(axis.letter, bar.position.clone().add(direction.clone().multiplyScalar(sense * (0.5 * long + 0.06 * this.size))), this.size, this.ink));
    this.rails.push({ index, group: rail });
    rail.matrixAutoUpdate = false;
    this.group.add(rail);
  }

  private body(index: number, colour: number): Body {
    const body: Body = { index, group: new three.Group(), materials: [], colour };
    if (index < 0) {
      this.group.add(body.group);
      return body;
    }
    body.group.matrixAutoUpdate = false;
    this.bodies.push(body);
    this.group.add(body.group);
    return body;
  }

  private add(body: Body, shape: three.BufferGeometry, from: three.Vector3, to: three.Vector3, at: three.Vector3, fixed?: number): void {
    const material = fixed === undefined ? new three.MeshPhongMaterial({ color: body.colour }) : steel();
    if (fixed === undefined) body.materials.push(material);
    const mesh = new three.Mesh(shape, material);
    mesh.quaternion.setFromUnitVectors(from, to.clone().normalize());
    mesh.position.copy(at);
    // edges in the colour of text: bodies stand out on any background
    mesh.add(new three.LineSegments(new three.EdgesGeometry(shape, 40), new three.LineBasicMaterial({ color: this.ink })));
    body.group.add(mesh);
  }

  private colour(index: number): number {
    const kind = this.axes[index]!.rotary;
    const nth = this.axes.slice(0, index).filter((axis) => axis.rotary === kind).length;
    const list = kind ? ROTARY : LINEAR;
    return list[nth % list.length]!;
  }

  /** The lowest and highest value of a joint over the path, or over its cuts. */
  private used(index: number, inCuts = false): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    const cutting = inCuts && hasFeed(this.path);
    for (let at = 0; at < this.path.count; at += 1) {
      if (cutting && kindOf(this.path, at) !== FEED) continue;
      const value = this.path.joints[at * this.path.axes + index]!;
      if (value < low) low = value;
      if (value > high) high = value;
    }
    return low <= high ? [low, high] : [0, 0];
  }
}

const hasFeed = (path: Path): boolean => path.flags.some((flags) => (flags & 3) === FEED);

const mean = ([low, high]: [number, number]): number => (low + high) / 2;

const parallel = (axis: AxisSketch, up: three.Vector3): boolean => Math.abs(new three.Vector3(...axis.direction).normalize().dot(up)) > 0.99;

const steel = (): three.MeshPhongMaterial => new three.MeshPhongMaterial({ color: STEEL });

function move(group: three.Group, pose: three.Matrix4): void {
  group.matrix.copy(pose);
  group.matrixWorldNeedsUpdate = true;
}

function atEnd({ limits }: AxisSketch, value: number): boolean {
  return limits !== null && (value < limits[0] + NEAR_END * (limits[1] - limits[0]) || value > limits[1] - NEAR_END * (limits[1] - limits[0]));
}

function lowestAlong(box: three.Box3, up: three.Vector3): number {
  let lowest = Infinity;
  for (const x of [box.min.x, box.max.x]) for (const y of [box.min.y, box.max.y]) for (const z of [box.min.z, box.max.z]) lowest = Math.min(lowest, new three.Vector3(x, y, z).dot(up));
  return lowest;
}

/** A letter that always faces the viewer. */
function label(letter: string, at: three.Vector3, size: number, ink: three.Color): three.Sprite {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const pen = canvas.getContext('2d')!;
  pen.font = 'bold 52px sans-serif';
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  pen.fillStyle = `#${ink.getHexString()}`;
  pen.fillText(letter, 32, 34);
  const sprite = new three.Sprite(new three.SpriteMaterial({ map: new three.CanvasTexture(canvas), depthTest: false, transparent: true }));
  sprite.scale.setScalar(0.08 * size);
  sprite.position.copy(at);
  sprite.renderOrder = 3;
  return sprite;
}
