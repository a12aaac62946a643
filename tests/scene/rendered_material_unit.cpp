// SPDX-License-Identifier: MIT
// What is told of a material that asks for more than a device renders.
#include "scene/rendered_material.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "devices/haptic/simulated_omni.hpp"
#include "devices/haptic/wand_description.hpp"
#include "haptics/stability/rendered_wall.hpp"
#include "haptics/tick_parameters.hpp"
#include "scene/world_file.hpp"

namespace burin::scene {
namespace {

haptics::TickParameters wand_ends(const devices::WandDescription& wand) {
    haptics::TickParameters parameters;
    parameters.probe.count = 2;
    for (std::size_t i = 0; i < 2; ++i)
        parameters.probe.points[i].offset_device_m = devices::offset_device_m(wand, wand.points[i]);
    return parameters;
}

TEST(RenderedMaterial, AStylusTellsThatItRendersLessThanTwelveHundred) {
    const RenderedMaterial rendered =
        rendered_material({.stiffness_N_per_m = 1200.0, .damping_Ns_per_m = 0.5}, devices::description_of({}), {}, 1);
    EXPECT_EQ(rendered.stiffness_N_per_m, 700.0);
    EXPECT_NEAR(rendered.damping_Ns_per_m, 0.443, 0.001);
    EXPECT_EQ(rendered.bound, haptics::StiffnessBound::device);
    EXPECT_EQ(text_of(rendered), "700 N/m, 0.44 N s/m (its maker's limit)");
}

TEST(RenderedMaterial, TheEndsOfAWandShareWhatItRenders) {
    const devices::WandDescription wand;
    const devices::DeviceDescription device = devices::device_of(wand);
    const HapticMaterial material{.stiffness_N_per_m = 1200.0, .damping_Ns_per_m = 0.5};
    const RenderedMaterial both = rendered_material(material, device, wand_ends(wand), 2);
    EXPECT_NEAR(both.stiffness_N_per_m, 857.66, 0.01);
    EXPECT_EQ(both.damping_Ns_per_m, 0.0);
    EXPECT_NE(both.bound, haptics::StiffnessBound::none);
    const RenderedMaterial one = rendered_material(material, device, wand_ends(wand), 1);
    EXPECT_EQ(one.stiffness_N_per_m, 1200.0);
}

TEST(RenderedMaterial, WhatIsRenderedAsAskedIsToldSo) {
    const RenderedMaterial rendered =
        rendered_material({.stiffness_N_per_m = 300.0, .damping_Ns_per_m = 0.2}, devices::description_of({}), {}, 1);
    EXPECT_EQ(rendered.stiffness_N_per_m, 300.0);
    EXPECT_EQ(rendered.damping_Ns_per_m, 0.2);
    EXPECT_EQ(text_of(rendered), "as asked");
}

// A point of a patch renders its share of the surface: what is told is the surface's.
TEST(RenderedMaterial, APatchOfPointsIsToldAsTheSurfaceThatItFeels) {
    haptics::TickParameters patch;
    patch.probe.count = 5;
    for (std::uint32_t i = 0; i < 5; ++i) patch.probe.points[i].share = 0.2;
    const auto rendered = [&](double stiffness) {
        return rendered_material({.stiffness_N_per_m = stiffness, .damping_Ns_per_m = 0.0}, devices::description_of({}),
                                 patch, 5);
    };
    EXPECT_NEAR(rendered(400.0).stiffness_N_per_m, 400.0, 1e-9);
    EXPECT_NEAR(rendered(1200.0).stiffness_N_per_m, 700.0, 1e-9);
}

TEST(RenderedMaterial, AWorldThatAsksForMoreIsToldInOneSentence) {
    std::vector<SceneObject> objects(3);
    objects[0].name = "usual";
    objects[1].name = "stone";
    objects[1].material = {.stiffness_N_per_m = 1200.0, .damping_Ns_per_m = 0.5};
    objects[2].name = "ghost";
    objects[2].felt = false;
    objects[2].material = objects[1].material;
    const devices::DeviceDescription stylus = devices::description_of({});
    EXPECT_EQ(more_than_rendered(objects, stylus, {}),
              "1 of 2 objects asks for more than simulated PHANTOM Omni renders, such as stone: 1200 N/m, 0.5 N s/m "
              "become 700 N/m, 0.44 N s/m (its maker's limit)");
    objects[1].material.stiffness_N_per_m = 650.0;
    objects[1].material.damping_Ns_per_m = 0.4;
    EXPECT_EQ(more_than_rendered(objects, stylus, {}), "");
}

// Four of the ten used to be 700 N/m on a stylus, whatever their file said.
TEST(RenderedMaterial, TheGardensTenThingsDifferOnAStylus) {
    const WorldOrProblems garden = read_world("assets/worlds/garden.toml");
    ASSERT_TRUE(garden.has_value());
    std::vector<double> stiffness;
    for (const SceneObject& object : garden->objects) {
        const RenderedMaterial rendered = rendered_material(object.material, devices::description_of({}), {}, 1);
        EXPECT_EQ(rendered.bound, haptics::StiffnessBound::none) << object.name << ": " << text_of(rendered);
        stiffness.push_back(rendered.stiffness_N_per_m);
    }
    std::ranges::sort(stiffness);
    for (std::size_t i = 1; i < stiffness.size(); ++i) EXPECT_GT(stiffness[i], 1.15 * stiffness[i - 1]);
}

}  // namespace
}  // namespace burin::scene
