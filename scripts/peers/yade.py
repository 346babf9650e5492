# To be run by YADE (`scripts/peers/run yade`): mass and inertia of its polyhedra, height, rest of ten blocks. There is no restitution.
import json
from yade import polyhedra_utils

STIFFNESS, DENSITY, FRICTION, GRAVITY = 2e10, 2500.0, 0.6, 9.81  # force over volume of overlap [N/m^3], [kg/m^3], -, [m/s^2]


def corners_of(kind, edge, z=0.0):
    sides = {'drum': 24}.get(kind, 4)
    radius = 0.5 * edge * (1.0 if kind == 'drum' else sqrt(2.0))
    shift = 3 * edge if kind == 'corners apart' else 0.0
    angles = [2 * pi * (k + (0.0 if kind == 'drum' else 0.5)) / sides for k in range(sides)]
    return [(shift + radius * cos(a), radius * sin(a), z + h * edge) for h in (-0.5, 0.5) for a in angles]


def volume(kind, edge):
    return (3 * sin(pi / 12) if kind == 'drum' else 1.0) * edge**3


def inertia(kind, edge):
    return edge**2 / 24 * (2 + cos(pi / 12)) if kind == 'drum' else edge**2 / 6


def load(count, edge):
    """`count` cubes on each other and on a fixed one."""
    O.reset()
    # of two bodies in series
    material = PolyhedraMat(density=DENSITY, young=2 * STIFFNESS, poisson=0.8, frictionAngle=atan(FRICTION))
    for k in range(count):
        O.bodies.append(polyhedra_utils.polyhedra(material, v=corners_of('corners', edge, (k + 0.5) * edge)))
    base = polyhedra_utils.polyhedra(material, v=[(3 * x, 3 * y, z) for x, y, z in corners_of('corners', edge, -0.5 * edge)])
    base.state.blockedDOFs = 'xyzXYZ'
    O.bodies.append(base)
    O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Polyhedra_Aabb()]),
                 InteractionLoop([Ig2_Polyhedra_Polyhedra_PolyhedraGeom()], [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                                 [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()]),
                 NewtonIntegrator(gravity=(0, 0, -GRAVITY), damping=0.2)]
    O.dt = 0.2 * sqrt(DENSITY * edge / STIFFNESS)


rows = []
for edge in (1.0, 0.1, 0.02, 0.01):
    def say(what, value, step=0.0):
        rows.append({'what': what, 'edge': edge, 'step': step, 'value': value})

    for kind in ('corners', 'drum', 'corners apart'):
        body = polyhedra_utils.polyhedra(PolyhedraMat(density=DENSITY), v=corners_of(kind, edge))
        if kind != 'corners apart':
            say('mass ' + kind, body.state.mass / DENSITY / volume(kind, edge))
        # principal ones, of the drum the least about its axis
        say('inertia ' + kind, min(body.state.inertia) / body.state.mass / inertia(kind, edge))
for edge in (1.0, 0.1, 0.01):
    load(10, edge)
    O.run(2000, True)
    x, y, z = O.bodies[9].state.pos
    say('ten cubes: height', z / edge - 9.5, O.dt)
    say('ten cubes: shift', sqrt(x * x + y * y) / edge, O.dt)
    say('ten cubes: seconds', O.time, O.dt)
    say('ten cubes: speed over sqrt(g edge)', max(b.state.vel.norm() for b in O.bodies) / sqrt(GRAVITY * edge), O.dt)
print(json.dumps({'peer': 'YADE', 'version': '2023.02a', 'rows': rows}).replace('{"what"', '\n  {"what"'))
