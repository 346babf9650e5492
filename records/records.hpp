#pragma once

/// Everything of `musim::records` that a program needs: ground motions read, measured, processed, rescaled and written.
#include "records/ground_motion.hpp"
#include "records/intensity.hpp"
#include "records/measures.hpp"
#include "records/processing.hpp"
#include "records/read_record.hpp"
#include "records/response_spectrum.hpp"
#include "records/scale_record.hpp"
#include "records/time_series.hpp"
#include "records/write_record.hpp"
