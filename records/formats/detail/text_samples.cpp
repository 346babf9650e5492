#include "records/formats/detail/text_samples.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "records/detail/text.hpp"
#include "records/formats/detail/parsers.hpp"

namespace musim::records::detail {
namespace {

/// A column that may become a component.
struct CandidateColumn {
    std::size_t column = 0;
    std::string name = {};
    ColumnTitle title = {};
    std::optional<SampleUnit> unit = {};          ///< that its title or the text above names
    std::optional<SampleQuantity> quantity = {};  ///< likewise

    bool is_rotation() const { return quantity ? records::is_rotation(*quantity) : title.is_rotation; }
};

class SampleChooser {
  public:
    SampleChooser(const TextFile& file, const TextTable& table, const TextHeading& heading, const TextLayout& layout,
                  const ReadOptions& options)
        : file_(&file), table_(&table), heading_(&heading), options_(&options) {
        for (std::size_t i = 0; i < layout.samples.size(); ++i) {
            const std::size_t column = layout.samples[i];
            CandidateColumn candidate{.column = column, .name = layout.names[i]};
            if (column < heading.titles.size()) candidate.title = heading.titles[column];
            candidates_.push_back(std::move(candidate));
        }
        if (options.unit) asked_unit_ = requested_unit(file, options);
    }

    ChosenSamples choose() {
        drop_foreign();
        name_units();
        keep_quantity(find_wanted());
        drop_magnitudes();
        for (CandidateColumn& candidate : candidates_) chosen_.columns.push_back({candidate.column, candidate.name, unit_of(candidate)});
        return std::move(chosen_);
    }

  private:
    std::string place(const CandidateColumn& candidate) const { return place_of(candidate.column, *heading_); }
    [[noreturn]] void fail(const std::string& what, const Remedy& remedy) const { file_->fail(heading_->titles_line, what, remedy); }

    template <class Is>
    void drop(const Is& is, const std::string& why) {
        for (const CandidateColumn& candidate : candidates_)
            if (is(candidate)) chosen_.notes.push_back(fmt::format("{} is left out ({})", place(candidate), why));
        std::erase_if(candidates_, is);
    }

    /// Leaves out what is no motion beside motions; alone, or chosen, it is refused.
    void drop_foreign() {
        const auto is_foreign = [](const CandidateColumn& c) { return !c.title.unit.foreign.empty() || c.title.unit.seconds; };
        const auto is_remark = [](const CandidateColumn& c) { return c.title.is_remark && !c.title.unit.motion; };
        const auto is_given = [](const CandidateColumn& c) { return c.title.unit.motion.has_value(); };
        const auto may_be_motion = [&](const CandidateColumn& c) { return !is_foreign(c) && !is_remark(c); };
        const bool has_given = std::any_of(candidates_.begin(), candidates_.end(), is_given);
        const bool has_motion = std::any_of(candidates_.begin(), candidates_.end(), may_be_motion);
        for (const CandidateColumn& candidate : candidates_) {
            if (!is_foreign(candidate)) continue;
            const std::string_view noun = candidate.title.unit.foreign.empty() ? "a time" : candidate.title.unit.foreign;
            const bool may_hold_motion = noun == "a voltage" || noun == "counts" || candidate.title.quantity;
            if (options_->columns || !has_motion || (may_hold_motion && !has_given && !heading_->stated.motion)) {
                const std::string_view first_advice =
                    may_hold_motion ? "make it a motion by the sensor's sensitivity and name its unit, or choose others with "
                                    : "choose others with ";
                fail(fmt::format("{} holds {} (no motion)", place(candidate), noun), {first_advice, Setting::columns});
            }
        }
        for (const CandidateColumn& candidate : std::vector<CandidateColumn>(candidates_)) {
            if (!is_foreign(candidate)) continue;
            const std::string_view noun = candidate.title.unit.foreign.empty() ? "a time" : candidate.title.unit.foreign;
            drop([&](const CandidateColumn& c) { return c.column == candidate.column; }, std::string(noun));
        }
        if (has_motion && !options_->columns) drop(is_remark, "no motion by its title");
    }

    /// Gives each column the unit and quantity that are said of it; a unit that is not understood needs one from the caller.
    void name_units() {
        const UnitStatement& stated = heading_->stated;
        for (CandidateColumn& candidate : candidates_) {
            const ColumnTitle& title = candidate.title;
            if (!title.unknown_unit.empty() && !asked_unit_) {
                fail(fmt::format("{} names the unit {} (not understood, or not of what the title says)", place(candidate),
                                 quoted(std::string_view(title.unknown_unit))),
                     {"give ", Setting::unit, " or choose others with ", Setting::columns});
            }
            candidate.quantity = title.quantity;
            if (!title.unknown_unit.empty()) continue;
            candidate.unit = title.unit.motion;
            if (candidate.unit) continue;
            if (!stated.unknown.empty() && !asked_unit_) {
                file_->fail(*heading_->stated_line,
                            fmt::format("unit '{}' is none that is known of a motion, or one of several", stated.unknown),
                            {"give ", Setting::unit});
            }
            const bool turns = title.is_rotation || (stated.rotation && !stated.motion);
            const std::optional<SampleUnit>& of_kind = turns ? stated.rotation : stated.motion;
            const bool suits = of_kind && (!title.quantity || *title.quantity == of_kind->quantity);
            if (suits) candidate.unit = of_kind;
            if (candidate.unit) candidate.quantity = candidate.unit->quantity;
            if (!candidate.quantity && !title.is_rotation) candidate.quantity = stated.quantity;
        }
        const auto given = std::find_if(candidates_.begin(), candidates_.end(),
                                        [](const CandidateColumn& c) { return c.unit.has_value() && !c.is_rotation(); });
        const auto unnamed =
            std::find_if(candidates_.begin(), candidates_.end(), [](const CandidateColumn& c) { return !c.unit && !c.is_rotation(); });
        if (given != candidates_.end() && unnamed != candidates_.end() && !asked_unit_ && unnamed->title.unknown_unit.empty()) {
            if (unnamed->quantity && *unnamed->quantity != given->unit->quantity) return;
            fail(fmt::format("{} names no unit ({} is in {})", place(*unnamed), place(*given), given->unit->name),
                 {"give ", Setting::unit, " or choose others with ", Setting::columns});
        }
    }

    bool holds(SampleQuantity quantity) const {
        return std::any_of(candidates_.begin(), candidates_.end(), [&](const CandidateColumn& c) { return c.quantity == quantity; });
    }

    /// The quantity of rotations beside one of `derivatives`: that with as many, or else what sensors give, rates before angles.
    std::optional<SampleQuantity> find_rotation(int derivatives) const {
        for (const int order : {derivatives, 1, 0, 2})
            if (holds(find_quantity(true, order))) return find_quantity(true, order);
        return std::nullopt;
    }

    SampleQuantity find_wanted() const {
        if (options_->quantity) return *options_->quantity;
        if (asked_unit_) return asked_unit_->quantity;
        if (holds(SampleQuantity::acceleration)) return SampleQuantity::acceleration;
        if (holds(SampleQuantity::velocity) && holds(SampleQuantity::displacement)) {
            fail("columns hold velocities and displacements (one quantity is read)", {"give ", Setting::quantity});
        }
        if (holds(SampleQuantity::velocity)) return SampleQuantity::velocity;
        if (holds(SampleQuantity::displacement)) return SampleQuantity::displacement;
        const bool is_turned =
            std::all_of(candidates_.begin(), candidates_.end(), [](const CandidateColumn& c) { return c.is_rotation(); });
        return is_turned ? find_rotation(1).value_or(SampleQuantity::angular_velocity) : SampleQuantity::acceleration;
    }

    void keep_quantity(SampleQuantity quantity) {
        const auto is_other = [&](const CandidateColumn& c) { return c.quantity && *c.quantity != quantity; };
        if (std::all_of(candidates_.begin(), candidates_.end(), is_other)) {
            const CandidateColumn& first = candidates_.front();
            if (first.unit) {
                file_->fail(fmt::format("title names the unit {} (asked for: {})", first.unit->name,
                                        asked_unit_ ? asked_unit_->name : to_string(quantity)),
                            {"correct ", Setting::quantity, " or ", Setting::unit});
            }
            fail(fmt::format("{} holds {} (asked for: {})", place(first), to_string(*first.quantity), to_string(quantity)),
                 {"correct ", Setting::quantity, " or ", Setting::unit});
        }
        // rotations stand beside translations
        const std::optional<SampleQuantity> beside = is_rotation(quantity) ? std::nullopt : find_rotation(derivative_order(quantity));
        for (int order = 2; order >= 0; --order) {
            for (const SampleQuantity other : {find_quantity(false, order), find_quantity(true, order)}) {
                if (other == quantity || other == beside) continue;
                drop([&](const CandidateColumn& c) { return c.quantity == other; }, std::string(to_string(other)));
            }
        }
        keep_rotations_with_unit(quantity);
        quantity_ = quantity;
    }

    /// Rotations are in no unit that could be guessed: beside translations they are left out, alone or chosen they are refused.
    void keep_rotations_with_unit(SampleQuantity quantity) {
        const auto is_unclear = [&](const CandidateColumn& c) {
            const bool is_asked = asked_unit_ && records::is_rotation(asked_unit_->quantity);
            return !c.unit && !is_asked && (c.is_rotation() || records::is_rotation(quantity));
        };
        const auto unclear = std::find_if(candidates_.begin(), candidates_.end(), is_unclear);
        if (unclear == candidates_.end()) return;
        if (options_->columns || records::is_rotation(quantity)) {
            fail(fmt::format("{} is a rotation that names no unit (rad, deg, rad/s, deg/s, rad/s^2, ...)", place(*unclear)),
                 {"write it into the title, give ", Setting::unit, " or choose others with ", Setting::columns});
        }
        drop(is_unclear, "a rotation that names no unit");
    }

    /// Leaves out the length of a vector whose components stand beside it: it is never negative, they are.
    void drop_magnitudes() {
        if (options_->columns) return;
        const auto is_negative_somewhere = [&](const CandidateColumn& c) {
            for (std::size_t row = 0; row < table_->rows.size(); ++row)
                if (table_->at(row, c.column) < 0.0) return true;
            return false;
        };
        const auto is_magnitude = [&](const CandidateColumn& c) { return c.title.is_magnitude && !is_negative_somewhere(c); };
        const auto is_signed = [&](const CandidateColumn& c) { return !c.title.is_magnitude && is_negative_somewhere(c); };
        const bool has_magnitude =
            std::any_of(candidates_.begin(), candidates_.end(), [](const CandidateColumn& c) { return c.title.is_magnitude; });
        if (has_magnitude && std::any_of(candidates_.begin(), candidates_.end(), is_signed)) drop(is_magnitude, "the length of a vector");
    }

    SampleUnit unit_of(const CandidateColumn& candidate) {
        if (asked_unit_ && (!candidate.unit || candidate.unit->quantity == asked_unit_->quantity)) {
            if (candidate.unit && candidate.unit->si != asked_unit_->si) {
                chosen_.notes.push_back(fmt::format("{} is read in {} as asked for (its title names {})", place(candidate),
                                                    asked_unit_->name, candidate.unit->name));
            }
            return *asked_unit_;
        }
        if (candidate.unit) return *candidate.unit;
        chosen_.is_unit_given = false;
        return *find_sample_unit(si_unit_name(quantity_));
    }

    const TextFile* file_;
    const TextTable* table_;
    const TextHeading* heading_;
    const ReadOptions* options_;
    std::vector<CandidateColumn> candidates_;
    std::optional<SampleUnit> asked_unit_;
    SampleQuantity quantity_ = SampleQuantity::acceleration;
    ChosenSamples chosen_;
};

}  // namespace

ChosenSamples choose_samples(const TextFile& file, const TextTable& table, const TextHeading& heading, const TextLayout& layout,
                             const ReadOptions& options) {
    return SampleChooser(file, table, heading, layout, options).choose();
}

}  // namespace musim::records::detail
