#pragma once

#include <vector>

#include "lsdem/run/specimen_batch.hpp"
#include "lsdem/study/ensemble_members.hpp"

/// Specimens that the members of an ensemble share with other ensembles: the same blocks under another motion need not be laid again.
namespace musim::lsdem {

/// Has every member use its specimen from batch.folder, which is prepared where it is missing: the seeds of `batch` are those of `members`,
/// its scene is not looked at. A member is then another job, named by the content of its specimen too. One whose specimen does not come to
/// rest stays as it is, and would lay it again; its report says so. Throws as make_specimens does.
std::vector<SpecimenReport> use_specimens(std::vector<EnsembleMember>& members, SpecimenBatch batch);

/// The same when all specimens are there. Throws ResultError for the first that is not.
void use_prepared_specimens(std::vector<EnsembleMember>& members, const std::filesystem::path& folder, const std::string& version);

}  // namespace musim::lsdem
