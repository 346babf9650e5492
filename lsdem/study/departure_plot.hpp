#pragma once

#include <string>

#include "lsdem/study/line_plot.hpp"
#include "lsdem/study/pair.hpp"

namespace musim::lsdem::study {

/// How models and twins depart from their prototype: the running maximum of the difference over the peak velocity, on a logarithmic axis
/// over the prototype's time, with the horizon marked. `name` says of what.
LinePlot make_departure_plot(const PairStudy& study, const std::string& name);

}  // namespace musim::lsdem::study
