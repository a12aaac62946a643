// SPDX-License-Identifier: MIT
// Times the ticks of the haptic loop on meshes.
#include "bench/haptics/touch_run.hpp"

#include "base/try.hpp"
#include "haptics/channels.hpp"

namespace burin::bench {
namespace {

struct Case {
    const NamedProbe& probe;
    bool friction;
    Pacing pacing;
};

void touch(Haptics& all, const TouchedScene& scene, const Case& of) {
    MonotonicClock clock;
    TickCosts& costs = all.ticks.emplace_back();
    costs.scene = scene.name, costs.smooth = scene.smooth;
    costs.probe = of.probe.name, costs.radius_m = of.probe.radius_m;
    costs.pacing = name_of(of.pacing), costs.friction = of.friction;
    costs.triangles = scene.snapshot->triangles(), costs.mean_edge_m = scene.snapshot->mean_edge_m();
    const PressedWalk path(scene.walk, {.above_m = of.probe.radius_m + 0.005});
    TouchRun run(costs, clock, session_parameters(of.probe.probe, of.friction), path, false);
    std::uint64_t sequence = 0;
    const bool paced = of.pacing != Pacing::back_to_back;
    run.take(paced ? all.options.paced_ticks : all.options.back_to_back_ticks, of.pacing, [&](Nanoseconds now_ns) {
        fill(run.channels().surface.draft(), scene, ++sequence, now_ns);
        run.channels().surface.publish();
    });
    if (!paced && of.probe.probe.count == 1)
        costs.contact_lost = contacts_lost(scene, run.hands_without_contact_m(), of.probe.radius_m);
}

// Rehearsed ticks are taken with friction alone, as a session has it: they differ from cold ones by the caches alone.
void touch_with(Haptics& all, const TouchedScene& scene, const NamedProbe& probe) {
    for (const bool friction : {true, false})
        for (const Pacing pacing : {Pacing::cold, Pacing::rehearsed, Pacing::back_to_back})
            if (friction || pacing != Pacing::rehearsed) touch(all, scene, {probe, friction, pacing});
}

}  // namespace

Result<void> measure_ticks(Haptics& all, const Tell& log_progress) {
    BURIN_TRY(scenes, touch_scenes(all.options.scenes));
    all.notes.insert(all.notes.end(), scenes.notes.begin(), scenes.notes.end());
    for (const TouchScene& wanted : scenes.scenes) {
        const auto scene = touched(wanted);
        if (!scene) {
            all.notes.push_back("not touched: " + scene.error().line());
            continue;
        }
        for (const NamedProbe& probe : probes_on((*scene)->snapshot->mean_edge_m())) {
            // Runs few probes on smooth spheres: they only show that the size of the mesh does not matter.
            if (wanted.smooth && probe.name != "point" && probe.name != "ball_2_mm") continue;
            log_progress("ticks on " + wanted.name + ", " + std::to_string((*scene)->snapshot->triangles()) +
                         " triangles, " + probe.name);
            touch_with(all, **scene, probe);
        }
    }
    return {};
}

}  // namespace burin::bench
