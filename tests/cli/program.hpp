#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace musim::cli {

inline std::string read_all(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// What the program left behind.
struct Outcome {
    int exit_code = -1;
    std::string out;
    std::string err;

    nlohmann::json json() const { return nlohmann::json::parse(out); }

    /// Exactly one line on stderr, `musim: error: ...`.
    bool has_one_error_line() const { return err.starts_with("musim: error: ") && err.find('\n') == err.size() - 1; }
};

/// A directory of its own for each test, removed at its end; the program runs in it.
class Workplace {
  public:
    Workplace() {
        std::string pattern = (std::filesystem::temp_directory_path() / "musim-cli-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~Workplace() { std::filesystem::remove_all(path_); }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;

    /// Runs `musim ARGUMENTS`; `shell` comes first on the same command line, e.g. a limit.
    Outcome run(const std::string& arguments, const std::string& shell = "") const {
        const std::filesystem::path out = path_ / ".stdout";
        const std::filesystem::path err = path_ / ".stderr";
        const std::string command = "cd '" + path_.string() + "' && { " + shell + " " + MUSIM_PROGRAM + " " + arguments + "; } >'" +
                                    out.string() + "' 2>'" + err.string() + "'";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_all(out), read_all(err)};
    }

    /// Runs commands of the shell.
    void shell(const std::string& commands) const {
        const std::string command = "cd '" + path_.string() + "' && { " + commands + "; }";
        if (std::system(command.c_str()) == -1) throw std::runtime_error("there is no shell");
    }

    void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }
    bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }
    std::string read(const std::string& name) const { return read_all(path_ / name); }

    /// How many files and folders there are, but for what run() leaves; in a folder of it, all.
    long count(const std::string& folder = ".") const {
        long n = 0;
        for (const auto& entry : std::filesystem::directory_iterator(path_ / folder))
            n += entry.path().filename().string().starts_with(".std") ? 0 : 1;
        return n;
    }

  private:
    std::filesystem::path path_;
};

/// Stands in for a full disk: no file may grow beyond 4 KiB.
inline constexpr const char* kFullDisk = "trap '' XFSZ; ulimit -f 4;";

}  // namespace musim::cli
