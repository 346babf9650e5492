#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>

#include "lsdem/results/checked_json.hpp"
#include "lsdem/results/folder_contents.hpp"
#include "lsdem/results/read_results.hpp"
#include "lsdem/results/write_results.hpp"
#include "tests/study/made_run.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;
using musim::tests::bytes_of;
using musim::tests::message_of;
using musim::tests::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// Renames that are still carried out; the process ends in place of the next one. Negative: all are.
int renames_left = -1;

}  // namespace

/// Takes the place of the C library's in this program.
extern "C" int rename(const char* from, const char* to) noexcept {
    if (renames_left == 0) _exit(1);
    if (renames_left > 0) --renames_left;
    return renameat(AT_FDCWD, from, AT_FDCWD, to);
}

namespace {

ResultOrigin make_origin(const std::string& scene) {
    return {.command = "run", .program_version = "9.9.9", .parts = {{"material", scene}}};
}

/// Two runs and a picture, the second in a folder named by the scene, all as long as `samples`.
void write_folder(const fs::path& directory, const std::string& scene, std::size_t samples, Overwriting overwriting) {
    ResultFolder folder(directory, make_origin(scene), overwriting);
    const ResultHeader header{.scene = "{}", .program_version = "9.9.9"};
    folder.add_run("", make_made_run(samples), header);
    folder.add_run("model-" + scene, make_made_run(samples), header);
    folder.add_text("picture.svg", scene);
    folder.commit();
}

std::map<std::string, std::string> read_files(const fs::path& directory) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(directory)) {
        const std::string name = fs::relative(entry.path(), directory).string();
        if (entry.is_regular_file() && name.front() != '.') files[name] = bytes_of(entry.path());
    }
    return files;
}

/// With hidden ones.
auto count_entries(const fs::path& directory) {
    return std::distance(fs::recursive_directory_iterator(directory), fs::recursive_directory_iterator());
}

/// Replaces results of "old" by those of "new" in a process that ends before its rename number `count`; whether it ended there.
bool stop_at_rename(int count, const fs::path& directory, const std::string& scene, std::size_t samples) {
    const pid_t child = fork();
    if (child == 0) {
        renames_left = count;
        write_folder(directory, scene, samples, Overwriting::force);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WEXITSTATUS(status) != 0;
}

/// Stops the replacing at each of its renames; what is then read is old, new, or refused, and the same command ends as if nothing had been.
void check_each_rename(const std::string& scene, std::size_t samples) {
    const TemporaryFolder expected;
    write_folder(expected.path() / "old", "old", 20, Overwriting::refuse);
    write_folder(expected.path() / "new", scene, samples, Overwriting::refuse);
    const auto old_files = read_files(expected.path() / "old"), new_files = read_files(expected.path() / "new");
    int refused = 0;
    for (int count = 0;; ++count) {
        const TemporaryFolder place;
        const fs::path out = place.path() / "out";
        write_folder(out, "old", 20, Overwriting::refuse);
        if (!stop_at_rename(count, out, scene, samples)) break;
        std::string why;
        try {
            read_run(out);
            const auto files = read_files(out);
            CHECK_MESSAGE((files == old_files || files == new_files), "rename ", count);
        } catch (const ResultError& error) {
            why = error.what();
            ++refused;
            CHECK_MESSAGE(why.ends_with("give the command `musim run` again that made them"), why);
        }
        // once files have been replaced the folder is that of the command that replaced them
        write_folder(out, scene, samples, why.empty() ? Overwriting::force : Overwriting::refuse);
        CHECK_MESSAGE(read_files(out) == new_files, "rename ", count);
        CHECK_FALSE(fs::exists(out / ".unfinished"));
        CHECK(count_entries(out) == count_entries(expected.path() / "new"));
        CHECK_NOTHROW(read_run(out));
    }
    // result.h5, result.xdmf, spine.csv and summary.json of two runs, the picture
    CHECK(refused >= 9);
}

}  // namespace

TEST_CASE("results that are being replaced by those of another scene are old or new or refused wherever the program is killed") {
    check_each_rename("new", 30);
}

TEST_CASE("results that are being replaced by those of the same scene are old or new or refused wherever the program is killed") {
    check_each_rename("old", 20);
}

TEST_CASE("results of another scene or version or command are not replaced unasked") {
    const TemporaryFolder place;
    const fs::path contents = place.path() / kContentsName;
    write_folder(place.path(), "old", 20, Overwriting::refuse);
    const auto before = read_files(place.path());
    const auto refusal = [&](const ResultOrigin& origin) {
        return message_of<ResultError>([&] { ResultFolder(place.path(), origin, Overwriting::refuse); });
    };
    const std::string remedy = "; choose another directory, or take leave to replace them";
    CHECK(refusal(make_origin("old")).empty());
    CHECK(refusal(make_origin("new")) ==
          contents.string() + ": here are results of another scene or other settings (these differ: material)" + remedy);
    ResultOrigin other = make_origin("old");
    other.program_version = "10.0.0";
    CHECK(refusal(other) == contents.string() + ": here are results of musim 9.9.9, this is 10.0.0" + remedy);
    other = make_origin("old");
    other.command = "pair";
    CHECK(refusal(other) == contents.string() + ": here are results of `musim run`" + remedy);
    other = make_origin("old");
    other.parts["--twins"] = "3";
    CHECK(refusal(other).find("these differ: --twins") != std::string::npos);
    CHECK(read_files(place.path()) == before);

    // without its list, and with a damaged one
    fs::remove(contents);
    CHECK(refusal(make_origin("old")) ==
          (place.path() / "result.h5").string() + ": it is not known what these results were made from" + remedy);
    place.write(kContentsName, "{");
    CHECK(refusal(make_origin("old")).starts_with(contents.string() + ": is damaged"));
    CHECK_THROWS_AS(read_run(place.path()), ResultError);
    write_folder(place.path(), "new", 30, Overwriting::force);
    CHECK(read_run(place.path()).history.samples() == 30);
}
