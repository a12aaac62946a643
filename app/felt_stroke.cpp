// SPDX-License-Identifier: MIT
#include "app/felt_stroke.hpp"

#include <algorithm>
#include <iterator>

#include "app/progress.hpp"
#include "devices/simulated_omni.hpp"
#include "haptics/haptic_loop.hpp"
#include "haptics/realtime.hpp"

namespace burin {
namespace {

constexpr Nanoseconds kUpdatePeriod_ns = 10'000'000;  // 100 carving updates a second
constexpr double kRest_s = 0.3;           // the hand rests before and after the stroke: the gate's ramp must be over
constexpr double kBorder_m = 0.008;       // of the workspace, kept free: the surface pushes the hand off its path
constexpr double kSweepTolerance = 0.05;  // of a cell

Similarity fit_into_workspace(const Stroke& stroke, const Vec3& workspace_m) {
    Box bounds;
    for (const StrokeRow& row : stroke) bounds.include(row.position_object_m);
    const Vec3 needed = bounds.extent() / (workspace_m - Vec3(2.0 * kBorder_m));
    return {bounds.center(), Quat{1, 0, 0, 0}, std::max({1.0, needed.x, needed.y, needed.z})};
}

Result<SimulatedHand> hand_along(const Stroke& stroke, const Similarity& object_from_device) {
    const Similarity device_from_object = inverse(object_from_device);
    std::vector<HandPose> script;
    script.reserve(stroke.size() + 1);
    const auto pose = [&](const StrokeRow& row, double time_s) {
        return HandPose{time_s, device_from_object * row.position_object_m, row.orientation_object,
                        row.button ? 1u : 0u};
    };
    script.push_back(pose(stroke.front(), 0.0));
    script.back().buttons = 0;
    for (const StrokeRow& row : stroke) script.push_back(pose(row, row.time_s - stroke.front().time_s + kRest_s));
    return SimulatedHand::create(std::move(script));
}

// The carving side of the channels: stroke samples in, surfaces out.
class CarvingSide {
public:
    CarvingSide(Carving& carving, HapticChannels& channels, const Tool& tool, double reach_m)
        : carving_(carving), channels_(channels), tool_(tool), reach_m_(reach_m) {}

    Result<void> update(Nanoseconds now_ns) {
        const std::vector<ToolSweep> sweeps = drain();
        if (!sweeps.empty()) {
            if (const auto updated = carving_.update(sweeps); !updated) return updated;
        }
        return publish(now_ns);
    }

    Result<void> publish(Nanoseconds now_ns) {
        LocalSurface& surface = channels_.surface.draft();
        const double radius_m = tool_.ball_radius_m() + reach_m_;
        if (const auto done = carving_.local_surface(tool_position_, radius_m, surface); !done) return done;
        surface.sequence = ++sequence_;
        surface.made_ns = now_ns;
        channels_.surface.publish();
        return {};
    }

    void start_at(const Vec3& position_object) { tool_position_ = position_object; }
    [[nodiscard]] std::uint64_t published() const { return sequence_; }

private:
    // What the working tool has swept since the last update.
    std::vector<ToolSweep> drain() {
        std::vector<ToolSweep> sweeps;
        std::vector<Pose> run;    // where the tool was, from press to release
        bool goes_on = pressed_;  // the run began before this update: its first point has been cut already
        if (goes_on) run.push_back({last_point_});
        const auto end_run = [&] {
            if (run.size() >= 2 || (run.size() == 1 && !goes_on)) {
                std::ranges::copy(sweeps_along(run, tool_, tolerance_m()), std::back_inserter(sweeps));
            }
            run.clear();
            goes_on = false;
        };
        StrokeSample sample;
        while (channels_.stroke.pop(sample)) {
            tool_position_ = sample.position_object_m;
            pressed_ = (sample.buttons & 1u) != 0;
            if (!pressed_) {
                end_run();
                continue;
            }
            last_point_ = sample.position_object_m;
            if (run.empty() || run.back().position_m != last_point_) run.push_back({last_point_});
        }
        end_run();
        return sweeps;
    }

    [[nodiscard]] double tolerance_m() const { return kSweepTolerance * carving_.surface().lattice().spacing_m; }

    Carving& carving_;
    HapticChannels& channels_;
    Tool tool_;
    double reach_m_;
    Vec3 tool_position_{0.0}, last_point_{0.0};
    bool pressed_ = false;
    std::uint64_t sequence_ = 0;
};

// What the tick records say, added up.
class FigureKeeper {
public:
    explicit FigureKeeper(FeltFigures& figures) : figures_(figures) {}

    void take(HapticChannels& channels) {
        TickRecord record;
        while (channels.records.pop(record)) add(record);
    }

    void finish() {
        if (figures_.ticks_in_contact > 0) {
            figures_.force_mean_in_contact_N = force_sum_N_ / static_cast<double>(figures_.ticks_in_contact);
        }
    }

private:
    void add(const TickRecord& record) {
        ++figures_.ticks;
        const double force_N = glm::length(record.given.force_device_N);
        figures_.force_max_N = std::max(figures_.force_max_N, force_N);
        if ((record.flags & kTickInContact) != 0) {
            ++figures_.ticks_in_contact;
            force_sum_N_ += force_N;
            figures_.penetration_max_m = std::max(figures_.penetration_max_m, record.penetration_m);
        }
        if ((record.flags & kTickLate) != 0) ++figures_.ticks_late;
        if ((record.flags & kTickSampleDropped) != 0) ++figures_.samples_dropped;
        if (record.cause != GateCause::none) ++figures_.zero_force_ticks[text(record.cause)];
    }

    FeltFigures& figures_;
    double force_sum_N_ = 0.0;
};

struct Session {
    Carving& carving;
    HapticChannels& channels;
    CarvingSide& side;
    FeltFigures& figures;
    double end_s;
};

Result<void> run_in_simulated_time(const Session& session, SimulatedHand hand) {
    SimulatedClock clock;
    SimulatedOmni omni(std::move(hand), {}, &clock);
    HapticLoop loop(omni, clock, session.channels);
    FigureKeeper keeper(session.figures);
    MonotonicClock stopwatch;
    Progress progress("carving by feel");
    if (const auto published = session.side.publish(clock.now_ns()); !published) return published;
    Nanoseconds next_update_ns = kUpdatePeriod_ns;
    while (seconds(clock.now_ns()) < session.end_s) {
        clock.sleep_until(clock.now_ns() + loop.period_ns());
        const Nanoseconds before_ns = stopwatch.now_ns();
        loop.step();
        session.figures.tick_ns.push_back(static_cast<std::uint32_t>(stopwatch.now_ns() - before_ns));
        if (clock.now_ns() < next_update_ns) continue;
        if (const auto updated = session.side.update(clock.now_ns()); !updated) return updated;
        keeper.take(session.channels);
        next_update_ns += kUpdatePeriod_ns;
        progress.show(seconds(clock.now_ns()) / session.end_s);
    }
    keeper.take(session.channels);
    keeper.finish();
    return {};
}

Result<void> run_in_real_time(const Session& session, SimulatedHand hand) {
    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    SimulatedOmni omni(std::move(hand), {}, &clock);
    HapticLoop loop(omni, clock, session.channels);
    FigureKeeper keeper(session.figures);
    Progress progress("carving by feel, in real time");
    if (const auto published = session.side.publish(start_ns); !published) return published;
    HapticThread haptic_thread(loop);
    const RealtimeNotice notice = haptic_thread.start();
    if (!notice.text.empty()) session.figures.notices.push_back(notice.text);
    Result<void> outcome;
    Nanoseconds next_update_ns = start_ns;
    while (seconds(clock.now_ns() - start_ns) < session.end_s && outcome) {
        next_update_ns = std::max(next_update_ns + kUpdatePeriod_ns, clock.now_ns());
        clock.sleep_until(next_update_ns);
        outcome = session.side.update(clock.now_ns());
        keeper.take(session.channels);
        progress.show(seconds(clock.now_ns() - start_ns) / session.end_s);
    }
    haptic_thread.stop();
    keeper.take(session.channels);
    keeper.finish();
    return outcome;
}

}  // namespace

Result<FeltFigures> carve_by_feel(Carving& carving, const Stroke& stroke, const Tool& tool,
                                  const FeltOptions& options) {
    FeltFigures figures;
    figures.workspace_device_m = OmniModel{}.workspace_m;
    figures.object_from_device = fit_into_workspace(stroke, figures.workspace_device_m);
    figures.duration_s = stroke.back().time_s - stroke.front().time_s + 2.0 * kRest_s;
    Result<SimulatedHand> hand = hand_along(stroke, figures.object_from_device);
    if (!hand) return std::unexpected(hand.error());

    HapticChannels channels;
    TickParameters& parameters = channels.parameters.draft();
    parameters.sequence = 1;
    parameters.workspace.object_from_device = figures.object_from_device;
    parameters.probe.points[0].radius_m = tool.ball_radius_m();
    channels.parameters.publish();

    // Far enough for the fastest hand to stay inside the known ball until the next update: 1 m/s for 12 ms.
    const double reach_m = 0.012 * figures.object_from_device.scale + 2.0 * carving.surface().lattice().spacing_m;
    CarvingSide side(carving, channels, tool, reach_m);
    side.start_at(stroke.front().position_object_m);
    const Session session{carving, channels, side, figures, figures.duration_s};
    const auto ran = options.real_time ? run_in_real_time(session, std::move(*hand))
                                       : run_in_simulated_time(session, std::move(*hand));
    if (!ran) return std::unexpected(ran.error());
    figures.surfaces_published = side.published();
    figures.last_tool = channels.tool.newest();
    return figures;
}

}  // namespace burin
