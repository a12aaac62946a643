// SPDX-License-Identifier: MIT
// A tool in the groove that it cuts: it is let go, it sinks by the law, and it is never set inside material.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bench/haptics/carving_scenes.hpp"
#include "tests/compute/effort.hpp"
#include "tests/support/property_cases.hpp"

namespace burin::haptics {
namespace {

struct GrooveCase {
    bench::CarvingTool tool;
    int resolution = 128;
    double speed_m_per_s = 0.0;

    [[nodiscard]] std::string name() const {
        return tool.name + ", N = " + std::to_string(resolution) + ", " + std::to_string(speed_m_per_s) + " m/s";
    }
};

// Of these, N = 128 at the last speed in every run, and of the others as many as there is time for.
std::vector<GrooveCase> groove_cases(const std::vector<double>& speeds) {
    std::vector<GrooveCase> cases, finer;
    for (const bench::CarvingTool& tool : bench::carving_tools())
        for (const double speed : speeds)
            for (const int resolution : {128, 256, 512})
                (resolution == 128 && speed == speeds.back() ? cases : finer).push_back({tool, resolution, speed});
    const auto wanted = static_cast<std::size_t>(test::costly_cases(static_cast<int>(finer.size())));
    for (std::size_t i = 0; i < wanted; ++i) cases.push_back(finer[i * finer.size() / wanted]);
    if (compute::test::kSanitized) cases.resize(1);  // each takes some ten seconds then
    return cases;
}

}  // namespace

TEST(CarvedGroove, LetsGoOfAToolThatIsLiftedOutOfIt) {
    for (const GrooveCase& one : groove_cases({0.02, 0.1, 0.3})) {
        const bench::Lifted lifted = bench::lift_out(one.tool.shape, one.resolution, one.speed_m_per_s);
        EXPECT_EQ(lifted.most_clear_N, 0.0) << one.name();
        EXPECT_EQ(lifted.held_clear, 0u) << one.name();
        EXPECT_EQ(lifted.let_go, 0u) << one.name();
        EXPECT_LE(lifted.limited, lifted.ticks / 33) << one.name();
    }
}

TEST(CarvedGroove, APressedToolSinksByTheLawAndHoldsStillBelowTheYield) {
    std::vector<std::pair<bench::CarvingTool, double>> cases, others;
    for (const bench::CarvingTool& tool : bench::carving_tools()) {
        (cases.size() < 3 ? cases : others).emplace_back(tool, 0.003);
        others.emplace_back(tool, 0.0005);
    }
    others.resize(static_cast<std::size_t>(test::costly_cases(static_cast<int>(others.size()))));
    cases.insert(cases.end(), others.begin(), others.end());
    if (compute::test::kSanitized) cases.resize(1);
    for (const auto& [tool, from_m] : cases) {
        const bench::Sunk sunk = bench::sink(tool.shape, 128, 1.5, from_m);
        // A bull-nose's rounding and a cone's tip have few samples, and what these lack counts threefold here.
        const double within = tool.name == "bull-nose" || tool.name == "cone" ? 0.2 : 0.1;
        EXPECT_NEAR(sunk.found_m_per_s / sunk.law_m_per_s, 1.0, within) << tool.name << ' ' << from_m;
        EXPECT_LT(bench::sink(tool.shape, 128, 0.9, from_m).found_m_per_s, 1e-5) << tool.name << ' ' << from_m;
    }
}

TEST(CarvedGroove, AToolThatIsPlungedIsNeverSetInsideMaterial) {
    std::vector<GrooveCase> cases = groove_cases({0.0});
    for (const GrooveCase& one : cases)
        for (const bool at_once : {false, true}) {
            const bench::Plunged plunged = bench::plunge(one.tool.shape, one.resolution, at_once);
            EXPECT_EQ(plunged.let_go, 0u) << one.name() << ' ' << at_once;
            EXPECT_EQ(plunged.without_force, 0u) << one.name() << ' ' << at_once;
            EXPECT_LE(plunged.most_cost_us, 340.0) << one.name() << ' ' << at_once;
        }
}

}  // namespace burin::haptics
