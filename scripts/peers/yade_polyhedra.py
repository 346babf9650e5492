# To be run by YADE (`scripts/peers/run yade_polyhedra [REPEATS STEPS [MUSIM_BENCH]]`): microseconds of one core per block and step of its
# polyhedra, of an arch of 31 voussoirs with 8 corners and of a column of 12 drums of 24 flats. They settle on their base before they are
# timed; shaken, it then moves as in musim's bench: 1.00, 0.71 and 0.31 g at 10 Hz along x, y, z. With musim's bench program that one's
# scenes are timed in turn with YADE's: arch and drums; drums_shaken, and arch_hit, whose voussoirs each have a velocity of their own.
import json
import os
import statistics
import subprocess
import sys
import time
from yade import polyhedra_utils

# force over volume of overlap [N/m^3], [kg/m^3], -, [m/s^2]
STIFFNESS, DENSITY, FRICTION, GRAVITY = 2e10, 2000.0, 0.6, 9.81
REPEATS, STEPS = (int(argument) for argument in (sys.argv[1:] + ['7', '60'][len(sys.argv) - 1:])[:2])
BENCH = sys.argv[3] if len(sys.argv) > 3 else None
SETTLING, SETTLING_DAMPING = 800, 0.7
MUSIM_SCENES = {('arch', 'sticking'): 'arch', ('arch', 'shaken'): 'arch_hit', ('drums', 'sticking'): 'drums',
                ('drums', 'shaken'): 'drums_shaken'}


def box(low, high):
    return [tuple(high[k] if i >> k & 1 else low[k] for k in range(3)) for i in range(8)]


def arch(voussoirs=31, inner=0.9, outer=1.1, depth=0.3):
    """Wedges of half a circle, what holds them at both ends, and the area of a joint."""
    radius, thickness = 0.5 * (inner + outer), outer - inner

    def corner(k, radius, y):
        return (radius * cos(pi * k / voussoirs), y, radius * sin(pi * k / voussoirs))
    blocks = [[corner(n, r, y) for n in (k, k + 1) for r in (inner, outer) for y in (-0.5 * depth, 0.5 * depth)] for k in range(voussoirs)]
    held = [box((middle - thickness, -depth, -thickness), (middle + thickness, depth, 0)) for middle in (-radius, radius)]
    return blocks, held, thickness * depth


def drums(count=12, radius=0.3, height=0.4, flats=24):
    ring = [(radius * cos(2 * pi * k / flats), radius * sin(2 * pi * k / flats)) for k in range(flats)]
    blocks = [[(x, y, z * height) for z in (k, k + 1) for x, y in ring] for k in range(count)]
    return blocks, [box((-2 * radius, -2 * radius, -height), (2 * radius, 2 * radius, 0))], 0.5 * flats * sin(2 * pi / flats) * radius**2


def load(blocks, held, area):
    O.reset()
    # of two bodies in series
    material = PolyhedraMat(density=DENSITY, young=2 * STIFFNESS, poisson=0.8, frictionAngle=atan(FRICTION))
    for corners in blocks + held:
        O.bodies.append(polyhedra_utils.polyhedra(material, v=corners))
    for body in list(O.bodies)[len(blocks):]:
        body.state.blockedDOFs = 'xyzXYZ'
    O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Polyhedra_Aabb()]),
                 InteractionLoop([Ig2_Polyhedra_Polyhedra_PolyhedraGeom()], [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                                 [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
                 NewtonIntegrator(gravity=(0, 0, -GRAVITY), damping=SETTLING_DAMPING)]
    O.dt = 0.2 * sqrt(min(body.state.mass for body in list(O.bodies)[:len(blocks)]) / (STIFFNESS * area))
    O.run(SETTLING, True)
    O.engines[-1].damping = 0.2


def shake(bases):
    """From rest; the engine's velocity is -A omega sin(omega t + fi)."""
    omega = 2 * pi * 10.0
    motion = HarmonicMotionEngine(A=(1.00 * GRAVITY / omega**2, 0.71 * GRAVITY / omega**2, 0.31 * GRAVITY / omega**2), f=(10, 10, 10),
                                  fi=(pi - omega * O.time,) * 3, ids=bases)
    O.engines = O.engines[:-1] + [motion] + O.engines[-1:]


def time_musim(scene):
    """Microseconds of one core per block and step by musim's bench."""
    own = {key: value for key, value in os.environ.items() if key != 'LD_LIBRARY_PATH'}
    lines = subprocess.run([BENCH, scene], env=own, capture_output=True, text=True, check=True).stdout.splitlines()
    rows = [dict(zip(lines[0].split(','), line.split(','))) for line in lines[1:]]
    return next(float(row['us_per_block_step_core']) for row in rows if row['threads'] == '1')


rows = []
for name, (blocks, held, area) in (('arch', arch()), ('drums', drums())):
    for state in ('sticking', 'shaken'):
        load(blocks, held, area)
        if state == 'shaken':
            shake(list(range(len(blocks), len(blocks) + len(held))))
        times = []
        for _ in range(REPEATS):
            begin = time.process_time()
            O.run(STEPS, True)
            times.append((time.process_time() - begin) / STEPS / len(blocks) * 1e6)
        rows.append({'scene': name, 'state': state, 'blocks': len(blocks), 'contacts': sum(i.isReal for i in O.interactions),
                     'core_us_per_block_and_step': round(statistics.median(times), 1), 'least': round(min(times), 1),
                     'most': round(max(times), 1), 'step_s': O.dt, 'load': os.getloadavg()[0]})
        if BENCH:
            rows[-1]['musim'] = time_musim(MUSIM_SCENES[name, state])
print(json.dumps({'peer': 'YADE', 'version': '2023.02a', 'rows': rows}).replace('{"scene"', '\n  {"scene"'))
