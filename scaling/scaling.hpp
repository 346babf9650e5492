#pragma once

/// Everything of `musim::scaling` that a program needs: quantities with units, laws of similitude and their factors, dimensionless groups.
#include "scaling/laws/law_similitude.hpp"
#include "scaling/laws/scale_law.hpp"
#include "scaling/laws/scale_law_catalogue.hpp"
#include "scaling/laws/scale_law_json.hpp"
#include "scaling/laws/similitude.hpp"
#include "scaling/pi/pi_problem.hpp"
#include "scaling/quantity_text.hpp"
#include "scaling/structures/distortion.hpp"
#include "scaling/units.hpp"
