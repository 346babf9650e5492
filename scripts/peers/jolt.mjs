// Jolt as it begins. Hulls and boxes have a convex radius of 5 cm at most, which both shapes cut to what fits.
import {readFileSync} from 'node:fs';
import init from 'jolt-physics/wasm-compat';
import {prism, volume, measure, kDensity, kFriction, kGravity} from './measure.mjs';

const jolt = await init(), kStill = 0, kMoving = 1;

function describe(kind, edge) {
    const half = new jolt.Vec3(0.5 * edge, 0.5 * edge, 0.5 * edge);
    let settings;
    if (kind === 'sphere') settings = new jolt.SphereShapeSettings(0.5 * edge);
    else if (kind === 'box') settings = new jolt.BoxShapeSettings(half);
    else {
        settings = new jolt.ConvexHullShapeSettings();
        for (const [x, y, z] of prism(kind, edge).corners) settings.mPoints.push_back(new jolt.Vec3(x, y, z));
    }
    settings.mDensity = kDensity;
    const made = settings.Create();
    if (made.HasError()) throw new Error(made.GetError().c_str());
    return made.Get();
}

/// One world at a time: its memory is given back with the next.
let before;

function make({restitution, step}) {
    if (before) jolt.destroy(before);
    const settings = new jolt.JoltSettings();
    Object.assign(settings, {mMaxBodies: 64, mMaxBodyPairs: 1024, mMaxContactConstraints: 1024});
    const pairs = new jolt.ObjectLayerPairFilterTable(2);
    pairs.EnableCollision(kStill, kMoving);
    pairs.EnableCollision(kMoving, kMoving);
    const layers = [new jolt.BroadPhaseLayer(0), new jolt.BroadPhaseLayer(1)], broad = new jolt.BroadPhaseLayerInterfaceTable(2, 2);
    for (const layer of [kStill, kMoving]) broad.MapObjectToBroadPhaseLayer(layer, layers[layer]);
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = broad;
    settings.mObjectVsBroadPhaseLayerFilter = new jolt.ObjectVsBroadPhaseLayerFilterTable(broad, 2, pairs, 2);
    const world = before = new jolt.JoltInterface(settings), system = world.GetPhysicsSystem(), bodies = [];
    system.SetGravity(new jolt.Vec3(0, 0, -kGravity));
    const listener = new jolt.ContactListenerJS();
    let points = 0;
    const count = (a, b, manifold) => { points += jolt.wrapPointer(manifold, jolt.ContactManifold).mRelativeContactPointsOn1.size(); };
    listener.OnContactValidate = () => jolt.ValidateResult_AcceptAllContactsForThisBodyPair;
    listener.OnContactAdded = count;
    listener.OnContactPersisted = count;
    listener.OnContactRemoved = () => {};
    system.SetContactListener(listener);
    function add(shape, z, motion, layer) {
        const creation = new jolt.BodyCreationSettings(shape, new jolt.RVec3(0, 0, z), new jolt.Quat(0, 0, 0, 1), motion, layer);
        Object.assign(creation, {mFriction: kFriction, mRestitution: restitution, mLinearDamping: 0, mAngularDamping: 0});
        const body = system.GetBodyInterface().CreateBody(creation);
        system.GetBodyInterface().AddBody(body.GetID(), jolt.EActivation_Activate);
        return body;
    }
    add(new jolt.BoxShape(new jolt.Vec3(50, 50, 1)), -1, jolt.EMotionType_Static, kStill);
    return {
        add(kind, edge, z) { bodies.push(add(describe(kind, edge), z, jolt.EMotionType_Dynamic, kMoving)); },
        advance() { points = 0; world.Step(step, 1); },
        place(i) { const at = bodies[i].GetPosition(); return [at.GetX(), at.GetY(), at.GetZ()]; },
        speed(i) { return bodies[i].GetLinearVelocity().GetZ(); },
        points() { return points; },
    };
}

const {version} = JSON.parse(readFileSync('node_modules/jolt-physics/package.json'));
measure('Jolt', version, {
    mass: (kind, edge) => describe(kind, edge).GetMassProperties().mMass / kDensity / volume(kind, edge),
    inertia(kind, edge) {
        const found = describe(kind, edge).GetMassProperties();
        return found.mInertia.GetAxisZ().GetZ() / found.mMass;
    },
    make,
});
