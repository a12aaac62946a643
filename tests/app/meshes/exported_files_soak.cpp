// SPDX-License-Identifier: MIT
// Ten carved parts of 128 to 512 cells, exported in four units and three formats and read back: by our own counts and
// by CGAL's, which reads the files itself. Half an hour; without BURIN_SOAK_OPERATIONS, as in scripts/test, one part.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "tests/app/meshes/carved_samples.hpp"
#include "tests/app/meshes/cgal_judge.hpp"
#include "tests/app/meshes/file_counts.hpp"

namespace burin::app {
namespace {

constexpr std::array kSoakUnits{"m", "cm", "mm", "in"};
constexpr std::array kSoakEndings{".stl", ".ply", ".obj"};

void expect_as_reported(const std::filesystem::path& file, const Json& report) {
    const Json counts = counts_of_file(file);
    EXPECT_EQ(counts, counts_of_report(report)) << file;
    EXPECT_EQ(counts["open_edges"], 0) << file;
    EXPECT_EQ(counts["nonmanifold_edges"], 0) << file;
    EXPECT_EQ(counts["misoriented_edges"], 0) << file;
    const auto verdict = judge_by_cgal(file.string());
    if (!verdict) return;
    EXPECT_TRUE(verdict->is_read && verdict->is_manifold && verdict->is_closed) << file;
    EXPECT_EQ(verdict->crossing_pairs, report["mesh"]["self_intersections"]["left"].get<std::uint64_t>()) << file;
}

}  // namespace

TEST(ExportedFilesSoak, HaveWhatTheReportSaysAndCgalAgrees) {
    const Workplace place;
    write_meshes_of_samples(place);
    std::vector<CarvedSample> samples = carved_samples();
    if (std::getenv("BURIN_SOAK_OPERATIONS") == nullptr) samples.resize(1);
    for (const CarvedSample& sample : samples) {
        for (const std::string unit : kSoakUnits) {
            const auto outcome = carve_sample(place, sample, unit);
            ASSERT_EQ(outcome.status, 0) << outcome.output;
            const Json report = Json::parse(place.read(sample.name + "-" + unit + ".json"));
            for (const char* ending : kSoakEndings) {
                const std::filesystem::path file = place / (sample.name + "-" + unit + ending);
                expect_as_reported(file, report);
                std::filesystem::remove(file);
            }
        }
    }
    if (!judge_by_cgal(""))
        GTEST_SKIP() << "CGAL is not installed, and judged nothing: scripts/setup --peers installs it";
}

}  // namespace burin::app
