// SPDX-License-Identifier: MIT
#include "session/drive/thread_replay.hpp"

#include "base/try.hpp"
#include "geometry/contact/local_surface.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "haptics/tick_parameters.hpp"
#include "session/drive/thread_recorder.hpp"
#include "session/drive/tick_witness.hpp"
#include "session/live/session.hpp"
#include "session/record/tick_source.hpp"

#include <algorithm>
#include <utility>

namespace burin::session {
namespace {

// Returns the value with this sequence, or null. Drops earlier ones, which are not asked for again.
template <typename T>
const T* seen(std::deque<T>& values, std::uint64_t sequence) {
    while (!values.empty() && values.front().sequence < sequence) values.pop_front();
    return !values.empty() && values.front().sequence == sequence ? &values.front() : nullptr;
}

}  // namespace

Result<void> check_rate(Session& session, const ThreadLog& log, const std::string& name) {
    const Nanoseconds period_ns = session.loop().period_ns();
    if (log.clock.period_ns == period_ns) return {};
    return fail(name,
                "its ticks are " + std::to_string(log.clock.period_ns) + " ns apart, this device's " +
                    std::to_string(period_ns),
                "replay it with the device that it was recorded with");
}

struct ThreadReplay::Part {
    std::optional<TickSeen> next;                 // of the turn in progress
    std::deque<geometry::LocalSurface> surfaces;  // that ticks may still see, by sequence
    std::deque<haptics::TickParameters> parameters;
    std::deque<haptics::ToolState> tools;  // after each tick that frames may still see
};

ThreadReplay::ThreadReplay(Session& session, const ThreadLog& log, std::unique_ptr<TickSource> ticks,
                           const std::string& name)
    : session_(session),
      log_(log),
      name_(name),
      ticks_source_(std::move(ticks)),
      update_lines_(log.clock, log.updates),
      parts_(session.hands().parts()),
      check_(session.hands().parts()) {
    keep_surfaces();
    for (std::size_t part = 0; part < parts_.size(); ++part)
        parts_[part].tools.push_back(session_.hands().newest_tool(part));
}

ThreadReplay::~ThreadReplay() = default;

// ---- Frames

Result<void> ThreadReplay::advance_to(Nanoseconds) {
    keep_parameters();
    BURIN_TRY_DO(run_turns(std::ranges::max(frame_->ticks)));
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        std::deque<haptics::ToolState>& tools = parts_[i].tools;
        while (tools.size() > 1 && tools[1].tick <= frame_->ticks[i]) tools.pop_front();
    }
    return {};
}

std::vector<haptics::ToolState> ThreadReplay::tools() {
    std::vector<haptics::ToolState> tools;
    for (const Part& part : parts_) tools.push_back(part.tools.front());
    return tools;
}

Result<Executor::Taken> ThreadReplay::take_updates() {
    keep_parameters();
    BURIN_TRY_DO(run_updates(frame_->updates));
    return Taken{{}, frame_->updates};
}

bool ThreadReplay::is_as_recorded(const StateWords& words) {
    const bool same = check_.frame(frame_->ticks, words) == frame_->check;
    const std::uint64_t activity = session_.activity().check();
    return same && frame_->activity.value_or(activity) == activity;
}

Result<void> ThreadReplay::run_to_end() {
    if (!log_.end_check) return {};
    keep_parameters();
    BURIN_TRY_DO(run_updates(log_.updates.count));
    for (;;) {
        BURIN_TRY(there, read_turn());
        if (!there) return check_ends_together();
        BURIN_TRY_DO(run_turn());
    }
}

// ---- Turns of the loop

Result<void> ThreadReplay::run_turns(std::uint64_t last) {
    while (ticks_ < last) {
        BURIN_TRY(there, read_turn());
        if (!there) return ends("tick " + std::to_string(last));
        BURIN_TRY_DO(run_turn());
    }
    return {};
}

// Reads the next tick of each part; false where there is none.
Result<bool> ThreadReplay::read_turn() {
    bool all = true;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (parts_[i].next) continue;
        BURIN_TRY(tick, ticks_source_->next(i));
        parts_[i].next = std::move(tick);
        all = all && parts_[i].next.has_value();
    }
    return all;
}

Result<haptics::PartInput> ThreadReplay::input_of(std::size_t i) {
    Part& part = parts_[i];
    const TickSeen& tick = *part.next;
    const std::string what = "tick " + std::to_string(ticks_ + 1) + " saw ";
    if (updating_ && tick.surface_sequence > updates_ + 1)
        return contradiction(ticks_source_->place(i), what + "a surface for which its own sample was needed");
    // The first surface existed before the first update.
    if (!updating_ && tick.surface_sequence > 0) {
        BURIN_TRY_DO(run_updates(tick.surface_sequence - 1));
    }
    const geometry::LocalSurface* surface = seen(part.surfaces, tick.surface_sequence);
    if (surface == nullptr)
        return contradiction(ticks_source_->place(i), what + "surface " + std::to_string(tick.surface_sequence) +
                                                          ", which there is not, or is no more");
    const haptics::TickParameters* parameters = seen(part.parameters, tick.parameter_sequence);
    if (parameters == nullptr)
        return contradiction(ticks_source_->place(i), what + "parameters " + std::to_string(tick.parameter_sequence) +
                                                          ", which no frame has set by then");
    return haptics::PartInput{tick.sample, surface, parameters};
}

Result<void> ThreadReplay::run_turn() {
    ticking_ = ticks_ + 1;
    haptics::HapticLoop& loop = session_.loop();
    const TickSeen& first = *parts_.front().next;
    // A log of lines holds only whether a tick was late, not by how much; it counts as late from half a period on.
    Nanoseconds lateness_ns = first.lateness_ns.value_or(first.late ? loop.period_ns() : 0);
    if (const auto known = witness_ != nullptr ? witness_->known(0, ticking_) : std::nullopt;
        known && !first.lateness_ns) {
        parts_.front().next->sample.joints = known->joints;
        lateness_ns = known->lateness_ns;
    }
    std::vector<haptics::PartInput> inputs;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        BURIN_TRY(input, input_of(i));
        inputs.push_back(input);
    }
    loop.repeat(inputs, first.time_ns, lateness_ns);
    ++ticks_;
    ticking_ = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        parts_[i].next.reset();
        BURIN_TRY_DO(judge(i));
    }
    return {};
}

// Takes the tick that the loop has just repeated for a part out of its ring.
Result<void> ThreadReplay::judge(std::size_t i) {
    haptics::TickRecord again;
    while (session_.hands().channels(i).records.pop(again)) {
    }
    check_.tick(i, again);
    parts_[i].tools.push_back(session_.hands().newest_tool(i));
    return witness_ != nullptr ? witness_->take(i, again) : Result<void>{};
}

void ThreadReplay::keep_parameters() {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const haptics::TickParameters& newest = session_.hands().channels(i).parameters.newest();
        std::deque<haptics::TickParameters>& kept = parts_[i].parameters;
        if (kept.empty() || kept.back().sequence < newest.sequence) kept.push_back(newest);
    }
}

// ---- Updates

Result<void> ThreadReplay::run_updates(std::uint64_t last) {
    if (last > log_.updates.count) return ends("update " + std::to_string(last) + " of the scene");
    while (updates_ < last) {
        BURIN_TRY_DO(run_update());
    }
    return {};
}

Result<void> ThreadReplay::run_update() {
    const scene::SceneUpdate update = *update_lines_.next();
    updating_ = true;
    const std::string where = name_ + ":" + std::to_string(update_lines_.line());
    const std::string what = "update " + std::to_string(updates_ + 1) + " took ";
    const std::uint64_t last_tick = update.last_ticks.empty() ? 0 : std::ranges::max(update.last_ticks);
    if (ticking_ > 0 && last_tick >= ticking_)
        return contradiction(where, what + "the sample of a tick that saw its surface");
    BURIN_TRY_DO(run_turns(last_tick));
    if (update.orders > orders_.size())
        return contradiction(where, what + std::to_string(update.orders) + " orders of " +
                                        std::to_string(orders_.size()) + " that there were");
    for (std::size_t i = 0; i < update.orders; ++i) {
        orders_.front()();
        orders_.pop_front();
    }
    BURIN_TRY_DO(session_.scene().repeat(update));
    ++updates_;
    session_.collect({});
    updating_ = false;
    keep_surfaces();
    return {};
}

void ThreadReplay::keep_surfaces() {
    for (std::size_t i = 0; i < parts_.size(); ++i)
        parts_[i].surfaces.push_back(session_.hands().channels(i).surface.newest());
}

// ---- Errors

// Says what is wrong behind the last ticks that could be read.
std::optional<std::string> ThreadReplay::hole() const {
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (auto found = ticks_source_->hole(i)) return found;
    return std::nullopt;
}

// All parts of a session that was closed end with the same turn.
Result<void> ThreadReplay::check_ends_together() const {
    constexpr const char* kRemedy = "it was changed since: burin session check names where; take it from a copy";
    if (const auto found = hole()) return fail(name_, "is damaged: " + *found, kRemedy);
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (parts_[i].next)
            return fail(name_,
                        "is damaged: " + session_.hands().name_of(i) + " has more ticks than another part of the hands",
                        kRemedy);
    return {};
}

// A log that was closed says so in its last line: then nothing is torn off, and what is missing was taken out.
std::unexpected<Error> ThreadReplay::ends(const std::string& what) {
    if (log_.end_check)
        return fail(name_,
                    "is damaged: it lacks " + what + ", which its frames need, though it goes on to its end" +
                        (hole() ? " (" + *hole() + ")" : ""),
                    "it was changed since: burin session check names where; take it from a copy");
    log_ends_ = true;
    return fail(name_, "the recording ends before " + what + ", which its last frames need",
                "it was torn off; what comes before is replayed");
}

std::unexpected<Error> ThreadReplay::contradiction(const std::string& where, const std::string& what) const {
    return fail(
        where, what,
        "the file was changed: replay it as it was recorded, or take out what the threads did (docs/formats.md)");
}

}  // namespace burin::session
