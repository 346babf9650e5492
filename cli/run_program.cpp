#include "cli/run_program.hpp"

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "cli/app.hpp"
#include "cli/commands.hpp"
#include "cli/option_name.hpp"
#include "cli/output.hpp"
#include "cli/usage.hpp"
#include "scaling/shorten.hpp"

namespace musim::cli {
namespace {

/// Every error is one line on stderr.
int report_error(const std::string& message, int exit_code) {
    constexpr std::size_t kLongest = 1000;  // letters: whatever a message echoes, a line of it can be read
    std::fprintf(stderr, "musim: error: %s\n", scaling::make_line(scaling::shorten(message, kLongest)).c_str());
    return exit_code;
}

int carry_out(int argc, char** argv) {
    forget_notes();
    if (argc < 2) {
        note("{}", describe_program());
        return kUsageError;
    }
    CLI::App app;
    Action action;
    add_commands(app, action, argv[1]);

    try {
        refuse_empty_values(argc, argv);
        app.parse(argc, argv);
        const int exit_code = action();
        if (exit_code == kDone) print_notes();
        flush_output();
        return exit_code;
    } catch (const CLI::Success& help_or_version) {
        return app.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        return report_error(describe_usage_error(app, error), kUsageError);
    }
}

}  // namespace

int run_program(int argc, char** argv) {
    // a file above the limit of its size is an error of writing it
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        return carry_out(argc, argv);
    } catch (const std::bad_alloc&) {
        return report_error("not enough memory; try a shorter duration or lower output rates", kInputError);
    } catch (const std::runtime_error& error) {
        return report_error(word(error), kInputError);
    } catch (const std::invalid_argument& error) {
        return report_error(word(error), kInputError);
    } catch (const std::exception& error) {
        return report_error(std::string("internal: ") + error.what(), kInternalError);
    }
}

}  // namespace musim::cli
