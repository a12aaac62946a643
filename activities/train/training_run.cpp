// SPDX-License-Identifier: MIT
#include "activities/train/training_run.hpp"

#include <array>
#include <utility>

#include "base/text.hpp"

namespace burin::activities {
namespace {

using study::OperatorAct;

constexpr std::array<std::pair<std::string_view, OperatorSays>, 6> kWords{{{"start", OperatorSays::start},
                                                                           {"next", OperatorSays::next},
                                                                           {"pause", OperatorSays::pause},
                                                                           {"go on", OperatorSays::go_on},
                                                                           {"stop", OperatorSays::stop},
                                                                           {"repeat", OperatorSays::repeat}}};

OperatorAct act_of(OperatorSays says) {
    switch (says) {
        case OperatorSays::next: return OperatorAct::next;
        case OperatorSays::pause: return OperatorAct::pause;
        case OperatorSays::go_on: return OperatorAct::go_on;
        case OperatorSays::stop: return OperatorAct::stop;
        case OperatorSays::repeat: return OperatorAct::repeat;
        case OperatorSays::start:
        case OperatorSays::note: break;
    }
    return OperatorAct::none;
}

const char* phase_text(study::StagePhase phase) {
    switch (phase) {
        case study::StagePhase::begin:
        case study::StagePhase::waiting: return "waits for the start cap";
        case study::StagePhase::armed: return "in the start cap";
        case study::StagePhase::running: return "clock runs";
        case study::StagePhase::paused: return "paused";
        case study::StagePhase::done: return "done";
    }
    return "";
}

const char* name_of(study::StageEventKind kind) {
    switch (kind) {
        case study::StageEventKind::start_touched: return "start touched";
        case study::StageEventKind::clock_started: return "clock started";
        case study::StageEventKind::end_touched: return "end touched";
        case study::StageEventKind::attempt_failed: return "attempt failed";
        case study::StageEventKind::ended: return "stage ended";
    }
    return "";
}

}  // namespace

Result<OperatorCommand> operator_command(std::string_view text) {
    for (const auto& [word, says] : kWords)
        if (text == word) return OperatorCommand{says, {}};
    constexpr std::string_view kNote = "note ";
    if (text.starts_with(kNote) && text.size() > kNote.size())
        return OperatorCommand{OperatorSays::note, std::string(text.substr(kNote.size()))};
    return fail("\"" + std::string(text.substr(0, 40)) + "\"", "is nothing that an operator can say",
                "write start, next, pause, go on, stop, repeat or note TEXT");
}

TrainingRun::TrainingRun(const study::Protocol& protocol, const study::Group& group, const FeltWorlds& worlds,
                         std::vector<study::StagePlace> places)
    : protocol_(protocol), group_(group), worlds_(worlds), places_(std::move(places)) {
    if (places_.empty()) phase_ = Phase::finished;
}

const study::StagePlace* TrainingRun::place() const { return at_ < places_.size() ? &places_[at_] : nullptr; }

void TrainingRun::say(Nanoseconds now_ns, std::string name, std::string value) {
    said_.push_back({now_ns, std::move(name), std::move(value)});
}

void TrainingRun::command(const OperatorCommand& command, Nanoseconds now_ns) {
    if (command.says == OperatorSays::note) return say(now_ns, "note", command.text);
    if (command.says == OperatorSays::start) {
        if (phase_ == Phase::between) begin(now_ns);
        return;
    }
    if (command.says == OperatorSays::stop) stopped_ = true;
    if (phase_ == Phase::in_stage) acts_.push_back(act_of(command.says));
}

bool TrainingRun::paused() const {
    if (phase_ != Phase::in_stage) return false;
    bool is_paused = (session_ ? session_->state() : page_).phase == study::StagePhase::paused;
    for (const OperatorAct act : acts_)
        if (act == OperatorAct::pause || act == OperatorAct::go_on) is_paused = act == OperatorAct::pause;
    return is_paused;
}

Result<void> TrainingRun::check(const OperatorCommand& command) const {
    const bool in_stage = phase_ == Phase::in_stage;
    if (command.says == OperatorSays::note) return {};
    if (command.says == OperatorSays::start) {
        if (phase_ == Phase::between) return {};
        return fail("", phase_ == Phase::finished ? "all stages are done" : "a stage is under way",
                    "end it first, with next or stop");
    }
    if (!in_stage) return fail("", "no stage is under way", "start begins one");
    if (command.says == OperatorSays::next && !places_[at_].stage->ends_by_operator)
        return fail("", "this stage ends by itself, as the protocol has it", "wait, or break it off with stop");
    if (command.says == OperatorSays::pause && paused())
        return fail("", "the stage is paused already", "go on ends the pause");
    if (command.says == OperatorSays::go_on && !paused()) return fail("", "the stage is not paused", "leave it out");
    if (command.says == OperatorSays::repeat) {
        if (places_[at_].stage->kind != study::StageKind::trial)
            return fail("", "this stage is no trial and has no attempts", "leave it out");
        if (paused()) return fail("", "the attempt is lost with the pause already", "go on");
    }
    return {};
}

void TrainingRun::begin(Nanoseconds now_ns) {
    const study::Stage& stage = *places_[at_].stage;
    const auto found = worlds_.find(stage.world);
    world_ = found != worlds_.end() ? found->second.get() : nullptr;
    session_.reset();
    if (world_ != nullptr) session_.emplace(protocol_, stage, group_, *world_);
    page_setup_ = study::setup_of(protocol_, stage);
    page_ = {};
    page_events_.clear();
    acts_.clear();
    last_.reset();
    begun_ns_ = now_ns;
    page_time_s_ = 0.0;
    events_told_ = 0;
    phase_ = Phase::in_stage;
    say(now_ns, "stage begun", stage.name);
}

OperatorAct TrainingRun::next_act() {
    if (acts_.empty()) return OperatorAct::none;
    const OperatorAct act = acts_.front();
    acts_.pop_front();
    return act;
}

void TrainingRun::note_stage_events(Nanoseconds now_ns) {
    const std::vector<study::StageEvent>& events = session_ ? session_->events() : page_events_;
    for (; events_told_ < events.size(); ++events_told_) {
        const study::StageEvent& event = events[events_told_];
        const study::StageState& state = session_ ? session_->state() : page_;
        say(now_ns, name_of(event.kind),
            event.kind == study::StageEventKind::attempt_failed ? study::name_of(event.failure)
            : event.kind == study::StageEventKind::ended        ? study::name_of(state.result)
                                                                : formatted("%.4f s", event.time_s));
    }
    const bool done = session_ ? session_->done() : page_.phase == study::StagePhase::done;
    if (done) phase_ = Phase::ended;
}

OperatorAct TrainingRun::follow(const haptics::TickRecord& record) {
    if (phase_ != Phase::in_stage || !session_) return OperatorAct::none;
    const OperatorAct act = next_act();
    session_->follow(record, act);
    last_ = LastTick{touches_wall(record), record.sample.fault != devices::DeviceFault::none,
                     glm::length(record.gate.given.force_device_N)};
    note_stage_events(record.time_ns);
    return act;
}

void TrainingRun::take_page_on(Nanoseconds now_ns) {
    page_time_s_ = seconds(now_ns - begun_ns_);
    const study::StageStep stepped = study::step(page_setup_, page_, {page_time_s_, {}, next_act(), false});
    page_ = stepped.state;
    for (std::size_t i = 0; i < stepped.event_count; ++i) page_events_.push_back(stepped.events[i]);
    note_stage_events(now_ns);
}

TrainingShown TrainingRun::frame(Nanoseconds now_ns) {
    if (phase_ == Phase::in_stage && !session_) take_page_on(now_ns);
    TrainingShown shown;
    shown.events = std::exchange(said_, {});
    const study::StagePlace* at = place();
    if (at == nullptr || phase_ != Phase::in_stage) return shown;
    shown.page = at->stage->page_text;
    if (!session_) return shown;
    shown.wand_seen = at->stage->sees_wand;
    if (last_) shown.moment = moment_of(*world_, *session_, last_->touches_wall);
    shown.objects = shown_objects(*world_, *at->stage, group_, shown.moment.value_or(StageMoment{}));
    return shown;
}

std::vector<PanelRow> TrainingRun::rows() const {
    const study::StagePlace* at = place();
    if (at == nullptr) return {{"stage", "all stages are done"}};
    std::vector<PanelRow> rows{
        {"stage", formatted("%s (day %zu, stage %zu)", at->stage->name.c_str(), at->day, at->place)}};
    if (phase_ == Phase::between) {
        rows.push_back({"now", "start begins it"});
        return rows;
    }
    const auto add_left = [&](const study::StageState& of, double time_s) {
        if (!at->stage->ends_after_s) return;
        const double paused_s = of.paused_s + (of.phase == study::StagePhase::paused ? time_s - of.pause_begun_s : 0.0);
        rows.push_back({"left", formatted("%.0f s of %.0f", std::max(*at->stage->ends_after_s + paused_s - time_s, 0.0),
                                          *at->stage->ends_after_s)});
    };
    if (!session_) {
        rows.push_back({"time", formatted("%.1f s", page_time_s_)});
        add_left(page_, page_time_s_);
        return rows;
    }
    const study::StageState& state = session_->state();
    const study::FeltForces& forces = session_->forces();
    const bool trial = at->stage->kind == study::StageKind::trial;
    rows.push_back({"now", trial                                      ? phase_text(state.phase)
                           : state.phase == study::StagePhase::paused ? "paused"
                                                                      : "runs"});
    if (trial) rows.push_back({"attempt", formatted("%u of %u", state.attempt, at->stage->attempts)});
    add_left(state, session_->time_s());
    const bool runs = trial && state.phase == study::StagePhase::running;
    rows.push_back(
        {"clock", formatted("%.1f s", runs ? session_->time_s() - state.clock_started_s : session_->time_s())});
    if (!last_) return rows;
    const auto points = session_->touch().points_m(session_->sample());
    const study::NearestOnLine nearest = study::nearest_on(world_->world().spine_m, 0.5 * (points[0] + points[1]));
    rows.push_back(
        {"path", formatted("%.0f mm along, %.0f mm off the axis", 1e3 * nearest.along_m, 1e3 * nearest.distance_m)});
    rows.push_back({"force", formatted("%.2f N, largest %.2f N", last_->force_N, forces.largest_N)});
    if (trial && state.phase == study::StagePhase::waiting) {
        const study::CapBox cap = study::start_cap(world_->world());
        const Vec3 middle_m = cap.centre_m + 0.5 * cap.depth_m * cap.z;
        rows.push_back(
            {"start cap", formatted("%.0f mm away", 1e3 * glm::distance(middle_m, 0.5 * (points[0] + points[1])))});
    }
    const StageMoment moment = moment_of(*world_, *session_, last_->touches_wall);
    rows.push_back({"caps", moment.start_touched ? "in the start cap"
                            : moment.end_touched ? "in the end cap"
                                                 : "in none"});
    rows.push_back({"saturated", formatted("%.1f %% of ticks", forces.ticks == 0
                                                                   ? 0.0
                                                                   : 100.0 * static_cast<double>(forces.limited_ticks) /
                                                                         static_cast<double>(forces.ticks))});
    rows.push_back({"missed ticks", formatted("%llu", static_cast<unsigned long long>(forces.late_ticks))});
    if (last_->fault) rows.push_back({"device", "fault: no force is given"});
    return rows;
}

EndedStage TrainingRun::take_end() {
    BURIN_CHECK(phase_ == Phase::ended);
    EndedStage ended;
    if (session_)
        ended = ended_stage(protocol_, *places_[at_].stage, *world_, *session_);
    else
        ended = {page_, page_events_, {}, 0, page_time_s_};
    session_.reset();
    last_.reset();
    world_ = nullptr;
    ++at_;
    phase_ = at_ < places_.size() ? Phase::between : Phase::finished;
    return ended;
}

}  // namespace burin::activities
