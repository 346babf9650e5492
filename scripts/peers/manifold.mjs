// manifold-3d: solids only. A drum as it makes it when no number of flats is named, and cubes that stand on each other, joined.
import {readFileSync} from 'node:fs';
import load from 'manifold-3d';
import {print, volume} from './measure.mjs';

const wasm = await load();
wasm.setup();
const {Manifold} = wasm;
const rows = [];
for (const edge of [1, 0.1, 0.02, 0.01]) {
    const say = (what, value) => rows.push({what, edge, step: 0, value});
    const radius = 0.5 * edge, drum = Manifold.cylinder(edge, radius, radius);
    say('flats drum', drum.numVert() / 2);
    say('mass round drum', drum.volume() / (Math.PI * radius ** 2 * edge));
    say('mass drum', Manifold.cylinder(edge, radius, radius, 24).volume() / volume('drum', edge));
    const cubes = [...Array(10).keys()].map(k => Manifold.cube([edge, edge, edge], true).translate([0, 0, (k + 0.5) * edge]));
    const joined = Manifold.union(cubes);
    say('bodies', joined.decompose().length);
    say('mass joined', joined.volume() / (10 * edge ** 3));
}
print('manifold', JSON.parse(readFileSync('node_modules/manifold-3d/package.json')).version, rows);
