// SPDX-License-Identifier: MIT
#include "app/felt_stroke.hpp"

#include <algorithm>
#include <cstdio>

#include "app/felt_carving.hpp"
#include "app/felt_hand.hpp"
#include "app/progress.hpp"
#include "devices/simulated_omni.hpp"
#include "haptics/haptic_loop.hpp"
#include "haptics/realtime.hpp"

namespace burin {
namespace {

constexpr Nanoseconds kUpdatePeriod_ns = 10'000'000;  // 100 carving updates a second

// Asks the workpiece as it is before the stroke.
Result<SimulatedHand> pressing_hand(Carving& carving, const Stroke& stroke, const Tool& tool, const Feel& feel,
                                    const Similarity& object_from_device) {
    const double radius_m = tool.ball_radius_m();
    LocalSurface surface;
    Result<void> asked;
    const auto into_material = [&](const Vec3& place) {
        if (const auto done = carving.local_surface(place, 2.0 * radius_m, surface); !done) asked = done;
        return engagement(surface, place, radius_m).engagement.into_object;
    };
    Result<SimulatedHand> hand = hand_along(stroke, object_from_device, feel, into_material);
    if (!asked) return std::unexpected(asked.error());
    return hand;
}

LoopTimes times_of(const HapticLoop& loop) {
    const auto us = [](const Histogram& of, double q) { return static_cast<double>(of.quantile_ns(q)) * 1e-3; };
    const Histogram &late = loop.lateness(), &tick = loop.duration();
    return {true,          loop.skipped_deadlines(), us(late, 0.5),   us(late, 0.99), us(late, 0.999), us(late, 1.0),
            us(tick, 0.5), us(tick, 0.99),           us(tick, 0.999), us(tick, 1.0)};
}

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
    FigureKeeper keeper(session.figures, session.end_s, seconds(loop.period_ns()));
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
    keeper.finish(session.channels);
    return {};
}

Result<void> run_in_real_time(const Session& session, SimulatedHand hand) {
    MonotonicClock clock;
    const Nanoseconds start_ns = clock.now_ns();
    SimulatedOmni omni(std::move(hand), {}, &clock);
    HapticLoop loop(omni, clock, session.channels);
    FigureKeeper keeper(session.figures, session.end_s, seconds(loop.period_ns()));
    Progress progress("carving by feel, in real time");
    if (const auto published = session.side.publish(start_ns); !published) return published;
    HapticThread haptic_thread(loop);
    const RealtimeNotice notice = haptic_thread.start();
    if (!notice.text.empty()) {
        session.figures.notices.push_back(notice.text);
        std::fprintf(stderr, "burin: %s\n", notice.text.c_str());
    }
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
    session.figures.loop = times_of(loop);
    keeper.take(session.channels);
    keeper.finish(session.channels);
    return outcome;
}

}  // namespace

Result<FeltFigures> carve_by_feel(Carving& carving, const Stroke& stroke, const Tool& tool,
                                  const FeltOptions& options) {
    FeltFigures figures;
    figures.workspace_device_m = OmniModel{}.workspace_m;
    figures.object_from_device = fit_into_workspace(stroke, figures.workspace_device_m);
    figures.duration_s = stroke.back().time_s - stroke.front().time_s + 2.0 * kHandRests_s;
    Result<SimulatedHand> hand = pressing_hand(carving, stroke, tool, options.feel, figures.object_from_device);
    if (!hand) return std::unexpected(hand.error());

    HapticChannels channels;
    TickParameters& parameters = channels.parameters.draft();
    parameters.sequence = 1;
    parameters.workspace.object_from_device = figures.object_from_device;
    parameters.probe = ball_probe(tool.ball_radius_m());
    parameters.materials.fill(options.feel.material);
    parameters.action = action_of(tool.operation);
    channels.parameters.publish();

    // Far enough for the fastest hand to stay inside the known ball until the next update: 1 m/s for 12 ms.
    const double reach_m = 0.012 * figures.object_from_device.scale + 2.0 * carving.surface().lattice().spacing_m;
    CarvingSide side(carving, channels, tool, options.feel.material.hardness_Ns_per_m3, reach_m);
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
