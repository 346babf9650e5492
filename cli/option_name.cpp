#include "cli/option_name.hpp"

#include "scaling/error.hpp"

namespace musim::cli {

std::string_view option_name(Setting setting) {
    switch (setting) {
        case Setting::time_step:
            return "--dt SECONDS";
        case Setting::unit:
            return "--unit";
        case Setting::quantity:
            return "--quantity";
        case Setting::sensitivity:
            return "--sensitivity NUMBER";
        case Setting::station_response:
            return "--station-xml FILE";
        case Setting::columns:
            return "--columns";
        case Setting::skipped_lines:
            return "--skip LINES";
    }
    return "";
}

std::string word(const std::exception& error) {
    const auto* const with_remedy = dynamic_cast<const Error*>(&error);
    return with_remedy != nullptr ? with_remedy->worded(option_name) : error.what();
}

}  // namespace musim::cli
