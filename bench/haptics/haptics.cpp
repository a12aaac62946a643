// SPDX-License-Identifier: MIT
#include "bench/haptics/haptics.hpp"

#include "base/try.hpp"
#include "bench/haptics/haptics_rows.hpp"
#include "bench/measure/timing.hpp"
#include "haptics/realtime.hpp"

namespace burin::bench {

HapticsOptions quick_haptics() {
    HapticsOptions quick;
    quick.sizes = {2'000, 20'000};
    quick.scenes = {.spheres = {2'000}, .rough_triangles = 2'000, .sides = 16, .needles = 10};
    quick.accuracy_size = 20'000;
    quick.paced_ticks = 10;
    quick.back_to_back_ticks = 100;
    quick.peer_ticks = 5;
    quick.accuracy_ticks = 2'000;
    quick.contact_ticks = 5'000;
    quick.edits = 5;
    quick.parts_turns = 200;
    quick.shape_ticks = 100;
    quick.wand_ticks = 1'000;
    quick.solid_resolutions = {48};
    quick.carved_resolutions = {};
    quick.ask_for_realtime = false;
    return quick;
}

Result<void> on_rough_scenes(const Haptics& all, const Tell& notify, const std::string& what,
                             const std::function<Result<void>(const TouchedScene&)>& measure) {
    BURIN_TRY(scenes, touch_scenes(all.options.scenes));
    for (const TouchScene& wanted : scenes.scenes) {
        if (wanted.smooth) continue;
        const auto scene = touched(wanted);
        if (!scene) continue;
        notify("measuring: " + what + " on " + wanted.name);
        BURIN_TRY_DO(measure(**scene));
    }
    return {};
}

Result<Haptics> run_haptics(const HapticsOptions& options, const Tell& notify) {
    Haptics all;
    all.options = options;
    all.machine = machine();
    all.realtime = "not asked for";
    // Edits come first, and without real-time priority: they are the publisher's work.
    BURIN_TRY_DO(measure_edits(all, notify));
    BURIN_TRY_DO(measure_accuracy(all, notify));
    BURIN_TRY_DO(measure_parts(all, notify));
    BURIN_TRY_DO(measure_shapes(all, notify));
    BURIN_TRY_DO(measure_carved(all, notify));
    BURIN_TRY_DO(measure_wand(all, notify));
    if (options.ask_for_realtime) {
        const haptics::RealtimeNotice notice = haptics::ask_for_realtime();
        all.realtime = notice.text.empty() ? "priority and locked memory" : notice.text;
    }
    BURIN_TRY_DO(measure_ticks(all, notify));
    BURIN_TRY_DO(measure_carving_ticks(all, notify));
    BURIN_TRY_DO(measure_peer_ticks(all, notify));
    sort_worst_first(all.ticks);
    return all;
}

}  // namespace burin::bench
