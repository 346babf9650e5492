#include "lsdem/report/tower_data.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lsdem/export/base64.hpp"
#include "lsdem/plot/solid_edges.hpp"
#include "lsdem/results/base_frame.hpp"
#include "lsdem/rotation.hpp"

namespace musim::lsdem {
namespace {

/// Displacements and rotations of all blocks at one instant, the base turned back, and their velocities.
struct TowerFrame {
    double time = 0.0;
    BaseState base;
    std::vector<Vector3> displacement, rotation, velocity;
};

Quaternion to_quaternion(const Eigen::Vector4f& wxyz) {
    return Quaternion(static_cast<double>(wxyz[0]), static_cast<double>(wxyz[1]), static_cast<double>(wxyz[2]),
                      static_cast<double>(wxyz[3]))
        .normalized();
}

/// The base at the sample nearest to a time.
const BaseState& find_base(const History& history, double time) {
    const auto after = std::lower_bound(history.time.begin(), history.time.end(), time);
    std::size_t k = static_cast<std::size_t>(after - history.time.begin());
    if (k == history.time.size() || (k > 0 && time - history.time[k - 1] < history.time[k] - time)) --k;
    return history.base[k];
}

std::vector<TowerFrame> list_frames(const StoredRun& run) {
    const std::size_t blocks = run.blocks.size.size();
    std::vector<TowerFrame> list;
    const Frames& frames = run.frames;
    for (std::size_t k = 0; k < frames.time.size(); ++k) {
        TowerFrame& frame = list.emplace_back();
        frame.time = frames.time[k];
        frame.base = find_base(run.history, frame.time);
        for (std::size_t b = 0; b < blocks; ++b) {
            const std::size_t at = k * blocks + b;
            const Vector3 place = turn_back(frame.base, Vector3(frames.position[at].cast<double>()));
            frame.displacement.emplace_back(place - run.initial.position[b]);
            frame.rotation.push_back(
                rotation_vector(run.initial.orientation[b], turn_back(frame.base, to_quaternion(frames.quaternion[at]))));
            frame.velocity.emplace_back(frames.velocity[at].cast<double>());
        }
    }
    if (!list.empty()) return list;
    for (const Kinematics* state : {&run.initial, &run.final}) {
        TowerFrame& frame = list.emplace_back();
        frame.time = state == &run.initial ? 0.0 : run.history.time.back();
        frame.base = find_base(run.history, frame.time);
        for (std::size_t b = 0; b < blocks; ++b) {
            frame.displacement.emplace_back(turn_back(frame.base, state->position[b]) - run.initial.position[b]);
            frame.rotation.push_back(rotation_vector(run.initial.orientation[b], turn_back(frame.base, state->orientation[b])));
        }
        frame.velocity.assign(blocks, Vector3::Zero());
    }
    return list;
}

double find_largest(const std::vector<TowerFrame>& frames, std::vector<Vector3> TowerFrame::*field) {
    double largest = 0.0;
    for (const TowerFrame& frame : frames) {
        for (const Vector3& value : frame.*field) largest = std::max(largest, value.cwiseAbs().maxCoeff());
    }
    return largest;
}

/// Values in steps of scale/Steps, as differences from the frame before.
template <class Integer, int Steps>
class DeltaCoder {
  public:
    DeltaCoder(std::size_t blocks, double scale) : scale_(scale), before_(3 * blocks, 0) {}

    void add(const std::vector<Vector3>& values, std::string& bytes) {
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<Integer> deltas;
            deltas.reserve(values.size());
            for (std::size_t b = 0; b < values.size(); ++b) {
                const auto now = static_cast<Integer>(scale_ > 0.0 ? std::lround(values[b][axis] / scale_ * Steps) : 0);
                Integer& before = before_[static_cast<std::size_t>(axis) * values.size() + b];
                deltas.push_back(static_cast<Integer>(now - before));
                before = now;
            }
            for (unsigned byte = 0; byte < sizeof(Integer); ++byte) {
                for (const Integer delta : deltas) bytes += static_cast<char>((static_cast<unsigned>(delta) >> (8U * byte)) & 0xFFU);
            }
        }
    }

    /// Half a step.
    double rounding() const { return 0.5 * scale_ / Steps; }

  private:
    double scale_;
    std::vector<Integer> before_;
};

std::string compress_bytes(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string packed(size, '\0');
    const int status = compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                                 Z_DEFAULT_COMPRESSION);
    if (status != Z_OK) throw std::runtime_error("the frames cannot be compressed: zlib has not enough memory; keep fewer frames");
    packed.resize(size);
    return packed;
}

template <class Number>
void append(std::string& bytes, Number number) {
    std::array<char, sizeof(Number)> raw{};
    std::memcpy(raw.data(), &number, sizeof(Number));
    bytes.append(raw.data(), raw.size());
}

std::string list_start(const StoredRun& run) {
    std::string bytes;
    for (std::size_t b = 0; b < run.blocks.size.size(); ++b) {
        const Quaternion& q = run.initial.orientation[b];
        for (int axis = 0; axis < 3; ++axis) append(bytes, static_cast<float>(run.initial.position[b][axis]));
        for (const double part : {q.w(), q.x(), q.y(), q.z()}) append(bytes, static_cast<float>(part));
        for (int axis = 0; axis < 3; ++axis) append(bytes, static_cast<float>(run.blocks.size[b][axis]));
    }
    return bytes;
}

std::string list_slips(const ReportedRun& reported) {
    std::vector<float> slip(reported.run.blocks.size.size(), 0.0F);
    if (reported.response) {
        for (const Joint& joint : reported.response->damage.joints) {
            slip[joint.upper] = std::max(slip[joint.upper], static_cast<float>(joint.slip));
        }
    }
    std::string bytes;
    for (const float value : slip) append(bytes, value);
    return bytes;
}

/// Contact forces on all blocks, over their weights, frame by frame; nothing when the run has not kept them.
std::vector<double> list_forces(const ReportedRun& reported) {
    const StoredRun& run = reported.run;
    if (!reported.response || !(reported.response->scales.gravity > 0.0)) return {};
    std::vector<double> forces;
    forces.reserve(run.frames.contact_force.size());
    const std::size_t blocks = run.blocks.mass.size();
    for (std::size_t i = 0; i < run.frames.contact_force.size(); ++i) {
        const double weight = run.blocks.mass[i % blocks] * reported.response->scales.gravity;
        forces.push_back(static_cast<double>(run.frames.contact_force[i]) / weight);
    }
    return forces;
}

/// Steps of the square root, from 0 to that of the largest.
constexpr double kForceSteps = 255.0;

std::string code_forces(const std::vector<double>& forces, std::size_t blocks, double largest) {
    std::vector<std::uint8_t> before(blocks, 0);
    std::string bytes;
    bytes.reserve(forces.size());
    for (std::size_t i = 0; i < forces.size(); ++i) {
        const auto now = static_cast<std::uint8_t>(largest > 0.0 ? std::lround(kForceSteps * std::sqrt(forces[i] / largest)) : 0);
        bytes += static_cast<char>(static_cast<std::uint8_t>(now - before[i % blocks]));
        before[i % blocks] = now;
    }
    return bytes;
}

/// Shapes of blocks that are no boxes.
nlohmann::json list_shapes(const BlockShapes& shapes) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& shape : shapes.list) {
        const SolidEdges edges = find_edges(shape->solid);
        std::string corners;
        nlohmann::json faces = nlohmann::json::array();
        std::int64_t before = 0;
        for (std::size_t p = 0; p < shape->solid.pieces.size(); ++p) {
            const Polyhedron& piece = shape->solid.pieces[p];
            for (const Vector3& corner : piece.corners) {
                for (int axis = 0; axis < 3; ++axis) append(corners, static_cast<float>(corner[axis]));
            }
            for (std::size_t f = 0; f < piece.faces.size(); ++f) {
                if (!piece.faces[f].outer) continue;
                nlohmann::json& face = faces.emplace_back(nlohmann::json::array());
                const auto loop = piece.loop(piece.faces[f]);
                for (std::size_t i = 0; i < loop.size(); ++i) {
                    const std::int64_t corner = before + loop[i];
                    face.push_back(edges.drawn[p][f][i] ? corner : ~corner);
                }
            }
            before += static_cast<std::int64_t>(piece.corners.size());
        }
        list.push_back({{"corners", encode_base64(corners)}, {"faces", std::move(faces)}, {"radius", shape->radius}});
    }
    return list;
}

std::array<double, 3> to_array(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// Members of a run whose base turns.
void add_turn(const std::vector<TowerFrame>& frames, nlohmann::json& data) {
    if (std::none_of(frames.begin(), frames.end(), [](const TowerFrame& frame) { return has_turned(frame.base); })) return;
    for (const TowerFrame& frame : frames) {
        const Quaternion& q = frame.base.turn;
        data["turn"].push_back({q.w(), q.x(), q.y(), q.z()});
    }
    data["pivot"] = to_array(frames.front().base.pivot);
}

}  // namespace

TowerData make_tower_data(const ReportedRun& reported) {
    const StoredRun& run = reported.run;
    const std::size_t blocks = run.blocks.size.size();
    const std::vector<TowerFrame> frames = list_frames(run);
    const double far = find_largest(frames, &TowerFrame::displacement), turned = find_largest(frames, &TowerFrame::rotation),
                 fast = find_largest(frames, &TowerFrame::velocity);
    DeltaCoder<std::int16_t, 32767> displacement(blocks, far), rotation(blocks, turned);
    DeltaCoder<std::int8_t, 127> velocity(blocks, fast);
    std::string bytes;
    nlohmann::json times = nlohmann::json::array(), base = nlohmann::json::array();
    for (const TowerFrame& frame : frames) {
        displacement.add(frame.displacement, bytes);
        rotation.add(frame.rotation, bytes);
        velocity.add(frame.velocity, bytes);
        times.push_back(frame.time);
        base.push_back(to_array(frame.base.displacement));
    }
    const std::vector<double> forces = list_forces(reported);
    const double largest_force = forces.empty() ? 0.0 : *std::max_element(forces.begin(), forces.end());
    std::string layers, shapes;
    for (const int layer : run.blocks.layer) append(layers, static_cast<std::int16_t>(layer));
    for (const int shape : run.blocks.shapes.of_block) append(shapes, static_cast<std::int32_t>(shape));
    TowerData data{.json = {{"label", reported.label},
                            {"blocks", blocks},
                            {"length", run.similitude.length()},
                            {"time", run.similitude.time()},
                            {"velocity", run.similitude.velocity()},
                            {"stands", reported.stands},
                            {"has_frames", !run.frames.time.empty()},
                            {"times", times},
                            {"base", base},
                            {"scales", {{"displacement", far}, {"rotation", turned}, {"velocity", fast}, {"force", largest_force}}},
                            {"start", encode_base64(list_start(run))},
                            {"slip", encode_base64(list_slips(reported))},
                            {"layer", encode_base64(layers)},
                            {"shapes", list_shapes(run.blocks.shapes)},
                            {"shape", encode_base64(shapes)},
                            {"forces", forces.empty() ? "" : encode_base64(compress_bytes(code_forces(forces, blocks, largest_force)))},
                            {"frames", encode_base64(compress_bytes(bytes))}},
                   // half a step of the square root, at the largest force
                   .rounding = {.displacement = displacement.rounding(),
                                .rotation = rotation.rounding(),
                                .velocity = velocity.rounding(),
                                .force = largest_force / kForceSteps}};
    add_turn(frames, data.json);
    return data;
}

}  // namespace musim::lsdem
