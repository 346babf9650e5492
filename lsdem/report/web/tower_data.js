// Runs as a report holds them, and what can be said of their blocks at a time.
const holder = document.getElementById("tower");
const part = function (name) { return document.getElementById("tower-" + name); };
const say = function (text) { part("message").textContent = text; };

// Colours at even places, linear in between: viridis of matplotlib, and RdBu of ColorBrewer for what has a sign.
const SEQUENTIAL = ["#440154", "#482475", "#414487", "#355f8d", "#2a788e", "#21918c", "#22a884", "#44bf70", "#7ad151", "#bddf26", "#fde725"];
const DIVERGING = ["#053061", "#2166ac", "#4393c3", "#92c5de", "#d1e5f0", "#f7f7f7", "#fddbc7", "#f4a582", "#d6604d", "#b2182b", "#67001f"];

const isShaken = function (run) { return !run.stands; };

// `unit` is what is shown, `factor` of it in one of the values (m/s, m, degrees).
const QUANTITIES = [
  { key: "vx", name: "velocity along x", unit: "cm/s", factor: 100, signed: true, moves: true },
  { key: "vy", name: "velocity along y", unit: "cm/s", factor: 100, signed: true, moves: true },
  { key: "vz", name: "velocity along z", unit: "cm/s", factor: 100, signed: true, moves: true },
  { key: "speed", name: "speed", unit: "cm/s", factor: 100, signed: false, moves: true },
  { key: "moved", name: "displacement since the start, relative to the base", unit: "mm", factor: 1000, signed: false, kept: isShaken },
  { key: "turned", name: "rotation since the start, relative to the base", unit: "°", factor: 1, signed: false, kept: isShaken },
  { key: "force", name: "contact forces on it, over its weight", unit: "", factor: 1, signed: false, kept: function (run) { return run.forces !== null; } },
  { key: "slip", name: "slip below it at the end", unit: "mm", factor: 1000, signed: false, still: true, kept: isShaken },
  { key: "tilt", name: "tilt at the start", unit: "°", factor: 1, signed: false, still: true },
  { key: "layer", name: "layer", unit: "", factor: 1, signed: false, still: true },
];

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Sums up differences from frame to frame of 8-bit integers, one of each block.
function unpackForces(bytes, blocks) {
  for (let i = blocks; i < bytes.length; ++i) bytes[i] += bytes[i - blocks];
  return bytes;
}

// Sums up differences from frame to frame: integers of `width` bytes, three components of all blocks one after another.
function unpack(bytes, frames, blocks) {
  const perFrame = blocks * 15;
  const moved = new Int16Array(frames * blocks * 3), turned = new Int16Array(frames * blocks * 3), fast = new Int8Array(frames * blocks * 3);
  for (let f = 0; f < frames; ++f) {
    for (const [target, offset] of [[moved, 0], [turned, 6 * blocks]]) {
      for (let axis = 0; axis < 3; ++axis) {
        const from = f * perFrame + offset + axis * 2 * blocks;
        for (let b = 0; b < blocks; ++b) {
          const at = (f * blocks + b) * 3 + axis;
          const delta = bytes[from + b] | (bytes[from + blocks + b] << 8);
          target[at] = delta + (f > 0 ? target[at - 3 * blocks] : 0);
        }
      }
    }
    for (let axis = 0; axis < 3; ++axis) {
      const from = f * perFrame + 12 * blocks + axis * blocks;
      for (let b = 0; b < blocks; ++b) {
        const at = (f * blocks + b) * 3 + axis;
        fast[at] = bytes[from + b] + (f > 0 ? fast[at - 3 * blocks] : 0);
      }
    }
  }
  return { moved: moved, turned: turned, fast: fast };
}

// A shape of blocks: the faces of its surface by their corners, counter-clockwise from outside, in the frame of the block. `lines`: for each
// corner of each face, whether its edge to the next one is a line. A ball has a radius, and its faces stand for it.
class Shape {
  constructor(corners, faces, lines, radius) {
    this.corners = corners;
    this.faces = faces;
    this.lines = lines;
    this.radius = radius;
    this.normals = faces.map(function (face) {
      const [origin, ...rest] = face.map(function (c) { return new THREE.Vector3().fromArray(corners[c]); });
      const sum = new THREE.Vector3();
      for (let i = 0; i + 1 < rest.length; ++i) sum.add(rest[i].clone().sub(origin).cross(rest[i + 1].clone().sub(origin)));
      return sum.normalize();
    });
    this.size = [0, 1, 2].map(function (axis) {
      const along = corners.map(function (corner) { return corner[axis]; });
      return Math.max.apply(null, along) - Math.min.apply(null, along);
    });
  }

  // As a page holds it: a corner as its complement is one whose edge is no line.
  static unpack(data) {
    const places = new Float32Array(bytesOf(data.corners).buffer), corners = [];
    for (let i = 0; i < places.length; i += 3) corners.push([places[i], places[i + 1], places[i + 2]]);
    const faces = data.faces.map(function (face) { return face.map(function (c) { return c < 0 ? ~c : c; }); });
    const lines = data.faces.map(function (face) { return face.map(function (c) { return c >= 0 && data.radius === 0; }); });
    return new Shape(corners, faces, lines, data.radius);
  }

  // A box of edges 1, which is drawn in the size of each block.
  static cube() {
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(function (c) { return [c & 1 ? 0.5 : -0.5, c & 2 ? 0.5 : -0.5, c & 4 ? 0.5 : -0.5]; });
    const faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    return new Shape(corners, faces, faces.map(function () { return [true, true, true, true]; }), 0);
  }
}

// A run: its blocks, its frames, and where they are at a time of the first run.
class Run {
  constructor(data, frames, forces) {
    this.label = data.label;
    this.blocks = data.blocks;
    this.length = data.length;
    this.velocity = data.velocity;
    this.hasFrames = data.has_frames;
    this.stands = data.stands;
    this.times = data.times.map(function (t) { return t / data.time; });
    this.base = data.base;
    // of a base that turns: about a place, by a quaternion at each frame
    this.pivot = new THREE.Vector3().fromArray(data.pivot || [0, 0, 0]);
    this.turns = data.turn ? data.turn.map(function (q) { return new THREE.Quaternion(q[1], q[2], q[3], q[0]); }) : null;
    this.turn = new THREE.Quaternion();
    this.start = new Float32Array(bytesOf(data.start).buffer);
    this.slip = new Float32Array(bytesOf(data.slip).buffer);
    this.layer = new Int16Array(bytesOf(data.layer).buffer);
    // the shapes and their numbers by block; 0: the box
    this.shapes = [Shape.cube()].concat(data.shapes.map(Shape.unpack));
    this.shape = new Int32Array(this.blocks);
    if (data.shape) this.shape.set(new Int32Array(bytesOf(data.shape).buffer).map(function (shape) { return shape + 1; }));
    this.frames = frames;
    this.forces = forces;
    this.largestForce = data.scales.force;
    this.step = { moved: data.scales.displacement / 32767, turned: data.scales.rotation / 32767, fast: data.scales.velocity / 127 };
    this.displacement = new Float32Array(3 * this.blocks);
    this.rotation = new Float32Array(3 * this.blocks);
    this.ground = [0, 0, 0];
  }

  shapeOf(block) { return this.shapes[this.shape[block]]; }

  // Factors along the block's axes by which its shape is drawn [m].
  extentOf(block) {
    return this.shape[block] > 0 ? [1, 1, 1] : [this.start[10 * block + 7], this.start[10 * block + 8], this.start[10 * block + 9]];
  }

  // Corners of a block at the start, in units of the first run.
  cornersOf(block) {
    const s = this.start, length = this.length, extent = this.extentOf(block), at = 10 * block;
    const turn = new THREE.Quaternion(s[at + 4], s[at + 5], s[at + 6], s[at + 3]), centre = new THREE.Vector3(s[at], s[at + 1], s[at + 2]);
    return this.shapeOf(block).corners.map(function (corner) {
      const place = new THREE.Vector3(corner[0] * extent[0], corner[1] * extent[1], corner[2] * extent[2]);
      return place.applyQuaternion(turn).add(centre).divideScalar(length);
    });
  }

  // The two frames about a time, and the weight of the later one.
  about(time) {
    const times = this.times;
    let low = 0, high = times.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle; else high = middle;
    }
    const span = times[high] - times[low];
    const weight = span > 0 ? Math.min(1, Math.max(0, (time - times[low]) / span)) : 0;
    return { low: low, high: high, weight: weight };
  }

  seek(time) {
    const at = this.about(time), n = 3 * this.blocks;
    const mix = function (values, step, i) {
      return step * ((1 - at.weight) * values[at.low * n + i] + at.weight * values[at.high * n + i]);
    };
    for (let i = 0; i < n; ++i) {
      this.displacement[i] = mix(this.frames.moved, this.step.moved, i);
      this.rotation[i] = mix(this.frames.turned, this.step.turned, i);
    }
    this.at = at;
    for (let axis = 0; axis < 3; ++axis) {
      this.ground[axis] = (1 - at.weight) * this.base[at.low][axis] + at.weight * this.base[at.high][axis];
    }
    if (this.turns) this.turn.copy(this.turns[at.low]).slerp(this.turns[at.high], at.weight);
  }

  // Only what one block needs: where it is at a time.
  seekBlock(time, block) {
    const at = this.about(time), n = 3 * this.blocks;
    this.at = at;
    for (let axis = 0; axis < 3; ++axis) {
      const i = 3 * block + axis;
      this.displacement[i] = this.step.moved * ((1 - at.weight) * this.frames.moved[at.low * n + i] + at.weight * this.frames.moved[at.high * n + i]);
      this.rotation[i] = this.step.turned * ((1 - at.weight) * this.frames.turned[at.low * n + i] + at.weight * this.frames.turned[at.high * n + i]);
      this.ground[axis] = (1 - at.weight) * this.base[at.low][axis] + at.weight * this.base[at.high][axis];
    }
  }

  velocityOf(block, axis) {
    const n = 3 * this.blocks, i = 3 * block + axis;
    return this.step.fast * ((1 - this.at.weight) * this.frames.fast[this.at.low * n + i] + this.at.weight * this.frames.fast[this.at.high * n + i]);
  }

  forceOf(block) {
    if (this.forces === null) return 0;
    const of = function (run, frame) { const share = run.forces[frame * run.blocks + block] / 255; return run.largestForce * share * share; };
    return (1 - this.at.weight) * of(this, this.at.low) + this.at.weight * of(this, this.at.high);
  }

  // Angle of the block's own z axis with the vertical at the start [degrees].
  tiltOf(block) {
    const x = this.start[10 * block + 4], y = this.start[10 * block + 5];
    return 2 * Math.asin(Math.min(1, Math.hypot(x, y))) * 180 / Math.PI;
  }

  // A quantity of a block now, in units of the first run.
  value(key, block) {
    const i = 3 * block;
    switch (key) {
      case "vx": return this.velocityOf(block, 0) / this.velocity;
      case "vy": return this.velocityOf(block, 1) / this.velocity;
      case "vz": return this.velocityOf(block, 2) / this.velocity;
      case "speed": return Math.hypot(this.velocityOf(block, 0), this.velocityOf(block, 1), this.velocityOf(block, 2)) / this.velocity;
      case "moved":
        return Math.hypot(this.displacement[i] - this.ground[0], this.displacement[i + 1] - this.ground[1], this.displacement[i + 2] - this.ground[2]) / this.length;
      case "turned": return Math.hypot(this.rotation[i], this.rotation[i + 1], this.rotation[i + 2]) * 180 / Math.PI;
      case "force": return this.forceOf(block);
      case "tilt": return this.tiltOf(block);
      case "slip": return this.slip[block] / this.length;
      default: return this.layer[block];
    }
  }

  // Where colours end: the largest value of any frame; of forces, which impacts drive high, what all but a hundredth stay below.
  limit(key) {
    if (key === "force") {
      if (this.forces === null) return 0;
      const share = Uint8Array.from(this.forces).sort()[Math.floor(0.99 * (this.forces.length - 1))] / 255;
      return this.largestForce * share * share;
    }
    const quantity = QUANTITIES.find(function (candidate) { return candidate.key === key; });
    let largest = 0;
    const kept = this.at;
    for (let f = 0; f < this.times.length; ++f) {
      if (f > 0 && quantity.still) break;
      this.seek(this.times[f]);
      for (let b = 0; b < this.blocks; ++b) largest = Math.max(largest, Math.abs(this.value(key, b)));
    }
    if (kept) this.seek(this.times[kept.low]);
    return largest;
  }
}

// Extent of all blocks of a run at its start, in units of the first run.
function findBounds(run) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let b = 0; b < run.blocks; ++b) {
    for (const corner of run.cornersOf(b)) {
      for (const axis of [0, 1, 2]) {
        low[axis] = Math.min(low[axis], corner.getComponent(axis));
        high[axis] = Math.max(high[axis], corner.getComponent(axis));
      }
    }
  }
  return { low: low, high: high };
}

function uniteBounds(bounds) {
  const each = function (choose, end) { return [0, 1, 2].map(function (axis) { return choose.apply(null, bounds.map(function (b) { return b[end][axis]; })); }); };
  return { low: each(Math.min, "low"), high: each(Math.max, "high") };
}

function format(value, quantity) {
  const number = Number((value * quantity.factor).toPrecision(3)).toString();
  return quantity.unit ? number + " " + quantity.unit : number;
}
