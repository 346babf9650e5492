#include "records/formats/detail/mseed_record.hpp"

namespace musim::records::detail {
namespace {

thread_local std::string complaint;  // libmseed calls back without context

void keep_complaint(char* text) { complaint = text; }

}  // namespace

void catch_mseed_complaints() {
    static const bool is_set = (ms_loginit(keep_complaint, "", keep_complaint, ""), true);
    static_cast<void>(is_set);
    complaint.clear();
}

std::string last_mseed_complaint() { return complaint.substr(0, complaint.find('\n')); }

}  // namespace musim::records::detail
