// SPDX-License-Identifier: MIT
#include "toolbox/feel_options.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace burin::toolbox {
namespace {

haptics::TouchMaterial material_with(const FeelOptions& options) {
    const auto settings = parse_feel_settings(options);
    EXPECT_TRUE(settings) << (settings ? "" : settings.error().line());
    return touch_material(settings.value_or(FeelSettings{}));
}

}  // namespace

TEST(FeelOptions, APresetGivesWhatNoNumberGives) {
    const auto soft = material_with({.hardness = "soft"}), hard = material_with({.hardness = "hard"});
    EXPECT_LT(soft.hardness_Ns_per_m3, hard.hardness_Ns_per_m3);
    EXPECT_LT(soft.stiffness_N_per_m, hard.stiffness_N_per_m);
    EXPECT_GT(soft.damping_Ns_per_m, hard.damping_Ns_per_m);
    FeelOptions options{.hardness = "soft"};
    options.stiffness_N_per_m = 123.0;
    options.friction = 0.4;
    const auto given = material_with(options);
    EXPECT_EQ(given.hardness_Ns_per_m3, soft.hardness_Ns_per_m3);
    EXPECT_EQ(given.damping_Ns_per_m, soft.damping_Ns_per_m);
    EXPECT_EQ(given.stiffness_N_per_m, 123.0);
    EXPECT_EQ(given.dynamic_friction, 0.4);
    EXPECT_NEAR(given.static_friction, 0.5, 1e-12);
}

TEST(FeelOptions, AHardnessAsANumberIsInKilopascalsAndTakesTheRestFromMedium) {
    const auto medium = material_with({.hardness = "medium"}), given = material_with({.hardness = "2.5"});
    EXPECT_EQ(given.hardness_Ns_per_m3, 2.5e6);
    EXPECT_EQ(given.stiffness_N_per_m, medium.stiffness_N_per_m);
    EXPECT_NEAR(given.cutting_yield_Pa, medium.cutting_yield_Pa * 2.5 / 4.0, 1e-9);
    EXPECT_EQ(material_with({.hardness = "2.5", .yield_kPa = 7.0}).cutting_yield_Pa, 7e3);
    EXPECT_EQ(given.cutting_drag_Ns_per_m3, medium.cutting_drag_Ns_per_m3);
    EXPECT_EQ(with_hardness(*parse_feel_settings({.hardness = "soft"}), 2.5),
              *parse_feel_settings({.hardness = "2.5"}));
    EXPECT_EQ(material_with({.hardness = "inf"}).hardness_Ns_per_m3, std::numeric_limits<double>::infinity());
    const auto air = material_with({.hardness = "0"});
    EXPECT_EQ(air.hardness_Ns_per_m3, 0.0);
    EXPECT_EQ(air.cutting_yield_Pa, 0.0);
    EXPECT_EQ(air.cutting_drag_Ns_per_m3, 0.0) << "what gives way without resistance does not drag either";
}

TEST(FeelOptions, AMaterialOfPublishedFiguresIsTheChipLawOfADrivenCutter) {
    // Lime along the grain: K_c 15.2 N/mm2 and F_e 3.22 N/mm; two edges on 6 mm at 3.14 m/s, thrust ratio 0.3.
    const auto lime = material_with({.hardness = "lime"});
    EXPECT_NEAR(lime.hardness_Ns_per_m3, 0.3 * 15.2e6 / 3.14, 1.0);
    EXPECT_NEAR(lime.cutting_yield_Pa, 0.3 * 3220.0 / 9.42e-3, 1.0);
    EXPECT_GT(material_with({.hardness = "oak"}).cutting_yield_Pa, lime.cutting_yield_Pa);
    const auto ringed = material_with({.hardness = "oak", .grain_mm = 3.0});
    EXPECT_EQ(ringed.grain_spacing_m, 3e-3);
    EXPECT_GT(ringed.grain_share, 0.0);
    EXPECT_EQ(lime.grain_share, 0.0);
}

TEST(FeelOptions, OfTheHandAreCheckedToo) {
    FeelOptions options;
    const auto usual = parse_feel(options);
    ASSERT_TRUE(usual);
    EXPECT_EQ(usual->name, "medium");
    options.hardness = "4";
    options.grip_N_per_m *= 4.0;
    options.press_N = 2.0;
    const auto firm = parse_feel(options);
    ASSERT_TRUE(firm);
    EXPECT_EQ(firm->name, "given");
    EXPECT_EQ(firm->press_N, 2.0);
    // The damping ratio d / (2 sqrt(k m)) stays: four times the stiffness, twice the damping.
    EXPECT_NEAR(firm->grip.damping_Ns_per_m, 2.0 * usual->grip.damping_Ns_per_m, 1e-12);
    for (const double bad : {-0.1, 10.1, std::nan("")}) {
        options.press_N = bad;
        ASSERT_FALSE(parse_feel(options)) << bad;
        EXPECT_EQ(parse_feel(options).error().line(), "--press: is out of range; give a number from 0 to 10");
    }
}

TEST(FeelSettings, OutOfRangeAreRefused) {
    EXPECT_TRUE(check_feel({}));
    EXPECT_TRUE(check_feel({.stiffness_N_per_m = 1e5, .friction = 2.0}));
    for (const double bad : {-1.0, 1.1e5, std::nan("")}) EXPECT_FALSE(check_feel({.stiffness_N_per_m = bad})) << bad;
    for (const double bad : {-1.0, 1.1e6, std::nan("")}) EXPECT_FALSE(check_feel({.yield_kPa = bad})) << bad;
    for (const double bad : {-1.0, 1.1e3, std::nan(""), 1e-310, 0.009})
        EXPECT_FALSE(check_feel({.grain_mm = bad})) << bad;
    for (const double bad : {-0.1, 2.1, std::nan("")}) EXPECT_FALSE(check_feel({.friction = bad})) << bad;
}

}  // namespace burin::toolbox
