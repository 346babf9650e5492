#include "lsdem/study/ensemble.hpp"

#include <algorithm>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/interruption.hpp"
#include "cli/lsdem/specimen_batch.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/progress_line.hpp"
#include "cli/report.hpp"
#include "cli/result_options.hpp"
#include "cli/version.hpp"
#include "cli/whole_option.hpp"
#include "lsdem/run/run.hpp"
#include "lsdem/scene/scene_json.hpp"
#include "lsdem/study/compare_ensembles.hpp"
#include "lsdem/study/ensemble_files.hpp"
#include "lsdem/study/ensemble_members.hpp"

namespace musim::cli {
namespace {

using lsdem::MemberStatus;

struct EnsembleOptions : ResultOptions {
    std::string scene;
    std::vector<std::string> compare;
    int members = 10;
    int only = 0;  ///< from 1; 0: all
    bool list = false;
    std::string specimens;
    std::string axis;

    std::optional<int> axis_index() const {
        if (axis.empty()) return std::nullopt;
        return static_cast<int>(std::string("xyz").find(axis));
    }
};

/// Is it wrong with a member, and how does the program end then?
int exit_code_of(MemberStatus status) {
    if (status == MemberStatus::failed) return kInputError;
    return status == MemberStatus::diverged || status == MemberStatus::unsettled ? kNumericalFailure : kDone;
}

/// One line on stderr for every member that is no result; the exit code: a numerical failure goes before a failed job.
int report_members(const EnsembleOptions& options, const std::vector<lsdem::MemberResult>& members) {
    int exit_code = kDone;
    for (const lsdem::MemberResult& member : members) {
        const int own = exit_code_of(member.status);
        if (own == kDone) continue;
        note("musim: error: {}: {} (seed {}): {}\n", options.scene, member.name, member.seed, member.reason);
        exit_code = std::max(exit_code, own);
    }
    return exit_code;
}

std::string with_sd(const lsdem::SampleMoments& moments, Eigen::Index i, double unit = 1.0) {
    if (moments.count() == 0) return "-";
    if (moments.count() == 1) return fmt::format("{:.4g}", moments.mean()[i] / unit);
    return fmt::format("{:.4g} +- {:.2g}", moments.mean()[i] / unit, moments.sd()[i] / unit);
}

void print_summary(const lsdem::EnsembleSummary& summary, const std::vector<lsdem::MemberReport>& reports) {
    const auto before = std::count_if(reports.begin(), reports.end(), [](const lsdem::MemberReport& r) { return r.reused; });
    const auto resumed = std::count_if(reports.begin(), reports.end(), [](const lsdem::MemberReport& r) { return r.resumed; });
    print("{}: {} members ({} there before, {} resumed): {} completed, {} collapsed, {} diverged, {} unsettled, {} failed\n", summary.name,
          summary.members.size(), before, resumed, summary.count(MemberStatus::completed), summary.count(MemberStatus::collapsed),
          summary.count(MemberStatus::diverged), summary.count(MemberStatus::unsettled), summary.count(MemberStatus::failed));
    for (const lsdem::MemberResult& member : summary.members) {
        print("  {}  seed {:<6} {}", member.name, member.seed, lsdem::to_string(member.status));
        if (member.collapse_time && *member.collapse_time <= 0.0) {
            print(" while it was prepared");
        } else if (member.collapse_time) {
            print(" at {:.4g} s", *member.collapse_time);
        }
        print("\n");
    }
    if (summary.levels.empty()) return;
    const std::string axis = lsdem::axis_name(summary.axis);
    print("\n  mean +- standard deviation over the {} completed members, motion along {}\n", summary.count(MemberStatus::completed), axis);
    print("  {:>5} {:>24} {:>24} {:>24}\n", "level", "peak v [m/s]", "peak " + axis + " [mm]", "residual " + axis + " [mm]");
    for (auto level = summary.levels.rbegin(); level != summary.levels.rend(); ++level) {
        print("  {:>5} {:>24} {:>24} {:>24}\n", level->level, with_sd(level->peak_velocity, summary.axis),
              with_sd(level->peak_displacement, summary.axis, 1e-3), with_sd(level->residual_displacement, summary.axis, 1e-3));
    }
    for (const lsdem::SpeedMoments& speed : summary.speeds) {
        if (speed.speed.count() == 0) continue;
        print("  speed by {:<17} {} m/s, {} members\n", speed.method, with_sd(speed.speed, 0), speed.speed.count());
    }
    print("  damage index {}\n", with_sd(summary.damage, 0));
}

int list_members(const EnsembleOptions& options, const std::vector<lsdem::EnsembleMember>& members) {
    nlohmann::json list = nlohmann::json::array();
    for (std::size_t i = 0; i < members.size(); ++i) {
        const std::string state = lsdem::to_string(lsdem::find_state(options.out, members[i]));
        list.push_back({{"index", i + 1}, {"name", members[i].name}, {"seed", members[i].seed}, {"state", state}});
        if (!options.json) print("{:>4}  {}  seed {:<6} {}\n", i + 1, members[i].name, members[i].seed, state);
    }
    if (options.json) print_json({{"members", list}});
    return kDone;
}

std::vector<lsdem::MemberReport> carry_out(const EnsembleOptions& options, const std::vector<lsdem::EnsembleMember>& members,
                                           ProgressInParts& progress) {
    const lsdem::MemberSettings settings{.directory = options.out,
                                         .version = kVersion,
                                         .threads = options.threads,
                                         .checkpoint_interval = options.checkpoint_interval,
                                         .on_progress = progress.observer().on_progress,
                                         .on_no_checkpoint = note_no_checkpoint};
    return lsdem::run_members(members, settings);
}

/// Has the members use what is in the folder of specimens, and prepares there what is missing.
void take_specimens(const EnsembleOptions& options, std::vector<lsdem::EnsembleMember>& members, ProgressInParts& progress) {
    lsdem::SpecimenBatch batch = begin_batch(options.specimens, options.threads, options.checkpoint_interval);
    batch.on_progress = progress.observer().on_preparation;
    for (const lsdem::SpecimenReport& report : lsdem::use_specimens(members, std::move(batch))) warn_of_fallen(report);
}

/// One member alone; the summary of the ensemble is for whoever runs them all.
int run_one(const EnsembleOptions& options, const lsdem::EnsembleMember& member, ProgressInParts& progress) {
    const std::vector<lsdem::MemberReport> reports = carry_out(options, {member}, progress);
    const lsdem::EnsembleSummary summary = lsdem::summarize_ensemble(options.out, {member}, reports, options.axis_index());
    const lsdem::MemberResult& result = summary.members.front();
    if (options.json) {
        print_json(lsdem::to_json(result));
    } else if (reports.front().error.empty()) {
        print("{}: seed {}, {}{}\n", lsdem::member_folder(options.out, member).string(), member.seed, lsdem::to_string(result.status),
              reports.front().reused ? " before" : "");
    }
    return report_members(options, summary.members);
}

/// Every ensemble against the first.
int compare_ensembles(const EnsembleOptions& options) {
    const lsdem::DimensionlessBands first = lsdem::read_bands(options.compare.front());
    nlohmann::json list = nlohmann::json::array();
    for (auto directory = options.compare.begin() + 1; directory != options.compare.end(); ++directory) {
        const lsdem::BandOverlap overlap = lsdem::compare_bands(first, lsdem::read_bands(*directory));
        list.push_back(lsdem::to_json(overlap));
        list.back()["directory"] = *directory;
        if (options.json) continue;
        print("{} against {}: {} levels and times\n", *directory, first.name, overlap.points);
        print("  {:.1f} % of its means within mean +- sd, {:.1f} % within two standard errors\n", 100.0 * overlap.within_sd,
              100.0 * overlap.within_error);
    }
    if (options.json) print_json({{"reference", first.name}, {"compared", list}});
    return kDone;
}

int run_ensemble(const EnsembleOptions& options) {
    if (!options.compare.empty()) return compare_ensembles(options);
    const lsdem::Scene scene = read_scene(options.scene);
    std::vector<lsdem::EnsembleMember> members = lsdem::plan_ensemble(scene, options.members, kVersion);
    if (options.list) {
        if (!options.specimens.empty()) lsdem::use_prepared_specimens(members, options.specimens, kVersion);
        return list_members(options, members);
    }

    // what would be wrong with every member is one error, and found before any runs
    lsdem::make_upright_specimen(members.front().scene);
    std::optional<lsdem::ResultFolder> folder;
    if (options.only == 0) {
        lsdem::ResultOrigin origin = options.origin();
        origin.add(scene);
        if (!options.specimens.empty()) origin.parts["--specimens"] = "given";  // members' names say which
        folder.emplace(options.out, std::move(origin), options.choice());
    }
    note_cut_motions(options.scene, scene);
    if (options.only > 0) members = {members[static_cast<std::size_t>(options.only - 1)]};
    std::vector<lsdem::MemberReport> reports;
    {
        ProgressInParts progress(scene.name);
        if (!options.specimens.empty()) take_specimens(options, members, progress);
        if (options.only > 0) return run_one(options, members.front(), progress);
        reports = carry_out(options, members, progress);
    }
    const lsdem::EnsembleSummary summary = lsdem::summarize_ensemble(options.out, members, reports, options.axis_index());
    lsdem::add_ensemble(*folder, summary, kVersion);
    folder->commit();
    if (options.json) {
        print_json(lsdem::to_json(summary, kVersion));
    } else {
        print_summary(summary, reports);
        print("Summary and members in {}\n", options.out);
    }
    return report_members(options, summary.members);
}

}  // namespace

void add_ensemble_command(CLI::App& app, Action& action) {
    auto options = std::make_shared<EnsembleOptions>();
    CLI::App* command = app.add_subcommand("ensemble", "A scene with several seeds of its block heights and scatter: mean and scatter");
    CLI::Option* scene_file = command->add_option("scene", options->scene, "Scene file with a height_deviation or a scatter");
    scene_file->type_name("SCENE.json");
    CLI::Option* out = options->add_out(*command, "Directory for the members and ensemble.json, .h5, .csv, .svg");
    CLI::Option* compare =
        command->add_option("--compare", options->compare, "Compare ensembles with the first of them, of any scales; run nothing");
    compare->type_name("DIR DIR...")->expected(2, 1000)->excludes(scene_file)->excludes(out);
    add_whole_option(*command, "--members", options->members, "How many seeds, from the scene's on", {1, 100000})->capture_default_str();
    command
        ->add_option("--specimens", options->specimens,
                     "Folder of specimens as musim specimen makes them: members use what is there, what is missing is prepared there")
        ->type_name("DIR")
        ->excludes(compare);
    CLI::Option* list = command->add_flag("--list", options->list, "Name the members and how far they are; run nothing");
    add_whole_option(*command, "--only", options->only, "Run this member alone (1 to N), without a summary: a job of a cluster", {1})
        ->type_name("INDEX")
        ->excludes(list);
    command->add_option("--axis", options->axis, "Axis of the main motion (default: along which the base moves most)")
        ->check(one_of({"x", "y", "z"}));
    options->add_with_checkpoints_to(*command);
    command->footer(
        "Examples:\n"
        "  musim ensemble examples/uneven_wall.json -o out/walls --members 10\n"
        "  musim ensemble examples/uneven_wall.json -o out/walls --list\n"
        "  musim ensemble examples/uneven_wall.json -o out/harder --specimens out/specimens\n"
        "  musim ensemble examples/uneven_wall.json -o out/walls --only 3 --threads 1 --json\n"
        "  musim ensemble --compare out/walls out/walls_107\n"
        "Members run side by side, one thread each, into DIR/members/NAME, as `musim run` writes there. The same command again runs what "
        "is\n"
        "missing, continues what was killed, and sums up: to the same bytes. Names follow from content (scene, record, specimen, program\n"
        "version).\n"
        "Results of another scene, version or way of laying specimens in DIR are not overwritten without --force (exit code 3); more\n"
        "members may be added. --list and --only want the same --specimens.\n"
        "Diverged and unsettled members, and those without results, are reported and left out of all means; collapsed ones count until\n"
        "they collapse. Exit code 4: a member diverged or did not come to rest; 3: a member could not be run.");
    command->callback([&action, options] {
        if (options->compare.empty() && options->scene.empty()) throw CLI::RequiredError("scene (or --compare)");
        if (options->compare.empty() && options->out.empty()) throw CLI::RequiredError("--out");
        if (options->only > options->members) {
            throw CLI::ValidationError("--only", fmt::format("there is no member {} of {}", options->only, options->members));
        }
        action = [options] { return run_again([&] { return run_ensemble(*options); }, options->out); };
    });
}

}  // namespace musim::cli
