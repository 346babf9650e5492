// FCL's convex shapes: mass properties and contacts of one body on another. It moves nothing.
#include <fcl/fcl.h>

#include <memory>

#include "measure.hh"

namespace {

std::shared_ptr<fcl::CollisionGeometryd> make(const std::string& kind, double edge) {
    if (kind == "box") return std::make_shared<fcl::Boxd>(edge, edge, edge);
    auto corners = std::make_shared<std::vector<fcl::Vector3d>>();
    for (const auto& [x, y, z] : peers::corners_of(kind, edge)) corners->emplace_back(x, y, z);
    auto faces = std::make_shared<std::vector<int>>();
    const auto list = peers::faces_of(static_cast<int>(corners->size() / 2));
    for (const std::vector<int>& face : list) {
        faces->push_back(static_cast<int>(face.size()));
        faces->insert(faces->end(), face.begin(), face.end());
    }
    return std::make_shared<fcl::Convexd>(corners, static_cast<int>(list.size()), faces, false);
}

/// One body on another, a millionth of the edge into it.
int count_points(const std::string& kind, double edge) {
    fcl::Transform3d up = fcl::Transform3d::Identity();
    up.translation() = fcl::Vector3d(0.1 * edge, 0.0, (1.0 - 1e-6) * edge);
    const fcl::CollisionObjectd below(make(kind, edge)), above(make(kind, edge), up);
    fcl::CollisionRequestd request;
    request.enable_contact = true;
    request.num_max_contacts = 64;
    fcl::CollisionResultd result;
    fcl::collide(&below, &above, request, result);
    return static_cast<int>(result.numContacts());
}

}  // namespace

int main() {
    peers::Report report("FCL", FCL_VERSION);
    for (const double edge : {1.0, 0.1, 0.02, 0.01}) {
        for (const std::string kind : {"corners", "drum", "corners apart"}) {
            const auto solid = make(kind, edge);
            report.say("mass " + kind, edge, 0, solid->computeVolume() / peers::volume_of(kind, edge));
            const double inertia = solid->computeMomentofInertiaRelatedToCOM()(2, 2) / solid->computeVolume();
            report.say("inertia " + kind, edge, 0, inertia / peers::inertia_of(kind, edge));
        }
        for (const std::string kind : {"corners", "box"}) report.say("points " + kind, edge, 0, count_points(kind, edge));
    }
}
