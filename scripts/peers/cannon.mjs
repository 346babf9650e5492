// cannon-es with the contact stiffness and relaxation that it begins with.
import {readFileSync} from 'node:fs';
import * as cannon from 'cannon-es';
import {prism, volume, measure, kDensity, kFriction, kGravity} from './measure.mjs';

function make_shape(kind, edge) {
    if (kind === 'sphere') return new cannon.Sphere(0.5 * edge);
    if (kind === 'box') return new cannon.Box(new cannon.Vec3(0.5 * edge, 0.5 * edge, 0.5 * edge));
    const {corners, faces} = prism(kind, edge);
    return new cannon.ConvexPolyhedron({vertices: corners.map(corner => new cannon.Vec3(...corner)), faces});
}

function make({restitution, step}) {
    const world = new cannon.World({gravity: new cannon.Vec3(0, 0, -kGravity)});
    Object.assign(world.defaultContactMaterial, {friction: kFriction, restitution});
    world.addBody(new cannon.Body({mass: 0, shape: new cannon.Plane()}));
    const bodies = [];
    return {
        add(kind, edge, z) {
            bodies.push(new cannon.Body({mass: kDensity * edge ** 3, shape: make_shape(kind, edge), position: new cannon.Vec3(0, 0, z),
                                         linearDamping: 0, angularDamping: 0}));
            world.addBody(bodies.at(-1));
        },
        advance() { world.step(step); },
        place(i) { return bodies[i].position.toArray(); },
        speed(i) { return bodies[i].velocity.z; },
        points() { return world.contacts.length; },
    };
}

const {version} = JSON.parse(readFileSync('node_modules/cannon-es/package.json'));
measure('cannon-es', version, {
    mass: (kind, edge) => make_shape(kind, edge).volume() / volume(kind, edge),
    inertia(kind, edge) {
        if (kind === 'corners apart') return undefined;
        const found = new cannon.Vec3();
        make_shape(kind, edge).calculateLocalInertia(1, found);
        return found.z;
    },
    make,
});
