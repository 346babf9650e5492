#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/options.hpp"
#include "lsdem/scene/scene.hpp"
#include "records/formats/read_record.hpp"
#include "records/processing/processing.hpp"

namespace musim::cli {

/// Adds --at-rest: yes, displaced or no, as "at_rest": true, "displaced" or false in a scene.
CLI::Option* add_at_rest_option(CLI::App& command, std::string& at_rest);

/// The value of that option.
records::AtRest find_at_rest(const std::string& at_rest);

/// Missing parts of plain text files, as options --dt, --unit, --columns, --skip.
struct TextRecordOptions {
    std::optional<Number> dt;  ///< [s]
    std::optional<std::string> unit;
    std::optional<std::string> columns;  ///< "time=2,x=3"
    std::optional<int> skip;             ///< lines

    /// Adds the options, each of which needs `file` where that is an option.
    void add_to(CLI::App& command, CLI::Option* file = nullptr);

    records::ReadOptions read_options() const;
};

/// Missing parts of record files: the options of text files, --quantity, --sensitivity, --station-xml.
struct RecordSourceOptions {
    TextRecordOptions text;
    std::optional<std::string> quantity;
    std::optional<Number> sensitivity;
    std::string station_xml;

    /// Adds the options, each of which needs `file` where that is an option.
    void add_to(CLI::App& command, CLI::Option* file = nullptr);

    records::ReadOptions read_options() const;

    /// The files that loading `sources` reads: those that are not the built-in record, and the StationXML file if one is named.
    std::vector<std::string> find_files(std::vector<std::string> sources) const;

    /// Reads a record file, or makes the built-in record when `source` is "synthetic". Throws records::ReadError.
    records::GroundMotion load(const std::string& source) const;

    /// The same for a record that a file names, from the folder of that file.
    records::GroundMotion load_beside(const std::string& naming_file, const std::string& source) const;
};

/// A record that shakes a scene, as options --record, --component, --at-rest, and those of record files.
struct RecordMotionOptions {
    std::string record;                   ///< file; empty: the scene's own motion stays
    std::vector<std::string> components;  ///< "x=360"
    RecordSourceOptions source;
    std::string at_rest = "yes";  ///< see add_at_rest_option()

    /// Adds the options; `help` says what becomes of the record.
    void add_to(CLI::App& command, const std::string& help);

    /// Lets the record's strong motion shake the scene (lsdem::use_record), and says on stderr what was done. Throws CLI::ValidationError
    /// for a component that is not AXIS=NAME, and as lsdem::use_record.
    void apply(lsdem::Scene& scene) const;
};

/// Description of a positional record argument in help texts.
inline constexpr const char* kRecordArgument =
    "Record file of any format in docs/user/record_formats.md (PEER, CSMIP, COSMOS, SMC, K-NET, JMA, ESM, SAC, miniSEED, DEEPSOIL, text, "
    "...), also in a .gz or .zip file, or `synthetic` for the built-in one";

}  // namespace musim::cli
