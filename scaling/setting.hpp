#pragma once

#include <string_view>

#include "scaling/remedy.hpp"

namespace musim {

/// Thing that a caller gives beside its input, or has done, in a language of its own: a command by an option, a scene by a key.
enum class Setting : int {
    time_step,
    unit,
    quantity,
    sensitivity,
    station_response,
    columns,
    skipped_lines,
    factor,               ///< of a quantity of a law
    axes,                 ///< of a shake table, for components
    specimen_folder,      ///< of prepared specimens
    specimen_count,       ///< of other specimens than a pair's own
    preparation,          ///< of specimens; a folder follows
    specimen_list,        ///< JSON of prepared specimens
    overwriting,          ///< of results
    single_run,           ///< of a scene with one motion
    sequence,             ///< of a scene with a list of motions
    run_resumption,       ///< of an unfinished run; a folder follows
    sequence_resumption,  ///< of an unfinished sequence; a folder follows
};

/// Name of a setting in plain words, e.g. "the time step".
std::string_view plain_name(Setting setting);

}  // namespace musim
