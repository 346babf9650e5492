// Blocks of one or several runs in 3D, side by side in the time of the first run.
"use strict";
(function () {
  const holder = document.getElementById("tower");
  if (!holder) return;
  const part = function (name) { return document.getElementById("tower-" + name); };
  const message = part("message");
  const tell = function (text) { message.textContent = text; };

  // Colours at even places, linear in between: viridis of matplotlib, and RdBu of ColorBrewer for what has a sign.
  const SEQUENTIAL = ["#440154", "#482475", "#414487", "#355f8d", "#2a788e", "#21918c", "#22a884", "#44bf70", "#7ad151", "#bddf26", "#fde725"];
  const DIVERGING = ["#053061", "#2166ac", "#4393c3", "#92c5de", "#d1e5f0", "#f7f7f7", "#fddbc7", "#f4a582", "#d6604d", "#b2182b", "#67001f"];

  const isShaken = function (run) { return !run.stands; };

  // `unit` is what is told, `factor` of it in one of the values (m/s, m, degrees).
  const QUANTITIES = [
    { key: "vx", name: "velocity along x", unit: "cm/s", factor: 100, signed: true, moves: true },
    { key: "vy", name: "velocity along y", unit: "cm/s", factor: 100, signed: true, moves: true },
    { key: "vz", name: "velocity along z", unit: "cm/s", factor: 100, signed: true, moves: true },
    { key: "speed", name: "speed", unit: "cm/s", factor: 100, signed: false, moves: true },
    { key: "moved", name: "displacement since the start, relative to the base", unit: "mm", factor: 1000, signed: false, kept: isShaken },
    { key: "turned", name: "rotation since the start", unit: "°", factor: 1, signed: false, kept: isShaken },
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
      this.start = new Float32Array(bytesOf(data.start).buffer);
      this.slip = new Float32Array(bytesOf(data.slip).buffer);
      this.layer = new Int16Array(bytesOf(data.layer).buffer);
      this.frames = frames;
      this.forces = forces;
      this.largestForce = data.scales.force;
      this.step = { moved: data.scales.displacement / 32767, turned: data.scales.rotation / 32767, fast: data.scales.velocity / 127 };
      this.displacement = new Float32Array(3 * this.blocks);
      this.rotation = new Float32Array(3 * this.blocks);
      this.ground = [0, 0, 0];
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

  const VERTEX = [
    "attribute vec3 place; attribute vec4 turn; attribute vec3 extent; attribute vec3 moved; attribute vec3 turned; attribute float shade;",
    "uniform float enlarge; uniform float exaggeration; uniform vec3 ground; uniform vec3 origin; uniform vec3 cutNormal; uniform float cutAt;",
    "varying float vShade; varying vec3 vFace; varying vec3 vNormal;",
    "vec4 product(vec4 a, vec4 b) { return vec4(a.w*b.xyz + b.w*a.xyz + cross(a.xyz, b.xyz), a.w*b.w - dot(a.xyz, b.xyz)); }",
    "vec3 rotate(vec4 q, vec3 v) { return v + 2.0*cross(q.xyz, cross(q.xyz, v) + q.w*v); }",
    "vec4 fromVector(vec3 r) { float a = length(r); return a < 1e-9 ? vec4(0.5*r, 1.0) : vec4(r*(sin(0.5*a)/a), cos(0.5*a)); }",
    "void main() {",
    "  vec4 q = product(fromVector(exaggeration*turned), turn);",
    "  vec3 centre = place + exaggeration*(moved - ground);",
    "  vec3 at = origin + enlarge*(centre + rotate(q, position*extent));",
    "  vShade = shade; vFace = position; vNormal = normalize(normalMatrix*rotate(q, normal));",
    "  gl_Position = dot(cutNormal, enlarge*place) > cutAt ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix*modelViewMatrix*vec4(at, 1.0);",
    "}"].join("\n");
  const FRAGMENT = [
    "precision mediump float;",
    "uniform sampler2D colours; varying float vShade; varying vec3 vFace; varying vec3 vNormal;",
    "void main() {",
    "  vec3 a = abs(vFace)*2.0; float inner = max(min(a.x, a.y), max(min(a.y, a.z), min(a.x, a.z)));",
    "  vec3 colour = vShade < -0.5 ? vec3(1.0, 0.0, 1.0) : texture2D(colours, vec2(clamp(vShade, 0.002, 0.998), 0.5)).rgb;",
    "  float light = 0.55 + 0.45*abs(normalize(vNormal).z);",
    "  gl_FragColor = vec4(colour*light*(inner > 0.955 ? 0.45 : 1.0), 1.0);",
    "}"].join("\n");

  function colourTexture(map) {
    const data = new Uint8Array(4 * 256);
    for (let i = 0; i < 256; ++i) {
      const scaled = i / 255 * (map.length - 1), index = Math.min(Math.floor(scaled), map.length - 2), weight = scaled - index;
      const from = new THREE.Color(map[index]), to = new THREE.Color(map[index + 1]);
      const mixed = from.lerp(to, weight);
      data[4 * i] = Math.round(255 * mixed.r); data[4 * i + 1] = Math.round(255 * mixed.g); data[4 * i + 2] = Math.round(255 * mixed.b); data[4 * i + 3] = 255;
    }
    const texture = new THREE.DataTexture(data, 256, 1, THREE.RGBAFormat);
    texture.needsUpdate = true;
    return texture;
  }

  // The mesh of a run: one box for all blocks, drawn as often as there are blocks.
  class Blocks {
    constructor(run, origin, uniforms) {
      this.run = run;
      this.origin = origin;
      const n = run.blocks, box = new THREE.BoxBufferGeometry(1, 1, 1);
      const geometry = new THREE.InstancedBufferGeometry();
      geometry.index = box.index;
      geometry.attributes.position = box.attributes.position;
      geometry.attributes.normal = box.attributes.normal;
      geometry.maxInstancedCount = n;
      const place = new Float32Array(3 * n), turn = new Float32Array(4 * n), extent = new Float32Array(3 * n);
      for (let b = 0; b < n; ++b) {
        const s = run.start.subarray(10 * b, 10 * b + 10);
        place.set([s[0], s[1], s[2]], 3 * b);
        turn.set([s[4], s[5], s[6], s[3]], 4 * b);
        extent.set([s[7], s[8], s[9]], 3 * b);
      }
      const add = function (name, values, size) {
        const attribute = new THREE.InstancedBufferAttribute(values, size);
        geometry.setAttribute ? geometry.setAttribute(name, attribute) : geometry.addAttribute(name, attribute);
        return attribute;
      };
      add("place", place, 3); add("turn", turn, 4); add("extent", extent, 3);
      this.moved = add("moved", run.displacement, 3);
      this.turned = add("turned", run.rotation, 3);
      this.shade = add("shade", new Float32Array(n), 1);
      this.uniforms = Object.assign({ enlarge: { value: 1 / run.length }, ground: { value: new THREE.Vector3() }, origin: { value: origin } }, uniforms);
      const material = new THREE.ShaderMaterial({ uniforms: this.uniforms, vertexShader: VERTEX, fragmentShader: FRAGMENT });
      this.mesh = new THREE.Mesh(geometry, material);
      this.mesh.frustumCulled = false;
    }

    show(time, quantity, limit, relative, chosen) {
      const run = this.run;
      run.seek(time);
      const ground = relative ? run.ground : [0, 0, 0];
      this.uniforms.ground.value.set(ground[0], ground[1], ground[2]);
      const shade = this.shade.array;
      for (let b = 0; b < run.blocks; ++b) {
        const share = limit > 0 ? run.value(quantity.key, b) / limit : 0;
        shade[b] = quantity.signed ? 0.5 * (1 + share) : share;
      }
      if (chosen >= 0) shade[chosen] = -1;
      this.moved.needsUpdate = this.turned.needsUpdate = this.shade.needsUpdate = true;
    }

    // Centre of a block as it is drawn.
    centre(block, exaggeration) {
      const run = this.run, ground = this.uniforms.ground.value, s = run.start, d = run.displacement, k = 1 / run.length;
      return new THREE.Vector3(
        this.origin.x + k * (s[10 * block] + exaggeration * (d[3 * block] - ground.x)),
        this.origin.y + k * (s[10 * block + 1] + exaggeration * (d[3 * block + 1] - ground.y)),
        this.origin.z + k * (s[10 * block + 2] + exaggeration * (d[3 * block + 2] - ground.z)));
    }
  }

  // Extent of all blocks of a run at its start, in units of the first run.
  function findBounds(run) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let b = 0; b < run.blocks; ++b) {
      for (let axis = 0; axis < 3; ++axis) {
        const centre = run.start[10 * b + axis] / run.length, half = 0.5 * run.start[10 * b + 7 + axis] / run.length;
        low[axis] = Math.min(low[axis], centre - half);
        high[axis] = Math.max(high[axis], centre + half);
      }
    }
    return { low: low, high: high };
  }

  const leastOf = function (corners) { return [0, 1, 2].map(function (axis) { return Math.min.apply(null, corners.map(function (c) { return c[axis]; })); }); };
  const mostOf = function (corners) { return [0, 1, 2].map(function (axis) { return Math.max.apply(null, corners.map(function (c) { return c[axis]; })); }); };

  function polyline(points, width, height) {
    let least = Infinity, most = -Infinity;
    points.forEach(function (p) { least = Math.min(least, p[1]); most = Math.max(most, p[1]); });
    const first = points[0][0], last = points[points.length - 1][0];
    const x = function (t) { return 4 + (width - 8) * (last > first ? (t - first) / (last - first) : 0.5); };
    const y = function (v) { return height - 4 - (height - 8) * (most > least ? (v - least) / (most - least) : 0.5); };
    return points.map(function (p) { return x(p[0]).toFixed(1) + "," + y(p[1]).toFixed(1); }).join(" ");
  }

  function format(value, quantity) {
    const number = Number((value * quantity.factor).toPrecision(3)).toString();
    return quantity.unit ? number + " " + quantity.unit : number;
  }

  class Viewer {
    constructor(runs) {
      this.runs = runs;
      this.duration = Math.max.apply(null, runs.map(function (run) { return run.times[run.times.length - 1]; }));
      this.time = 0;
      this.playing = false;
      this.chosen = { run: 0, block: -1 };
      this.limits = {};
      this.canvas = part("canvas");
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
      this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
      this.scene = new THREE.Scene();
      this.shared = { exaggeration: { value: 1 }, cutNormal: { value: new THREE.Vector3(0, 1, 0) }, cutAt: { value: 1e9 }, colours: { value: null } };
      this.textures = { true: colourTexture(DIVERGING), false: colourTexture(SEQUENTIAL) };
      const bounds = runs.map(findBounds);
      // what cuts go through: all runs in one place
      this.bounds = { low: leastOf(bounds.map(function (b) { return b.low; })), high: mostOf(bounds.map(function (b) { return b.high; })) };
      const gap = 0.6 * Math.max.apply(null, bounds.map(function (b) { return b.high[0] - b.low[0]; }));
      let edge = bounds[0].low[0];
      this.groups = runs.map(function (run, i) {
        const group = new Blocks(run, new THREE.Vector3(edge - bounds[i].low[0], 0, 0), this.shared);
        edge += bounds[i].high[0] - bounds[i].low[0] + gap;
        return group;
      }, this);
      // what cameras look at: all runs side by side
      this.extent = { low: [bounds[0].low[0], this.bounds.low[1], this.bounds.low[2]], high: [edge - gap, this.bounds.high[1], this.bounds.high[2]] };
      this.groups.forEach(function (group) { this.scene.add(group.mesh); }, this);
      this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
      this.camera.up.set(0, 0, 1);
      this.leaveFingerToPage();
      this.controls = new THREE.OrbitControls(this.camera, this.canvas);
      this.controls.touches.TWO = THREE.TOUCH.DOLLY_ROTATE;
      this.controls.enableKeys = false;
      this.controls.addEventListener("change", this.draw.bind(this));
      holder.classList.toggle("still", runs.every(function (run) { return run.stands; }));
      this.fillControls();
      this.listen();
      this.resize();
      this.look("corner");
      this.chooseQuantity();
      this.update();
    }

    // One finger scrolls the page: the controls, which would keep it, see touches of two only.
    leaveFingerToPage() {
      ["touchstart", "touchmove"].forEach(function (name) {
        this.canvas.addEventListener(name, function (event) { if (event.touches.length < 2) event.stopImmediatePropagation(); }, { passive: true });
      }, this);
    }

    // What one finger turns the blocks by.
    listenToHandle() {
      const viewer = this, handle = part("handle"), kTurnPerPixel = 0.01;
      let last = null;
      handle.addEventListener("pointerdown", function (event) { last = [event.clientX, event.clientY]; handle.setPointerCapture(event.pointerId); });
      handle.addEventListener("pointermove", function (event) {
        if (!last) return;
        viewer.turn(kTurnPerPixel * (last[0] - event.clientX), kTurnPerPixel * (last[1] - event.clientY));
        last = [event.clientX, event.clientY];
        viewer.controls.update();
        viewer.draw();
      });
      ["pointerup", "pointercancel"].forEach(function (name) { handle.addEventListener(name, function () { last = null; }); });
    }

    fillControls() {
      const hasVelocity = this.runs.some(function (run) { return run.hasFrames; });
      QUANTITIES.forEach(function (quantity) {
        if (!hasVelocity && quantity.moves) return;
        if (quantity.kept && !this.runs.some(quantity.kept)) return;
        part("colour").add(new Option(quantity.name, quantity.key));
      }, this);
      this.runs.forEach(function (run, i) { part("run").add(new Option(run.label, String(i))); });
      part("time").max = String(this.duration);
      part("block").max = String(this.runs[0].blocks);
    }

    listen() {
      const viewer = this;
      part("play").addEventListener("click", function () { viewer.play(!viewer.playing); });
      part("time").addEventListener("input", function () { viewer.play(false); viewer.time = Number(part("time").value); viewer.update(); });
      part("colour").addEventListener("change", function () { viewer.chooseQuantity(); viewer.update(); });
      part("exaggeration").addEventListener("input", function () { viewer.shared.exaggeration.value = Math.max(1, Number(part("exaggeration").value) || 1); viewer.update(); });
      part("relative").addEventListener("change", function () { viewer.update(); });
      part("cut").addEventListener("input", function () { viewer.cut(); });
      part("cut-axis").addEventListener("change", function () { viewer.cut(); });
      part("block").addEventListener("change", function () { viewer.choose(Number(part("run").value), Number(part("block").value) - 1); });
      part("run").addEventListener("change", function () { viewer.choose(Number(part("run").value), Number(part("block").value) - 1); });
      holder.querySelectorAll("[data-camera]").forEach(function (button) {
        button.addEventListener("click", function () { viewer.look(button.dataset.camera); });
      });
      let down = null;
      this.canvas.addEventListener("pointerdown", function (event) { down = [event.clientX, event.clientY]; });
      this.canvas.addEventListener("pointerup", function (event) {
        if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) viewer.pick(event);
      });
      this.listenToHandle();
      this.canvas.addEventListener("keydown", function (event) { viewer.key(event); });
      new ResizeObserver(function () { viewer.resize(); }).observe(this.canvas.parentElement);
    }

    key(event) {
      const turn = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
      const nearer = { "+": 0.9, "=": 0.9, "-": 1 / 0.9 }[event.key];
      if (turn) this.turn(turn[0], turn[1]);
      else if (nearer) this.camera.position.sub(this.controls.target).multiplyScalar(nearer).add(this.controls.target);
      else if (event.key === " ") this.play(!this.playing);
      else return;
      event.preventDefault();
      this.controls.update();
      this.draw();
    }

    turn(around, over) {
      const arm = this.camera.position.clone().sub(this.controls.target);
      const flat = Math.hypot(arm.x, arm.y), radius = arm.length();
      const azimuth = Math.atan2(arm.y, arm.x) + around;
      const height = Math.min(1.55, Math.max(-1.55, Math.atan2(arm.z, flat) - over));
      arm.set(radius * Math.cos(height) * Math.cos(azimuth), radius * Math.cos(height) * Math.sin(azimuth), radius * Math.sin(height));
      this.camera.position.copy(this.controls.target).add(arm);
    }

    look(preset) {
      const low = this.extent.low, high = this.extent.high, size = [0, 1, 2].map(function (i) { return high[i] - low[i]; });
      const tall = Math.max(size[2], size[0] / this.camera.aspect, preset === "top" ? size[1] : 0);
      const distance = 0.62 * tall / Math.tan(this.camera.fov * Math.PI / 360) + size[1];
      const target = new THREE.Vector3(0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2]));
      const direction = { front: [0, -1, 0], side: [1, 0, 0], top: [0, -0.001, 1], corner: [0.6, -1, 0.45] }[preset];
      this.controls.target.copy(target);
      this.camera.position.copy(new THREE.Vector3().fromArray(direction).normalize().multiplyScalar(distance)).add(target);
      this.camera.near = 0.01 * distance;
      this.camera.far = 20 * distance;
      this.camera.updateProjectionMatrix();
      this.controls.update();
      this.draw();
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

    choose(run, block) {
      if (!(block >= 0 && block < this.runs[run].blocks)) return;
      this.chosen = { run: run, block: block };
      part("run").value = String(run);
      part("block").value = String(block + 1);
      this.update();
    }

    // The nearest block on the ray through a pixel, as boxes at their places.
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
          inverse.copy(turn).conjugate();
          const centre = group.centre(b, this.shared.exaggeration.value);
          const from = ray.ray.origin.clone().sub(centre).applyQuaternion(inverse), along = ray.ray.direction.clone().applyQuaternion(inverse);
          let enter = -Infinity, leave = Infinity;
          ["x", "y", "z"].forEach(function (name, i) {
            const half = 0.5 * s[10 * b + 7 + i] / run.length;
            const a = (-half - from[name]) / along[name], c = (half - from[name]) / along[name];
            enter = Math.max(enter, Math.min(a, c));
            leave = Math.min(leave, Math.max(a, c));
          });
          if (enter <= leave && leave > 0 && (best === null || enter < best.at)) best = { at: enter, run: g, block: b };
        }
      }, this);
      if (best) this.choose(best.run, best.block);
    }

    describeBlock() {
      const facts = part("block-facts"), run = this.runs[this.chosen.run], b = this.chosen.block;
      if (b < 0) return;
      const table = document.createElement("table"), caption = document.createElement("caption");
      caption.textContent = "block " + (b + 1) + " of " + run.label + ", layer " + run.layer[b];
      table.appendChild(caption);
      QUANTITIES.forEach(function (quantity) {
        if (quantity.key === "layer" || (!run.hasFrames && quantity.moves) || (quantity.kept && !quantity.kept(run))) return;
        const row = table.insertRow(), head = document.createElement("th"), cell = document.createElement("td");
        head.scope = "row";
        head.textContent = quantity.name;
        cell.className = "number";
        cell.textContent = format(run.value(quantity.key, b), quantity);
        row.append(head, cell);
      });
      const points = this.historyOf(run, b);
      const picture = document.createElementNS("http://www.w3.org/2000/svg", "svg");
      picture.setAttribute("viewBox", "0 0 300 90");
      picture.setAttribute("role", "img");
      picture.setAttribute("aria-label", this.quantity.name + " of the block over time");
      const line = document.createElementNS("http://www.w3.org/2000/svg", "polyline");
      line.setAttribute("points", polyline(points, 300, 90));
      line.setAttribute("fill", "none");
      line.setAttribute("stroke", "currentColor");
      picture.appendChild(line);
      const values = points.map(function (p) { return p[1]; });
      const below = document.createElement("p");
      below.className = "small";
      below.textContent = this.quantity.name + " over " + this.duration.toPrecision(3) + " s, from " + format(Math.min.apply(null, values), this.quantity) +
        " to " + format(Math.max.apply(null, values), this.quantity);
      facts.replaceChildren(table, picture, below);
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
      part("time").value = String(this.time);
      part("clock").textContent = this.time.toFixed(3) + " s";
      this.describeBlock();
      this.draw();
    }

    resize() {
      const box = this.canvas.parentElement.getBoundingClientRect();
      if (box.width < 1 || box.height < 1) return;
      this.renderer.setSize(box.width, box.height, false);
      this.camera.aspect = box.width / box.height;
      this.camera.updateProjectionMatrix();
      this.draw();
    }

    draw() {
      this.renderer.render(this.scene, this.camera);
    }
  }

  // Only what one block needs: where it is at a time.
  Run.prototype.seekBlock = function (time, block) {
    const at = this.about(time), n = 3 * this.blocks;
    this.at = at;
    for (let axis = 0; axis < 3; ++axis) {
      const i = 3 * block + axis;
      this.displacement[i] = this.step.moved * ((1 - at.weight) * this.frames.moved[at.low * n + i] + at.weight * this.frames.moved[at.high * n + i]);
      this.rotation[i] = this.step.turned * ((1 - at.weight) * this.frames.turned[at.low * n + i] + at.weight * this.frames.turned[at.high * n + i]);
      this.ground[axis] = (1 - at.weight) * this.base[at.low][axis] + at.weight * this.base[at.high][axis];
    }
  };

  async function begin() {
    if (typeof DecompressionStream === "undefined") {
      tell("This browser cannot unpack the blocks (no DecompressionStream); one of 2023 or later can.");
      return;
    }
    tell("unpacking ...");
    const runs = [];
    for (const element of document.querySelectorAll("script.tower-data")) {
      const data = JSON.parse(element.textContent);
      element.remove();
      const packed = bytesOf(data.frames), forces = data.forces ? unpackForces(await inflate(bytesOf(data.forces)), data.blocks) : null;
      data.frames = data.forces = null;
      runs.push(new Run(data, unpack(await inflate(packed), data.times.length, data.blocks), forces));
    }
    try {
      window.musimTower = new Viewer(runs);
    } catch (error) {
      tell("This browser shows no 3D pictures (" + error.message + ").");
      return;
    }
    const still = runs.filter(function (run) { return !run.hasFrames && !run.stands; });
    const order = runs.length > 1 ? "from left to right: " + runs.map(function (run) { return run.label; }).join(", ") : "";
    const kept = still.length > 0 ? "start and end only: no frames were kept" : "";
    tell([order, kept].filter(Boolean).join("; "));
    holder.dataset.ready = "yes";
  }

  begin().catch(function (error) { tell("The blocks cannot be shown: " + error.message); throw error; });
})();
