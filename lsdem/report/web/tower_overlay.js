// What stands around the blocks: a grid on the ground, its mesh width, and the names of the runs below them.

// 1, 2 or 5 times a power of ten, at most `size`.
function findRoundStep(size) {
  const power = Math.pow(10, Math.floor(Math.log10(size)));
  return [5, 2, 1].map(function (digit) { return digit * power; }).find(function (step) { return step <= size * (1 + 1e-9); });
}

function writeLength(metres) {
  const unit = metres >= 1 ? { name: "m", factor: 1 } : metres >= 0.01 ? { name: "cm", factor: 100 } : { name: "mm", factor: 1000 };
  return Number((metres * unit.factor).toPrecision(3)) + " " + unit.name;
}

function makeGrid(extent) {
  const step = findRoundStep(Math.max(sizeAlong(extent, 2), sizeAlong(extent, 1)) / 8), z = extent.low[2];
  const [left, front] = [0, 1].map(function (axis) { return step * Math.floor(extent.low[axis] / step - 1); });
  const [right, rear] = [0, 1].map(function (axis) { return step * Math.ceil(extent.high[axis] / step + 1); });
  const ends = [];
  for (let i = 0; left + i * step <= right + 0.5 * step; ++i) ends.push(left + i * step, front, z, left + i * step, rear, z);
  for (let i = 0; front + i * step <= rear + 0.5 * step; ++i) ends.push(left, front + i * step, z, right, front + i * step, z);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(ends, 3));
  const grid = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: 0x808080, transparent: true, opacity: 0.45 }));
  grid.frustumCulled = false;
  return { lines: grid, step: step };
}

function cornersOf(bounds) {
  const corners = [];
  for (const x of [bounds.low[0], bounds.high[0]]) for (const y of [bounds.low[1], bounds.high[1]]) for (const z of [bounds.low[2], bounds.high[2]]) {
    corners.push(new THREE.Vector3(x, y, z));
  }
  return corners;
}

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
