#pragma once

#include "lsdem/study/simulate.hpp"

namespace musim::lsdem::study {

/// simulate(), for one of several runs of one command: with settings.checkpoint the run leaves its checkpoints in that file, and its end,
/// too. What is found there goes on, or is not run again; all but wall times are the bits of a run without interruption. The file must be
/// of this very run: its name is to say so. One that cannot be read is as good as none. A run that diverged is not kept.
RunResult run_kept(const Specimen& specimen, const TimePlan& plan, RunStart begin, const RunSettings& settings);

}  // namespace musim::lsdem::study
