// Surroundings of the blocks: a grid on the ground, its mesh width, the axes' directions, and the names of the runs below them.

// 1, 2 or 5 times a power of ten, at most `size`.
function findRoundStep(size) {
  const power = Math.pow(10, Math.floor(Math.log10(size)));
  return [5, 2, 1].map(function (digit) { return digit * power; }).find(function (step) { return step <= size * (1 + 1e-9); });
}

function writeLength(metres) {
  const unit = metres >= 1 ? { name: "m", factor: 1 } : metres >= 0.01 ? { name: "cm", factor: 100 } : { name: "mm", factor: 1000 };
  return Number((metres * unit.factor).toPrecision(3)) + " " + unit.name;
}

function findGridStep(extent) { return findRoundStep(Math.max(sizeAlong(extent, 2), sizeAlong(extent, 1)) / 8); }

function makeGrid(extent, step) {
  const z = extent.low[2];
  const [left, front] = [0, 1].map(function (axis) { return step * Math.floor(extent.low[axis] / step - 1); });
  const [right, rear] = [0, 1].map(function (axis) { return step * Math.ceil(extent.high[axis] / step + 1); });
  const ends = [];
  for (let i = 0; left + i * step <= right + 0.5 * step; ++i) ends.push(left + i * step, front, z, left + i * step, rear, z);
  for (let i = 0; front + i * step <= rear + 0.5 * step; ++i) ends.push(left, front + i * step, z, right, front + i * step, z);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(ends, 3));
  const grid = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: 0x808080, transparent: true, opacity: 0.45 }));
  grid.frustumCulled = false;
  return grid;
}

// The axes x, y and z as arrows in a corner of the view, for a picture whose right and upward directions are given.
const TRIAD = { size: 76, arm: 24, head: 5, letter: 32 };

class Triad {
  constructor() {
    this.picture = makeSvg("svg", { viewBox: [-TRIAD.size / 2, -TRIAD.size / 2, TRIAD.size, TRIAD.size].join(" "), role: "img" });
    this.axes = ["x", "y", "z"].map(function (name) {
      const arrow = makeSvg("path", { class: name, fill: "none" }), letter = makeSvg("text", { class: name, "text-anchor": "middle", "dominant-baseline": "central" });
      letter.textContent = name;
      this.picture.append(arrow, letter);
      return { arrow: arrow, letter: letter };
    }, this);
    part("axes").replaceChildren(this.picture);
  }

  show(right, up) {
    const texts = [], toward = right.clone().cross(up), near = 0.3;
    this.axes.forEach(function (axis, i) {
      const name = "xyz"[i], x = right.getComponent(i), y = -up.getComponent(i), length = Math.hypot(x, y), arm = TRIAD.arm;
      const ux = length > 0 ? x / length : 0, uy = length > 0 ? y / length : 0, head = Math.min(TRIAD.head, arm * length);
      const end = [arm * x, arm * y], back = [end[0] - head * ux, end[1] - head * uy];
      axis.arrow.setAttribute("d", "M0 0L" + [end[0], end[1]].map(function (v) { return v.toFixed(2); }).join(" ") +
        [-1, 1].map(function (side) { return "M" + (back[0] - side * 0.5 * head * uy).toFixed(2) + " " + (back[1] + side * 0.5 * head * ux).toFixed(2) + "L" + end[0].toFixed(2) + " " + end[1].toFixed(2); }).join(""));
      // of an axis that is seen end on the letter stands beside its root
      const share = length < near ? 0 : 1, away = TRIAD.letter - arm;
      axis.letter.setAttribute("x", (share ? end[0] + away * ux : -9).toFixed(2));
      axis.letter.setAttribute("y", (share ? end[1] + away * uy : 9).toFixed(2));
      const words = [[toward.getComponent(i), "toward you", "away from you"], [-y, "up", "down"], [x, "to the right", "to the left"]];
      const most = words.reduce(function (best, word) { return Math.abs(word[0]) > Math.abs(best[0]) + 1e-6 ? word : best; });
      texts.push(name + " " + (most[0] > 0 ? most[1] : most[2]));
    });
    this.picture.setAttribute("aria-label", "Axes: " + texts.join(", "));
  }
}

function cornersOf(bounds) {
  const corners = [];
  for (const x of [bounds.low[0], bounds.high[0]]) for (const y of [bounds.low[1], bounds.high[1]]) for (const z of [bounds.low[2], bounds.high[2]]) {
    corners.push(new THREE.Vector3(x, y, z));
  }
  return corners;
}

// A run in words, in place of its picture.
function describeRun(run) { return run.label + ", " + run.blocks + (run.blocks === 1 ? " block" : " blocks"); }

// Names of several runs, each below its blocks.
class RunNames {
  constructor(runs) {
    this.spans = runs.length < 2 ? [] : runs.map(function (run) {
      const span = document.createElement("span");
      span.textContent = run.label;
      return span;
    });
    part("names").replaceChildren(...this.spans);
  }

  place(camera, boxes, width, height) {
    this.spans.forEach(function (span, i) {
      let left = Infinity, right = -Infinity, lowest = -Infinity;
      for (const corner of cornersOf(boxes[i])) {
        const seen = corner.project(camera), x = 0.5 * width * (1 + seen.x), y = 0.5 * height * (1 - seen.y);
        left = Math.min(left, x);
        right = Math.max(right, x);
        lowest = Math.max(lowest, y);
      }
      const middle = 0.5 * (left + right);
      span.hidden = !(middle > 0 && middle < width);
      span.style.left = middle.toFixed(1) + "px";
      span.style.top = Math.min(height - span.offsetHeight, Math.max(0, lowest + 2)).toFixed(1) + "px";
    });
  }
}
