#include "lsdem/report/report.hpp"

#include <doctest/doctest.h>

#include "lsdem/report/report_content.hpp"

using namespace musim::lsdem;

namespace {

ReportContent make_content(ReportKind kind, const char* summary) {
    ReportContent content;
    content.kind = kind;
    content.summary = nlohmann::json::parse(summary);
    return content;
}

Statement only_headline(const ReportContent& content) {
    const std::vector<Statement> headlines = make_headlines(content);
    REQUIRE(headlines.size() == 1);
    return headlines.front();
}

ReportedRun make_run(const char* label, RunStatus status, const char* outcome) {
    ReportedRun run;
    run.label = label;
    run.run.status = status;
    run.summary = nlohmann::json::parse(outcome);
    return run;
}

}  // namespace

TEST_CASE("a run's headline says whether the structure stands and how far its top went") {
    ReportContent content = make_content(ReportKind::run, "{}");
    content.runs.push_back(make_run("one", RunStatus::completed,
                                    R"({"outcome": {"blocks": 8, "fallen": 0, "top": {"peak_displacement_m": 0.00734,
                                        "residual_displacement_m": 0.00433}}})"));
    const Statement stands = only_headline(content);
    CHECK(stands.tone == Tone::good);
    CHECK(stands.text ==
          "The structure stands: 0 of 8 blocks fell; largest displacement of the top relative to the base 7.34 mm, residual 4.33 mm.");

    content.runs.front().summary["outcome"]["fallen"] = 2;
    CHECK(only_headline(content).tone == Tone::warning);

    content.runs.front().run.status = RunStatus::collapsed;
    content.runs.front().run.collapse_time = 0.43;
    CHECK(only_headline(content).text == "The structure collapsed at 0.43 s: 2 of 8 blocks fell.");

    content.runs.front().run.status = RunStatus::diverged;
    content.runs.front().run.divergence = "block 3 is nowhere";
    const Statement diverged = only_headline(content);
    CHECK(diverged.tone == Tone::bad);
    CHECK(diverged.text.find("block 3 is nowhere") != std::string::npos);
}

TEST_CASE("the headline of several runs names those that do not stand") {
    ReportContent content = make_content(ReportKind::runs, "{}");
    content.runs.push_back(make_run("one", RunStatus::completed, "{}"));
    content.runs.push_back(make_run("two", RunStatus::collapsed, "{}"));
    CHECK(only_headline(content).text == "1 of 2 structures stand; two collapsed.");
    CHECK(only_headline(content).tone == Tone::warning);
    content.runs.push_back(make_run("three", RunStatus::diverged, "{}"));
    CHECK(only_headline(content).text == "1 of 3 structures stand; two collapsed, three diverged.");
    CHECK(only_headline(content).tone == Tone::bad);
}

TEST_CASE("a pair's headline is its agreement and until when it is proved") {
    const Statement headline =
        only_headline(make_content(ReportKind::pair, R"({"agreement": "differ", "verdict": ["They differ.", "By 3 %.", "More."]})"));
    CHECK(headline.tone == Tone::bad);
    CHECK(headline.text == "They differ. By 3 %.");
    CHECK(make_headlines(make_content(ReportKind::pair, "{}")).empty());
}

TEST_CASE("a sequence's headline is its collapse and not how its first stages ended") {
    const Statement collapsed = only_headline(make_content(
        ReportKind::sequence, R"({"motions": 6, "status": "collapsed", "collapse": {"stage": 2, "name": "aftershock", "time_s": 0.43},
            "stages": [{"status": "completed"}, {"status": "collapsed", "fallen_blocks": 20, "since_first_start": {"damage_index": 0.635}}]})"));
    CHECK(collapsed.tone == Tone::warning);
    CHECK(
        collapsed.text ==
        "The structure collapsed in motion 2 of 6 (aftershock), 0.43 s after its start: 20 blocks fell; damage index 0.635 since the first "
        "start.");
    const Statement stands =
        only_headline(make_content(ReportKind::sequence, R"({"motions": 2, "status": "completed", "collapse": null, "stages": [{}, {}]})"));
    CHECK(stands.tone == Tone::good);
    CHECK(stands.text == "The structure stands after 2 of 2 motions.");
    CHECK(only_headline(make_content(ReportKind::sequence, "{}")).tone == Tone::bad);
}

TEST_CASE("an ensemble's headline counts its members by how they ended") {
    ReportContent content = make_content(ReportKind::ensemble, "{}");
    content.ensembles.push_back(
        {.label = "wall",
         .folder = {},
         .summary = nlohmann::json::parse(R"({"members": [{"status": "completed"}, {"status": "collapsed"}, {"status": "diverged"}, {}],
             "damage_index": {"mean": 0.25, "sd": 0.12}})"),
         .bands = {}});
    const Statement headline = only_headline(content);
    CHECK(headline.tone == Tone::bad);
    CHECK(headline.text == "wall: 1 of 4 members stand, 1 collapsed, 2 without a result; damage index 0.25 ± 0.12 (standard deviation).");
}
