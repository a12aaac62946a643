// SPDX-License-Identifier: MIT
#include "app/session/scripted_session.hpp"

#include "app/session/carving_thread.hpp"
#include "app/session/live_session.hpp"
#include "app/session/session_stage.hpp"

namespace burin {

Result<void> run_in_simulated_time(const SculptOptions& options, const SessionWall& wall, InputSource input) {
    SimulatedClock clock;
    auto session = LiveSession::create(options, wall, clock);
    if (!session) return std::unexpected(session.error());
    Result<SessionStage> stage = SessionStage::open(options.live, wall);
    if (!stage) return std::unexpected(stage.error());
    LiveSession& s = **session;
    if (auto news = s.desk().take_news()) s.take(std::move(*news));
    Nanoseconds next_update_ns = CarvingThread::kPeriod_ns;
    while (const auto frame = input.begin_frame(0, 0)) {
        while (clock.now_ns() + s.loop().period_ns() <= frame->time_ns) {
            clock.sleep_until(clock.now_ns() + s.loop().period_ns());
            s.loop().step();
            if (clock.now_ns() < next_update_ns) continue;
            if (const auto updated = s.desk().update(clock.now_ns()); !updated) return updated;
            next_update_ns += CarvingThread::kPeriod_ns;
        }
        stage->look();
        s.step(*frame, stage->place(), s.newest_tool(), [&](CarvingOrder order) {
            s.desk().order(order);
            s.desk().finish_export();  // so that what comes after finds it done
        });
        if (auto news = s.desk().take_news()) s.take(std::move(*news));
        if (stage->shows()) static_cast<void>(stage->inputs(0.0));  // the script has the say
        // Without an output nobody sees a frame that is not photographed.
        if (stage->shows() || s.wants_screenshots()) {
            if (const auto drawn = stage->draw(s, frame->display_ns); !drawn) return std::unexpected(drawn.error());
        }
        if (s.state().quit) break;
    }
    return {};
}

}  // namespace burin
