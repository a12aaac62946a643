// SPDX-License-Identifier: MIT
// A mesh file has what its report says, in every unit and format: scaling and rounding come before the repair.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "tests/app/meshes/carved_samples.hpp"
#include "tests/app/meshes/file_counts.hpp"
#include "tests/support/places.hpp"

namespace burin::app {
namespace {

constexpr std::array kFileUnits{"m", "cm", "mm", "in"};
constexpr std::array kFileEndings{".stl", ".ply", ".obj"};

const std::string kFilesBurin = kBurinCommand;

// A double cone whose two halves have rims of their own, one a step or two of a float below the other: closed, and
// clean as doubles.
std::string crowded_obj() {
    std::string text = "# units m\nv 0 0 0.5\n", faces;
    constexpr int kAround = 200;
    for (int i = 0; i < kAround; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kAround;
        for (const double height : {0.25 + 4e-8, 0.25})
            text += formatted("v %.17g %.17g %.17g\n", 0.1 * std::cos(angle), 0.1 * std::sin(angle), height);
    }
    text += "v 0 0 0\n";
    for (int i = 0; i < kAround; ++i) {
        const int upper = 2 + 2 * i, lower = upper + 1, next_upper = 2 + 2 * ((i + 1) % kAround),
                  next_lower = next_upper + 1;
        faces += formatted("f 1 %d %d\nf %d %d %d\nf %d %d %d\nf %d %d %d\n", upper, next_upper, upper, lower,
                           next_lower, upper, next_lower, next_upper, lower, 2 + 2 * kAround, next_lower);
    }
    return text + faces;
}

}  // namespace

TEST(ExportedFiles, HaveWhatTheReportSaysInEveryUnitAndFormat) {
    const Workplace place;
    write_meshes_of_samples(place);
    const std::vector<CarvedSample> samples = carved_samples();
    std::size_t left = 0, found = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        for (const std::string unit : kFileUnits) {
            const std::string file = samples[i].name + "-" + unit;
            const auto outcome = carve_sample(place, samples[i], unit);
            ASSERT_EQ(outcome.status, 0) << outcome.output;
            const Json report = Json::parse(place.read(file + ".json"));
            EXPECT_EQ(report["export_unit"], unit);
            const Json said = counts_of_report(report);
            EXPECT_EQ(said["open_edges"], 0) << file;
            EXPECT_EQ(said["nonmanifold_edges"], 0) << file;
            EXPECT_EQ(said["misoriented_edges"], 0) << file;
            left += said["crossing_pairs"].get<std::size_t>();
            found += report["mesh"]["self_intersections"]["found"].get<std::size_t>();
            for (const char* ending : kFileEndings)
                EXPECT_EQ(counts_of_file(place / (file + ending)), said) << file << ending;
        }
    }
    // Where walls thinner than a cell meet, single pairs cannot be separated.
    EXPECT_LE(left, found / 20) << found;
}

TEST(ExportedFiles, OfTwoMeshesCombinedHaveWhatTheReportSays) {
    const Workplace place;
    write_meshes_of_samples(place);
    for (const std::string unit : kFileUnits) {
        const auto outcome =
            place.run(kFilesBurin +
                      " combine part.obj tool.obj --operation difference --resolution 96 --export a.stl"
                      " --export a.ply --export a.obj --report r.json --export-units " +
                      unit);
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        const Json report = Json::parse(place.read("r.json"));
        EXPECT_EQ(report["export_unit"], unit);
        for (const char* ending : kFileEndings)
            EXPECT_EQ(counts_of_file(place / (std::string("a") + ending)), counts_of_report(report)) << unit << ending;
    }
}

TEST(ExportedFiles, AConvertedMeshStaysAsSoundAsItWas) {
    const Workplace place;
    write_meshes_of_samples(place);
    place.write("crowded.obj", crowded_obj());
    ASSERT_EQ(carve_sample(place, carved_samples()[1], "m").status, 0);
    for (const std::string file : {"crowded.obj", "part2-m.obj"}) {
        const Json before = counts_of_file(place / file);
        EXPECT_EQ(before["open_edges"], 0) << file;
        for (const std::string unit : kFileUnits) {
            for (const char* ending : kFileEndings) {
                const auto outcome =
                    place.run(kFilesBurin + " convert " + file + " out" + ending + " --export-units " + unit);
                ASSERT_EQ(outcome.status, 0) << outcome.output;
                EXPECT_EQ(counts_of_file(place / (std::string("out") + ending)), before) << file << unit << ending;
            }
        }
    }
}

}  // namespace burin::app
