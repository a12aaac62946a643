// SPDX-License-Identifier: MIT
// Cuts a groove into a block of 40 mm and lets a point sink into it: what a hand feels on the groove's floor.
#include <cstdio>

#include "compute/mesher/surface.hpp"
#include "compute/engine/engine.hpp"
#include "haptics/tick.hpp"

using namespace burin;

int main() {
    WorkerPool pool(2);
    auto block = compute::make_block({0.04, 0.04, 0.04}, 64, {});
    if (!block) return std::fprintf(stderr, "%s\n", block.error().line().c_str()), 1;
    const auto engine = compute::make_cpu_engine(std::move(*block), pool);
    compute::Surface surface(engine->solid().lattice);
    surface.mesh_all(engine->solid(), pool);

    // A ball of 5 mm along the top: its middle in the top's plane, so the groove is 5 mm deep.
    const compute::BallSweep groove{{0.01, 0.04, 0.02}, {0.03, 0.04, 0.02}, 0.005};
    if (const auto carved = engine->carve({&groove, 1}); !carved) return 1;
    surface.update(engine->solid(), engine->take_changes(), pool);
    std::printf("%.0f mm3 left\n", 1e9 * surface.volume_m3());

    geometry::LocalSurface near;  // what the tick touches
    near.sequence = 1;
    compute::gather_local_surface(surface, {0.02, 0.035, 0.02}, 0.02, near);
    haptics::TickParameters parameters;
    parameters.sequence = 1;
    parameters.workspace.object_from_device = {};
    parameters.probe = haptics::ball_probe(0.001);
    parameters.max_surface_age_s = 0.0;
    const devices::DeviceDescription device{.max_force_N = 3.3};
    haptics::FullTickState state;
    for (int i = 1; i <= 1000; ++i) {  // a second: 12 mm down, from 6 mm above the top
        devices::DeviceSample hand;
        hand.time_ns = i * Nanoseconds{1'000'000};
        hand.position_device_m = {0.02, 0.046 - 0.012e-3 * i, 0.02};
        const haptics::FullTick tick = haptics::full_tick(state, hand, near, parameters, device, hand.time_ns, 0.001);
        state = tick.next;
        const double given_N = tick.record.gate.given.force_device_N.y;
        if (i % 250 == 0) std::printf("at %.1f mm: %.2f N\n", 1e3 * hand.position_device_m.y, given_N);
    }
}
