#pragma once

#include <exception>
#include <string>
#include <string_view>

#include "scaling/remedy.hpp"

namespace musim::cli {

/// Option or command that gives a setting, e.g. "--dt SECONDS".
std::string_view option_name(Setting setting);

/// Message of an error, its remedy in options.
std::string word(const std::exception& error);

}  // namespace musim::cli
