// ODE, in double precision as Debian builds it, with dWorldStep and its default error reduction.
#include <ode/ode.h>

#include <memory>

#include "measure.hh"

namespace {

/// A prism in the layouts of dCreateConvex and of meshes.
struct Prism {
    std::vector<dReal> planes, points;
    std::vector<unsigned> polygons;
    std::vector<dTriIndex> triangles;

    Prism(const std::string& kind, double edge) {
        const auto corners = peers::corners_of(kind, edge);
        for (const auto& corner : corners) points.insert(points.end(), corner.begin(), corner.end());
        for (const std::vector<int>& face : peers::faces_of(static_cast<int>(corners.size() / 2))) {
            std::array<double, 3> n{};
            double length = 0.0, offset = 0.0;
            for (int k = 0; k < 3; ++k) {
                const int a = (k + 1) % 3, b = (k + 2) % 3;
                const auto side = [&](int to, int axis) { return corners[face[to]][axis] - corners[face[0]][axis]; };
                n[k] = side(1, a) * side(2, b) - side(1, b) * side(2, a);
                length += n[k] * n[k];
            }
            for (int k = 0; k < 3; ++k) {
                planes.push_back(n[k] / std::sqrt(length));
                offset += planes.back() * corners[face[0]][k];
            }
            planes.push_back(offset);
            polygons.push_back(face.size());
            polygons.insert(polygons.end(), face.begin(), face.end());
            for (std::size_t k = 1; k + 1 < face.size(); ++k) {
                for (const int corner : {face[0], face[k], face[k + 1]}) triangles.push_back(corner);
            }
        }
    }
};

dMass weigh(const Prism& prism) {
    const dTriMeshDataID data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data, prism.points.data(), 3 * sizeof(dReal), prism.points.size() / 3, prism.triangles.data(),
                                prism.triangles.size(), 3 * sizeof(dTriIndex));
    const dGeomID geom = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
    dMass mass;
    dMassSetTrimesh(&mass, peers::kDensity, geom);
    dGeomDestroy(geom);
    dGeomTriMeshDataDestroy(data);
    return mass;
}

class Ode {
  public:
    class World {
      public:
        World(double restitution, double step, double /*edge*/) : restitution_(restitution), step_(step) {
            dWorldSetGravity(world_, 0, 0, -peers::kGravity);
            dCreatePlane(space_, 0, 0, 1, 0);
        }
        ~World() {
            dJointGroupDestroy(group_);
            dSpaceDestroy(space_);
            dWorldDestroy(world_);
        }
        void add(const std::string& kind, double edge, double z) {
            prisms_.push_back(std::make_unique<Prism>(kind, edge));
            const Prism& prism = *prisms_.back();
            const dGeomID geom = kind == "sphere" ? dCreateSphere(space_, 0.5 * edge)
                                 : kind == "box"  ? dCreateBox(space_, edge, edge, edge)
                                                  : dCreateConvex(space_, prism.planes.data(), prism.planes.size() / 4, prism.points.data(),
                                                                  prism.points.size() / 3, prism.polygons.data());
            const dBodyID body = dBodyCreate(world_);
            dMass mass;
            dMassSetBox(&mass, peers::kDensity, edge, edge, edge);
            dBodySetMass(body, &mass);
            dGeomSetBody(geom, body);
            dBodySetPosition(body, 0, 0, z);
            bodies_.push_back(body);
        }
        void advance() {
            points_ = 0;
            dSpaceCollide(space_, this, meet);
            dWorldStep(world_, step_);
            dJointGroupEmpty(group_);
        }
        double height(int i) const { return dBodyGetPosition(bodies_[i])[2]; }
        double aside(int i) const { return std::hypot(dBodyGetPosition(bodies_[i])[0], dBodyGetPosition(bodies_[i])[1]); }
        double speed(int i) const { return dBodyGetLinearVel(bodies_[i])[2]; }
        int points() const { return points_; }

      private:
        static void meet(void* data, dGeomID a, dGeomID b) {
            World& world = *static_cast<World*>(data);
            std::array<dContact, 16> contacts{};
            const int count = dCollide(a, b, contacts.size(), &contacts[0].geom, sizeof(dContact));
            world.points_ += count;
            for (int i = 0; i < count; ++i) {
                contacts[i].surface.mode = dContactBounce | dContactApprox1;
                contacts[i].surface.mu = peers::kFriction;
                contacts[i].surface.bounce = world.restitution_;
                contacts[i].surface.bounce_vel = 0.0;
                dJointAttach(dJointCreateContact(world.world_, world.group_, &contacts[i]), dGeomGetBody(a), dGeomGetBody(b));
            }
        }

        double restitution_, step_;
        int points_ = 0;
        dWorldID world_ = dWorldCreate();
        dSpaceID space_ = dHashSpaceCreate(nullptr);
        dJointGroupID group_ = dJointGroupCreate(0);
        std::vector<dBodyID> bodies_;
        std::vector<std::unique_ptr<Prism>> prisms_;
    };

    double mass(const std::string& kind, double edge) const {
        return weigh(Prism(kind, edge)).mass / peers::kDensity / peers::volume_of(kind, edge);
    }
    double inertia(const std::string& kind, double edge) const {
        dMass mass = weigh(Prism(kind, edge));
        dMassTranslate(&mass, -mass.c[0], -mass.c[1], -mass.c[2]);
        return mass.I[10] / mass.mass;
    }
};

}  // namespace

int main() {
    dInitODE();
    peers::measure("ODE", "0.16.2", Ode{});
    dCloseODE();
}
