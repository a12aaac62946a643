// SPDX-License-Identifier: MIT
// Measures what a tool feels in the groove that it cuts, against what is right (carving_scenes.hpp).
#include "bench/haptics/carving_scenes.hpp"
#include "bench/haptics/haptics.hpp"
#include "bench/haptics/turned_scene.hpp"

namespace burin::bench {
namespace {

constexpr double kLiftedAt_m_per_s = 0.1, kAgainAt_m_per_s = 0.05, kPressedAtYields = 1.5, kPressedFrom_m = 0.003;

std::vector<CarvedFeel> carved_with(const CarvingTool& tool, int resolution) {
    const Lifted lifted = lift_out(tool.shape, resolution, kLiftedAt_m_per_s);
    const Sunk sunk = sink(tool.shape, resolution, kPressedAtYields, kPressedFrom_m);
    const CarvedAgain again = carve_again(tool.shape, resolution, kAgainAt_m_per_s);
    return {{"lifted from its groove", tool.name, "N", resolution, 0.0, lifted.most_clear_N, lifted.ticks,
             lifted.limited, lifted.let_go},
            {"sinks by the law", tool.name, "mm/s", resolution, 1e3 * sunk.law_m_per_s, 1e3 * sunk.found_m_per_s,
             sunk.ticks, sunk.limited, 0},
            {"carved again", tool.name, "N", resolution, again.right_N, again.mean_N, again.ticks, again.limited,
             again.let_go}};
}

// The piece stands, and is turned at the fastest of the speeds that a hand turns it at.
CarvedFeel turned_under(const CarvingTool& tool) {
    constexpr double kTurnedAt_deg_per_s = 180.0;
    const TurnedUnder stands = turn_under(tool.shape, {});
    const TurnedUnder turned = turn_under(tool.shape, {.speed_deg_per_s = kTurnedAt_deg_per_s});
    return {"turned under", tool.name,      "N",          0, stands.mean_N, turned.least_N,
            turned.ticks,   turned.limited, turned.let_go};
}

}  // namespace

Result<void> measure_carved(Haptics& all, const Tell& notify) {
    for (const int resolution : all.options.carved_resolutions)
        for (const CarvingTool& tool : carving_tools()) {
            notify("in the groove that it cuts, " + std::to_string(resolution) + " cells, " + tool.name);
            for (CarvedFeel& row : carved_with(tool, resolution)) all.carved.push_back(std::move(row));
        }
    if (all.options.carved_resolutions.empty()) return {};
    for (const CarvingTool& tool : carving_tools()) {
        notify("on a piece that turns, " + tool.name);
        all.carved.push_back(turned_under(tool));
    }
    return {};
}

}  // namespace burin::bench
