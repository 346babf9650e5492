#pragma once

/// Everything of `musim::scaling` that a program needs: quantities with units, laws of similitude and their factors, dimensionless groups.
#include "scaling/distortion.hpp"
#include "scaling/law_similitude.hpp"
#include "scaling/pi_problem.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/scale_law.hpp"
#include "scaling/scale_law_catalogue.hpp"
#include "scaling/scale_law_json.hpp"
#include "scaling/similitude.hpp"
#include "scaling/units.hpp"
