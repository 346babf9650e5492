#pragma once

#include <string>
#include <vector>

#include "records/measures/response_spectrum.hpp"
#include "records/shake_table/table_check.hpp"

/// Correction of a motion: what must be given up so that a table can make it.
namespace musim::records {

/// A model's record, its component i to be made by axis i.
struct TableTask {
    GroundMotion model;
    std::vector<TableAxis> axes;  ///< one for each component
    Payload payload;              ///< of the model
    double energy_share = 0.99;   ///< ShakeTable::energy_share
    DriveSettings settings = {};  ///< what is done to the record in any case; its amplitude is 1
};

/// Limits of one component's axis.
struct ComponentUse {
    std::string component, axis;
    TableDemand demand;
    std::vector<LimitUse> uses;
    bool is_rotation = false;
};

/// Uses of all limits by the task's record, or by it changed as `settings` say. Throws ProcessingError as the steps do.
std::vector<ComponentUse> check_task(const TableTask& task);
std::vector<ComponentUse> check_task(const TableTask& task, const DriveSettings& settings);

/// The largest LimitUse::used() of all; 0 without limits.
double find_largest_use(const std::vector<ComponentUse>& uses);

/// Response spectra of one component, 5 % of critical, before and after a correction; of a rotation those of an oscillator that turns, its
/// pseudo accelerations in rad/s².
struct SpectrumChange {
    std::string component;
    ResponseSpectrum before, after;
    bool is_rotation = false;
};

/// A change of the record after which the table can make it, and what it does to the response.
struct Correction {
    DriveSettings settings;
    std::vector<ComponentUse> uses;
    std::vector<SpectrumChange> spectra;
    double mean_change = 0.0;     ///< of |ln(PSA after/PSA before)| over all periods and components
    double largest_change = 0.0;  ///< of the same
};

/// Ways to fit a record to a table, the one with the least mean change of the response spectra at `periods` first: a smaller amplitude, a
/// higher high-pass corner (against displacement), and both where that changes less by a tenth; with a low-pass in each, should the record
/// reach above what the table can follow. Corners are looked for in steps of an eighth of an octave from the record's own corner or
/// 1/duration to the middle of its energy; the amplitude is then what the most-used limit needs. (All at the record's own step; the
/// controller's is put in last.) Empty when none fits, as when the payload is too heavy. Throws ProcessingError as the steps do.
std::vector<Correction> find_corrections(const TableTask& task, const std::vector<scaling::Time>& periods);

/// 50 periods over the band that holds the energy of all components: from 1/highest to 1/lowest frequency of their demands.
std::vector<scaling::Time> make_task_periods(const std::vector<ComponentUse>& uses);

}  // namespace musim::records
