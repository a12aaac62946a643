// SPDX-License-Identifier: MIT
// Ten carved parts of 128 to 512 cells, exported in four units and three formats and read back: by our own counts and
// by CGAL's, which reads the files itself. Minutes; without BURIN_SOAK_OPERATIONS, as in scripts/test, the first two.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "tests/app/carved_samples.hpp"
#include "tests/app/cgal_judge.hpp"
#include "tests/app/file_counts.hpp"

namespace burin::app {
namespace {

constexpr std::array kSoakUnits{"m", "cm", "mm", "in"};
constexpr std::array kSoakEndings{".stl", ".ply", ".obj"};

// Calls check(file, ending, report) for each exported file of the parts.
template <typename Check>
void for_each_exported_file(const Workplace& place, Check&& check) {
    write_meshes_of_samples(place);
    std::vector<CarvedSample> samples = carved_samples();
    if (std::getenv("BURIN_SOAK_OPERATIONS") == nullptr) samples.resize(2);
    for (const CarvedSample& sample : samples) {
        for (const std::string unit : kSoakUnits) {
            const auto outcome = carve_sample(place, sample, unit);
            ASSERT_EQ(outcome.status, 0) << outcome.output;
            const Json report = Json::parse(place.read(sample.name + "-" + unit + ".json"));
            for (const char* ending : kSoakEndings) {
                const std::filesystem::path file = place / (sample.name + "-" + unit + ending);
                check(file, report);
                std::filesystem::remove(file);
            }
        }
    }
}

}  // namespace

TEST(ExportedFilesSoak, HaveWhatTheReportSays) {
    const Workplace place;
    for_each_exported_file(place, [](const std::filesystem::path& file, const Json& report) {
        const Json counts = counts_of_file(file);
        EXPECT_EQ(counts, counts_of_report(report)) << file;
        EXPECT_EQ(counts["open_edges"], 0) << file;
        EXPECT_EQ(counts["nonmanifold_edges"], 0) << file;
        EXPECT_EQ(counts["misoriented_edges"], 0) << file;
    });
}

TEST(ExportedFilesSoak, AreJudgedByCgalAsTheReportSays) {
    if (!judge_by_cgal("")) GTEST_SKIP() << "CGAL is not installed: scripts/setup --peers installs it";
    const Workplace place;
    for_each_exported_file(place, [](const std::filesystem::path& file, const Json& report) {
        const auto verdict = judge_by_cgal(file.string());
        ASSERT_TRUE(verdict && verdict->is_read) << file;
        EXPECT_TRUE(verdict->is_manifold) << file;
        EXPECT_TRUE(verdict->is_closed) << file;
        EXPECT_EQ(verdict->crossing_pairs, report["mesh"]["self_intersections"]["left"].get<std::uint64_t>()) << file;
    });
}

}  // namespace burin::app
