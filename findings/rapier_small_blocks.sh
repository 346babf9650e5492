#!/usr/bin/env bash
# Rapier 0.21.0 (npm, @dimforge/rapier3d-compat): moments of inertia of a block given by its eight corners, from a density.
# Guess: over m L^2 they are the same at every size; of edges 0.4, 0.6 and 1 times L they are 0.1133, 0.0967 and 0.0433 about x, y and z.
# Behaviour: so they are at L = 1 m and 10 cm; at 3 cm and 1 cm, of stone, those about x and z are exchanged without a word: a slender block
# that should topple turns as if it lay. Density decides with the size (300 kg/m^3: at 6 cm too): something absolute is compared where
# principal axes are found. `cuboid` is right at every size; so is a hull whose mass properties are set by hand (setMassProperties).
set -euo pipefail
source "$(dirname "$(realpath "$0")")/support/debian.sh"
npm install --silent --no-audit --no-fund @dimforge/rapier3d-compat@0.21.0 >/dev/null

cat > blow.mjs <<'CODE'
import RAPIER from '@dimforge/rapier3d-compat';
await RAPIER.init();
const [kind, length, density] = [process.argv[2], ...process.argv.slice(3).map(Number)], half = [0.2, 0.3, 0.5].map(part => part * length);
const corners = [...Array(8).keys()].flatMap(i => half.map((h, k) => i >> k & 1 ? h : -h));
/// A blow of m L^2 about an axis: the spin it leaves is one over the moment of inertia over m L^2.
function strike(axis) {
    const world = new RAPIER.World({x: 0, y: 0, z: 0}), body = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic());
    const shape = kind === 'hull' ? RAPIER.ColliderDesc.convexHull(Float32Array.from(corners)) : RAPIER.ColliderDesc.cuboid(...half);
    world.createCollider(shape.setDensity(density), body);
    body.recomputeMassPropertiesFromColliders();
    body.applyTorqueImpulse({x: 0, y: 0, z: 0, [axis]: body.mass() * length ** 2}, true);
    return (1 / body.angvel()[axis]).toFixed(4);
}
console.log(['x', 'y', 'z'].map(strike).join(' '));
CODE
for length in 1 0.1; do expect "hull, $length m" "$(node blow.mjs hull $length 2500)" "0.1133 0.0967 0.0433"; done
for length in 0.03 0.01; do expect "hull, $length m" "$(node blow.mjs hull $length 2500)" "0.0433 0.0967 0.1133"; done
expect "hull, 0.06 m, 300 kg/m^3" "$(node blow.mjs hull 0.06 300)" "0.0433 0.0967 0.1133"
for length in 1 0.01; do expect "cuboid, $length m" "$(node blow.mjs cuboid $length 2500)" "0.1133 0.0967 0.0433"; done
