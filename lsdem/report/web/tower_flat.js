// The blocks at the start, drawn without WebGL for browsers that have none: parallel lines stay parallel, farther blocks are drawn first.
const FLAT_BACK = [0.5, -1, 0.4];
// Brightness of faces across the block's axes.
const FLAT_SHADES = [0.78, 0.92, 1];

// Faces that look towards `back`, each with its corners, the farthest first, and how near the block is.
function findFlatFaces(run, block, shift, back) {
  const s = run.start.subarray(10 * block, 10 * block + 10), turn = new THREE.Quaternion(s[4], s[5], s[6], s[3]);
  const shape = run.shapeOf(block), corners = run.cornersOf(block), faces = [];
  corners.forEach(function (corner) { corner.x += shift; });
  shape.faces.forEach(function (face, f) {
    const normal = shape.normals[f];
    if (normal.clone().applyQuaternion(turn).dot(back) <= 0) return;
    const shade = FLAT_SHADES.reduce(function (sum, own, axis) { const part = normal.getComponent(axis); return sum + own * part * part; }, 0);
    const own = face.map(function (c) { return corners[c]; });
    const near = own.reduce(function (sum, corner) { return sum + corner.dot(back) / own.length; }, 0);
    faces.push({ corners: own, lines: shape.lines[f], shade: shade, near: near });
  });
  faces.sort(function (a, b) { return a.near - b.near; });
  const centre = new THREE.Vector3(s[0], s[1], s[2]).divideScalar(run.length);
  centre.x += shift;
  return { near: centre.dot(back), faces: faces };
}

function drawFlat(canvas, runs) {
  const box = canvas.parentElement.getBoundingClientRect(), scale = Math.min(2, window.devicePixelRatio || 1);
  canvas.width = Math.max(1, Math.round(scale * box.width));
  canvas.height = Math.max(1, Math.round(scale * box.height));
  const back = new THREE.Vector3().fromArray(FLAT_BACK).normalize(), right = new THREE.Vector3(0, 0, 1).cross(back).normalize(), up = back.clone().cross(right);
  new Triad().show(right, up);
  const shifts = arrangeRuns(runs.map(findBounds), canvas.width / canvas.height);
  const blocks = [];
  runs.forEach(function (run, i) { for (let b = 0; b < run.blocks; ++b) blocks.push(findFlatFaces(run, b, shifts[i], back)); });
  blocks.sort(function (a, b) { return a.near - b.near; });

  const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (const block of blocks) for (const face of block.faces) {
    face.corners = face.corners.map(function (corner) { return [corner.dot(right), -corner.dot(up)]; });
    for (const corner of face.corners) for (const i of [0, 1]) { low[i] = Math.min(low[i], corner[i]); high[i] = Math.max(high[i], corner[i]); }
  }
  const zoom = Math.min(ROOM.side * canvas.width / (high[0] - low[0]), ROOM.bottom * canvas.height / (high[1] - low[1]));
  const place = function (corner) { return [canvas.width / 2 + zoom * (corner[0] - 0.5 * (low[0] + high[0])), 0.46 * canvas.height + zoom * (corner[1] - 0.5 * (low[1] + high[1]))]; };

  const pen = canvas.getContext("2d");
  for (const block of blocks) for (const face of block.faces) {
    const grey = Math.round(225 * face.shade), places = face.corners.map(place);
    pen.fillStyle = "rgb(" + grey + "," + grey + "," + grey + ")";
    pen.beginPath();
    places.forEach(function (corner) { pen.lineTo.apply(pen, corner); });
    pen.closePath();
    pen.fill();
    // what is no line joins the face to the one beside it
    [false, true].forEach(function (line) {
      pen.strokeStyle = line ? "#333" : pen.fillStyle;
      pen.beginPath();
      places.forEach(function (corner, i) {
        if (face.lines[i] !== line) return;
        pen.moveTo.apply(pen, corner);
        pen.lineTo.apply(pen, places[(i + 1) % places.length]);
      });
      pen.stroke();
    });
  }
}

// In place of the canvas, which a failed attempt at WebGL may have taken.
function showFlat(runs) {
  const canvas = document.createElement("canvas"), old = part("canvas");
  canvas.id = old.id;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "The blocks at the start: " + runs.map(describeRun).join("; "));
  old.replaceWith(canvas);
  holder.classList.add("flat");
  drawFlat(canvas, runs);
  new ResizeObserver(function () { drawFlat(canvas, runs); }).observe(canvas.parentElement);
}
