// SPDX-License-Identifier: MIT
// Short live sessions that are recorded into a session file and done again: of a script that carves, and of four
// fingers that grasp a block.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "compute/engine/chosen_engine.hpp"
#include "desk/run/session_frames.hpp"
#include "session/drive/driver.hpp"
#include "session/drive/executors.hpp"
#include "session/drive/recording_start.hpp"
#include "session/drive/thread_replay.hpp"
#include "session/drive/tick_comparison.hpp"
#include "session/record/session_log.hpp"
#include "session/record/session_recording.hpp"
#include "session/record/tick_source.hpp"
#include "session/state/session_settings.hpp"
#include "tests/desk/threads_seen.hpp"
#include "tests/geometry/touch_samples.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/paced_clock.hpp"

namespace burin::session {

inline constexpr ImageSize kShownSize{640, 360};

// Into the ball's front and along it, and an undo.
inline const std::string kShortScript = R"(burin-input 1 test
0.02 mouse 320 180
0.05 scroll 0 15
0.1 button press left
0.12 scroll 0 10
0.2 mouse 330 184
0.3 mouse 350 190
0.4 button release left
0.42 command undo
0.5 close
)";

inline SessionSetup short_options(const std::string& record) {
    SessionSetup options = carving_setup();
    options.carve.workpiece.resolution = 32;
    options.hands.tool.shape = "ball:0.012";
    options.carve.engine = compute::EngineChoice::cpu;
    options.threads = 1;
    options.record.path = record;
    return options;
}

// A session that is recorded into a file: of a script, or of a user who does nothing.
struct Recorded {
    enum class Of { script, nobody };
    Recorded(const std::string& path, Clock& clock, Of of) : Recorded(short_options(path), clock, of) {}
    Recorded(const SessionSetup& options, Clock& clock, Of of, const std::string& of_script = kShortScript)
        : script(of_script) {
        auto created = Desk::create(options, *session_wall(options.desk), clock);
        if (!created) throw std::runtime_error(created.error().line());
        desk = std::move(*created);
        auto writer = create_recording(options, {{"program", "a test"}}, desk->session());
        if (!writer) throw std::runtime_error(writer.error().line());
        begin(std::move(*writer), of);
    }
    // Of nobody, into a file of a disk that fails.
    Recorded(const std::string& path, Clock& clock, const std::string& vfs) : script(kShortScript) {
        const SessionSetup options = short_options(path);
        desk = std::move(*Desk::create(options, *session_wall(options.desk), clock));
        RecordingOf of;
        of.parts.push_back({"", desk->session().hands().device(0), desk->session().channels().parameters.newest().probe,
                            &desk->session().channels().records});
        of.clock = clock_of(desk->session());
        of.settings = settings_line(options);
        of.vfs = vfs;
        auto recording = SessionRecording::create(path, std::move(of));
        if (!recording) throw std::runtime_error(recording.error().line());
        begin(InputLogWriter::into(std::move(*recording)), Of::nobody);
    }
    void begin(InputLogWriter writer, Of of) {
        input.emplace(of == Of::nobody ? InputSource::live(std::move(writer))
                                       : InputSource::play(*parse_input_log(script, "script"), std::move(writer)));
        recorder.emplace(*input, desk->session());
    }

    std::string script;
    ImageSize shown = kShownSize;
    std::unique_ptr<Desk> desk;
    std::optional<InputSource> input;
    std::optional<ThreadRecorder> recorder;
};

// Makes a frame every 10 ms of a clock that goes on when hand and scene are ready for it: on a busy machine all of it
// comes later, and nothing is lost.
class ShortFrames final : public FrameSource {
public:
    ShortFrames(Recorded& of, PacedClock& clock, ThreadsSeen& threads) : of_(of), clock_(clock), threads_(threads) {}
    [[nodiscard]] std::optional<Nanoseconds> next() override {
        if (of_.desk->session().state().quit) return ended();
        clock_.sleep_until(clock_.now_ns() + kFrame_ns);
        threads_.wait(kFrame_ns);
        of_.recorder->outside();
        const Nanoseconds time_ns = clock_.now_ns() - of_.desk->session().start_ns();
        const auto input = of_.input->begin_frame(time_ns, time_ns + kFrame_ns);
        if (!input) return ended();
        frame_ = *input;
        return clock_.now_ns();
    }
    [[nodiscard]] Result<void> make(Executor& executor) override {
        const auto done = step_frame(*of_.desk, executor, *of_.recorder, frame_, {{.size = of_.shown}});
        if (!done) static_cast<void>(ended());
        return done;
    }

private:
    static constexpr Nanoseconds kFrame_ns = 10'000'000;

    std::optional<Nanoseconds> ended() {
        threads_.frames_end();
        return std::nullopt;
    }

    Recorded& of_;
    PacedClock& clock_;
    ThreadsSeen& threads_;
    FrameInput frame_;
};

// Records it with its threads, at the machine's pace. Returns how many ticks it had.
inline std::uint64_t record_live(const SessionSetup& options, const std::string& script = kShortScript,
                                 ImageSize shown = kShownSize) {
    PacedClock clock(2);  // the hand's thread and the frames
    Recorded recorded(options, clock, Recorded::Of::script, script);
    recorded.shown = shown;
    Session& s = recorded.desk->session();
    ThreadsSeen seen(s, clock, 30);
    ShortFrames frames(recorded, clock, seen);
    ThreadedExecutor threads(clock, s.loop(), s.channels_of_parts(), s.scene(), {},
                             [&](const auto& ended) { seen.update_ended(ended); });
    static_cast<void>(threads.start());
    EXPECT_TRUE(drive(threads, frames));
    recorded.recorder->finish(threads.take_updates()->updates);
    s.finish_scene();
    const auto outcome = s.files().outcome();
    EXPECT_TRUE(outcome) << outcome.error().line();
    return s.loop().ticks();
}

class ShortFramesAgain final : public FrameSource {
public:
    ShortFramesAgain(Desk& desk, InputSource input, const ThreadLog& log, ThreadReplay& replay, ImageSize shown)
        : desk_(desk), input_(std::move(input)), log_(log), replay_(replay), shown_(shown) {
        recorder_.keep_events();
    }
    [[nodiscard]] std::optional<Nanoseconds> next() override {
        if (next_ == log_.frames.size()) return std::nullopt;
        frame_ = input_.begin_frame(0, 0).value();
        replay_.begin_frame(log_.frames[next_++]);
        return frame_.time_ns;
    }
    [[nodiscard]] Result<void> make(Executor& executor) override {
        if (const auto done = step_frame(desk_, executor, recorder_, frame_, {{.size = shown_}}); !done) return done;
        departed_ += replay_.is_as_recorded(desk_.words()) ? 0u : 1u;
        return {};
    }
    [[nodiscard]] std::size_t departed() const { return departed_; }
    [[nodiscard]] std::vector<TrialMark> trials() { return recorder_.take_trials(); }
    [[nodiscard]] std::vector<EventMark> events() { return recorder_.take_events(); }

private:
    Desk& desk_;
    InputSource input_;
    const ThreadLog& log_;
    ThreadReplay& replay_;
    ImageSize shown_;
    std::size_t next_ = 0, departed_ = 0;
    ThreadRecorder recorder_{input_, desk_.session()};
    FrameInput frame_;
};

struct Judged {
    Result<void> done;
    std::vector<TrialMark> trials;
    std::vector<EventMark> events;
    std::size_t departed = 0;  // frames
    record::Comparison found;
    std::uint64_t unrecorded = 0;
};

// Does a log again, and compares its ticks with those of a file.
inline Judged judged(InputLog log, const std::string& path, const SessionSetup& options, ImageSize shown = kShownSize) {
    const ThreadLog threads = *log.threads;
    auto reader = record::RecordReader::open(path);
    auto judge = TickComparison::create(*reader, {});
    SimulatedClock clock;
    auto desk = Desk::create_as_recorded(options, *session_wall(options.desk), threads, path, clock);
    auto ticks = threads.ticks.count > 0 ? ticks_of_lines(threads, path) : std::move(*ticks_of_columns(*reader));
    ThreadReplay replay((*desk)->session(), threads, std::move(ticks), path);
    replay.judge_ticks(&*judge);
    ShortFramesAgain frames(**desk, InputSource::replay(std::move(log)), threads, replay, shown);
    Judged result;
    result.done = drive(replay, frames);
    if (result.done) result.done = replay.run_to_end();
    (*desk)->session().finish_scene();
    result.trials = frames.trials();
    result.events = frames.events();
    result.departed = frames.departed();
    result.found = judge->found();
    result.unrecorded = judge->unrecorded();
    return result;
}

// Takes hold of what two parts of its first hand touch while the button is down, so that they still feel it, and lets
// go with the button.
class Grasping final : public Activity {
public:
    [[nodiscard]] std::string settings() const override { return "grasping"; }
    [[nodiscard]] Result<void> act(std::span<const std::string>, ActivityOrders&) override { return {}; }
    void step(const ActivityView& view, ActivityOrders& orders) override {
        at = view.world->find(1)->pose;
        for (const scene::ContactEvent& event : view.contacts) {
            contacts.push_back(event);
            if (event.what == scene::ContactEvent::What::begin)
                touching_.insert(event.by.part);
            else
                touching_.erase(event.by.part);
        }
        const bool pressed = (view.first_part().tool.buttons & 1u) != 0;
        // The hand may move before the hold is carried out on a busy machine: its way begins where the block's does.
        if (held_ && at == Pose{}) took_m = view.first_part().tool.hip_object_m;
        const haptics::TickRecord* last = view.first_part().ticks.empty() ? nullptr : &view.first_part().ticks.back();
        if (!held_ && pressed && touching_.size() >= 2 && last != nullptr) {
            held_ = true;
            took_m = view.first_part().tool.hip_object_m;
            orders.trials.push_back({last->time_ns, "grasp"});
            event_ = EventMark{last->time_ns, "takes hold", "block"};
            HoldObject hold{"block", {}, true};
            for (const std::size_t part : touching_) hold.by.push_back({0, part});
            holds.push_back(hold);
        } else if (held_ && !pressed && last != nullptr) {
            held_ = false;
            let_go_m = view.first_part().tool.hip_object_m;
            orders.trials.push_back({last->time_ns, "", "let go"});
            holds.push_back({"block", {}, false});
        } else {
            return;
        }
        orders.holds.push_back(holds.back());
    }
    void write(ActivityRecord& record) override {
        if (event_) record.events.push_back(*std::exchange(event_, std::nullopt));
    }
    [[nodiscard]] std::uint64_t check() const override { return holds.size() + adds_to_check; }
    [[nodiscard]] bool is_running() const override { return true; }
    [[nodiscard]] ActivityPanel panel() const override { return {.title = "Grasp"}; }

    std::vector<scene::ContactEvent> contacts;
    std::vector<HoldObject> holds;
    Pose at;                    // of the block
    Vec3 took_m{}, let_go_m{};  // where its first finger was as the block began to move, and as it was let go
    std::uint64_t adds_to_check = 0;

private:
    std::set<std::size_t> touching_;
    bool held_ = false;
    std::optional<EventMark> event_;
};

// A block between the fingers of a hand.
inline SessionSetup grasp_options(const std::string& record, std::shared_ptr<Grasping> activity) {
    SessionSetup options = carving_setup();
    options.scene.no_workpiece = true;
    options.threads = 1;
    options.hands.tool.shape = "ball:0.005";
    options.hands.device = "simulated-fingers";
    options.record.path = record;
    options.activity = std::move(activity);
    auto world = std::make_shared<scene::World>();
    world->name = "a block";
    scene::SceneObject block;
    block.id = 1;
    block.name = "block";
    block.mesh = std::make_shared<const geometry::TriangleMesh>(geometry::test::cube(0.055));
    world->objects.push_back(block);
    // The hand's workspace reaches over all that is seen.
    scene::SceneObject around = block;
    around.id = 2;
    around.name = "around";
    around.mesh = std::make_shared<const geometry::TriangleMesh>(geometry::test::cube(0.1));
    around.felt = false;
    world->objects.push_back(around);
    options.scene.given = world;
    return options;
}

inline Result<InputLog> log_in(const std::string& path) {
    auto reader = record::RecordReader::open(path);
    if (!reader) return std::unexpected(reader.error());
    return read_session_log(*reader);
}

}  // namespace burin::session
