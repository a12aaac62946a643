// SPDX-License-Identifier: MIT
// A session whose one device carves on the scene's thread and draws on the frame's, and is lost while both do: a replay
// that the processor carves on one thread gives every tick and the solid again, to the bit.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "desk/present/presenter.hpp"
#include "desk/run/session.hpp"
#include "gpu/core.hpp"
#include "tests/desk/recorded_session.hpp"
#include "tests/desk/validated_desk.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

// Frames of 10 ms, each with its picture, on a clock that goes on when hand and scene are ready for it.
class DrawnFrames final : public SessionFrames {
public:
    // lost_at: the frame before whose picture the device is lost; none: it is not.
    DrawnFrames(Desk& desk, Presenter& presenter, InputSource input, PacedClock& clock, ThreadsSeen& threads,
                std::optional<int> lost_at)
        : SessionFrames(desk, presenter, std::move(input)),
          presenter_(presenter),
          clock_(clock),
          threads_(threads),
          lost_at_(lost_at) {}

private:
    static constexpr Nanoseconds kFrame_ns = 10'000'000;

    [[nodiscard]] std::optional<FrameInput> next_input() override {
        clock_.sleep_until(clock_.now_ns() + kFrame_ns);
        threads_.wait(kFrame_ns);
        recorder_.outside();
        const Nanoseconds time_ns = clock_.now_ns() - session_.start_ns();
        return input_.begin_frame(time_ns, time_ns + kFrame_ns);
    }
    [[nodiscard]] bool wants_picture() override {
        if (frame_++ == lost_at_) presenter_.device().core()->lose_at_next_submit = true;
        return true;
    }
    void finished(const FrameInput&, bool) override {
        if (session_.state().quit) threads_.frames_end();
    }

    Presenter& presenter_;
    PacedClock& clock_;
    ThreadsSeen& threads_;
    const std::optional<int> lost_at_;
    int frame_ = 0;
};

class OneDevice : public ValidatedDesk {
protected:
    struct Carved {
        std::string engine;  // at the end
        std::uint64_t submissions_to_carve = 0, submissions_to_draw = 0;
        std::string said;
    };
    // Carves the short script with threads, draws it, and records it.
    Carved carve(std::optional<int> lost_at = {}) {
        SessionSetup options = drawn_options();
        options.carve.engine = compute::EngineChoice::vulkan;
        testing::internal::CaptureStderr();
        Carved carved;
        const Result<void> done = run(options, lost_at, carved);
        carved.said = testing::internal::GetCapturedStderr();
        EXPECT_TRUE(done) << done.error().line();
        return carved;
    }
    // Expects that the processor gives what was recorded: ticks, frames, and the solid at the end.
    void expect_the_processors() const {
        SessionSetup options = drawn_options();
        options.carve.engine = compute::EngineChoice::cpu;
        options.record.path.clear();
        options.record.input = (place / "it.session").string();
        auto reader = record::RecordReader::open(options.record.input);
        ASSERT_TRUE(reader) << reader.error().line();
        auto log = read_session_log(*reader);
        ASSERT_TRUE(log) << log.error().line();
        auto judge = TickComparison::create(*reader, {});
        ASSERT_TRUE(judge) << judge.error().line();
        const ReplayManner manner{.witness = &*judge, .ticks = &*reader};
        const auto done = replay_as_recorded(options, session_wall(options.desk).value(), std::move(*log), manner);
        EXPECT_TRUE(done) << done.error().line();
        EXPECT_FALSE(judge->found().difference) << judge->found().difference->line();
        EXPECT_GT(judge->found().ticks, 300u);
    }

    Workplace place;

private:
    [[nodiscard]] SessionSetup drawn_options() const {
        SessionSetup options = short_options((place / "it.session").string());
        options.desk.offscreen = true;
        options.desk.width = static_cast<int>(kShownSize.width);
        options.desk.height = static_cast<int>(kShownSize.height);
        return options;
    }
    static Result<void> run(const SessionSetup& options, std::optional<int> lost_at, Carved& carved) {
        PacedClock clock(2);  // the hand's thread and the frames
        const auto wall = session_wall(options.desk);
        if (!wall) return std::unexpected(wall.error());
        auto presenter = Presenter::open(options.desk, *wall);
        if (!presenter) return std::unexpected(presenter.error());
        auto desk = Desk::create(carving_with(*presenter, options), *wall, clock);
        if (!desk) return std::unexpected(desk.error());
        Session& session = (*desk)->session();
        auto writer = create_recording(options, {{"program", "a test"}}, session);
        if (!writer) return std::unexpected(writer.error());
        ThreadsSeen seen(session, clock, 30);
        DrawnFrames frames(**desk, *presenter,
                           InputSource::play(*parse_input_log(kShortScript, "script"), std::move(*writer)), clock, seen,
                           lost_at);
        ThreadedExecutor threads(clock, session.loop(), session.channels_of_parts(), session.scene(), {},
                                 [&](const auto& ended) { seen.update_ended(ended); });
        static_cast<void>(threads.start());
        const Result<void> driven = drive(threads, frames);
        const Result<void> finished = frames.finish(threads);
        const compute::CarvingEngine& engine = *session.scene_side().engine();
        carved.engine = engine.name();
        if (const auto traffic = engine.traffic()) carved.submissions_to_carve = traffic->submissions;
        carved.submissions_to_draw = presenter->device().asked().submissions;
        return driven ? finished : driven;
    }
};

}  // namespace

TEST_F(OneDevice, CarvesOnOneThreadAndDrawsOnAnother) {
    const Carved carved = carve();
    EXPECT_EQ(carved.engine, "vulkan") << carved.said;
    EXPECT_GT(carved.submissions_to_carve, 5u) << "nothing was carved";
    EXPECT_GT(carved.submissions_to_draw, 5u) << "nothing was drawn";
    expect_the_processors();
}

TEST_F(OneDevice, IsLostInMidStrokeAndPictureAndSolidGoOn) {
    const Carved carved = carve(20);
    EXPECT_TRUE(carved.said.contains("the graphics device was lost; starting on a new one")) << carved.said;
    EXPECT_TRUE(carved.said.contains("the processor carves instead, and nothing is lost")) << carved.said;
    EXPECT_TRUE(carved.said.contains("carves again")) << carved.said;
    EXPECT_EQ(carved.engine, "vulkan") << carved.said;
    expect_the_processors();
}

}  // namespace burin::session
