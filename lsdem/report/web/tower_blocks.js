// The blocks of a run as meshes of three.js, one for each shape.
const VERTEX = [
  "attribute float inside; attribute vec3 place; attribute vec4 turn; attribute vec3 extent; attribute vec3 moved; attribute vec3 turned; attribute float shade;",
  "uniform float enlarge; uniform float exaggeration; uniform vec3 ground; uniform vec4 tilt; uniform vec3 pivot; uniform vec3 origin; uniform vec3 cutNormal; uniform float cutAt; uniform vec3 size;",
  "varying float vShade; varying float vInside; varying vec3 vFace; varying vec3 vNormal;",
  "vec4 product(vec4 a, vec4 b) { return vec4(a.w*b.xyz + b.w*a.xyz + cross(a.xyz, b.xyz), a.w*b.w - dot(a.xyz, b.xyz)); }",
  "vec3 rotate(vec4 q, vec3 v) { return v + 2.0*cross(q.xyz, cross(q.xyz, v) + q.w*v); }",
  "vec4 fromVector(vec3 r) { float a = length(r); return a < 1e-9 ? vec4(0.5*r, 1.0) : vec4(r*(sin(0.5*a)/a), cos(0.5*a)); }",
  "void main() {",
  "  vec4 q = product(fromVector(exaggeration*turned), turn);",
  "  vec3 centre = place + exaggeration*(moved - ground);",
  "  vec3 at = origin + enlarge*(pivot + rotate(tilt, centre + rotate(q, position*extent) - pivot));",
  "  vShade = shade; vInside = inside; vFace = position/size; vNormal = normalize(normalMatrix*rotate(tilt, rotate(q, normal)));",
  "  gl_Position = dot(cutNormal, enlarge*place) > cutAt ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix*modelViewMatrix*vec4(at, 1.0);",
  "}"].join("\n");
// The chosen block is striped, so that no colour of a quantity is taken for it.
const FRAGMENT = [
  "precision mediump float;",
  "uniform sampler2D colours; varying float vShade; varying float vInside; varying vec3 vFace; varying vec3 vNormal;",
  "void main() {",
  "  float stripe = step(0.5, fract(3.0*(vFace.x + vFace.y + vFace.z)));",
  "  vec3 colour = vShade < -0.5 ? mix(vec3(0.0), vec3(1.0, 0.85, 0.0), stripe) : texture2D(colours, vec2(clamp(vShade, 0.002, 0.998), 0.5)).rgb;",
  "  float light = 0.55 + 0.45*abs(normalize(vNormal).z);",
  "  gl_FragColor = vec4(colour*light*(vInside < 0.045 ? 0.45 : 1.0), 1.0);",
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

// Surface of a shape, each face as triangles about its middle: `inside` is 0 on its lines, 1 in the middle.
function makeSurface(shape) {
  const position = [], normal = [], inside = [];
  shape.faces.forEach(function (face, f) {
    const corners = face.map(function (c) { return new THREE.Vector3().fromArray(shape.corners[c]); });
    const middle = new THREE.Vector3();
    corners.forEach(function (corner) { middle.addScaledVector(corner, 1 / corners.length); });
    corners.forEach(function (corner, i) {
      const line = shape.lines[f][i] ? 0 : 1;
      [middle, corner, corners[(i + 1) % corners.length]].forEach(function (place, k) {
        const across = shape.radius > 0 ? place.clone().normalize() : shape.normals[f];
        position.push(place.x, place.y, place.z);
        normal.push(across.x, across.y, across.z);
        inside.push(k === 0 ? 1 : line);
      });
    });
  });
  return { position: position, normal: normal, inside: inside };
}

// A shape, drawn as often as there are blocks of it.
class ShapeMesh {
  constructor(run, number, blocks, uniforms) {
    this.blocks = blocks;
    const n = blocks.length, shape = run.shapes[number], surface = makeSurface(shape);
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.maxInstancedCount = n;
    const set = function (name, attribute) {
      geometry.setAttribute ? geometry.setAttribute(name, attribute) : geometry.addAttribute(name, attribute);
      return attribute;
    };
    set("position", new THREE.Float32BufferAttribute(surface.position, 3));
    set("normal", new THREE.Float32BufferAttribute(surface.normal, 3));
    set("inside", new THREE.Float32BufferAttribute(surface.inside, 1));
    const add = function (name, size) { return set(name, new THREE.InstancedBufferAttribute(new Float32Array(size * n), size)); };
    const place = add("place", 3), turn = add("turn", 4), extent = add("extent", 3);
    blocks.forEach(function (b, i) {
      const s = run.start.subarray(10 * b, 10 * b + 10);
      place.array.set([s[0], s[1], s[2]], 3 * i);
      turn.array.set([s[4], s[5], s[6], s[3]], 4 * i);
      extent.array.set(run.extentOf(b), 3 * i);
    });
    this.moved = add("moved", 3);
    this.turned = add("turned", 3);
    this.shade = add("shade", 1);
    const own = Object.assign({ size: { value: new THREE.Vector3().fromArray(shape.size) } }, uniforms);
    this.mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({ uniforms: own, vertexShader: VERTEX, fragmentShader: FRAGMENT }));
    this.mesh.frustumCulled = false;
  }

  // Takes the values of its blocks from those of all.
  show(run, shade) {
    this.blocks.forEach(function (b, i) {
      for (let axis = 0; axis < 3; ++axis) {
        this.moved.array[3 * i + axis] = run.displacement[3 * b + axis];
        this.turned.array[3 * i + axis] = run.rotation[3 * b + axis];
      }
      this.shade.array[i] = shade[b];
    }, this);
    this.moved.needsUpdate = this.turned.needsUpdate = this.shade.needsUpdate = true;
  }
}

// All blocks of a run.
class Blocks {
  constructor(run, origin, uniforms) {
    this.run = run;
    this.origin = origin;
    this.shade = new Float32Array(run.blocks);
    this.uniforms = Object.assign({ enlarge: { value: 1 / run.length }, ground: { value: new THREE.Vector3() }, tilt: { value: new THREE.Vector4(0, 0, 0, 1) }, pivot: { value: new THREE.Vector3() }, origin: { value: origin } }, uniforms);
    this.meshes = [];
    this.object = new THREE.Group();
    run.shapes.forEach(function (shape, number) {
      const blocks = [];
      for (let b = 0; b < run.blocks; ++b) if (run.shape[b] === number) blocks.push(b);
      if (blocks.length === 0) return;
      const mesh = new ShapeMesh(run, number, blocks, this.uniforms);
      this.meshes.push(mesh);
      this.object.add(mesh.mesh);
    }, this);
  }

  show(time, quantity, limit, relative, chosen) {
    const run = this.run, shade = this.shade;
    run.seek(time);
    const ground = relative ? run.ground : [0, 0, 0];
    this.uniforms.ground.value.set(ground[0], ground[1], ground[2]);
    // the base turns as it does, whatever displacements are multiplied by
    const turn = this.tilt = relative ? new THREE.Quaternion() : run.turn.clone();
    this.uniforms.tilt.value.set(turn.x, turn.y, turn.z, turn.w);
    const shift = new THREE.Vector3().fromArray(run.ground).sub(this.uniforms.ground.value);
    this.uniforms.pivot.value.copy(run.pivot).addScaledVector(shift, this.uniforms.exaggeration.value);
    for (let b = 0; b < run.blocks; ++b) {
      const share = limit > 0 ? run.value(quantity.key, b) / limit : 0;
      shade[b] = quantity.signed ? 0.5 * (1 + share) : share;
    }
    if (chosen >= 0) shade[chosen] = -1;
    this.meshes.forEach(function (mesh) { mesh.show(run, shade); });
  }

  // Centre of a block as it is drawn.
  centre(block, exaggeration) {
    const run = this.run, ground = this.uniforms.ground.value, s = run.start, d = run.displacement;
    const place = new THREE.Vector3(
      s[10 * block] + exaggeration * (d[3 * block] - ground.x),
      s[10 * block + 1] + exaggeration * (d[3 * block + 1] - ground.y),
      s[10 * block + 2] + exaggeration * (d[3 * block + 2] - ground.z));
    return this.turned(place).divideScalar(run.length).add(this.origin);
  }

  // A place that turns with the base.
  turned(place) {
    const pivot = this.uniforms.pivot.value;
    return place.sub(pivot).applyQuaternion(this.tilt).add(pivot);
  }

  // Puts what stands on the base at the start, in units of the first run, where the base is.
  putOnBase(object) {
    const shift = new THREE.Vector3().copy(this.uniforms.pivot.value).sub(this.run.pivot);
    object.position.copy(this.turned(shift)).divideScalar(this.run.length).add(this.origin).sub(this.origin.clone().applyQuaternion(this.tilt));
    object.quaternion.copy(this.tilt);
  }
}
