// Where runs stand beside each other, and where the camera stands so that they fill the picture.

// Shares of the half picture that the structure may take from its middle: below it stand the names of the runs.
const ROOM = { side: 0.94, top: 0.94, bottom: 0.84 };

// Room between two runs beside each other, in widths of the widest.
const LEAST_GAP = 0.4, LARGEST_GAP = 3;

const DIRECTIONS = { front: [0, -1, 0], side: [1, 0, 0], top: [0, -0.001, 1], corner: [0.6, -1, 0.45], beside: [0.3, -1, 0.2] };

const sizeAlong = function (bounds, axis) { return bounds.high[axis] - bounds.low[axis]; };

// Width over height of the runs from the front, with a gap in widths of the widest.
function findAspect(bounds, gap) {
  const widest = Math.max.apply(null, bounds.map(function (b) { return sizeAlong(b, 0); }));
  const widths = bounds.reduce(function (sum, b) { return sum + sizeAlong(b, 0); }, 0);
  return (widths + gap * widest * (bounds.length - 1)) / sizeAlong(uniteBounds(bounds), 2);
}

// Distance of each run along x from its own place, so that together they are as wide as a picture of this aspect can hold.
function arrangeRuns(bounds, aspect) {
  const narrow = findAspect(bounds, 0), step = findAspect(bounds, 1) - narrow;
  const gap = step > 0 ? Math.min(LARGEST_GAP, Math.max(LEAST_GAP, (0.8 * aspect - narrow) / step)) : 0;
  const widest = Math.max.apply(null, bounds.map(function (b) { return sizeAlong(b, 0); }));
  let edge = bounds[0].low[0];
  return bounds.map(function (b) {
    const shift = edge - b.low[0];
    edge += sizeAlong(b, 0) + gap * widest;
    return shift;
  });
}

// Corners of all blocks of a run at its start, one after another, in units of the first run.
function findBlockCorners(run) {
  const corners = [];
  for (let b = 0; b < run.blocks; ++b) for (const corner of run.cornersOf(b)) corners.push(corner.x, corner.y, corner.z);
  return Float64Array.from(corners);
}

// Reach of the corners of the runs, each shifted along x, in a direction.
function findReach(corners, shifts, direction) {
  let most = -Infinity;
  corners.forEach(function (places, i) {
    const shift = direction.x * shifts[i];
    for (let at = 0; at < places.length; at += 3) {
      most = Math.max(most, shift + direction.x * places[at] + direction.y * places[at + 1] + direction.z * places[at + 2]);
    }
  });
  return most;
}

// The nearest place of a camera that looks along -back, and what it looks at, so that all corners are within ROOM. A corner at x, y across
// the view and w against it is seen at (x - cx)/(cw - w) from a camera at cx, cy, cw: each pair of sides asks for a cw of its own, and what
// the less demanding pair leaves is shared evenly. `reachOf` finds how far the corners reach in a direction.
function fitCamera(camera, reachOf, direction) {
  const back = new THREE.Vector3().fromArray(direction).normalize();
  const right = new THREE.Vector3().crossVectors(camera.up, back).normalize(), up = new THREE.Vector3().crossVectors(back, right);
  const half = Math.tan(camera.fov * Math.PI / 360), side = ROOM.side * half * camera.aspect, top = ROOM.top * half, bottom = ROOM.bottom * half;
  const reach = function (axis, sign, slope) { return reachOf(axis.clone().multiplyScalar(sign).addScaledVector(back, slope)); };
  const rightmost = reach(right, 1, side), leftmost = reach(right, -1, side), highest = reach(up, 1, top), lowest = reach(up, -1, bottom);
  const cw = Math.max((rightmost + leftmost) / (2 * side), (highest + lowest) / (top + bottom));
  const cx = 0.5 * (rightmost - leftmost), cy = 0.5 * (highest - top * cw + bottom * cw - lowest);
  const depth = 0.5 * (reachOf(back) - reachOf(back.clone().negate()));
  const target = right.multiplyScalar(cx).add(up.multiplyScalar(cy)).addScaledVector(back, depth);
  return { target: target, position: target.clone().addScaledVector(back, cw - depth) };
}

// Turns a camera about what it looks at, by angles around the vertical and over the horizon.
function turnCamera(camera, target, around, over) {
  const arm = camera.position.clone().sub(target);
  const flat = Math.hypot(arm.x, arm.y), radius = arm.length();
  const azimuth = Math.atan2(arm.y, arm.x) + around;
  const height = Math.min(1.55, Math.max(-1.55, Math.atan2(arm.z, flat) - over));
  arm.set(radius * Math.cos(height) * Math.cos(azimuth), radius * Math.cos(height) * Math.sin(azimuth), radius * Math.sin(height));
  camera.position.copy(target).add(arm);
}
