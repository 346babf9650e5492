#include "lsdem/study/mechanism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "lsdem/study/pair_text.hpp"

namespace musim::lsdem {
namespace {

/// Place of a joint's second body; the ground stands where it is.
BodyPlace place_of(const std::optional<std::size_t>& body, const std::vector<BodyPlace>& places) {
    return body ? places[*body] : BodyPlace{};
}

Vector3 to_body(const BodyPlace& place, const Vector3& x) { return place.orientation.conjugate() * (x - place.position); }

JointMotion find_motion(const RigidJoint& joint, const std::vector<BodyPlace>& drawn, const std::vector<BodyPlace>& first,
                        const std::vector<BodyPlace>& second) {
    JointMotion motion{.block = joint.block, .other = joint.other, .of_block = {}, .of_other = {}};
    const BodyPlace &block = second[joint.block], other = place_of(joint.other, second);
    const BodyPlace other_drawn = place_of(joint.other, drawn), other_first = place_of(joint.other, first);
    const Vector3 normal = other.orientation * (other_drawn.orientation.conjugate() * joint.normal);
    std::vector<double> opening, slip;
    for (const Vector3& corner : joint.corners) {
        const Vector3 in_block = to_body(drawn[joint.block], corner), in_other = to_body(other_drawn, corner);
        // what there was in the first state is no motion, seen from the other body
        const Vector3 before =
            other.orientation * (other_first.orientation.conjugate() * (first[joint.block] * in_block - other_first * in_other));
        motion.of_block.push_back(block * in_block);
        motion.of_other.push_back(other * in_other);
        const Vector3 way = motion.of_block.back() - motion.of_other.back() - before;
        opening.push_back(normal.dot(way));
        slip.push_back((way - opening.back() * normal).norm());
    }
    const auto [least, most] = std::minmax_element(opening.begin(), opening.end());
    motion.least_opening = *least;
    motion.opening = *most;
    // the quarter of the opening next to the edge that stays closed
    const double closed = *least + 0.25 * (*most - *least);
    double count = 0.0;
    for (std::size_t c = 0; c < opening.size(); ++c) {
        if (opening[c] > closed) continue;
        motion.slip = std::max(motion.slip, slip[c]);
        motion.edge += motion.of_other[c];
        count += 1.0;
    }
    motion.edge /= count;
    return motion;
}

double size_of(const JointMotion& joint) { return std::max(joint.opening, joint.slip); }

/// Blocks that move together, by the smallest number among them; one more for the ground.
class Bodies {
  public:
    explicit Bodies(std::size_t blocks) : first_(blocks + 1) { std::iota(first_.begin(), first_.end(), std::size_t{0}); }

    std::size_t find(std::size_t body) const {
        while (first_[body] != body) body = first_[body];
        return body;
    }
    void join(std::size_t a, std::size_t b) {
        a = find(a), b = find(b);
        first_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::size_t> first_;
};

JointEvent find_event(const JointMotion& joint, double limit) {
    if (joint.slip > limit) return JointEvent::slides;
    if (joint.least_opening > limit) return JointEvent::parts;
    return joint.opening > limit ? JointEvent::opens : JointEvent::sticks;
}

std::string name_other(const JointMotion& joint, const BlockTable& blocks) {
    return joint.other ? blocks.label(*joint.other) : "the ground";
}

std::string name_joint(const JointMotion& joint, const BlockTable& blocks) {
    return fmt::format("{} on {}", blocks.label(joint.block), name_other(joint, blocks));
}

/// Where in its joint the closed edge is.
std::string name_edge(const JointMotion& joint, const std::array<Vector3, 2>& axes) {
    Vector3 middle = Vector3::Zero();
    for (const Vector3& corner : joint.of_other) middle += corner;
    const Vector3 arm = joint.edge - middle / static_cast<double>(joint.of_other.size());
    const double downhill = arm.dot(axes[0]), upward = arm.dot(axes[1]);
    if (std::abs(downhill) >= std::abs(upward)) return downhill >= 0.0 ? "downhill" : "uphill";
    return upward > 0.0 ? "upper" : "lower";
}

constexpr std::size_t kNamed = 6;  ///< of a list

/// "a, b and c"; long lists end in a number.
std::string list_words(std::vector<std::string> words) {
    if (words.size() > kNamed) {
        const std::size_t others = words.size() - (kNamed - 1);
        words.resize(kNamed - 1);
        words.push_back(fmt::format("{} others", others));
    }
    return join_words(words);
}

/// "block 7", "blocks 7 to 9, as one body,", "12 blocks from block 3 to block 20, as one body,".
std::string name_body(const std::vector<std::size_t>& members, const BlockTable& blocks) {
    const std::size_t first = members.front(), last = members.back();
    if (members.size() == 1) return blocks.label(first);
    const bool in_row = last - first + 1 == members.size();
    if (in_row && !blocks.is_listed()) return fmt::format("blocks {} to {}, as one body,", first, last);
    const std::string ends = fmt::format("{} to {}, as one body,", blocks.label(first), blocks.label(last));
    return in_row ? ends : fmt::format("{} blocks from {}", members.size(), ends);
}

/// Supports of one body: what it moves against, each once.
std::string name_supports(const std::vector<const JointMotion*>& joints, const BlockTable& blocks) {
    std::vector<std::string> names;
    for (const JointMotion* joint : joints) {
        const std::string name = name_other(*joint, blocks);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return list_words(names);
}

}  // namespace

std::vector<JointMotion> find_joint_motions(const std::vector<RigidJoint>& joints, const std::vector<BodyPlace>& drawn,
                                            const std::vector<BodyPlace>& first, const std::vector<BodyPlace>& second) {
    std::vector<JointMotion> motions;
    for (const RigidJoint& joint : joints) {
        // the upper one is the block that moves on the other
        RigidJoint turned = joint;
        if (joint.other && joint.normal.z() < 0.0) {
            turned.block = *joint.other;
            turned.other = joint.block;
            turned.normal = -joint.normal;
        }
        motions.push_back(find_motion(turned, drawn, first, second));
    }
    return motions;
}

double find_largest_motion(const std::vector<JointMotion>& joints, const std::vector<double>& edge) {
    double largest = 0.0;
    for (const JointMotion& joint : joints) {
        const double smaller = joint.other ? std::min(edge[joint.block], edge[*joint.other]) : edge[joint.block];
        largest = std::max(largest, size_of(joint) / smaller);
    }
    return largest;
}

Mechanism find_mechanism(std::vector<JointMotion> joints, const std::vector<int>& held) {
    double largest = 0.0;
    for (const JointMotion& joint : joints) largest = std::max(largest, size_of(joint));
    const std::size_t ground = held.size();
    Bodies bodies(held.size());
    for (std::size_t b = 0; b < held.size(); ++b) {
        if (held[b] != 0) bodies.join(b, ground);
    }
    for (JointMotion& joint : joints) {
        joint.event = find_event(joint, kMovingPart * largest);
        if (joint.event == JointEvent::sticks) bodies.join(joint.block, joint.other.value_or(ground));
    }
    Mechanism mechanism{.joints = std::move(joints), .body = std::vector<std::size_t>(held.size(), 0), .bodies = 0};
    std::vector<std::size_t> number(held.size() + 1, 0);
    for (std::size_t b = 0; b < held.size(); ++b) {
        const std::size_t first = bodies.find(b);
        if (first == bodies.find(ground)) continue;
        if (number[first] == 0) number[first] = ++mechanism.bodies;
        mechanism.body[b] = number[first];
    }
    return mechanism;
}

std::string to_string(JointEvent event) {
    switch (event) {
        case JointEvent::opens:
            return "opens";
        case JointEvent::slides:
            return "slides";
        case JointEvent::parts:
            return "parts";
        case JointEvent::sticks:
            break;
    }
    return "sticks";
}

std::string describe(const Mechanism& mechanism, const BlockTable& blocks, const std::array<Vector3, 2>& axes) {
    std::vector<const JointMotion*> opened, slid, parted, moving;
    for (const JointMotion& joint : mechanism.joints) {
        const bool is_within = mechanism.body[joint.block] == (joint.other ? mechanism.body[*joint.other] : 0);
        if (joint.event == JointEvent::sticks || is_within) continue;
        moving.push_back(&joint);
        (joint.event == JointEvent::opens ? opened : joint.event == JointEvent::slides ? slid : parted).push_back(&joint);
    }
    if (moving.empty()) return "no joint opens or slides";
    if (mechanism.bodies == 1 && parted.empty()) {
        std::vector<std::size_t> members;
        for (std::size_t b = 0; b < mechanism.body.size(); ++b) {
            if (mechanism.body[b] != 0) members.push_back(b);
        }
        const std::string who = name_body(members, blocks), ending = members.size() > 1 ? "" : "s";
        if (opened.empty()) return fmt::format("{} slide{} on {}", who, ending, name_supports(slid, blocks));
        const std::string overturns = fmt::format("{} overturn{} about the {} edge on {}", who, ending, name_edge(*opened.front(), axes),
                                                  name_supports(opened, blocks));
        return slid.empty() ? overturns : fmt::format("{} and slide{} on {}", overturns, ending, name_supports(slid, blocks));
    }
    std::vector<std::string> parts;
    const auto list = [&](const std::vector<const JointMotion*>& joints, const char* one, const char* several, bool by_edge) {
        if (joints.empty()) return;
        std::vector<std::string> names;
        for (const JointMotion* joint : joints) {
            names.push_back(name_joint(*joint, blocks) + (by_edge ? fmt::format(" ({} edge)", name_edge(*joint, axes)) : ""));
        }
        parts.push_back(fmt::format("{} {}: {}", joints.size(), joints.size() == 1 ? one : several, list_words(names)));
    };
    list(opened, "hinge", "hinges", true);
    list(slid, "joint that slides", "joints that slide", false);
    list(parted, "joint that parts", "joints that part", false);
    std::string text = fmt::format("{} {}; ", mechanism.bodies, mechanism.bodies == 1 ? "body moves" : "bodies move");
    for (std::size_t i = 0; i < parts.size(); ++i) text += (i > 0 ? "; " : "") + parts[i];
    return text;
}

}  // namespace musim::lsdem
