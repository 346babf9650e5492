#include "lsdem/study/ensemble_specimens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lsdem/results/result_error.hpp"

namespace musim::lsdem {
namespace {

/// The member whose blocks stand where `file` has them.
EnsembleMember with_specimen(const EnsembleMember& member, const std::filesystem::path& file, const std::string& version) {
    Scene scene = member.scene;
    Preparation preparation = scene.preparation.value_or(Preparation{});
    preparation.placing.reset();
    preparation.specimen = std::filesystem::absolute(file);
    scene.preparation = preparation;
    return make_member(std::move(scene), version);
}

}  // namespace

std::vector<SpecimenReport> use_specimens(std::vector<EnsembleMember>& members, SpecimenBatch batch) {
    batch.scene = members.front().scene;
    batch.seeds.clear();
    for (const EnsembleMember& member : members) batch.seeds.push_back(member.seed);
    const auto missing = std::count_if(members.begin(), members.end(), [&](const EnsembleMember& member) {
        return !std::filesystem::exists(batch.folder / specimen_file_of(member.scene));
    });
    // those whose specimens are there follow, too
    if (missing > 0) batch.runs_to_follow = static_cast<double>(members.size()) / static_cast<double>(missing);
    std::vector<SpecimenReport> reports = make_specimens(batch);
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (reports[i].reused || reports[i].prepared.rest.at_rest) members[i] = with_specimen(members[i], reports[i].file, batch.version);
    }
    return reports;
}

void use_prepared_specimens(std::vector<EnsembleMember>& members, const std::filesystem::path& folder, const std::string& version) {
    for (EnsembleMember& member : members) {
        const std::filesystem::path file = folder / specimen_file_of(member.scene);
        if (!std::filesystem::exists(file)) {
            throw ResultError(fmt::format("{}: does not exist, so member {} has no name yet; prepare it with musim specimen -o {}",
                                          file.string(), member.seed, folder.string()));
        }
        member = with_specimen(member, file, version);
    }
}

}  // namespace musim::lsdem
