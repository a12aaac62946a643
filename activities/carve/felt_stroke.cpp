// SPDX-License-Identifier: MIT
#include "activities/carve/felt_stroke.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "activities/carve/pressing_hand.hpp"
#include "base/progress.hpp"
#include "base/ring.hpp"
#include "base/try.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "haptics/tick_parameters.hpp"
#include "record/record_writer.hpp"
#include "sculpt/carved_workpiece.hpp"
#include "session/drive/headless_session.hpp"
#include "session/live/session.hpp"
#include "session/record/carved_by.hpp"
#include "toolbox/felt_tool.hpp"

namespace burin::activities {
namespace {

// Returns the time of the first tick that is not before the end.
Nanoseconds last_tick_ns(double end_s, Nanoseconds period_ns) {
    Nanoseconds tick_ns = (nanoseconds(end_s) / period_ns - 1) * period_ns;
    while (seconds(tick_ns) < end_s) tick_ns += period_ns;
    return tick_ns;
}

session::LoopTimes times_of(const haptics::HapticLoop& loop) {
    const auto us = [](const haptics::Histogram& of, double q) {
        return static_cast<double>(of.quantile_ns(q)) * 1e-3;
    };
    const haptics::Histogram &late = loop.lateness(), &tick = loop.duration();
    return {true,          loop.skipped_deadlines(), us(late, 0.5),   us(late, 0.99), us(late, 0.999), us(late, 1.0),
            us(tick, 0.5), us(tick, 0.99),           us(tick, 0.999), us(tick, 1.0)};
}

// The columns of every tick, in a session file of its own kind: an input log has nothing to say of a stroke.
class StrokeRecorder {
public:
    [[nodiscard]] Result<void> open(const std::string& path, const devices::DeviceDescription& device,
                                    const haptics::Probe& probe,
                                    std::vector<std::pair<std::string, std::string>> facts) {
        ticks_ = std::make_unique<Ring<haptics::TickRecord>>(record::kRingTicks);
        record::WriterOptions options;
        options.facts = std::move(facts);
        BURIN_TRY(made,
                  record::RecordWriter::create(path, {{device.name, device, probe, ticks_.get()}}, std::move(options)));
        writer_ = std::move(made);
        return {};
    }
    // Does nothing where none is open, as do the others.
    void add(const haptics::TickRecord& tick) {
        if (writer_) static_cast<void>(ticks_->push(tick));
    }
    // No clock holds simulated time back, so the ring would overflow while the writer writes: waits until it has all.
    [[nodiscard]] Result<void> go_on(bool waits) {
        if (!writer_) return {};
        if (waits) writer_->take_now();
        if (const auto failed = writer_->failure()) return std::unexpected(*failed);
        return {};
    }
    [[nodiscard]] Result<void> close(const compute::CarvingEngine& engine) {
        if (!writer_) return {};
        writer_->note_fact(session::kCarvedByFact, session::carved_by(engine));
        return writer_->close();
    }

    // Returns how many ticks it had no room for.
    [[nodiscard]] std::uint64_t lost() const { return ticks_ ? ticks_->refused() : 0; }

private:
    std::unique_ptr<Ring<haptics::TickRecord>> ticks_;  // some tens of megabytes: where it is open
    std::unique_ptr<record::RecordWriter> writer_;
};

// What of the options a stroke's session is made with: nothing is asked of a workpiece that is there already.
session::SessionSetup session_of_stroke(const session::SessionSetup& options, std::shared_ptr<FeltStroke> activity) {
    session::SessionSetup setup;
    setup.hands.tool = options.hands.tool;
    setup.carve.feel = options.carve.feel;
    setup.carve.mirror = options.carve.mirror;
    setup.carve.undo_memory_MiB = options.carve.undo_memory_MiB;
    setup.activity = std::move(activity);
    return setup;
}

}  // namespace

// ---- The activity

Result<void> FeltStroke::act(std::span<const std::string> /*words*/, session::ActivityOrders& /*orders*/) {
    return fail("do", "a stroke that is carved by feel takes no orders", "leave it out");
}

// Nobody steers the hand: all but the tool, the material and the place of the hand is as a tick has it by itself.
void FeltStroke::adjust(session::PartOfHand /*of*/, haptics::TickParameters& parameters) const {
    haptics::TickParameters own;
    own.workspace.object_from_device = parameters.workspace.object_from_device;
    own.probe = parameters.probe;
    own.shape = parameters.shape;
    own.tool = parameters.tool;
    own.materials = parameters.materials;
    own.action = parameters.action;
    parameters = std::move(own);
}

// ---- Its session

OpenedStroke::OpenedStroke(const sculpt::Sculpture& carving, const session::SessionSetup& options)
    : carving_(carving), real_time_(options.carve.stroke.real_time), record_(options.record.path) {}

OpenedStroke::~OpenedStroke() = default;

Result<std::unique_ptr<OpenedStroke>> OpenedStroke::create(sculpt::MadeWorkpiece made, const sculpt::Stroke& stroke,
                                                           const session::SessionSetup& options) {
    BURIN_TRY(tool, toolbox::parse_tool(options.hands.tool));
    BURIN_TRY(feel, toolbox::parse_feel(options.carve.feel));
    const toolbox::FeltTool felt_tool = toolbox::felt_tool(tool.shape);
    const sculpt::Sculpture& carving = *made.carving;
    std::unique_ptr<OpenedStroke> opened(new OpenedStroke(carving, options));
    opened->probe_ = felt_tool.probe;
    session::FeltFigures& figures = opened->figures_;
    figures.workspace_device_m = devices::OmniModel{}.workspace_m;
    figures.object_from_device = fit_into_workspace(stroke, figures.workspace_device_m);
    figures.duration_s = stroke.back().time_s - stroke.front().time_s + 2.0 * kHandRests_s;
    BURIN_TRY(hand, pressing_hand(carving, stroke, tool.shape, felt_tool.surface, feel, figures.object_from_device));

    session::BroughtHand brought;
    session::PlacedHand& placed = brought.placed.emplace();
    placed.scene_from_device = figures.object_from_device;
    const devices::HandTarget start = hand.target(0.0);
    placed.rest_device = {start.position_device_m, start.orientation_device};
    placed.begins_scene_m = stroke.front().position_object_m;
    // Far enough for the fastest hand to stay inside the known ball until the next update: 1 m/s for 12 ms.
    placed.reach_m = 0.012 * figures.object_from_device.scale + 2.0 * carving.surface().lattice().spacing_m;
    brought.leads = std::move(hand);

    Clock& clock = opened->real_time_ ? static_cast<Clock&>(opened->monotonic_) : opened->simulated_;
    const session::SessionSetup setup = session_of_stroke(options, std::make_shared<FeltStroke>(std::move(brought)));
    BURIN_TRY(session, session::Session::create(setup, clock, 1.0, sculpt::as_workpiece(std::move(made)), {}));
    opened->session_ = std::move(session);
    return opened;
}

Result<session::FeltFigures> OpenedStroke::run(std::vector<std::pair<std::string, std::string>> facts) {
    const Nanoseconds period_ns = session_->loop().period_ns();
    session::FigureKeeper keeper(figures_, figures_.duration_s, seconds(period_ns));
    StrokeRecorder recorder;
    if (!record_.empty()) BURIN_TRY_DO(recorder.open(record_, session_->hands().device(0), probe_, std::move(facts)));
    Progress progress(real_time_ ? "carving by feel, in real time" : "carving by feel");
    session::HeadlessRun run{.lasts_ns = last_tick_ns(figures_.duration_s, period_ns), .ends_on_time = true};
    run.on_tick = [&](std::size_t /*part*/, const haptics::TickRecord& tick) {
        keeper.add(tick);
        recorder.add(tick);
    };
    run.after_frame = [&] {
        progress.show(std::min(1.0, static_cast<double>(session_->step_ns()) / static_cast<double>(run.lasts_ns)));
        return recorder.go_on(!real_time_);
    };
    Result<void> driven;
    if (real_time_) {
        const Result<std::string> notice = session::run_headless_in_real_time(*session_, monotonic_, run);
        driven = notice ? Result<void>() : std::unexpected(notice.error());
        if (notice && !notice->empty()) {
            figures_.notices.push_back(*notice);
            std::fprintf(stderr, "burin: %s\n", notice->c_str());
        }
        figures_.loop = times_of(session_->loop());
    } else {
        run.tick_ns = &figures_.tick_ns;
        driven = session::run_headless(*session_, simulated_, run);
    }
    keeper.finish(session_->channels());
    figures_.records_lost += recorder.lost();
    const Result<void> closed = recorder.close(carving_.engine());
    if (!driven) return std::unexpected(driven.error());
    if (!closed) return std::unexpected(closed.error());
    figures_.surfaces_published = session_->scene().published(0);
    figures_.last_tool = session_->channels().tool.newest();
    return std::move(figures_);
}

std::vector<std::string> OpenedStroke::messages() const {
    std::vector<std::string> told;
    for (const session::Message& message : session_->notices().log().all()) told.push_back(message.text);
    return told;
}

}  // namespace burin::activities
