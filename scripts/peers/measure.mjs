// What is asked of every engine, as in measure.hh (README.md). An engine gives
//   mass(kind, edge):    mass over that of the true solid, of "corners" (the eight of a cube) or "drum" (its 48 corners)
//   inertia(kind, edge): moment of inertia about z through the centre over mass [m^2], also of "corners apart"
//   make({restitution, step, edge}): a world with a ground at z = 0, with add(kind, edge, z), advance(), place(i), speed(i) along z
//                        and points()
//   bounces:             false where it has no coefficient of restitution
//   more(edge):          what else is asked of it, by name
export const kGravity = 9.81, kDensity = 2500, kFriction = 0.6;  // [m/s^2], [kg/m^3]

const side = 2 * Math.PI / 24;
const outlines = {
    corners: [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]],
    'corners apart': [[2.5, -0.5], [3.5, -0.5], [3.5, 0.5], [2.5, 0.5]],
    drum: [...Array(24).keys()].map(k => [0.5 * Math.cos(side * k), 0.5 * Math.sin(side * k)]),
};

/// Corners of a prism along z, those below first, and its faces, seen from outside against the clock.
export function prism(kind, edge) {
    const outline = outlines[kind], n = outline.length, sides = [...Array(n).keys()];
    return {
        corners: [-0.5, 0.5].flatMap(z => outline.map(([x, y]) => [x * edge, y * edge, z * edge])),
        faces: [sides.map(k => n - 1 - k), sides.map(k => n + k), ...sides.map(k => [k, (k + 1) % n, n + (k + 1) % n, n + k])],
    };
}

export const volume = (kind, edge) => kind === 'drum' ? 3 * Math.sin(side) * edge ** 3 : edge ** 3;

/// Moment of inertia about z over mass [m^2].
const inertia = (kind, edge) => kind === 'drum' ? edge ** 2 / 24 * (2 + Math.cos(side)) : edge ** 2 / 6;

export function print(peer, version, rows) {
    console.log(JSON.stringify({peer, version, rows}).replace(/(\{"what)/g, '\n  $1'));
}

export function measure(peer, version, engine) {
    const rows = [], first = 1 / 240, short = 0.05;
    const say = (what, edge, step, value) => { if (value !== undefined) rows.push({what, edge, step, value}); };
    const run = (world, duration, step) => { for (let k = Math.round(duration / step); k > 0; --k) world.advance(); };
    // largest number of contacts within a short time
    const find_most_points = world => {
        let most = 0;
        for (let k = Math.round(short / first); k > 0; --k) {
            world.advance();
            most = Math.max(most, world.points());
        }
        return most;
    };
    for (const edge of [1, 0.1, 0.02, 0.01]) {
        for (const kind of ['corners', 'drum']) say(`mass ${kind}`, edge, 0, engine.mass(kind, edge));
        for (const [what, value] of Object.entries(engine.more?.(edge) ?? {})) say(what, edge, 0, value);
        for (const kind of ['corners', 'corners apart', 'drum']) {
            const found = engine.inertia(kind, edge);
            say(`inertia ${kind}`, edge, 0, found && found / inertia(kind, edge));
        }
        for (const kind of ['corners', 'box']) {
            const alone = engine.make({restitution: 0, step: first, edge});
            alone.add(kind, edge, 0.5 * edge);
            const on_ground = find_most_points(alone);
            run(alone, 2 - short, first);
            say(`height ${kind}`, edge, first, alone.place(0)[2] / edge - 0.5);
            const pair = engine.make({restitution: 0, step: first, edge});
            for (const k of [0, 1]) pair.add(kind, edge, (k + 0.5) * edge);
            say(`points ${kind}`, edge, first, find_most_points(pair) - on_ground);
            for (const step of [first, first / 4]) {
                const stack = engine.make({restitution: 0, step, edge});
                for (let k = 0; k < 10; ++k) stack.add(kind, edge, (k + 0.5) * edge);
                run(stack, 2, step);
                const [x, y, z] = stack.place(9);
                say(`stack height ${kind}`, edge, step, z / edge - 9.5);
                say(`stack shift ${kind}`, edge, step, Math.hypot(x, y) / edge);
            }
        }
        const fall = Math.sqrt(10 * edge / kGravity);
        for (const restitution of engine.bounces === false ? [] : [1, 0.5]) {
            for (const step of [first, first / 4, first / 16]) {
                for (const kind of ['sphere', 'box']) {
                    const world = engine.make({restitution, step, edge});
                    world.add(kind, edge, 5.5 * edge);
                    let top = 0, met = false;
                    for (let k = 1; k <= Math.round(2.5 * fall / step); ++k) {
                        world.advance();
                        met = met || world.speed(0) > 0 || k * step > 1.2 * fall;
                        if (met) top = Math.max(top, world.place(0)[2]);
                    }
                    say(`rebound ${kind} ${restitution}`, edge, step, (top / edge - 0.5) / 5);
                }
            }
        }
    }
    print(peer, version, rows);
}
