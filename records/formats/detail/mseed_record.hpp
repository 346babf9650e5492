#pragma once

#include <libmseed.h>

#include <chrono>
#include <memory>
#include <string>

#include "records/utc_time.hpp"

/// Parts that reading and writing with libmseed share.
namespace musim::records::detail {

struct FreeMseedRecord {
    void operator()(MSRecord* record) const { msr_free(&record); }
};
using MseedRecord = std::unique_ptr<MSRecord, FreeMseedRecord>;

/// From here on libmseed's complaints are kept, not printed; those of this thread so far are forgotten.
void catch_mseed_complaints();

/// The first line of the last complaint of this thread; empty when there was none.
std::string last_mseed_complaint();

}  // namespace musim::records::detail
