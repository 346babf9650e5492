#include "cli/option_name.hpp"

#include "scaling/error.hpp"
#include "scaling/setting.hpp"

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
        case Setting::factor:
            return "--set NAME=NUMBER";
        case Setting::axes:
            return "--axis COMPONENT=AXIS";
        case Setting::specimen_folder:
            return "the folder of --specimens";
        case Setting::specimen_count:
            return "--specimens";
        case Setting::preparation:
            return "musim specimen -o";
        case Setting::specimen_list:
            return "what `musim specimen --json` printed";
        case Setting::overwriting:
            return "--force to replace them";
        case Setting::single_run:
            return "`musim run`";
        case Setting::sequence:
            return "`musim sequence`";
        case Setting::run_resumption:
            return "musim run --resume";
        case Setting::sequence_resumption:
            return "musim sequence --resume";
    }
    return "";
}

std::string word(const std::exception& error) {
    const auto* const with_remedy = dynamic_cast<const Error*>(&error);
    return with_remedy != nullptr ? with_remedy->worded(option_name) : error.what();
}

}  // namespace musim::cli
