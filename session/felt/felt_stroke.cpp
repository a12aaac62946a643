// SPDX-License-Identifier: MIT
#include "session/felt/felt_stroke.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <vector>

#include "base/progress.hpp"
#include "base/try.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "haptics/realtime.hpp"
#include "record/record_writer.hpp"
#include "sculpt/carved_scene.hpp"
#include "session/drive/driver.hpp"
#include "session/drive/executors.hpp"
#include "session/record/carved_by.hpp"
#include "toolbox/felt_tool.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::session {
namespace {

// ---- The hand's motion

// Rest before and after the stroke; the gate's ramp must be over by then.
constexpr double kHandRests_s = 0.3;

// Returns the unit vector into the material near a tool, both in the object frame; zero where there is no material.
using IntoMaterial = std::function<Vec3(const Pose&)>;

// Margin of the workspace that is kept free: the surface pushes the hand off its path.
constexpr double kBorder_m = 0.008;

// Returns the tool's speed at each row, from the row before.
std::vector<double> speeds_of(const sculpt::Stroke& stroke) {
    std::vector<double> speeds(stroke.size(), 0.0);
    for (std::size_t i = 1; i < stroke.size(); ++i) {
        const double dt_s = stroke[i].time_s - stroke[i - 1].time_s;
        if (dt_s > 0.0) speeds[i] = glm::length(stroke[i].position_object_m - stroke[i - 1].position_object_m) / dt_s;
    }
    return speeds;
}

// Returns the median speed at which the tool works; 0 when it never moves while it does.
double middle_speed(const sculpt::Stroke& stroke, const std::vector<double>& speeds) {
    std::vector<double> working;
    for (std::size_t i = 1; i < stroke.size(); ++i)
        if (stroke[i].button && speeds[i] > 0.0) working.push_back(speeds[i]);
    if (working.empty()) return 0.0;
    const auto middle = working.begin() + static_cast<std::ptrdiff_t>(working.size() / 2);
    std::ranges::nth_element(working, middle);
    return *middle;
}

// Builds the hand's motion. While the button is pressed, the hand's target lies press_N / grip beyond the stroke, into
// the material: held on the stroke it would press with that force. The press is proportional to the speed, up to the
// median speed of the pressed rows, and eases where the hand rests: a tool that is pressed and not moved sinks.
Result<devices::SimulatedHand> hand_along(const sculpt::Stroke& stroke, const Similarity& object_from_device,
                                          const toolbox::Feel& feel, const IntoMaterial& into_material) {
    const Similarity device_from_object = inverse(object_from_device);
    const std::vector<double> speeds = speeds_of(stroke);
    const double usual = middle_speed(stroke, speeds);
    const double press_object_m = feel.press_N / feel.grip.stiffness_N_per_m * object_from_device.scale;
    std::vector<devices::HandPose> script;
    script.reserve(stroke.size() + 1);
    const auto add = [&](const sculpt::StrokeRow& row, double time_s, double share) {
        Vec3 wanted = row.position_object_m;
        if (share > 0.0)
            wanted += share * press_object_m * into_material({row.position_object_m, row.orientation_object});
        script.push_back({time_s, device_from_object * wanted, row.orientation_object, row.button ? 1u : 0u});
    };
    add(stroke.front(), 0.0, 0.0);
    script.back().buttons = 0;
    for (std::size_t i = 0; i < stroke.size(); ++i) {
        const bool presses = stroke[i].button && press_object_m > 0.0;
        // A stroke that never moves is a press at one point.
        const double share = !presses ? 0.0 : (usual > 0.0 ? std::min(1.0, speeds[i] / usual) : 1.0);
        add(stroke[i], stroke[i].time_s - stroke.front().time_s + kHandRests_s, share);
    }
    return devices::SimulatedHand::create(std::move(script), devices::HandPath::straight, feel.grip);
}

// Builds a hand that presses into the workpiece as it is before the stroke.
Result<devices::SimulatedHand> pressing_hand(sculpt::Sculpture& carving, const sculpt::Stroke& stroke,
                                             const toolbox::Tool& tool, const haptics::ToolSurface& tool_surface,
                                             const toolbox::Feel& feel, const Similarity& object_from_device) {
    const double around_m = toolbox::reach_of(tool.shape) + toolbox::size_of(tool.shape);
    geometry::LocalSurface surface;
    // Seen from within the tool, for the tip of one lies in the surface that it touches; but not far up its shank.
    const Vec3 middle = 0.5 * (Vec3(tool_surface.lo_m) + Vec3(tool_surface.hi_m));
    const double up_m = glm::length(middle);
    const Vec3 within = up_m > tool_surface.size_m ? (tool_surface.size_m / up_m) * middle : middle;
    const auto into_material = [&](const Pose& pose) {
        const Vec3 place = pose * within;
        carving.local_surface(place, around_m, surface);
        return haptics::into_material(surface, place, around_m);
    };
    return hand_along(stroke, object_from_device, feel, into_material);
}

LoopTimes times_of(const haptics::HapticLoop& loop) {
    const auto us = [](const haptics::Histogram& of, double q) {
        return static_cast<double>(of.quantile_ns(q)) * 1e-3;
    };
    const haptics::Histogram &late = loop.lateness(), &tick = loop.duration();
    return {true,          loop.skipped_deadlines(), us(late, 0.5),   us(late, 0.99), us(late, 0.999), us(late, 1.0),
            us(tick, 0.5), us(tick, 0.99),           us(tick, 0.999), us(tick, 1.0)};
}

// ---- The session

// Returns the first tick that is not before the end.
Nanoseconds last_tick_ns(double end_s, Nanoseconds period_ns) {
    Nanoseconds tick_ns = (nanoseconds(end_s) / period_ns - 1) * period_ns;
    while (seconds(tick_ns) < end_s) tick_ns += period_ns;
    return tick_ns;
}

// What is recorded of a felt stroke: where, what the hand holds, and the facts of the session.
struct FeltRecording {
    std::string path;  // empty: nothing
    std::vector<std::pair<std::string, std::string>> facts;
    haptics::Probe probe;
    const compute::CarvingEngine* engine;  // that carves
};

// The frames of a felt stroke, one for each carving update: they show nothing and collect figures. The ring of tick
// records has one reader: the recorder, where there is one, which hands them on.
class FeltFrames final : public FrameSource {
public:
    FeltFrames(Clock& clock, const haptics::HapticLoop& loop, haptics::HapticChannels& channels, FeltFigures& figures,
               const char* what)
        : clock_(clock),
          channels_(channels),
          start_ns_(clock.now_ns()),
          end_ns_(start_ns_ + last_tick_ns(figures.duration_s, loop.period_ns())),
          due_ns_(start_ns_),
          keeper_(figures, figures.duration_s, seconds(loop.period_ns())),
          progress_(what) {}

    enum class Pace { simulated, real };

    // Begins to record, before the first tick. Simulated time is not held back by any clock, so the ring would overflow
    // while the recorder writes: then each frame waits until it has taken all. In real time nobody waits.
    [[nodiscard]] Result<void> record(const FeltRecording& wanted, const devices::DeviceDescription& device,
                                      Pace pace) {
        if (wanted.path.empty()) return {};
        waits_for_recorder_ = pace == Pace::simulated;
        record::WriterOptions options;
        options.facts = wanted.facts;
        options.on_record = [this](std::size_t, const haptics::TickRecord& tick) { keeper_.add(tick); };
        BURIN_TRY(made,
                  record::RecordWriter::create(wanted.path, {{device.name, device, wanted.probe, &channels_.records}},
                                               std::move(options)));
        recorder_ = std::move(made);
        engine_ = wanted.engine;
        return {};
    }

    [[nodiscard]] std::optional<Nanoseconds> next() override {
        if (clock_.now_ns() >= end_ns_) return std::nullopt;
        due_ns_ = std::max(due_ns_ + scene::SceneService::kHandsMove_ns, clock_.now_ns());
        return std::min(due_ns_, end_ns_);
    }
    [[nodiscard]] Result<void> make(Executor&) override {
        BURIN_TRY_DO(take());
        progress_.show(static_cast<double>(clock_.now_ns() - start_ns_) / static_cast<double>(end_ns_ - start_ns_));
        return {};
    }
    // Takes what the last ticks have left, after they have ended, and closes the recording.
    [[nodiscard]] Result<void> finish() {
        Result<void> closed;
        if (recorder_) {
            recorder_->note_fact(kCarvedByFact, carved_by(*engine_));
            closed = recorder_->close();
        } else {
            keeper_.take(channels_);
        }
        keeper_.finish(channels_);
        return closed;
    }

private:
    [[nodiscard]] Result<void> take() {
        if (!recorder_) {
            keeper_.take(channels_);
            return {};
        }
        if (waits_for_recorder_) recorder_->take_now();
        if (const auto failed = recorder_->failure()) return std::unexpected(*failed);
        return {};
    }

    Clock& clock_;
    haptics::HapticChannels& channels_;
    Nanoseconds start_ns_, end_ns_, due_ns_;
    FigureKeeper keeper_;
    Progress progress_;
    bool waits_for_recorder_ = false;
    const compute::CarvingEngine* engine_ = nullptr;
    std::unique_ptr<record::RecordWriter> recorder_;  // last: its thread calls the keeper until it has ended
};

// Returns the first failure: of the stroke, else of the recording's end.
Result<void> first_failure(Result<void> driven, Result<void> finished) { return driven ? finished : driven; }

Result<void> feel_in_simulated_time(devices::SimulatedHand hand, haptics::HapticChannels& channels,
                                    sculpt::CarvedScene& carved, const FeltRecording& recording, FeltFigures& figures) {
    SimulatedClock clock;
    devices::SimulatedOmni omni(std::move(hand), {}, &clock);
    haptics::HapticLoop loop(omni, clock, channels);
    BURIN_TRY_DO(carved.update(clock.now_ns()));
    FeltFrames frames(clock, loop, channels, figures, "carving by feel");
    const auto begun = frames.record(recording, omni.description(), FeltFrames::Pace::simulated);
    if (!begun) return begun;
    SteppedExecutor executor(clock, loop, {&channels}, carved.service());
    executor.measure_ticks(figures.tick_ns);
    const Result<void> driven = drive(executor, frames);
    return first_failure(driven, frames.finish());
}

Result<void> feel_in_real_time(devices::SimulatedHand hand, haptics::HapticChannels& channels,
                               sculpt::CarvedScene& carved, const FeltRecording& recording, FeltFigures& figures) {
    MonotonicClock clock;
    devices::SimulatedOmni omni(std::move(hand), {}, &clock);
    haptics::HapticLoop loop(omni, clock, channels);
    BURIN_TRY_DO(carved.update(clock.now_ns()));
    FeltFrames frames(clock, loop, channels, figures, "carving by feel, in real time");
    const auto begun = frames.record(recording, omni.description(), FeltFrames::Pace::real);
    if (!begun) return begun;
    ThreadedExecutor executor(clock, loop, {&channels}, carved.service());
    const haptics::RealtimeNotice notice = executor.start();
    if (!notice.text.empty()) {
        figures.notices.push_back(notice.text);
        std::fprintf(stderr, "burin: %s\n", notice.text.c_str());
    }
    const Result<void> driven = drive(executor, frames);
    const Result<void> finished = frames.finish();
    figures.loop = times_of(loop);
    return first_failure(driven, finished);
}

}  // namespace

Similarity fit_into_workspace(const sculpt::Stroke& stroke, const Vec3& workspace_m) {
    Box bounds;
    for (const sculpt::StrokeRow& row : stroke) bounds.include(row.position_object_m);
    const Vec3 needed = bounds.extent() / (workspace_m - Vec3(2.0 * kBorder_m));
    return {bounds.center(), Quat{1, 0, 0, 0}, std::max({1.0, needed.x, needed.y, needed.z})};
}

Result<FeltFigures> carve_by_feel(sculpt::Sculpture& carving, const sculpt::Stroke& stroke, const toolbox::Tool& tool,
                                  const FeltOptions& options) {
    FeltFigures figures;
    const toolbox::FeltTool felt_tool = toolbox::felt_tool(tool.shape);
    figures.workspace_device_m = devices::OmniModel{}.workspace_m;
    figures.object_from_device = fit_into_workspace(stroke, figures.workspace_device_m);
    figures.duration_s = stroke.back().time_s - stroke.front().time_s + 2.0 * kHandRests_s;
    BURIN_TRY(hand, pressing_hand(carving, stroke, tool, felt_tool.surface, options.feel, figures.object_from_device));

    // A recorder may be busy with the disk for seconds.
    haptics::HapticChannels channels(haptics::HapticChannels::kTicks,
                                     options.record.empty() ? haptics::HapticChannels::kRecords : record::kRingTicks);
    haptics::TickParameters& parameters = channels.parameters.draft();
    parameters.sequence = 1;
    parameters.workspace.object_from_device = figures.object_from_device;
    parameters.probe = felt_tool.probe;
    parameters.shape = felt_tool.shape;
    parameters.tool = felt_tool.surface;
    parameters.materials.fill(options.feel.material);
    parameters.action = toolbox::action_of(tool.operation);
    channels.parameters.publish();

    // Far enough for the fastest hand to stay inside the known ball until the next update: 1 m/s for 12 ms.
    const double reach_m = 0.012 * figures.object_from_device.scale + 2.0 * carving.surface().lattice().spacing_m;
    sculpt::CarvedScene carved(carving, channels, tool, options.feel.material.hardness_Ns_per_m3, reach_m, {});
    carved.start_at(stroke.front().position_object_m);
    const auto feel = options.real_time ? feel_in_real_time : feel_in_simulated_time;
    const FeltRecording recording{options.record, options.facts, felt_tool.probe, &carving.engine()};
    BURIN_TRY_DO(feel(std::move(hand), channels, carved, recording, figures));
    figures.surfaces_published = carved.published();
    figures.last_tool = channels.tool.newest();
    return figures;
}

}  // namespace burin::session
