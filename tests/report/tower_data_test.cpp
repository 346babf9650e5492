#include "lsdem/report/tower_data.hpp"
#include "lsdem/report/report.hpp"

#include <doctest/doctest.h>
#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "lsdem/export/base64.hpp"
#include "tests/report/made_stored_run.hpp"

using namespace musim::lsdem;

namespace {

std::string decode_base64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned group = 0;
    int bits = 0;
    for (const char c : text) {
        if (c == '=') break;
        group = group << 6U | static_cast<unsigned>(digits.find(c));
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(group >> static_cast<unsigned>(bits) & 0xFFU);
    }
    return bytes;
}

std::string unpack(const std::string& packed, std::size_t size) {
    std::string bytes(size, '\0');
    uLongf length = size;
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length, reinterpret_cast<const Bytef*>(packed.data()), packed.size()) ==
            Z_OK);
    REQUIRE(length == size);
    return bytes;
}

/// Sums of 16-bit (bytes = 2) or 8-bit differences of a component of a block up to a frame, as the layout has them.
int sum_up(const std::string& frames, std::size_t blocks, std::size_t frame, std::size_t offset, std::size_t axis, std::size_t block,
           std::size_t bytes) {
    std::uint16_t sum = 0;
    for (std::size_t f = 0; f <= frame; ++f) {
        const std::size_t from = f * blocks * 15 + offset + axis * blocks * bytes + block;
        const auto low = static_cast<unsigned char>(frames[from]);
        const auto high = bytes == 2 ? static_cast<unsigned char>(frames[from + blocks]) : 0U;
        sum = static_cast<std::uint16_t>(sum + (low | high << 8U));
    }
    return bytes == 2 ? static_cast<std::int16_t>(sum) : static_cast<std::int8_t>(sum & 0xFFU);
}

}  // namespace

TEST_CASE("base64 is that of RFC 4648") {
    CHECK(encode_base64("").empty());
    CHECK(encode_base64("f") == "Zg==");
    CHECK(encode_base64("fo") == "Zm8=");
    CHECK(encode_base64("foo") == "Zm9v");
    CHECK(encode_base64("foobar") == "Zm9vYmFy");
    CHECK(encode_base64(std::string("\xff\x00\xfe", 3)) == "/wD+");
}

TEST_CASE("frames come back within the stated rounding") {
    const ReportedRun reported = make_stored_run(40);
    const TowerData data = make_tower_data(reported);
    const std::size_t blocks = 3;
    const std::string frames = unpack(decode_base64(data.json["frames"]), 40 * blocks * 15);
    const nlohmann::json& scales = data.json["scales"];
    double worst = 0.0, worst_turn = 0.0, worst_velocity = 0.0;
    for (std::size_t f = 0; f < 40; ++f) {
        for (std::size_t b = 0; b < blocks; ++b) {
            const Vector3 moved = reported.run.frames.position[f * blocks + b].cast<double>() - reported.run.initial.position[b];
            const Vector3& angle = reported.run.history.spine_rotation[f * blocks + b];
            for (int axis = 0; axis < 3; ++axis) {
                const auto a = static_cast<std::size_t>(axis);
                worst = std::max(
                    worst, std::abs(scales["displacement"].get<double>() / 32767 * sum_up(frames, blocks, f, 0, a, b, 2) - moved[axis]));
                worst_turn = std::max(
                    worst_turn,
                    std::abs(scales["rotation"].get<double>() / 32767 * sum_up(frames, blocks, f, 6 * blocks, a, b, 2) - angle[axis]));
                worst_velocity = std::max(
                    worst_velocity, std::abs(scales["velocity"].get<double>() / 127 * sum_up(frames, blocks, f, 12 * blocks, a, b, 1) -
                                             static_cast<double>(reported.run.frames.velocity[f * blocks + b][axis])));
            }
        }
    }
    // half a step of the largest value; frames are single precision, whose rounding (of 3 m and of 1 rad) comes on top
    CHECK(data.rounding.displacement == doctest::Approx(0.5 * scales["displacement"].get<double>() / 32767).epsilon(1e-12));
    CHECK(worst <= data.rounding.displacement * (1.0 + 1e-9));
    CHECK(worst > 0.5 * data.rounding.displacement);
    CHECK(worst_turn <= data.rounding.rotation + 4.0 * 6e-8);
    CHECK(worst_velocity <= data.rounding.velocity * (1.0 + 1e-9));
    CHECK(data.json["times"].size() == 40);
    CHECK(data.json["base"][39][0].get<double>() == reported.run.history.base[39].displacement.x());
    CHECK(decode_base64(data.json["start"]).size() == blocks * 40);
}

TEST_CASE("what turns with the base has not moved in a page, which knows the turn") {
    ReportedRun reported = make_stored_run(40);
    StoredRun& run = reported.run;
    const Vector3 pivot(0.5, -1.0, 0.0);
    for (std::size_t k = 0; k < run.history.samples(); ++k) {
        BaseState& base = run.history.base[k];
        base.pivot = pivot;
        base.turn = Quaternion(Eigen::AngleAxisd(0.02 * static_cast<double>(k), Vector3::UnitY()));
        for (std::size_t b = 0; b < 3; ++b) {
            const Vector3 place = pivot + base.displacement + base.turn * (run.initial.position[b] - pivot);
            const Quaternion q = base.turn * run.initial.orientation[b];
            run.frames.position[3 * k + b] = place.cast<float>();
            run.frames.quaternion[3 * k + b] = Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()).cast<float>();
        }
    }
    const TowerData data = make_tower_data(reported);
    // single precision of places some metres away, and of quaternions
    const double last = run.history.base.back().displacement.x();
    CHECK(data.json["scales"]["displacement"].get<double>() == doctest::Approx(last).epsilon(1e-5));
    CHECK(data.json["scales"]["rotation"].get<double>() < 1e-6);
    REQUIRE(data.json["turn"].size() == 40);
    CHECK(data.json["turn"][39][0].get<double>() == doctest::Approx(std::cos(0.39)).epsilon(1e-14));
    CHECK(data.json["turn"][39][2].get<double>() == doctest::Approx(std::sin(0.39)).epsilon(1e-14));
    CHECK(data.json["pivot"] == nlohmann::json{0.5, -1.0, 0.0});
    CHECK_FALSE(make_tower_data(make_stored_run(40)).json.contains("turn"));
}

TEST_CASE("contact forces come back over the weights of their blocks within the stated rounding") {
    const ReportedRun reported = make_stored_run(30);
    const TowerData data = make_tower_data(reported);
    const std::size_t blocks = 3;
    const std::string codes = unpack(decode_base64(data.json["forces"]), 30 * blocks);
    const double largest = data.json["scales"]["force"];
    std::vector<std::uint8_t> code(blocks, 0);
    double worst = 0.0;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        code[i % blocks] = static_cast<std::uint8_t>(code[i % blocks] + static_cast<unsigned char>(codes[i]));
        const double share = code[i % blocks] / 255.0, force = static_cast<double>(reported.run.frames.contact_force[i]) / 9.8;
        worst = std::max(worst, std::abs(largest * share * share - force));
    }
    CHECK(worst <= data.rounding.force);
    CHECK(worst > 0.25 * data.rounding.force);

    ReportedRun unmeasured = make_stored_run(30);
    unmeasured.response.reset();
    CHECK(make_tower_data(unmeasured).json["forces"] == "");
}

TEST_CASE("a run without frames shows its start and its end, and one that never moves does, too") {
    ReportedRun reported = make_stored_run(10);
    reported.run.frames = {};
    const TowerData data = make_tower_data(reported);
    CHECK(data.json["has_frames"] == false);
    REQUIRE(data.json["times"].size() == 2);
    CHECK(data.json["times"][1].get<double>() == reported.run.history.time.back());
    const std::string frames = unpack(decode_base64(data.json["frames"]), 2 * std::size_t{3} * 15);
    CHECK(sum_up(frames, 3, 0, 0, 0, 1, 2) == 0);
    CHECK(sum_up(frames, 3, 1, 0, 0, 1, 2) != 0);

    reported.run.final = reported.run.initial;
    const TowerData still = make_tower_data(reported);
    CHECK(still.rounding.displacement == 0.0);
    CHECK(still.rounding.rotation == 0.0);
}

TEST_CASE("a page with a copy of three.js has its licence beside it") {
    const std::string scripts = make_tower_scripts();
    CHECK(scripts.empty() == (scripts.find("The MIT License") == std::string::npos));
}

TEST_CASE("a page has the outer faces of shapes that are no boxes, and which of their edges are lines") {
    ReportedRun reported = make_stored_run(3);
    CHECK(make_tower_data(reported).json["shapes"].empty());
    CHECK(make_tower_data(reported).json["shape"] == "");

    // two cubes that share a face: what lies between them is not shown, nor the lines where sides go on in one plane
    Solid halves;
    for (const double x : {-0.5, 0.5}) {
        const Placing place{Matrix3::Identity(), {x, 0.0, 0.0}};
        halves.pieces.push_back(moved(make_box_solid({1.0, 1.0, 1.0}), place).pieces.front());
        halves.pieces.back().faces[x < 0.0 ? 1 : 0].outer = false;
    }
    reported.run.blocks.shapes.list = {std::make_shared<const BlockShape>(BlockShape{"halves", halves, 0.0})};
    reported.run.blocks.shapes.of_block = {-1, 0, -1};
    const nlohmann::json json = make_tower_data(reported).json;
    REQUIRE(json["shapes"].size() == 1);
    const nlohmann::json& shape = json["shapes"][0];
    CHECK(shape["radius"] == 0.0);
    CHECK(decode_base64(shape["corners"]).size() == 16 * 3 * sizeof(float));
    CHECK(shape["faces"].size() == 10);
    int lines = 0, none = 0;
    for (const nlohmann::json& face : shape["faces"]) {
        for (const int corner : face) {
            CHECK((corner < 0 ? ~corner : corner) < 16);
            ++(corner < 0 ? none : lines);
        }
    }
    CHECK(none == 8);
    CHECK(lines == 32);
    CHECK(decode_base64(json["shape"]) == std::string("\xff\xff\xff\xff\x00\x00\x00\x00\xff\xff\xff\xff", 12));
}
