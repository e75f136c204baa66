// The machine as simple solids: one group an axis, nested as the chain carries them.
import * as THREE from "three";

const bodyColours = { bed: 0x8d949b, linear: 0x9fb4c7, rotary: 0xc7b79f, table: 0xd9dde1,
  tool: 0xd55e00 };

function vector([x, y, z]) { return new THREE.Vector3(x, y, z); }

function material(colour, opacity = 0.55) {
  return new THREE.MeshLambertMaterial({ color: colour, transparent: opacity < 1, opacity,
    depthWrite: opacity === 1 });
}

function slide(axis, size) {
  const long = axis.min != null && axis.max != null ? axis.max - axis.min : size;
  const rail = new THREE.Mesh(new THREE.BoxGeometry(Math.max(long, 1), size * 0.035, size * 0.035),
    material(bodyColours.linear, 0.35));
  rail.quaternion.setFromUnitVectors(new THREE.Vector3(1, 0, 0), vector(axis.direction));
  const middle = long === size ? 0 : (axis.max + axis.min) / 2;
  rail.position.copy(vector(axis.direction)).multiplyScalar(middle);
  return rail;
}

function hub(axis, size) {
  const group = new THREE.Group();
  const drum = new THREE.Mesh(new THREE.CylinderGeometry(size * 0.07, size * 0.07, size * 0.14, 40),
    material(bodyColours.rotary));
  const line = new THREE.Mesh(new THREE.CylinderGeometry(size * 0.004, size * 0.004, size, 8),
    material(bodyColours.rotary, 0.9));
  group.add(drum, line);
  group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), vector(axis.direction));
  group.position.copy(vector(axis.point));
  return group;
}

/** Groups in M; move(positions by axis name, mm and rad) places them. */
export class MachineModel {
  constructor(machine, size, offset) {
    this.root = new THREE.Group();
    this.axes = [];
    this.table = this.chain(machine.axes.filter((a) => a.side === "work"), size, offset);
    this.spindle = this.chain(machine.axes.filter((a) => a.side === "tool"), size, offset);
  }

  chain(axes, size, offset) {
    let carrier = this.root;
    for (const axis of axes) {
      const group = new THREE.Group();
      const mark = axis.kind === "rotary" ? hub(axis, size * 0.5) : slide(axis, size);
      // Slides of the tool side are drawn beside the spindle, those of the work side below the part.
      if (axis.kind === "linear") mark.position.add(axis.side === "tool" ? offset.tool : offset.work);
      (axis.kind === "linear" ? carrier : group).add(mark);
      carrier.add(group);
      this.axes.push({ ...axis, group });
      carrier = group;
    }
    return carrier;
  }

  move(positions) {
    for (const axis of this.axes) {
      const q = positions[axis.name] ?? 0;
      const direction = vector(axis.direction);
      if (axis.kind === "linear") {
        axis.group.position.copy(direction.multiplyScalar(q));
      } else {
        const point = vector(axis.point);
        axis.group.quaternion.setFromAxisAngle(direction, q);
        axis.group.position.copy(point).sub(point.clone().applyQuaternion(axis.group.quaternion));
      }
    }
    this.root.updateMatrixWorld(true);
  }
}

/** A tool as long as [x, y, z] from gauge point to tip, in S. */
export function toolModel(tip, radius) {
  const length = Math.max(vector(tip).length(), 1e-3);
  const group = new THREE.Group();
  const shank = new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, length, 24),
    material(bodyColours.tool, 0.85));
  shank.position.y = length / 2;
  const nose = new THREE.Mesh(new THREE.CylinderGeometry(radius * 4, radius * 2.6, radius * 6, 32),
    material(bodyColours.bed, 0.8));
  nose.position.y = length + radius * 3;
  group.add(shank, nose);
  group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0),
    vector(tip).normalize().negate());
  group.position.copy(vector(tip));
  return group;
}

export function tableModel(radius) {
  const disc = new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, radius * 0.06, 64),
    material(bodyColours.table, 0.45));
  disc.rotation.x = Math.PI / 2;
  return disc;
}
