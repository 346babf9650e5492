#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "cli/app.hpp"
#include "cli/manual/command_text.hpp"
#include "cli/version.hpp"
#include "records/atomic_file.hpp"

namespace fs = std::filesystem;

namespace musim::cli {
namespace {

void write_pages(const fs::path& folder, const CommandText& command, const CommandText& root) {
    records::write_file_atomically(folder / (command.name("-") + ".1"), make_man_page(command, root, kVersion));
    for (const CommandText& each : command.commands) write_pages(folder, each, root);
}

/// Writes man pages to FOLDER/man1, completion to FOLDER/bash and FOLDER/zsh, by the names under which they are installed.
void write_manual(const fs::path& folder) {
    CLI::App app;
    Action action;
    add_commands(app, action);
    const CommandText root = describe_command(app);
    for (const char* each : {"man1", "bash", "zsh"}) fs::create_directories(folder / each);
    write_pages(folder / "man1", root, root);
    records::write_file_atomically(folder / "bash" / "musim", make_bash_completion(root));
    records::write_file_atomically(folder / "zsh" / "_musim", make_zsh_completion(root));
}

}  // namespace
}  // namespace musim::cli

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: musim_manual FOLDER\n", stderr);
        return musim::cli::kUsageError;
    }
    try {
        musim::cli::write_manual(argv[1]);
        return musim::cli::kDone;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "musim_manual: %s: %s\n", argv[1], error.what());
        return musim::cli::kInputError;
    }
}
