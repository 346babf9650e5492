// Rapier. As "rapier_unit" its length unit is the block's edge, as its documentation asks for where bodies are not of metres.
import RAPIER from '@dimforge/rapier3d-compat';
import {prism, volume, measure, kDensity, kFriction, kGravity} from './measure.mjs';

await RAPIER.init();
const own = process.argv[2] === 'rapier_unit';

function describe(kind, edge) {
    if (kind === 'sphere') return RAPIER.ColliderDesc.ball(0.5 * edge);
    if (kind === 'box') return RAPIER.ColliderDesc.cuboid(0.5 * edge, 0.5 * edge, 0.5 * edge);
    return RAPIER.ColliderDesc.convexHull(Float32Array.from(prism(kind, edge).corners.flat()));
}

function weigh(kind, edge) {
    const world = new RAPIER.World({x: 0, y: 0, z: 0});
    world.lengthUnit = own ? edge : 1;
    const body = world.createRigidBody(RAPIER.RigidBodyDesc.dynamic());
    world.createCollider(describe(kind, edge).setDensity(kDensity), body);
    body.recomputeMassPropertiesFromColliders();
    return body;
}

function make({restitution, step, edge}) {
    const world = new RAPIER.World({x: 0, y: 0, z: -kGravity});
    world.timestep = step;
    world.lengthUnit = own ? edge : 1;
    const rough = of => of.setRestitution(restitution).setFriction(kFriction);
    const ground = world.createCollider(rough(RAPIER.ColliderDesc.cuboid(50, 50, 1).setTranslation(0, 0, -1)));
    const bodies = [], colliders = [ground];
    return {
        add(kind, edge, z) {
            bodies.push(world.createRigidBody(RAPIER.RigidBodyDesc.dynamic().setTranslation(0, 0, z)));
            colliders.push(world.createCollider(rough(describe(kind, edge).setDensity(kDensity)), bodies.at(-1)));
        },
        advance() { world.step(); },
        place(i) { const {x, y, z} = bodies[i].translation(); return [x, y, z]; },
        speed(i) { return bodies[i].linvel().z; },
        points() {
            let count = 0;
            for (let i = 1; i < colliders.length; ++i) {
                for (let k = 0; k < i; ++k) world.contactPair(colliders[i], colliders[k], pair => { count += pair.numContacts(); });
            }
            return count;
        },
    };
}

measure(own ? 'Rapier, length unit' : 'Rapier', RAPIER.version(), {
    mass: (kind, edge) => weigh(kind, edge).mass() / kDensity / volume(kind, edge),
    // as it answers a blow
    inertia(kind, edge) {
        const body = weigh(kind, edge);
        body.applyTorqueImpulse({x: 0, y: 0, z: body.mass() * edge ** 2}, true);
        return edge ** 2 / body.angvel().z;
    },
    make,
});
