// SPDX-License-Identifier: MIT
// Times the ticks of the haptic loop on a solid that is carved, and on a groove that fits the tool.
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>

#include "base/try.hpp"
#include "bench/haptics/touch_run.hpp"
#include "haptics/channels.hpp"
#include "sculpt/carved_scene.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/felt_tool.hpp"

namespace burin::bench {
namespace {

constexpr double kTools_m[] = {0.002, 0.005};
constexpr Nanoseconds kCarvingUpdate_ns = 10'000'000;

// A ball of 100 mm of the medium material, as a session carves it, without undo and light.
class CarvedBall {
public:
    static Result<std::unique_ptr<CarvedBall>> create(int resolution) {
        BURIN_TRY(solid, compute::make_ball(BumpySphere{}.radius_m, resolution, geometry::Material{}));
        return std::unique_ptr<CarvedBall>(new CarvedBall(std::move(solid)));
    }
    [[nodiscard]] sculpt::Sculpture& sculpture() { return sculpture_; }
    [[nodiscard]] double cell_m() const { return sculpture_.surface().lattice().spacing_m; }

private:
    explicit CarvedBall(compute::Solid solid) : sculpture_(compute::make_cpu_engine(std::move(solid), pool_), pool_) {}

    WorkerPool pool_{1};
    sculpt::Sculpture sculpture_;
};

Result<PressedWalk> path_over_ball(double tool_m, double depth_m) {
    const BumpySphere ball{.bumps = 0.0};
    return PressedWalk::create(mesh_of(ball, 40), {.depth_m = depth_m, .above_m = tool_m + 0.005});
}

toolbox::Tool ball_tool(double radius_m) {
    toolbox::Tool tool;
    tool.shape = compute::BallTool{radius_m};
    return tool;
}

// Updates a hundred times a second, concurrently with the paced ticks.
class CarvingThread {
public:
    explicit CarvingThread(sculpt::CarvedScene& service) : thread_([this, &service] { work(service); }) {}
    ~CarvingThread() { static_cast<void>(stop()); }
    Result<void> stop() {
        stop_.store(true, std::memory_order_relaxed);  // relaxed: it only ends the loop; join orders the rest
        if (thread_.joinable()) thread_.join();
        return failure_;
    }

private:
    void work(sculpt::CarvedScene& service) {
        // The thread that creates this one may have a real-time priority; carving must not.
        const sched_param none{};
        pthread_setschedparam(pthread_self(), SCHED_OTHER, &none);
        MonotonicClock clock;
        Nanoseconds next_ns = clock.now_ns();
        while (failure_ && !stop_.load(std::memory_order_relaxed)) {
            failure_ = service.update(clock.now_ns());
            next_ns = std::max(next_ns + kCarvingUpdate_ns, clock.now_ns());
            clock.sleep_until(next_ns);
        }
    }
    Result<void> failure_;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

struct Carving {
    CarvedBall& ball;
    int resolution;
    double tool_m;
    Pacing pacing;
};

TickCosts& costs_of(Haptics& all, const std::string& scene, const Carving& of) {
    TickCosts& costs = all.ticks.emplace_back();
    costs.scene = scene + "_" + std::to_string(of.resolution);
    costs.probe = "ball_" + std::to_string(static_cast<int>(1e3 * of.tool_m + 0.5)) + "_mm";
    costs.pacing = name_of(of.pacing);
    costs.radius_m = of.tool_m, costs.mean_edge_m = of.ball.cell_m();
    costs.triangles = of.ball.sculpture().surface().triangles();
    return costs;
}

std::uint64_t ticks_of(const Haptics& all, Pacing pacing) {
    return pacing == Pacing::back_to_back ? all.options.back_to_back_ticks : all.options.paced_ticks;
}

// The tool cuts while the hand moves.
Result<void> touch_while_carving(Haptics& all, const Carving& of) {
    BURIN_TRY(path, path_over_ball(of.tool_m, 0.0015));
    MonotonicClock clock;
    TickCosts& costs = costs_of(all, "carving", of);
    haptics::TickParameters parameters = session_parameters(haptics::ball_probe(of.tool_m), true);
    parameters.tool = toolbox::felt_tool(compute::BallTool{of.tool_m}).surface;
    TouchRun run(costs, clock, parameters, path, true);
    const double reach_m = 0.012 + 2.0 * of.ball.cell_m();  // as a session: 1 m/s for 12 ms
    sculpt::CarvedScene service(of.ball.sculpture(), run.channels(), ball_tool(of.tool_m),
                                parameters.materials[0].hardness_Ns_per_m3, reach_m, {});
    service.start_at(path.hip_m());
    Result<void> done = service.update(clock.now_ns());
    if (of.pacing != Pacing::back_to_back) {
        CarvingThread thread(service);
        run.take(ticks_of(all, of.pacing), of.pacing, [](Nanoseconds) {});
        return thread.stop();
    }
    run.take(ticks_of(all, of.pacing), of.pacing, [&](Nanoseconds now_ns) {
        if (done) done = service.update(now_ns);
    });
    return done;
}

constexpr double kGroove_m = 0.0015, kDeeper_m = 0.001;

// Carves along the path that is to be touched.
Result<void> carve_groove(const Haptics& all, CarvedBall& ball, double tool_m) {
    BURIN_TRY(path, path_over_ball(tool_m, kGroove_m));
    const std::uint64_t ticks = std::max(all.options.paced_ticks, all.options.back_to_back_ticks);
    std::vector<Pose> poses;
    for (std::uint64_t pressed = 0; pressed < ticks || !poses.empty();) {
        path.step();
        if (path.lifted() && poses.size() > 1) {
            const auto sweeps = toolbox::sweeps_along(poses, ball_tool(tool_m), 0.05 * ball.cell_m());
            BURIN_TRY_DO(ball.sculpture().update(sweeps));
            poses.clear();
            if (pressed >= ticks) break;
        }
        if (path.pressed()) ++pressed;
        if (!path.lifted()) poses.push_back({path.hip_m()});
    }
    return {};
}

// The hand presses a millimetre deeper along the groove that the same tool has cut, and does not cut.
Result<void> touch_groove(Haptics& all, const Carving& of) {
    BURIN_TRY(path, path_over_ball(of.tool_m, kGroove_m + kDeeper_m));
    MonotonicClock clock;
    TickCosts& costs = costs_of(all, "groove", of);
    TouchRun run(costs, clock, session_parameters(haptics::ball_probe(of.tool_m), true), path, false);
    std::uint64_t sequence = 0;
    run.take(ticks_of(all, of.pacing), of.pacing, [&](Nanoseconds now_ns) {
        geometry::LocalSurface& draft = run.channels().surface.draft();
        const double reach_m = of.tool_m + 0.012 + 2.0 * of.ball.cell_m();
        of.ball.sculpture().local_surface(run.path().hip_m(), reach_m, draft);
        draft.sequence = ++sequence, draft.made_ns = now_ns;
        run.channels().surface.publish();
    });
    return {};
}

Result<void> measure_with(Haptics& all, int resolution, double tool_m, const Tell& notify) {
    const std::string what = std::to_string(resolution) + " cells, a ball of " +
                             std::to_string(static_cast<int>(1e3 * tool_m + 0.5)) + " mm";
    for (const Pacing pacing : {Pacing::cold, Pacing::rehearsed, Pacing::back_to_back}) {
        const auto ball = CarvedBall::create(resolution);  // every pacing carves a fresh one
        if (!ball) return std::unexpected(ball.error());
        notify("ticks under carving, " + what + ", " + name_of(pacing));
        BURIN_TRY_DO(touch_while_carving(all, {**ball, resolution, tool_m, pacing}));
    }
    BURIN_TRY(ball, CarvedBall::create(resolution));
    notify("ticks in a groove, " + what);
    BURIN_TRY_DO(carve_groove(all, *ball, tool_m));
    for (const Pacing pacing : {Pacing::cold, Pacing::rehearsed, Pacing::back_to_back})
        BURIN_TRY_DO(touch_groove(all, {*ball, resolution, tool_m, pacing}));
    return {};
}

}  // namespace

Result<void> measure_carving_ticks(Haptics& all, const Tell& notify) {
    for (const int resolution : all.options.solid_resolutions)
        for (const double tool_m : kTools_m) BURIN_TRY_DO(measure_with(all, resolution, tool_m, notify));
    return {};
}

}  // namespace burin::bench
