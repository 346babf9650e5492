// MuJoCo. As "mujoco_elliptic" with elliptic friction cones and several contacts of convex pairs (cone, multiccd), which are off at first.
import load from 'mujoco-js';
import {prism, volume, measure, kDensity, kFriction, kGravity} from './measure.mjs';

const mujoco = await load();
const other = process.argv[2] === 'mujoco_elliptic';

/// A closed mesh, its faces as triangles; without the first `open` of them.
function mesh(kind, edge, open = 0) {
    const {corners, faces} = prism(kind, edge);
    const triangles = faces.slice(open).flatMap(face => face.slice(2).map((last, k) => [face[0], face[k + 1], last]));
    return `<mesh name="solid" vertex="${corners.flat().join(' ')}" face="${triangles.flat().join(' ')}"/>`;
}

function describe(kind, edge) {
    const shape = kind === 'box' ? `type="box" size="${[1, 1, 1].map(x => 0.5 * x * edge).join(' ')}"` : 'type="mesh" mesh="solid"';
    return `<geom density="${kDensity}" friction="${kFriction}" ${shape}/>`;
}

function open_model(bodies, solid, step) {
    const [cone, flags] = other ? ['cone="elliptic"', '<flag multiccd="enable"/>'] : ['', ''];
    const option = `<option timestep="${step}" gravity="0 0 ${-kGravity}" ${cone}>${flags}</option>`;
    const listed = bodies.map(([kind, edge, z]) => `<body pos="0 0 ${z}"><freejoint/>${describe(kind, edge)}</body>`).join('');
    mujoco.FS.writeFile('/scene.xml', `<mujoco>${option}<asset>${solid}</asset><worldbody>
        <geom type="plane" size="50 50 1" friction="${kFriction}"/>${listed}</worldbody></mujoco>`);
    return mujoco.MjModel.loadFromXML('/scene.xml');
}

const weigh = (kind, edge, open = 0) => open_model([['solid', edge, edge]], mesh(kind, edge, open), 0.002);

function make({step, edge}) {
    const bodies = [];
    let model, data;
    return {
        add(kind, edge, z) { bodies.push([kind, edge, z]); },
        advance() {
            model ??= open_model(bodies, mesh('corners', edge), step);
            data ??= new mujoco.MjData(model);
            mujoco.mj_step(model, data);
        },
        place(i) { return [0, 1, 2].map(k => data.qpos[7 * i + k]); },
        points() { return data.ncon; },
    };
}

measure(other ? 'MuJoCo, elliptic' : 'MuJoCo', mujoco.mj_versionString(), {
    mass: (kind, edge) => weigh(kind, edge).body_mass[1] / kDensity / volume(kind, edge),
    // principal ones, the largest first: of the drum the least is about its axis
    inertia(kind, edge) { const model = weigh(kind, edge); return model.body_inertia[kind === 'drum' ? 5 : 3] / model.body_mass[1]; },
    make,
    bounces: false,
    // the cube without its lower face
    more(edge) {
        const model = weigh('corners', edge, 1);
        return {'mass open': model.body_mass[1] / kDensity / edge ** 3, 'centre open': model.body_ipos[5] / edge};
    },
});
