#include "records/design/parse_design.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include <algorithm>

#include "records/design/candidate.hpp"
#include "records/design/detail/material_fields.hpp"
#include "records/design/models.hpp"
#include "records/error.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"

namespace musim::records {
namespace {

using detail::Json;
using detail::JsonReader;
using detail::JsonRules;
using detail::read_modulus;
using detail::read_names;
using detail::read_number;
using detail::read_positive;
using detail::require_block;
using detail::require_list;
using detail::require_positive;
using detail::require_text;

Prototype read_prototype(const JsonReader& fields) {
    Prototype prototype;
    prototype.block = require_block(fields, "block");
    prototype.height = require_positive<scaling::Length>(fields, "height");
    prototype.density = require_positive<scaling::Density>(fields, "density");
    prototype.friction = require_positive<scaling::Ratio>(fields, "friction").value();
    prototype.mass = read_positive<scaling::Mass>(fields, "mass").value_or(scaling::Mass{});
    prototype.mass_center = read_positive<scaling::Length>(fields, "mass_center").value_or(0.5 * prototype.height);
    prototype.restitution = read_number(fields, "restitution");
    const auto block = [&] { return prototype.block; };
    prototype.modulus = read_modulus(fields, "modulus", "normal_stiffness", block);
    prototype.shear_modulus = read_modulus(fields, "shear_modulus", "shear_stiffness", block);
    prototype.deviation = read_positive<scaling::Length>(fields, "height_deviation");
    fields.refuse_unknown_keys();
    return prototype;
}

Material read_material(const JsonReader& value, const std::vector<Material>& presets) {
    if (value.json().is_string()) return detail::find_preset(value.text(), value.place(), presets);
    const JsonReader fields = value.object();
    const std::optional<Material> preset = detail::read_preset(fields, presets);
    const std::string name = preset ? fields.find<std::string>("name").value_or(preset->name) : require_text(fields, "name");
    Material material = detail::read_properties(fields, preset, [&] { return require_block(fields, "stiffness_block"); });
    material.name = name;
    detail::replace(material.smallest_edge, read_positive<scaling::Length>(fields, "smallest_edge"));
    detail::replace(material.price, read_number(fields, "price"));
    fields.refuse_unknown_keys();
    return material;
}

std::vector<Material> read_materials(const JsonReader& fields, const std::vector<Material>& presets) {
    std::vector<Material> materials;
    for (const JsonReader& entry : require_list(fields, "materials", R"(["wood", {"name": "resin", "density": ..., "friction": ...}])")) {
        const Material material = read_material(entry, presets);
        if (std::any_of(materials.begin(), materials.end(), [&](const Material& other) { return other.name == material.name; })) {
            fields.fail(fmt::format("the material \"{}\" comes twice", material.name), "give every one its own \"name\"");
        }
        materials.push_back(material);
    }
    return materials;
}

void read_rotation_peaks(const JsonReader& row, GivenPeaks& peaks) {
    for (const char* const key : {"acceleration", "velocity", "displacement"}) {
        if (!row.has(key)) continue;
        row.fail(fmt::format("{} is a peak of a translation (axis {} is a rotation)", key, peaks.axis),
                 "give angular_acceleration, angular_velocity and angle");
    }
    peaks.angular_acceleration = detail::read_turn<scaling::AngularAcceleration>(row, "angular_acceleration", "200 deg/s^2");
    if (!peaks.angular_acceleration) row.fail("angular_acceleration is missing", "add it");
    peaks.angular_velocity = detail::read_turn<scaling::Frequency>(row, "angular_velocity", "30 deg/s");
    peaks.angle = detail::read_turn<scaling::Ratio>(row, "angle", "5 deg");
}

std::vector<GivenPeaks> read_given_peaks(const JsonReader& fields) {
    std::vector<GivenPeaks> list;
    for (const JsonReader& entry : require_list(fields, "peaks", R"([{"axis": "x", "acceleration": "0.5 g", ...}])")) {
        const JsonReader row = entry.object();
        GivenPeaks peaks{.axis = require_text(row, "axis")};
        if (is_named_as_rotation(peaks.axis)) {
            read_rotation_peaks(row, peaks);
        } else {
            peaks.acceleration = require_positive<scaling::Acceleration>(row, "acceleration");
            peaks.velocity = read_positive<scaling::Velocity>(row, "velocity");
            peaks.displacement = read_positive<scaling::Length>(row, "displacement");
        }
        peaks.lowest_frequency = read_positive<scaling::Frequency>(row, "lowest_frequency");
        peaks.highest_frequency = read_positive<scaling::Frequency>(row, "highest_frequency");
        row.refuse_unknown_keys();
        list.push_back(peaks);
    }
    return list;
}

RecordFile read_record_file(const JsonReader& fields) {
    RecordFile record{.file = require_text(fields, "file")};
    if (fields.has("axes")) {
        const Json& axes = fields["axes"].json();
        if (!axes.is_object()) fields.fail("axes is no object", R"(write {"360": "x"}, component before axis)");
        for (const auto& [component, axis] : axes.items()) {
            if (!axis.is_string()) fields.fail("an axis is no text", R"(write {"360": "x"}, component before axis)");
            record.axes.emplace_back(component, axis.get<std::string>());
        }
    }
    detail::refuse_uncertainty(fields, "high_pass", "it is chosen");
    record.high_pass = read_positive<scaling::Frequency>(fields, "high_pass");
    return record;
}

std::variant<RecordFile, std::vector<GivenPeaks>> read_motion(const JsonReader& fields) {
    std::variant<RecordFile, std::vector<GivenPeaks>> motion;
    if (fields.has("peaks")) {
        motion = read_given_peaks(fields);
    } else {
        motion = read_record_file(fields);
    }
    fields.refuse_unknown_keys();
    return motion;
}

Limits read_limits(const JsonReader& fields) {
    Limits limits;
    limits.hall_height = read_positive<scaling::Length>(fields, "hall_height");
    limits.deviation_ratio = read_number(fields, "deviation_ratio");
    limits.overlap_ratio = read_number(fields, "overlap_ratio");
    if (fields.has("camera")) {
        const JsonReader camera = fields["camera"].object();
        detail::refuse_uncertainty(camera, "pictures", "they are chosen");
        limits.camera_rate = require_positive<scaling::Frequency>(camera, "rate");
        limits.pictures = require_positive<scaling::Ratio>(camera, "pictures").value();
        camera.refuse_unknown_keys();
    }
    fields.refuse_unknown_keys();
    return limits;
}

/// Every limit must find what it needs, lest it be passed over in silence.
void check_limits(const JsonReader& fields, const Design& design) {
    for (const Material& material : design.materials) {
        if ((design.limits.deviation_ratio || design.limits.overlap_ratio) && !material.deviation) {
            fields.fail(fmt::format("material {} has no height_deviation (limits ask for it)", material.name),
                        "add it, or remove the limit");
        }
        if (design.limits.overlap_ratio && !material.modulus) {
            fields.fail(fmt::format("material {} has no modulus (overlap_ratio asks for it)", material.name),
                        "add it, or remove the limit");
        }
    }
}

std::vector<DesignLaw> read_laws(const JsonReader& fields, const std::string& source) {
    if (!fields.has("laws")) return {scaling::load_scale_law("mu")};
    std::vector<DesignLaw> laws;
    const std::size_t count = require_list(fields, "laws", R"(["mu", {"law": "gravity_distorted", "set": {"a": 2}}])").size();
    for (std::size_t i = 0; i < count; ++i) {
        const JsonReader entry = fields["laws"].part(i);
        if (!entry.json().is_string() && !entry.json().is_object()) fields.fail("an entry of laws is no text", "write it in quotes");
        laws.push_back(detail::read_law(entry, source));
    }
    return laws;
}

/// A factor that a law expects and that nothing in the design gives is missing at every length. What contradicts is found later, by
/// material.
void check_laws(const JsonReader& fields, const Design& design) {
    for (const DesignLaw& law : design.laws) {
        for (const Material& material : design.materials) {
            try {
                const Models models(design, material, law);
            } catch (const scaling::MissingFactor& error) {
                const std::string remedy =
                    fmt::format(R"(give it by {{"law": "{}", "set": {{"NAME": NUMBER}}}}, or let it follow by "hold": [...])", law.name());
                throw error.with<ReadError>(remedy).seen_from<ReadError>(fmt::format("{}: laws: {}", fields.place(), material.name));
            } catch (const scaling::PiError& error) {
                throw error.seen_from<ReadError>(fields.place() + ": laws");
            } catch (const scaling::SimilitudeError&) {
                continue;
            }
        }
    }
}

std::vector<std::string> read_groups(const JsonReader& fields, const std::vector<DesignLaw>& laws) {
    if (!fields.has("groups")) return default_groups();
    std::vector<std::string> known = known_groups();
    for (const DesignLaw& law : laws) {
        for (const auto* products : {&law.law().held, &law.law().watched}) {
            for (const std::string& product : *products) {
                if (std::find(known.begin(), known.end(), product) == known.end()) known.push_back(product);
            }
        }
    }
    std::vector<std::string> names = read_names(fields, "groups", R"(["mu^N", "omega/p"])");
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            fields.fail(fmt::format("groups: \"{}\" is no group", name), fmt::format("take some of {}", fmt::join(known, ", ")));
        }
    }
    return names;
}

}  // namespace

Design parse_design(std::string_view json, const std::string& source, const std::vector<Material>& presets,
                    scaling::UncertainReading* reading) {
    const Json object = detail::parse_object(json, source, "musim-design/1", "design", R"("prototype": {...}, "materials": [...])");
    const JsonRules rules(reading);
    const JsonReader fields(object, rules, source);
    Design design;
    fields.read("name", design.name);
    if (!fields.has("prototype")) fields.fail("prototype is missing", R"(add {"block": [...], "height", "density", "friction"})");
    design.prototype = read_prototype(fields["prototype"].object());
    fields.read("table", design.table_file);
    const bool has_record = fields.has("record");
    if (has_record != !design.table_file.empty()) {
        fields.fail(has_record ? "table is missing (it is to make the record)" : "record is missing (the table is to make it)",
                    "give both, or neither");
    }
    if (has_record) design.motion = read_motion(fields["record"].object());
    if (fields.has("limits")) design.limits = read_limits(fields["limits"].object());
    design.materials = read_materials(fields, presets);
    design.laws = read_laws(fields, source);
    design.gravity = read_number(fields, "gravity");
    detail::refuse_uncertainty(fields, "length", "it is chosen");
    design.length = read_number(fields, "length");
    design.groups = read_groups(fields, design.laws);
    fields.refuse_unknown_keys();
    check_limits(fields, design);
    if (reading == nullptr || !reading->is_moved()) check_laws(fields, design);
    return design;
}

}  // namespace musim::records
