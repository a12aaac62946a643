// SPDX-License-Identifier: MIT
// burin hand [WORLD]: a hand in a glove, drawn and felt, among rigid things (activities/grasp).
#include <algorithm>
#include <cstdio>
#include <memory>

#include "activities/grasp/grasp.hpp"
#include "app/commands.hpp"
#include "app/live_options.hpp"
#include "app/live_replay.hpp"
#include "base/text.hpp"
#include "devices/gloves/glove_device.hpp"
#include "devices/registry/device_registry.hpp"

namespace burin::app {
namespace {

constexpr const char* kWorld = "assets/worlds/hand.toml";
// Scripts of what the arm does; the fingers close by the glove, or by the first button.
constexpr const char* kScripts = "assets/sessions/hand-";

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

}  // namespace

void add_hand_options(Command command, HandSession& hand) {
    hand.session.world = kWorld;
    hand.session.live.device = devices::kSimulatedGlove;
    hand.session.tool.shape = "ball:0.006";  // around a fingertip's patch
    command.option("FILE", hand.session.world, "A world: .toml, .wrl for VRML 2.0, or a mesh (STL, OBJ, PLY, OFF)")
        .show_default();
    command
        .option("--grasp", hand.grasp,
                "A scripted hand, offscreen, which leaves pictures: whole: grasps and carries a ball; pinch: a card "
                "between thumb and index; point: at the ball")
        .one_of({"whole", "pinch", "point"});
    command.option("--points", hand.options.points, "Of the patch by which a fingertip feels")
        .within(1, static_cast<int>(activities::kMostFingertipPoints))
        .show_default();
    command.choice("--mesh", hand.options.stiffness,
                   "shared: the points of a patch share a surface's stiffness; literal: each has all of it",
                   {{"shared", activities::PatchStiffness::shared}, {"literal", activities::PatchStiffness::literal}});
    add_live_options(command, hand.session.live);
}

Result<void> hand(const HandSession& options) {
    session::SculptOptions session = options.session;
    session::LiveOptions& live = session.live;
    session.no_workpiece = true;
    if (!live.hands.empty()) return fail("--device", "gives several hands, and one is drawn here", "name one device");
    if (!options.grasp.empty()) {
        if (live.device != devices::kSimulatedGlove)
            return fail("--grasp", "is of a simulated hand, and --device names " + live.device,
                        "leave one of them out");
        live.device = std::string(devices::kSimulatedGlove) + ":" + options.grasp;
        if (live.input.empty()) live.input = kScripts + options.grasp + ".txt";
        live.offscreen = true;
    }
    const Result<devices::DeviceNature> nature = devices::nature_of_device(live.device);
    if (!nature) return std::unexpected(nature.error());
    if (!nature->is_worn)
        return fail("--device " + live.device, "is no glove",
                    "name glove:PORT, or " + std::string(devices::kSimulatedGlove));
    // A glove whose arm nobody leads grasps by a script.
    if (live.offscreen && live.input.empty()) live.input = std::string(kScripts) + "glove.txt";
    const auto activity = std::make_shared<activities::Grasp>(options.options);
    session.activity = activity;
    const Result<void> done = run_recorded_session(session, "hand");
    if (done) print_grasps(*activity);
    return done;
}

}  // namespace burin::app
