#include "cli/lsdem/specimen_batch.hpp"

#include "cli/output.hpp"
#include "cli/version.hpp"

namespace musim::cli {

lsdem::SpecimenBatch begin_batch(const std::string& folder, int threads, double checkpoint_interval) {
    lsdem::SpecimenBatch batch;
    batch.folder = folder;
    batch.version = kVersion;
    batch.threads = threads;
    batch.checkpoint_interval = checkpoint_interval;
    batch.on_warning = [](const std::string& what) { note("musim: warning: {}\n", what); };
    return batch;
}

void warn_of_fallen(const lsdem::SpecimenReport& report) {
    if (report.fallen == 0) return;
    note("musim: warning: {}: {}; take another seed, or another --placing\n", report.file.string(), report.what_fell);
}

}  // namespace musim::cli
