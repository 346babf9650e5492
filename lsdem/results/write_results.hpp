#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lsdem/results/folder_contents.hpp"
#include "lsdem/results/history.hpp"
#include "lsdem/results/staged_files.hpp"

namespace musim::lsdem {

/// Texts that a result file holds besides the numbers of its run.
struct ResultHeader {
    std::string scene;  ///< the scene as JSON text
    std::string program_version;
};

/// Treatment of results that are in a directory already.
enum class Overwriting {
    refuse,  ///< those of another origin stay, and nothing is done; those of the same one are replaced
    force,   ///< they are replaced, whatever they are of
    resume   ///< what is there is the beginning of these
};

/// A directory of results that appear all together or not at all: nothing is left half-written when the disk is full.
class ResultFolder {
  public:
    /// Makes the directory and keeps it to this process. Throws records::WriteError, so that an unusable one, or one that another musim is
    /// working in, is met before the run and not after.
    explicit ResultFolder(const std::filesystem::path& directory) : files_(directory) {}

    /// The same for results that say what they are made from (contents.json). While commit() replaces files, contents.json says that they
    /// are not complete. Files of older results that are not among the new ones go with the first commit(). Throws ResultError for results
    /// that are not to be overwritten.
    ResultFolder(const std::filesystem::path& directory, ResultOrigin origin, Overwriting overwriting);

    /// Says what the results are made from, as that constructor, where it is read from the directory once this process has it. Throws
    /// ResultError as there.
    void set_origin(ResultOrigin origin, Overwriting overwriting);

    /// Adds to `subfolder` (may be empty): result.h5 (HDF5, layout in docs/user/file_formats.md), result.xdmf (opens it in ParaView),
    /// spine.csv and summary.json. Throws records::WriteError.
    void add_run(const std::filesystem::path& subfolder, const RunResult& run, const ResultHeader& header);

    /// Adds a text file, such as a picture. Throws records::WriteError.
    void add_text(const std::filesystem::path& name, const std::string& text) { files_.write(name, text); }

    /// Adds a JSON object that is read back, see make_checked_json(). Throws records::WriteError.
    void add_json(const std::filesystem::path& name, const nlohmann::json& object);

    /// Lets everything appear, replacing older results; more may be added after that. Throws records::WriteError.
    void commit();

  private:
    detail::StagedFiles files_;
    std::optional<FolderContents> contents_;  ///< of what is there and belongs to these results
    std::vector<std::string> older_;          ///< files of results that these replace
};

}  // namespace musim::lsdem
