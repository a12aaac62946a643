// SPDX-License-Identifier: MIT
#include "app/session/thread_replay.hpp"

namespace burin {
namespace {

// The one of this sequence; those before it are not asked for again.
template <typename T>
const T* seen(std::deque<T>& values, std::uint64_t sequence) {
    while (!values.empty() && values.front().sequence < sequence) values.pop_front();
    return !values.empty() && values.front().sequence == sequence ? &values.front() : nullptr;
}

}  // namespace

ThreadReplay::ThreadReplay(LiveSession& session, const ThreadLog& log, const std::string& name)
    : session_(session),
      log_(log),
      name_(name),
      tick_lines_(log.clock, log.ticks),
      update_lines_(log.clock, log.updates) {
    keep_surface();
    tools_.push_back(session_.newest_tool());
}

// ---- Frames

Result<ToolState> ThreadReplay::tool_of(const FrameSeen& frame) {
    keep_parameters();
    if (const auto run = run_ticks(frame.tick); !run) return std::unexpected(run.error());
    while (tools_.size() > 1 && tools_[1].tick <= frame.tick) tools_.pop_front();
    return tools_.front();
}

Result<std::optional<SurfaceNews>> ThreadReplay::news_of(const FrameSeen& frame) {
    keep_parameters();
    if (const auto run = run_updates(frame.updates); !run) return std::unexpected(run.error());
    std::optional<SurfaceNews> news;
    for (; !news_.empty() && news_.front().first <= frame.updates; news_.pop_front())
        add(news, std::move(news_.front().second));
    return news;
}

bool ThreadReplay::is_as_recorded(const FrameSeen& frame) {
    return check_.frame(frame.tick, session_.state()) == frame.check;
}

Result<std::optional<SurfaceNews>> ThreadReplay::finish() {
    FrameSeen last;
    last.tick = log_.ticks.count;
    last.updates = log_.updates.count;
    auto news = news_of(last);
    if (!news) return news;
    if (const auto tool = tool_of(last); !tool) return std::unexpected(tool.error());
    return news;
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
    const TickSeen tick = *tick_lines_.next();  // the log has counted them
    const std::size_t line = tick_lines_.line();
    const std::string what = "tick " + std::to_string(ticks_ + 1) + " saw ";
    ticking_ = ticks_ + 1;
    if (updating_ && tick.surface_sequence > updates_ + 1)
        return contradiction(line, what + "a surface for which its own sample was needed");
    // The first surface was there before the first update.
    if (!updating_ && tick.surface_sequence > 0) {
        if (const auto run = run_updates(tick.surface_sequence - 1); !run) return run;
    }
    const LocalSurface* surface = seen(surfaces_, tick.surface_sequence);
    if (surface == nullptr)
        return contradiction(
            line, what + "surface " + std::to_string(tick.surface_sequence) + ", which there is not, or is no more");
    const TickParameters* parameters = seen(parameters_, tick.parameter_sequence);
    if (parameters == nullptr)
        return contradiction(
            line, what + "parameters " + std::to_string(tick.parameter_sequence) + ", which no frame has set by then");
    HapticLoop& loop = session_.loop();
    // How late is only told; late is what begins after half a period.
    check_.tick(loop.repeat(tick.sample, *surface, *parameters, tick.time_ns, tick.late ? loop.period_ns() : 0));
    tools_.push_back(session_.newest_tool());
    ++ticks_;
    ticking_ = 0;
    return {};
}

void ThreadReplay::keep_parameters() {
    const TickParameters& newest = session_.channels().parameters.newest();
    if (parameters_.empty() || parameters_.back().sequence < newest.sequence) parameters_.push_back(newest);
}

// ---- Updates

Result<void> ThreadReplay::run_updates(std::uint64_t last) {
    if (last > log_.updates.count) return ends("update " + std::to_string(last) + " of the carving side");
    while (updates_ < last) {
        if (const auto run = run_update(); !run) return run;
    }
    return {};
}

Result<void> ThreadReplay::run_update() {
    const UpdateSeen update = *update_lines_.next();
    updating_ = true;
    const std::size_t line = update_lines_.line();
    const std::string what = "update " + std::to_string(updates_ + 1) + " took ";
    if (ticking_ > 0 && update.last_tick >= ticking_)
        return contradiction(line, what + "the sample of a tick that saw its surface");
    if (const auto run = run_ticks(update.last_tick); !run) return run;
    if (update.orders > orders_.size())
        return contradiction(line, what + std::to_string(update.orders) + " orders of " +
                                       std::to_string(orders_.size()) + " that there were");
    for (std::size_t i = 0; i < update.orders; ++i) {
        session_.desk().order(orders_.front());
        orders_.pop_front();
    }
    if (const auto updated = session_.desk().repeat(update); !updated) return updated;
    news_.emplace_back(++updates_, session_.desk().take_news());
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

}  // namespace burin
