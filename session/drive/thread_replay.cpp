// SPDX-License-Identifier: MIT
#include "session/drive/thread_replay.hpp"

namespace burin::session {
namespace {

// Returns the value with this sequence, or null. Drops earlier ones, which are not asked for again.
template <typename T>
const T* seen(std::deque<T>& values, std::uint64_t sequence) {
    while (!values.empty() && values.front().sequence < sequence) values.pop_front();
    return !values.empty() && values.front().sequence == sequence ? &values.front() : nullptr;
}

}  // namespace

Result<std::unique_ptr<LiveSession>> open_as_recorded(const SculptOptions& options, const SessionWall& wall,
                                                      const ThreadLog& log, const std::string& name,
                                                      SimulatedClock& clock) {
    clock.sleep_until(log.clock.start_ns);
    auto session = LiveSession::create(options, wall, clock, log.clock.pace);
    if (!session) return session;
    const Nanoseconds period_ns = (*session)->loop().period_ns();
    if (log.clock.period_ns == period_ns) return session;
    return fail(name,
                "its ticks are " + std::to_string(log.clock.period_ns) + " ns apart, this device's " +
                    std::to_string(period_ns),
                "replay it with the device that it was recorded with");
}

ThreadReplay::ThreadReplay(LiveSession& session, const ThreadLog& log, const std::string& name)
    : session_(session),
      log_(log),
      name_(name),
      tick_lines_(log.clock, log.ticks),
      update_lines_(log.clock, log.updates) {
    end_.tick = log.ticks.count;
    end_.updates = log.updates.count;
    keep_surface();
    tools_.push_back(session_.newest_tool());
}

// ---- Frames

Result<void> ThreadReplay::advance_to(Nanoseconds) {
    keep_parameters();
    if (const auto run = run_ticks(frame_->tick); !run) return run;
    while (tools_.size() > 1 && tools_[1].tick <= frame_->tick) tools_.pop_front();
    return {};
}

Result<Executor::Taken> ThreadReplay::take_updates() {
    keep_parameters();
    if (const auto run = run_updates(frame_->updates); !run) return std::unexpected(run.error());
    return Taken{{}, frame_->updates};
}

bool ThreadReplay::is_as_recorded() { return check_.frame(frame_->tick, words_of(session_.state())) == frame_->check; }

Result<void> ThreadReplay::run_to_end() {
    begin_frame(end_);
    keep_parameters();
    if (const auto run = run_updates(end_.updates); !run) return run;
    return run_ticks(end_.tick);
}

// ---- Ticks

Result<void> ThreadReplay::run_ticks(std::uint64_t last) {
    if (last > log_.ticks.count) return ends("tick " + std::to_string(last));
    while (ticks_ < last) {
        if (const auto run = run_tick(); !run) return run;
    }
    return {};
}

Result<void> ThreadReplay::run_tick() {
    TickSeen tick = *tick_lines_.next();  // the count was checked
    const std::size_t line = tick_lines_.line();
    const std::string what = "tick " + std::to_string(ticks_ + 1) + " saw ";
    ticking_ = ticks_ + 1;
    if (updating_ && tick.surface_sequence > updates_ + 1)
        return contradiction(line, what + "a surface for which its own sample was needed");
    // The first surface existed before the first update.
    if (!updating_ && tick.surface_sequence > 0) {
        if (const auto run = run_updates(tick.surface_sequence - 1); !run) return run;
    }
    const geometry::LocalSurface* surface = seen(surfaces_, tick.surface_sequence);
    if (surface == nullptr)
        return contradiction(
            line, what + "surface " + std::to_string(tick.surface_sequence) + ", which there is not, or is no more");
    const haptics::TickParameters* parameters = seen(parameters_, tick.parameter_sequence);
    if (parameters == nullptr)
        return contradiction(
            line, what + "parameters " + std::to_string(tick.parameter_sequence) + ", which no frame has set by then");
    haptics::HapticLoop& loop = session_.loop();
    // The log holds only whether a tick was late, not by how much; a tick counts as late from half a period on.
    Nanoseconds lateness_ns = tick.late ? loop.period_ns() : 0;
    if (const auto known = witness_ != nullptr ? witness_->known(ticks_ + 1) : std::nullopt) {
        tick.sample.joints = known->joints;
        lateness_ns = known->lateness_ns;
    }
    const haptics::TickRecord again = loop.repeat(tick.sample, *surface, *parameters, tick.time_ns, lateness_ns);
    check_.tick(again);
    tools_.push_back(session_.newest_tool());
    ++ticks_;
    ticking_ = 0;
    return witness_ != nullptr ? witness_->take(again) : Result<void>{};
}

void ThreadReplay::keep_parameters() {
    const haptics::TickParameters& newest = session_.channels().parameters.newest();
    if (parameters_.empty() || parameters_.back().sequence < newest.sequence) parameters_.push_back(newest);
}

// ---- Updates

Result<void> ThreadReplay::run_updates(std::uint64_t last) {
    if (last > log_.updates.count) return ends("update " + std::to_string(last) + " of the scene");
    while (updates_ < last) {
        if (const auto run = run_update(); !run) return run;
    }
    return {};
}

Result<void> ThreadReplay::run_update() {
    const scene::SceneUpdate update = *update_lines_.next();
    updating_ = true;
    const std::size_t line = update_lines_.line();
    const std::string what = "update " + std::to_string(updates_ + 1) + " took ";
    // A session has one hand, so far.
    const std::uint64_t last_tick = update.last_ticks.empty() ? 0 : update.last_ticks.front();
    if (ticking_ > 0 && last_tick >= ticking_)
        return contradiction(line, what + "the sample of a tick that saw its surface");
    if (const auto run = run_ticks(last_tick); !run) return run;
    if (update.orders > orders_.size())
        return contradiction(line, what + std::to_string(update.orders) + " orders of " +
                                       std::to_string(orders_.size()) + " that there were");
    for (std::size_t i = 0; i < update.orders; ++i) {
        orders_.front()();
        orders_.pop_front();
    }
    if (const auto updated = session_.scene().repeat(update); !updated) return updated;
    ++updates_;
    session_.collect({});
    updating_ = false;
    keep_surface();
    return {};
}

void ThreadReplay::keep_surface() { surfaces_.push_back(session_.channels().surface.newest()); }

// ---- Errors

std::unexpected<Error> ThreadReplay::ends(const std::string& what) {
    log_ends_ = true;
    return fail(name_, "the recording ends before " + what + ", which its last frames need",
                "it was torn off; what comes before is replayed");
}

std::unexpected<Error> ThreadReplay::contradiction(std::size_t line, const std::string& what) const {
    return fail(
        name_ + ":" + std::to_string(line), what,
        "the file was changed: replay it as it was recorded, or take out what the threads did (docs/formats.md)");
}

}  // namespace burin::session
