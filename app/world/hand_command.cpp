// SPDX-License-Identifier: MIT
#include "app/world/hand_command.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "activities/grasp/grasp.hpp"
#include "app/cli/live_options.hpp"
#include "app/cli/recorded_files.hpp"
#include "app/recordings/live_replay.hpp"
#include "base/assets.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/gloves/glove_device.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "session/record/input_files.hpp"
#include "session/record/recordings.hpp"

namespace burin::app {
namespace {

std::string scripted_world() { return asset_path("worlds/hand.toml"); }
// Returns a script of what the arm does; the fingers close by the glove, or by the first button.
std::string arm_script(const std::string& grasp) { return asset_path("sessions/hand-" + grasp + ".txt"); }

// Returns whether the scripts were written for that world. Its file may be another copy of it.
bool is_scripted_world(const std::string& world) { return session::is_same_file(world, scripted_world()); }

std::string seconds_text(Nanoseconds from_ns, Nanoseconds to_ns) {
    return formatted("%.1f s", seconds(to_ns - from_ns));
}

void print_grasps(const activities::Grasp& hand) {
    for (const activities::Grasped& grasp : hand.grasps()) {
        const bool is_held = grasp.ended_ns == 0;
        std::printf(
            "%s %s, carried %.0f mm%s\n", grasp.gesture == geometry::Gesture::pinch ? "pinched" : "grasped",
            grasp.object.c_str(), 1e3 * glm::length(grasp.carried_m),
            is_held ? ", and held at the end" : (", held for " + seconds_text(grasp.begun_ns, grasp.ended_ns)).c_str());
    }
    if (hand.grasps().empty()) std::printf("nothing was grasped\n");
}

// Has the hand go by the script of a grasp. Refuses what says otherwise.
Result<void> lead_by_grasp(session::SessionSetup& session, const std::string& grasp) {
    session::SessionSetup& setup = session;
    if (setup.hands.device != devices::kSimulatedGlove)
        return fail("--grasp", "is of a simulated hand, and --device names " + setup.hands.device,
                    "leave one of them out");
    if (!setup.record.input.empty())
        return fail("--grasp " + grasp, "leads the hand by a script, and --input names another",
                    "leave one of them out");
    if (!is_scripted_world(session.scene.world))
        return fail("--grasp " + grasp,
                    "goes by a script for " + scripted_world() + ", and " + session.scene.world + " is another world",
                    "lead the hand there with --input");
    setup.hands.device = std::string(devices::kSimulatedGlove) + ":" + grasp;
    setup.record.input = arm_script(grasp);
    setup.desk.offscreen = true;
    return {};
}

// Checks that the device is a glove which can render as asked.
Result<void> check_worn(const session::SessionSetup& setup, activities::GloveRendering rendering, bool has_line) {
    BURIN_TRY(nature, devices::nature_of_device(setup.hands.device, &session::session_recordings()));
    if (!nature.is_worn)
        return fail("--device " + setup.hands.device, "is no glove",
                    "name glove:PORT, or " + std::string(devices::kSimulatedGlove));
    if (rendering == activities::GloveRendering::local && !has_line)
        return fail("--rendering local", "needs a glove's controller, and " + setup.hands.device + " has none",
                    "name --device glove:PORT, or leave it out");
    return {};
}

CommandAction add_hand(Command command) {
    const auto options = std::make_shared<HandSession>();
    HandSession& hand = *options;
    prepare_hand(hand);
    command
        .option("FILE", hand.session.scene.world, "A world: .toml, .wrl for VRML 2.0, or a mesh (STL, OBJ, PLY, OFF)")
        .asset(AssetRoom::worlds)
        .show_default();
    command
        .option("--grasp", hand.grasp,
                "A scripted hand, offscreen, which leaves pictures: whole: grasps and carries a ball; pinch: a card "
                "between thumb and index; point: at the ball")
        .one_of({"whole", "pinch", "point"});
    command.option("--points", hand.options.points, "Of the patch by which a fingertip feels")
        .within(1, static_cast<int>(activities::kMostFingertipPoints))
        .show_default();
    command
        .option("--extent", hand.options.extent_mm, "From the patch's middle to its neighbours, along the skin, in mm")
        .within(activities::kLeastExtent_mm, activities::kMostExtent_mm)
        .show_default();
    command.choice(
        "--mesh", hand.options.stiffness,
        "shared: the points of a patch share a surface's stiffness by their areas; literal: each has all of it",
        {{"shared", activities::PatchStiffness::shared}, {"literal", activities::PatchStiffness::literal}});
    command.choice(
        "--rendering", hand.options.rendering,
        "Where the force of a contact that rests is made: distributed: here; local: at the controller of a "
        "glove on a line, which knows the piston's length alone",
        {{"distributed", activities::GloveRendering::distributed}, {"local", activities::GloveRendering::local}});
    add_live_options(command, hand.session);
    return action([options, command] {
        options->given = command.given();
        return app::hand(*options);
    });
}

// Leaves to a recording that is done again what the user has not given; what was given must be as it was recorded.
Result<activities::GraspOptions> grasp_of(const HandSession& hand, const std::string& repeated) {
    if (!repeated.starts_with("hand ")) return hand.options;
    BURIN_TRY(grasp, activities::grasp_options_of(repeated));
    for (const std::string& option : hand.given) {
        if (option == "--points") grasp.points = hand.options.points;
        if (option == "--extent") grasp.extent_mm = hand.options.extent_mm;
        if (option == "--mesh") grasp.stiffness = hand.options.stiffness;
        if (option == "--rendering") grasp.rendering = hand.options.rendering;
    }
    return grasp;
}

}  // namespace

void prepare_hand(HandSession& hand) {
    hand.session.scene.world = scripted_world();
    hand.session.hands.device = devices::kSimulatedGlove;
    hand.session.hands.tool.shape = "ball:0.006";  // around a fingertip's patch
}

Result<void> hand(const HandSession& options) {
    session::SessionSetup session = options.session;
    session::SessionSetup& setup = session;
    session.scene.no_workpiece = true;
    if (!setup.hands.named.empty())
        return fail("--device", "gives several hands, and one is drawn here", "name one device");
    if (!options.grasp.empty()) BURIN_TRY_DO(lead_by_grasp(session, options.grasp));
    const bool has_line = setup.hands.device.starts_with(std::string(devices::kGlove) + ":");
    BURIN_TRY_DO(check_worn(setup, options.options.rendering, has_line));
    // A glove whose arm nobody leads grasps by a script; a simulated one closes by its script's buttons.
    if (setup.desk.offscreen && setup.record.input.empty() && !is_scripted_world(session.scene.world))
        return fail(
            "--offscreen",
            "has the arm go by a script for " + scripted_world() + ", and " + session.scene.world + " is another world",
            "lead the hand there with --input");
    if (setup.desk.offscreen && setup.record.input.empty())
        setup.record.input = arm_script(has_line ? "glove" : "whole");
    const std::string repeated = repeated_activity(setup);
    BURIN_TRY(grasp, grasp_of(options, repeated));
    if (!repeated.empty()) leave_to_recording(session, std::ranges::find(options.given, "FILE") != options.given.end());
    const auto activity = std::make_shared<activities::Grasp>(grasp);
    session.activity = activity;
    const Result<void> done = run_recorded_session(session, "hand");
    if (done) print_grasps(*activity);
    return done;
}

CommandRow hand_row() { return {"hand", "Close, feel, grasp, carry and point with a drawn hand", add_hand}; }

}  // namespace burin::app
