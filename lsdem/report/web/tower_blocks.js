// The blocks of a run as one mesh of three.js.
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
// The chosen block is striped, so that no colour of a quantity is taken for it.
const FRAGMENT = [
  "precision mediump float;",
  "uniform sampler2D colours; varying float vShade; varying vec3 vFace; varying vec3 vNormal;",
  "void main() {",
  "  vec3 a = abs(vFace)*2.0; float inner = max(min(a.x, a.y), max(min(a.y, a.z), min(a.x, a.z)));",
  "  float stripe = step(0.5, fract(3.0*(vFace.x + vFace.y + vFace.z)));",
  "  vec3 colour = vShade < -0.5 ? mix(vec3(0.0), vec3(1.0, 0.85, 0.0), stripe) : texture2D(colours, vec2(clamp(vShade, 0.002, 0.998), 0.5)).rgb;",
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
