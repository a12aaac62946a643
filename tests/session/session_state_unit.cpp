// SPDX-License-Identifier: MIT
// The session's state, without any picture.
#include <gtest/gtest.h>

#include <fstream>

#include <cmath>

#include "haptics/tick.hpp"
#include "session/held/held_tool.hpp"
#include "session/input/input_event.hpp"
#include "session/state/command_table.hpp"
#include "session/state/leader.hpp"
#include "session/state/session_commands.hpp"
#include "session/state/session_orders.hpp"
#include "session/state/session_room.hpp"
#include "session/state/session_state.hpp"
#include "session/state/session_step.hpp"

namespace burin::session {
namespace {

Room test_room() {
    Room room;
    room.workpiece_object = {Vec3(-0.1), Vec3(0.1)};
    return room;
}

constexpr toolbox::ToolSizes kBall_m{0.01};

SessionState test_state(const Room& room) {
    return begin_session(room, {.shape = {toolbox::ToolKind::ball, kBall_m, {}}}, {}, {});
}

Result<void> run(SessionState& state, SessionOrders& orders, const std::string& name,
                 std::vector<std::string> arguments = {}) {
    return run_command(state, orders, {name, std::move(arguments)});
}

}  // namespace

TEST(SessionState, ForceOffReachesTheTick) {
    const Room room = test_room();
    SessionState state = test_state(room);
    SessionOrders orders;
    EXPECT_TRUE(parameters_of(state, room).enabled);
    for (const bool on : {false, true, false}) {
        orders = {};
        ASSERT_TRUE(run(state, orders, "force", {on ? "on" : "off"}));
        EXPECT_TRUE(orders.parameters) << "the loop is told";
        EXPECT_EQ(parameters_of(state, room).enabled, on);
    }
}

TEST(SessionState, AToolThatIsWrongLeavesTheOldOne) {
    const Room room = test_room();
    SessionState state = test_state(room);
    SessionOrders orders;
    for (const auto& [name, argument] : std::vector<std::pair<std::string, std::string>>{{"radius", "0"},
                                                                                         {"radius", "x"},
                                                                                         {"tool", "ball:"},
                                                                                         {"tool", "box:0.1,0,0.1"},
                                                                                         {"stiffness", "200000"},
                                                                                         {"colour", "red"},
                                                                                         {"hardness", "-3"},
                                                                                         {"friction", "nan"},
                                                                                         {"operation", "drill"},
                                                                                         {"technique", "teleport"},
                                                                                         {"stereo-mode", "hologram"},
                                                                                         {"force-filter", "1"}}) {
        const auto refused = run(state, orders, name, {argument});
        ASSERT_FALSE(refused) << name << " " << argument;
        EXPECT_FALSE(refused.error().line().empty());
    }
    EXPECT_EQ(state.led().tool, test_state(room).led().tool);
    EXPECT_EQ(state.feel, test_state(room).feel);
    EXPECT_TRUE(orders.carving.empty());
    EXPECT_FALSE(orders.parameters);
}

TEST(SessionState, EveryCommandThatChangesTheToolTellsCarvingAndTouch) {
    const Room room = test_room();
    for (const auto& [name, argument] : std::vector<std::pair<std::string, std::string>>{{"radius", "0.02"},
                                                                                         {"tool", "ball:0.03"},
                                                                                         {"colour", "0.1,0.2,0.3"},
                                                                                         {"operation", "fill"},
                                                                                         {"hardness", "500000"},
                                                                                         {"friction", "0.3"},
                                                                                         {"stiffness", "400"}}) {
        SessionState state = test_state(room);
        SessionOrders orders;
        ASSERT_TRUE(run(state, orders, name, {argument})) << name;
        EXPECT_EQ(orders.carving.size(), 1u) << name;
        EXPECT_TRUE(orders.parameters) << name;
        EXPECT_TRUE(haptics::parameters_are_sensible(parameters_of(state, room))) << name;
    }
}

TEST(SessionState, OnlyTouchingEndsWithTheNextTool) {
    const Room room = test_room();
    for (const auto& [name, arguments] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"tool-1", {}}, {"tool-2", {}}, {"tool-3", {}}, {"tool-4", {}}, {"operation", {"cut"}}}) {
        SessionState state = test_state(room);
        SessionOrders orders;
        ASSERT_TRUE(run(state, orders, "tool-5"));
        EXPECT_TRUE(std::isinf(parameters_of(state, room).materials[0].hardness_Ns_per_m3)) << "it can be cut";
        ASSERT_TRUE(run(state, orders, name, arguments)) << name;
        EXPECT_TRUE(std::isfinite(parameters_of(state, room).materials[0].hardness_Ns_per_m3)) << name;
        const auto* use = std::get_if<workpiece::UseTool>(&orders.carving.back());
        ASSERT_NE(use, nullptr) << name;
        EXPECT_TRUE(std::isfinite(use->hardness_Ns_per_m3)) << name;
    }
}

// A step reads no file: the same events would give another state when it has changed.
TEST(SessionState, AMeshToolIsTakenUpIfItWasReadBeforeAndElseRefused) {
    const Room room = test_room();
    const std::string known = testing::TempDir() + "held-tetrahedron.obj";
    std::ofstream(known) << "v 0 0 0\nv 0.02 0 0\nv 0 0.02 0\nv 0 0 0.02\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    auto meshes = std::make_shared<ToolMeshes>();
    ASSERT_TRUE(meshes->read({toolbox::ToolKind::mesh, {}, known}));
    for (const std::string& file : {known, std::string("no/such/file.stl")}) {
        SessionState state = test_state(room);
        state.meshes = meshes;
        const std::vector<InputEvent> events{{0, CommandInput{"tool", {"mesh:" + file}}}};
        Leader nobody;
        const SessionStep step = step_session(state, room, events, {}, nobody);
        if (file == known) {
            EXPECT_TRUE(step.orders.messages.empty());
            EXPECT_EQ(step.state.led().held->spec.file, known);
            EXPECT_FALSE(step.state.led().held->drawn->indices.empty());
            EXPECT_TRUE(haptics::parameters_are_sensible(parameters_of(step.state, room)));
            SessionOrders orders;
            SessionState held = step.state;
            EXPECT_FALSE(run(held, orders, "radius", {"0.01"})) << "its file gives its size";
        } else {
            ASSERT_EQ(step.orders.messages.size(), 1u);
            EXPECT_EQ(step.orders.messages[0].text,
                      "tool mesh:" + file +
                          ": has not been read, and a running session reads no files; start the session with it "
                          "(--tool), or take it up in its --input");
            EXPECT_EQ(step.state.led().tool, state.led().tool);
        }
    }
}

TEST(SessionState, AMaterialByNameTakesThePlaceOfNumbers) {
    const Room room = test_room();
    SessionState state = test_state(room);
    SessionOrders orders;
    ASSERT_TRUE(run(state, orders, "hardness", {"500000"}));
    ASSERT_TRUE(run(state, orders, "friction", {"0.05"}));
    for (const toolbox::FeelPresetDescriptor& preset : toolbox::feel_presets()) {
        ASSERT_TRUE(run(state, orders, "material", {std::string(preset.name)}));
        const haptics::TouchMaterial now = parameters_of(state, room).materials[0];
        const auto expected = toolbox::touch_material(toolbox::FeelSettings{.preset = preset.preset});
        EXPECT_EQ(now.hardness_Ns_per_m3, expected.hardness_Ns_per_m3) << preset.name;
        EXPECT_EQ(now.cutting_yield_Pa, expected.cutting_yield_Pa) << preset.name;
        EXPECT_EQ(now.dynamic_friction, expected.dynamic_friction) << preset.name;
    }
    const auto refused = run(state, orders, "material", {"oka"});
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().remedy.starts_with("did you mean oak?")) << refused.error().line();
}

TEST(SessionState, TheRadiusScalesAllSizesOfAToolThatIsNoBall) {
    const Room room = test_room();
    SessionState state = test_state(room);
    SessionOrders orders;
    ASSERT_TRUE(run(state, orders, "tool", {"bullnose:0.008,0.004,0.032"}));
    ASSERT_TRUE(run(state, orders, "radius", {"0.004"}));
    EXPECT_EQ(toolbox::text_of(state.led().tool.shape), "bullnose:0.004,0.002,0.016");
    EXPECT_EQ(descriptor_of(Quantity::radius).value(state), 0.004);
}

// Recordings hold commands and are replayed to the bit, so what these make of a state must not change.
TEST(SessionState, CommandsSetToolAndFeelToTheBitsTheyAlwaysHad) {
    const Room room = test_room();
    SessionState state = test_state(room);
    SessionOrders orders;
    ASSERT_TRUE(run(state, orders, "larger-radius"));
    EXPECT_EQ(state.led().tool.shape.sizes_m[0], 0.01122462) << "nine digits";
    ASSERT_TRUE(run(state, orders, "larger-radius"));
    EXPECT_EQ(state.led().tool.shape.sizes_m[0], 0.0125992094) << "of 0.01259920941444";
    ASSERT_TRUE(run(state, orders, "radius", {"0.00123456789123"}));
    EXPECT_EQ(state.led().tool.shape.sizes_m[0], 0.00123456789);
    ASSERT_TRUE(run(state, orders, "tool", {"ball:0.00123456789123"}));
    EXPECT_EQ(state.led().tool.shape.sizes_m[0], 0.00123456789123) << "a tool's own sizes are kept as they are";
    state.feel = {.preset = toolbox::FeelPreset::soft};
    ASSERT_TRUE(run(state, orders, "hardness", {"1234567.891234"}));
    const haptics::TouchMaterial material = parameters_of(state, room).materials[0];
    EXPECT_EQ(material.hardness_Ns_per_m3, 1.23456789 * 1e6);
    EXPECT_EQ(material.stiffness_N_per_m, 600.0) << "the medium preset's, as with --hardness and a number";
    ASSERT_TRUE(run(state, orders, "colour", {"0.1,0.5,1"}));
    EXPECT_EQ(toolbox::material_of(state.led().tool).colour, (std::array<std::uint8_t, 3>{26, 128, 255}));
}

TEST(SessionState, EveryQuantityIsReadWhereItsCommandSetIt) {
    const Room room = test_room();
    for (const QuantityDescriptor& quantity : quantities()) {
        if (is_of_a_viewer(SetQuantity{quantity.quantity, 0.0})) continue;
        SessionState state = test_state(room);
        SessionOrders orders;
        const double middle = quantity.by_ratio ? std::sqrt(quantity.from * quantity.to) : 0.5 * quantity.to;
        ASSERT_TRUE(run(state, orders, std::string(quantity.name), {std::to_string(middle)})) << quantity.name;
        EXPECT_NEAR(quantity.value(state), middle, 1e-3 * middle) << quantity.name;
        EXPECT_EQ(&descriptor_of(quantity.quantity), &quantity);
        const bool seen = quantity.concern == QuantityConcern::picture;
        EXPECT_EQ(orders.parameters, !seen) << quantity.name;
        EXPECT_EQ(orders.carving.size(), quantity.concern == QuantityConcern::tool_and_touch ? 1u : 0u);
    }
}

TEST(SessionState, TheNextTechniqueComesRoundToTheFirstOverAllOthers) {
    SessionState state = test_state(test_room());
    SessionOrders orders;
    for (std::size_t i = 1; i <= techniques().size(); ++i) {
        ASSERT_TRUE(run(state, orders, "next-workspace-technique"));
        EXPECT_EQ(state.led().technique, techniques()[i % techniques().size()].technique);
        EXPECT_EQ(descriptor_of(state.led().technique).name, haptics::text(state.led().technique));
    }
}

// What is led is followed by the ticks as a body that moves, and what a command places is not.
// A log that says how the mouse flies is none from before it could be said.
TEST(SessionState, FillsInFreeFlightOnceSomebodyHasChosenHowTheMouseFlies) {
    Room room = test_room();
    room.hands.front().fills = haptics::FillPlace::hand;
    SessionState state = test_state(room);
    SessionOrders orders;
    EXPECT_EQ(parameters_of(state, room).fills, haptics::FillPlace::surface);
    ASSERT_TRUE(run_command(state, orders, CommandInput{"mouse", {"free"}}));
    EXPECT_EQ(parameters_of(state, room).fills, haptics::FillPlace::hand);
    room.hands.front().fills = haptics::FillPlace::begun;
    EXPECT_EQ(parameters_of(test_state(room), room).fills, haptics::FillPlace::begun) << "a hand that feels";
    room.mouse = MouseMode::surface;
    room.mouse_chosen = true;
    EXPECT_EQ(parameters_of(test_state(room), room).fills, haptics::FillPlace::surface);
}

// What is about how a session is seen needs somebody who sees it.
TEST(SessionState, CommandsOfAViewerAreRefusedWhereThereIsNone) {
    std::size_t refused = 0;
    for (const CommandInput& command :
         {CommandInput{"stereo-mode", {"mono"}}, CommandInput{"view-top", {}}, CommandInput{"eye-distance", {"0.06"}},
          CommandInput{"select", {"anything"}}, CommandInput{"toggle-panel", {}}, CommandInput{"friction", {"0.3"}},
          CommandInput{"technique", {"moving"}}, CommandInput{"undo", {}}}) {
        SessionState state = test_state(test_room());
        SessionOrders orders;
        const auto done = run_command(state, orders, command);
        EXPECT_EQ(!done, is_of_a_viewer(*parse_command(command))) << command.name;
        if (done) continue;
        ++refused;
        EXPECT_EQ(done.error().line(),
                  command.name + ": is about how the session is seen, and nobody sees it; leave it out");
    }
    EXPECT_EQ(refused, 5u);
}

}  // namespace burin::session
