#pragma once

/// Everything of `musim::records` that a program needs: ground motions read, measured, processed, rescaled and written.
#include "records/formats/read_record.hpp"
#include "records/formats/write_record.hpp"
#include "records/ground_motion.hpp"
#include "records/measures/intensity.hpp"
#include "records/measures/measures.hpp"
#include "records/measures/response_spectrum.hpp"
#include "records/processing/base_motion.hpp"
#include "records/processing/processing.hpp"
#include "records/processing/scale_record.hpp"
#include "records/time_series.hpp"
