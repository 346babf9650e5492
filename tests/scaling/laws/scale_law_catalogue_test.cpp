#include "scaling/laws/scale_law_catalogue.hpp"

#include <doctest/doctest.h>

#include <functional>

#include "scaling/laws/scale_law_json.hpp"
#include "scaling/side_by_side.hpp"

namespace musim::scaling {

// each is read when it is asked for first, a law that another extends in between; ThreadSanitizer sees who writes what
TEST_CASE("threads that ask for the same laws at once find the same laws") {
    const std::vector<std::string>& names = scale_law_names();
    std::vector<std::vector<ScaleLaw>> found(4);
    std::vector<std::function<void()>> jobs;
    jobs.reserve(found.size());
    for (std::vector<ScaleLaw>& laws : found) {
        jobs.emplace_back([&] {
            for (const std::string& name : names) laws.push_back(find_scale_law(name).value());
        });
    }
    run_side_by_side(jobs, static_cast<int>(jobs.size()));
    for (const std::vector<ScaleLaw>& laws : found) {
        REQUIRE(laws.size() == names.size());
        for (std::size_t i = 0; i < names.size(); ++i) {
            CHECK(laws[i].name == names[i]);
            CHECK(write_scale_law(laws[i]) == write_scale_law(found.front()[i]));
        }
    }
    CHECK_FALSE(find_scale_law("no such law"));
}

}  // namespace musim::scaling
