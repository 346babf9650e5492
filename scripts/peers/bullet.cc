// Bullet, in single precision as Debian's libBulletDynamics. With -D bullet_bare hulls have no margin, set before their corners as it must
// be.
#include <btBulletDynamicsCommon.h>

#include <limits>
#include <memory>

#include "measure.hh"

namespace {

std::unique_ptr<btCollisionShape> make(const std::string& kind, double edge) {
    if (kind == "sphere") return std::make_unique<btSphereShape>(0.5 * edge);
    if (kind == "box") return std::make_unique<btBoxShape>(btVector3(1, 1, 1) * (0.5 * edge));
    auto hull = std::make_unique<btConvexHullShape>();
#ifdef bullet_bare
    hull->setMargin(0);
#endif
    for (const auto& [x, y, z] : peers::corners_of(kind, edge)) hull->addPoint(btVector3(x, y, z));
    return hull;
}

class Bullet {
  public:
    class World {
      public:
        World(double restitution, double step, double /*edge*/) : restitution_(restitution), step_(step) {
            world_.setGravity(btVector3(0, 0, -peers::kGravity));
            add(std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0), 0.0, 0.0);
        }
        ~World() {
            for (const auto& body : bodies_) world_.removeRigidBody(body.get());
        }
        void add(const std::string& kind, double edge, double z) { add(make(kind, edge), peers::kDensity * edge * edge * edge, z); }
        void advance() { world_.stepSimulation(step_, 0); }
        double height(int i) const { return at(i).z(); }
        double aside(int i) const { return std::hypot(at(i).x(), at(i).y()); }
        double speed(int i) const { return bodies_[i + 1]->getLinearVelocity().z(); }
        int points() {
            int points = 0;
            for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) points += dispatcher_.getManifoldByIndexInternal(i)->getNumContacts();
            return points;
        }

      private:
        const btVector3& at(int i) const { return bodies_[i + 1]->getWorldTransform().getOrigin(); }
        void add(std::unique_ptr<btCollisionShape> shape, double mass, double z) {
            btVector3 inertia(0, 0, 0);
            if (mass > 0) shape->calculateLocalInertia(mass, inertia);
            states_.push_back(std::make_unique<btDefaultMotionState>(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, z))));
            btRigidBody::btRigidBodyConstructionInfo info(mass, states_.back().get(), shape.get(), inertia);
            info.m_friction = mass > 0 ? peers::kFriction : 1.0;  // of a pair: the product
            info.m_restitution = mass > 0 ? restitution_ : 1.0;
            shapes_.push_back(std::move(shape));
            bodies_.push_back(std::make_unique<btRigidBody>(info));
            world_.addRigidBody(bodies_.back().get());
        }

        double restitution_, step_;
        btDefaultCollisionConfiguration configuration_;
        btCollisionDispatcher dispatcher_{&configuration_};
        btDbvtBroadphase broad_;
        btSequentialImpulseConstraintSolver solver_;
        btDiscreteDynamicsWorld world_{&dispatcher_, &broad_, &solver_, &configuration_};
        std::vector<std::unique_ptr<btCollisionShape>> shapes_;
        std::vector<std::unique_ptr<btDefaultMotionState>> states_;
        std::vector<std::unique_ptr<btRigidBody>> bodies_;
    };

    double mass(const std::string& /*kind*/, double /*edge*/) const { return std::numeric_limits<double>::quiet_NaN(); }
    double inertia(const std::string& kind, double edge) const {
        if (kind == "corners apart") return std::numeric_limits<double>::quiet_NaN();
        btVector3 inertia;
        make(kind, edge)->calculateLocalInertia(1.0, inertia);
        return inertia.z();
    }
};

}  // namespace

int main() {
#ifdef bullet_bare
    const char* const peer = "Bullet, margin 0";
#else
    const char* const peer = "Bullet";
#endif
    const int version = btGetVersion();
    peers::measure(peer, std::to_string(version / 100) + "." + std::to_string(version % 100), Bullet{});
}
