#include <doctest/doctest.h>

#include <functional>
#include <vector>

#include "lsdem/results/hdf5_file.hpp"
#include "lsdem/results/hdf5_reader.hpp"
#include "scaling/side_by_side.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace musim::lsdem;

// the HDF5 library of Debian is not built for threads; without a lock this reads damaged numbers or ends the program
TEST_CASE("files of results are written and read side by side") {
    const musim::tests::TemporaryFolder place;
    std::vector<int> right(8, 0);
    std::vector<std::function<void()>> jobs;
    for (std::size_t job = 0; job < right.size(); ++job) {
        jobs.emplace_back([&, job] {
            const std::string name = std::to_string(job) + ".h5";
            const std::vector<double> values(500, static_cast<double>(job));
            for (int i = 0; i < 20; ++i) {
                std::vector<char> bytes;
                {
                    detail::Hdf5File file;
                    file.exchange("/a/b", {values.size()}, values, "m");
                    bytes = file.image();
                }
                const auto path = place.write(name, {bytes.data(), bytes.size()});
                const detail::Hdf5Reader reader(path);
                right[job] += reader.read<double>("/a/b", 1).values == values ? 1 : 0;
            }
        });
    }
    musim::scaling::run_side_by_side(jobs, 4);
    for (const int count : right) CHECK(count == 20);
}
