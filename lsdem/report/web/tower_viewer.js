// Where a ray first meets the surface of a shape, in lengths of `along`; Infinity: nowhere.
function findEntry(shape, from, along) {
  let first = Infinity;
  shape.faces.forEach(function (face, f) {
    const normal = shape.normals[f], facing = normal.dot(along);
    if (!(facing < 0)) return;
    const corners = face.map(function (c) { return new THREE.Vector3().fromArray(shape.corners[c]); });
    const at = corners[0].clone().sub(from).dot(normal) / facing, place = from.clone().addScaledVector(along, at);
    const isInside = corners.every(function (corner, i) {
      return corners[(i + 1) % corners.length].clone().sub(corner).cross(place.clone().sub(corner)).dot(normal) >= 0;
    });
    if (isInside) first = Math.min(first, at);
  });
  return first;
}

// The view of the blocks and what steers it.
class Viewer {
  constructor(runs, renderer) {
    this.runs = runs;
    this.duration = Math.max.apply(null, runs.map(function (run) { return run.times[run.times.length - 1]; }));
    this.time = 0;
    this.playing = false;
    this.chosen = { run: 0, block: -1 };
    this.limits = {};
    this.canvas = part("canvas");
    this.renderer = renderer;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.firstView = runs.length > 1 ? "beside" : "corner";
    this.properties = new BlockProperties(this);
    this.names = new RunNames(runs);
    this.triad = new Triad();
    this.canvas.setAttribute("aria-label", "Blocks in three dimensions: " + runs.map(describeRun).join("; ") + ". ? lists the keys");
    this.fillScene();
    this.leavePageItsMoves();
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.touches.TWO = THREE.TOUCH.DOLLY_ROTATE;
    this.controls.enableKeys = false;
    holder.classList.toggle("still", runs.every(function (run) { return run.stands; }));
    this.fillControls();
    this.chooseQuantity();
    this.resize();
    this.look(this.firstView);
    this.listen();
    this.update();
  }

  fillScene() {
    this.scene = new THREE.Scene();
    this.shared = { exaggeration: { value: 1 }, cutNormal: { value: new THREE.Vector3(0, 1, 0) }, cutAt: { value: 1e9 }, colours: { value: null } };
    this.textures = { true: colourTexture(DIVERGING), false: colourTexture(SEQUENTIAL) };
    this.runBounds = this.runs.map(findBounds);
    this.corners = this.runs.map(findBlockCorners);
    // what cuts go through: all runs in one place
    this.bounds = uniteBounds(this.runBounds);
    this.groups = this.runs.map(function (run) { return new Blocks(run, new THREE.Vector3(), this.shared); }, this);
    this.groups.forEach(function (group) { this.scene.add(group.object); }, this);
    // the grids on which the runs stand: one for all, or, where they turn, one each
    const turns = this.runs.some(function (run) { return run.turns !== null; });
    this.grounds = (turns ? this.runs : this.runs.slice(0, 1)).map(function () { return new THREE.Group(); });
    this.grounds.forEach(function (ground) { this.scene.add(ground); }, this);
    // a picture as wide as the runs need, slender ones with the controls at their side
    const kWidest = 2, kSlender = 0.55, least = findAspect(this.runBounds, LEAST_GAP), most = findAspect(this.runBounds, LARGEST_GAP);
    holder.classList.toggle("slender", most < kSlender);
    holder.style.setProperty("--aspect", Math.min(kWidest, Math.max(1.2, 1.2 * least)).toFixed(3));
  }

  // Places the runs beside each other for the picture's shape, and the grid below them.
  arrange() {
    const shifts = this.shifts = arrangeRuns(this.runBounds, this.camera.aspect);
    this.boxes = this.runBounds.map(function (bounds, i) {
      return { low: [bounds.low[0] + shifts[i], bounds.low[1], bounds.low[2]], high: [bounds.high[0] + shifts[i], bounds.high[1], bounds.high[2]] };
    });
    this.groups.forEach(function (group, i) { group.origin.x = shifts[i]; });
    const whole = uniteBounds(this.boxes), step = findGridStep(whole);
    this.grounds.forEach(function (ground, i) {
      ground.children.slice().forEach(function (lines) { lines.geometry.dispose(); ground.remove(lines); });
      ground.add(makeGrid(this.grounds.length > 1 ? this.boxes[i] : whole, step));
    }, this);
    part("scale").textContent = "grid: " + writeLength(step);
  }

  // One finger scrolls the page, and so does a wheel before the view is clicked: the controls, which would keep both, see them only else.
  leavePageItsMoves() {
    const canvas = this.canvas;
    ["touchstart", "touchmove"].forEach(function (name) {
      canvas.addEventListener(name, function (event) { if (event.touches.length < 2) event.stopImmediatePropagation(); }, { passive: true });
    });
    canvas.addEventListener("wheel", function (event) {
      if (document.activeElement !== canvas && !event.ctrlKey) event.stopImmediatePropagation();
    }, { passive: true });
  }

  // Handle by which one finger turns the blocks.
  listenToHandle() {
    const viewer = this, handle = part("handle"), kTurnPerPixel = 0.01;
    let last = null;
    handle.addEventListener("pointerdown", function (event) { last = [event.clientX, event.clientY]; handle.setPointerCapture(event.pointerId); });
    handle.addEventListener("pointermove", function (event) {
      if (!last) return;
      viewer.turn(kTurnPerPixel * (last[0] - event.clientX), kTurnPerPixel * (last[1] - event.clientY));
      last = [event.clientX, event.clientY];
    });
    ["pointerup", "pointercancel"].forEach(function (name) { handle.addEventListener(name, function () { last = null; }); });
  }

  fillControls() {
    const viewer = this;
    const hasVelocity = this.runs.some(function (run) { return run.hasFrames; });
    QUANTITIES.forEach(function (quantity) {
      if (!hasVelocity && quantity.moves) return;
      if (quantity.kept && !this.runs.some(quantity.kept)) return;
      part("colour").add(new Option(quantity.name, quantity.key));
    }, this);
    this.runs.forEach(function (run, i) { part("run").add(new Option(run.label, String(i))); });
    part("time").max = String(this.duration);
    // so slow that the whole takes about ten seconds
    const speeds = Array.from(part("speed").options), kSeconds = 10;
    const oddness = function (option) { return Math.abs(Math.log(Math.max(viewer.duration, 1e-9) / Number(option.value) / kSeconds)); };
    part("speed").value = speeds.reduce(function (best, option) { return oddness(option) < oddness(best) ? option : best; }).value;
    part("block").max = String(this.runs[0].blocks);
  }

  listen() {
    const viewer = this;
    const on = function (name, event, act) { part(name).addEventListener(event, act); };
    const choose = function () { viewer.choose(Number(part("run").value), Number(part("block").value) - 1); };
    on("play", "click", function () { viewer.play(!viewer.playing); });
    on("back", "click", function () { viewer.step(-1); });
    on("on", "click", function () { viewer.step(1); });
    on("time", "input", function () { viewer.goTo(Number(part("time").value)); });
    on("colour", "change", function () { viewer.chooseQuantity(); viewer.update(); });
    on("exaggeration", "input", function () { viewer.shared.exaggeration.value = Math.max(1, Number(part("exaggeration").value) || 1); viewer.update(); });
    on("relative", "change", function () { viewer.update(); });
    on("cut", "input", function () { viewer.cut(); });
    on("cut-axis", "change", function () { viewer.cut(); });
    on("block", "change", choose);
    on("run", "change", function () { part("block").max = String(viewer.runs[Number(part("run").value)].blocks); choose(); });
    on("reset", "click", function () { viewer.look(viewer.firstView); });
    on("fill", "click", function () { viewer.fillScreen(); });
    on("keys", "click", function () { viewer.help(); });
    holder.querySelectorAll("[data-camera]").forEach(function (button) {
      button.addEventListener("click", function () { viewer.look(button.dataset.camera); });
    });
    let down = null;
    this.canvas.addEventListener("pointerdown", function (event) { down = [event.clientX, event.clientY]; });
    this.canvas.addEventListener("pointerup", function (event) {
      if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) viewer.pick(event);
    });
    this.controls.addEventListener("start", function () { viewer.leaveView(); });
    this.controls.addEventListener("change", function () { viewer.draw(); });
    document.addEventListener("musim-seek", function (event) { viewer.goTo(event.detail); });
    this.listenToHandle();
    listenToKeys(this);
    new ResizeObserver(function () { viewer.resize(); }).observe(this.canvas.parentElement);
  }

  turn(around, over) {
    this.leaveView();
    turnCamera(this.camera, this.controls.target, around, over);
    this.controls.update();
    this.draw();
  }

  approach(share) {
    this.leaveView();
    this.camera.position.sub(this.controls.target).multiplyScalar(share).add(this.controls.target);
    this.controls.update();
    this.draw();
  }

  // The camera is moved by hand from here on: a new size of the window leaves it where it is.
  leaveView() {
    this.view = null;
    this.markView();
  }

  markView() {
    const view = this.view;
    holder.querySelectorAll("[data-camera]").forEach(function (button) { button.setAttribute("aria-pressed", String(button.dataset.camera === view)); });
  }

  look(view) {
    this.view = view;
    const viewer = this, reachOf = function (direction) { return findReach(viewer.corners, viewer.shifts, direction); };
    const fit = fitCamera(this.camera, reachOf, DIRECTIONS[view]);
    const distance = fit.position.distanceTo(fit.target);
    this.controls.target.copy(fit.target);
    this.camera.position.copy(fit.position);
    this.camera.near = 0.01 * distance;
    this.camera.far = 20 * distance;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.markView();
    this.draw();
  }

  fillScreen() {
    if (document.fullscreenElement) document.exitFullscreen();
    else if (holder.requestFullscreen) holder.requestFullscreen();
  }

  help() {
    part("help").showModal();
  }

  cut() {
    const axis = { x: 0, y: 1, z: 2 }[part("cut-axis").value], share = Number(part("cut").value) / 1000;
    const low = this.bounds.low[axis], high = this.bounds.high[axis];
    this.shared.cutNormal.value.set(axis === 0 ? 1 : 0, axis === 1 ? 1 : 0, axis === 2 ? 1 : 0);
    // from the front: what lies nearer is cut away across y
    if (axis === 1) this.shared.cutNormal.value.negate();
    this.shared.cutAt.value = share >= 1 ? 1e9 : axis === 1 ? -(high + (low - high) * share) : low + (high - low) * share;
    this.draw();
  }

  chooseQuantity() {
    const key = part("colour").value;
    this.quantity = QUANTITIES.find(function (quantity) { return quantity.key === key; });
    if (!(key in this.limits)) this.limits[key] = Math.max.apply(null, this.runs.map(function (run) { return run.limit(key); }));
    this.shared.colours.value = this.textures[this.quantity.signed];
    const map = this.quantity.signed ? DIVERGING : SEQUENTIAL, limit = this.limits[key], quantity = this.quantity;
    const bar = document.createElement("div"), ends = document.createElement("div");
    bar.className = "bar";
    bar.style.background = "linear-gradient(to right, " + map.join(", ") + ")";
    ends.className = "ends";
    (this.quantity.signed ? [-limit, 0, limit] : [0, 0.5 * limit, limit]).forEach(function (value) {
      const text = document.createElement("span");
      text.textContent = format(value, quantity);
      ends.appendChild(text);
    });
    part("legend").replaceChildren(document.createTextNode(this.quantity.name), bar, ends);
    this.properties.make();
  }

  play(on) {
    this.playing = on && this.duration > 0;
    part("play").setAttribute("aria-pressed", String(this.playing));
    part("play").textContent = this.playing ? "Pause" : "Play";
    if (!this.playing) return;
    if (this.time >= this.duration) this.time = 0;
    let before = null;
    const viewer = this;
    const tick = function (now) {
      if (!viewer.playing) return;
      if (before !== null) viewer.time = Math.min(viewer.duration, viewer.time + Number(part("speed").value) * (now - before) / 1000);
      before = now;
      viewer.update();
      if (viewer.time >= viewer.duration) viewer.play(false); else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  goTo(time) {
    this.play(false);
    this.time = Math.min(this.duration, Math.max(0, time));
    this.update();
  }

  // To the next frame of the first run in a direction, or to the end that lies there.
  step(direction) {
    const times = this.runs[0].times, now = this.time, kSame = 1e-9 * this.duration;
    const beyond = times.filter(function (time) { return direction * (time - now) > kSame; });
    this.goTo(beyond.length === 0 ? (direction > 0 ? this.duration : 0) : direction > 0 ? beyond[0] : beyond[beyond.length - 1]);
  }

  choose(run, block) {
    if (!(block >= 0 && block < this.runs[run].blocks)) return;
    this.chosen = { run: run, block: block };
    part("run").value = String(run);
    part("block").value = String(block + 1);
    this.properties.make();
    this.update();
  }

  // The nearest block on the ray through a pixel.
  pick(event) {
    const rect = this.canvas.getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(2 * (event.clientX - rect.left) / rect.width - 1, 1 - 2 * (event.clientY - rect.top) / rect.height), this.camera);
    let best = null;
    this.groups.forEach(function (group, g) {
      const run = group.run, turn = new THREE.Quaternion(), more = new THREE.Quaternion(), inverse = new THREE.Quaternion();
      for (let b = 0; b < run.blocks; ++b) {
        const s = run.start, normal = this.shared.cutNormal.value;
        if ((normal.x * s[10 * b] + normal.y * s[10 * b + 1] + normal.z * s[10 * b + 2]) / run.length > this.shared.cutAt.value) continue;
        const axis = new THREE.Vector3(run.rotation[3 * b], run.rotation[3 * b + 1], run.rotation[3 * b + 2]).multiplyScalar(this.shared.exaggeration.value);
        const angle = axis.length();
        turn.set(s[10 * b + 4], s[10 * b + 5], s[10 * b + 6], s[10 * b + 3]);
        if (angle > 0) turn.premultiply(more.setFromAxisAngle(axis.divideScalar(angle), angle));
        inverse.copy(turn.premultiply(group.tilt)).conjugate();
        const centre = group.centre(b, this.shared.exaggeration.value);
        const extent = new THREE.Vector3().fromArray(run.extentOf(b)).divideScalar(run.length);
        const from = ray.ray.origin.clone().sub(centre).applyQuaternion(inverse).divide(extent);
        const along = ray.ray.direction.clone().applyQuaternion(inverse).divide(extent);
        const enter = findEntry(run.shapeOf(b), from, along);
        if (enter > 0 && enter < Infinity && (best === null || enter < best.at)) best = { at: enter, run: g, block: b };
      }
    }, this);
    if (best) this.choose(best.run, best.block);
  }

  historyOf(run, block) {
    const key = this.quantity.key, now = this.time;
    const points = run.times.map(function (time) { run.seekBlock(time, block); return [time, run.value(key, block)]; });
    run.seek(now);
    return points;
  }

  update() {
    const relative = part("relative").checked, limit = this.limits[this.quantity.key];
    this.groups.forEach(function (group, i) { group.show(this.time, this.quantity, limit, relative, i === this.chosen.run ? this.chosen.block : -1); }, this);
    this.grounds.forEach(function (ground, i) { this.groups[i].putOnBase(ground); }, this);
    part("time").value = String(this.time);
    part("clock").textContent = this.time.toFixed(3) + " s of " + Number(this.duration.toPrecision(4)) + " s";
    part("time").setAttribute("aria-valuetext", part("clock").textContent);
    this.properties.show();
    // the plots of the page show the time, too
    document.dispatchEvent(new CustomEvent("musim-time", { detail: this.time }));
    this.draw();
  }

  resize() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width < 1 || height < 1) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.view === null) return this.draw();
    this.arrange();
    if (this.view) this.look(this.view);
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
    this.names.place(this.camera, this.boxes, this.canvas.clientWidth, this.canvas.clientHeight);
    const turn = this.camera.quaternion;
    this.triad.show(new THREE.Vector3(1, 0, 0).applyQuaternion(turn), new THREE.Vector3(0, 1, 0).applyQuaternion(turn));
  }
}
