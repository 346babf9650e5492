#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/study/twin_growth.hpp"
#include "lsdem/types.hpp"

namespace musim::lsdem {

/// The laid specimen in the folder of a scene's twins, as a checkpoint before the first step.
inline constexpr const char* kTwinSpecimenName = "specimen.checkpoint";

/// Makes the folder and its parents. Throws records::WriteError.
void make_folder(const std::filesystem::path& folder);

/// Keeps what is known of a prototype, and its velocities: of every sample those of all blocks that move. The file appears whole or not at
/// all. Throws records::WriteError.
void write_prototype(const std::filesystem::path& folder, TwinPrototype prototype, std::vector<std::vector<Vector3>> velocities);

/// Reads it back into `prototype` and returns the velocities; nothing when there is none, or none that is whole.
std::optional<std::vector<std::vector<Vector3>>> read_prototype(const std::filesystem::path& folder, TwinPrototype& prototype);

/// Name of the file of a twin: `model_LENGTH.json`, or `moved_SHIFT_DIRECTIONS.json`, in numbers that read back the same.
std::string twin_file_name(const TwinChoice& choice);

/// Keeps a twin that has finished, as JSON: format, length, shift, directions, diverged, difference_m_s. Throws records::WriteError.
void write_twin(const std::filesystem::path& folder, const TwinRun& twin);

/// Fills in what is kept of a twin of this choice; false when there is nothing, or nothing whole.
bool read_twin(const std::filesystem::path& folder, TwinRun& twin);

/// A study summed up, without histories: layout in docs/user/file_formats.md. What there is not is null.
nlohmann::json to_json(const TwinStudy& study, const TwinSummary& summary);

/// One line per scene, twin and sample: scene, length, shift, directions, time_s, difference and its running maximum, both over the
/// prototype's peak velocity.
std::string make_twins_csv(const std::vector<TwinStudy>& studies);

/// One line per scene and sample: scene, time_s, count, mean_log10, sd_log10 of the running maximum over the models; empty where a sample
/// gives none. Copies that begin elsewhere are left out.
std::string make_spread_csv(const std::vector<TwinStudy>& studies);

}  // namespace musim::lsdem
