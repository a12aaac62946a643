// SPDX-License-Identifier: MIT
// A recorded session as a device, from end to end: the hand of a session that carves is recorded, and carves again in a
// session that nobody leads.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "record/motion.hpp"
#include "session/record/recordings.hpp"
#include "tests/desk/recorded_session.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

const std::string kCarves = R"(burin-input 1 test
0.02 mouse 320 180
0.05 scroll 0 15
0.1 button press left
0.12 scroll 0 10
0.2 mouse 330 184
0.3 mouse 350 190
0.4 button release left
0.5 close
)";
const std::string kNobody = "burin-input 1 test\n0.5 close\n";

// Frames each 5 ms of simulated time.
class SteppedFrames final : public FrameSource {
public:
    SteppedFrames(Recorded& of, Clock& clock) : of_(of), start_ns_(clock.now_ns()) {}
    [[nodiscard]] std::optional<Nanoseconds> next() override {
        if (of_.desk->session().state().quit) return std::nullopt;
        return start_ns_ + ++frame_ * 5'000'000;
    }
    [[nodiscard]] Result<void> make(Executor& executor) override {
        of_.recorder->outside();
        const Nanoseconds now_ns = start_ns_ + frame_ * 5'000'000 - of_.desk->session().start_ns();
        const auto input = of_.input->begin_frame(now_ns, now_ns + 10'000'000);
        if (!input) return fail("test", "has no input");
        return step_frame(*of_.desk, executor, *of_.recorder, *input, {{.size = kShownSize}});
    }

private:
    Recorded& of_;
    Nanoseconds start_ns_;
    Nanoseconds frame_ = 0;
};

// Records a session in simulated time; returns the checksum of the surface that it leaves.
std::uint64_t recorded_in_steps(const SessionSetup& options, const std::string& script) {
    SimulatedClock clock;
    Recorded recorded(options, clock, Recorded::Of::script, script);
    Session& s = recorded.desk->session();
    SteppedFrames frames(recorded, clock);
    SteppedExecutor executor(clock, s.loop(), s.channels_of_parts(), s.scene(),
                             [&](const auto& ended) { static_cast<void>(s.collect(ended)); });
    EXPECT_TRUE(drive(executor, frames));
    recorded.recorder->finish(executor.take_updates()->updates);
    s.finish_scene();
    EXPECT_TRUE(s.files().outcome());
    return check_of(s);
}

// All rows of a table's columns whose names begin so.
std::vector<record::Word> words_of(const std::string& path, std::size_t table, const std::string& columns) {
    auto reader = record::RecordReader::open(path);
    EXPECT_TRUE(reader) << reader.error().line();
    const auto chosen = record::choose_columns(reader->hands()[table].columns, columns);
    EXPECT_TRUE(chosen) << chosen.error().line();
    std::vector<record::Word> words;
    record::RowWalk walk(*reader, table);
    for (auto more = walk.next(); more && *more; more = walk.next())
        for (const std::size_t column : *chosen) words.push_back(walk.at(column));
    return words;
}

std::string recorded_refusal(const std::string& device) {
    SessionSetup setup;
    setup.hands.device = device;
    SessionSetup options = short_options({});
    options.hands.device = device;
    SimulatedClock clock;
    const auto desk = Desk::create(options, *session_wall(options.desk), clock);
    return desk ? "nothing" : desk.error().line();
}

}  // namespace

TEST(RecordedHand, CarvesAgainWhatItCarvedToTheBit) {
    const Workplace at;
    SessionSetup options = short_options((at / "first.session").string());
    const std::uint64_t carved = recorded_in_steps(options, kCarves);
    SessionSetup again = short_options((at / "again.session").string());
    again.hands.device = "recorded:" + options.record.path;
    const std::uint64_t carved_again = recorded_in_steps(again, kNobody);
    const std::uint64_t untouched = recorded_in_steps(short_options((at / "nobody.session").string()), kNobody);
    EXPECT_EQ(carved_again, carved) << "the same is removed";
    EXPECT_NE(carved, untouched) << "and something is";
    const std::string device = "sample_time_ns,position_device*,orientation_device*,rotation_device*,buttons,fault";
    const auto first = words_of(options.record.path, 0, device), second = words_of(again.record.path, 0, device);
    ASSERT_GE(first.size(), 480u * 13u);
    EXPECT_EQ(first.size(), second.size());
    EXPECT_TRUE(first == second);
    // The same samples before the same surface ask for the same forces, although nobody feels them.
    const std::string felt = "hip*,proxy*,force*,penetration*,time_ns";
    EXPECT_TRUE(words_of(options.record.path, 0, felt) == words_of(again.record.path, 0, felt));
    std::printf("%zu ticks, %zu words of the device: equal to the bit; surface %016llx\n",
                words_of(again.record.path, 0, "tick").size(), second.size(),
                static_cast<unsigned long long>(carved_again));
}

// A recording of a recorded hand is a recording as any other.
TEST(RecordedHand, IsRecordedAndReplayedItself) {
    const Workplace at;
    const std::string first = (at / "first.session").string();
    static_cast<void>(recorded_in_steps(short_options(first), kCarves));
    SessionSetup again = short_options((at / "again.session").string());
    again.hands.device = "recorded:" + first;
    EXPECT_GT(record_live(again, kNobody), 0u);
    auto reader = record::RecordReader::open(again.record.path);
    ASSERT_TRUE(reader) << reader.error().line();
    auto log = read_session_log(*reader);
    ASSERT_TRUE(log) << log.error().line();
    const Judged found = judged(std::move(*log), again.record.path, again);
    EXPECT_TRUE(found.done) << found.done.error().line();
    EXPECT_FALSE(found.found.difference);
    EXPECT_GE(found.found.ticks, 100u);
}

TEST(RecordedHand, IsChosenByNameOfSeveral) {
    const Workplace at;
    SessionSetup options = short_options((at / "two.session").string());
    options.hands.named = {{"right", "simulated"}, {"left", "simulated-fingers"}};
    options.hands.device = "simulated";
    static_cast<void>(recorded_in_steps(options, kCarves));
    const devices::Recordings& recordings = session_recordings();
    const auto left = recordings.hand_of(options.record.path, "left");
    ASSERT_TRUE(left) << left.error().line();
    EXPECT_EQ(left->device, "simulated-fingers");
    ASSERT_EQ(left->parts.size(), 4u);
    EXPECT_EQ(left->parts[1].name, "index");
    EXPECT_EQ(recordings.hand_of(options.record.path, "right")->parts.size(), 1u);
    EXPECT_EQ(recordings.device_of(options.record.path, "").value(), "simulated") << "the first";
    EXPECT_TRUE(recorded_refusal("recorded:" + options.record.path + ":middle").contains("its hands are right, left"))
        << recorded_refusal("recorded:" + options.record.path + ":middle");
    SessionSetup again = short_options((at / "again.session").string());
    again.hands.device = "recorded:" + options.record.path + ":right";
    static_cast<void>(recorded_in_steps(again, kNobody));
    EXPECT_TRUE(words_of(options.record.path, 0, "position_device*") ==
                words_of(again.record.path, 0, "position_device*"));
}

TEST(RecordedHand, SaysWhatIsWrongWithAFile) {
    const Workplace at;
    const std::string none = "recorded:" + (at / "none.session").string();
    EXPECT_TRUE(recorded_refusal(none).contains("none.session")) << recorded_refusal(none);
    at.write("text.session", "burin-input 1 test\n0.5 close\n");
    const std::string text = recorded_refusal("recorded:" + (at / "text.session").string());
    EXPECT_TRUE(text.contains("text.session")) << text;
    const std::string file = (at / "one.session").string();
    static_cast<void>(recorded_in_steps(short_options(file), kNobody));
    EXPECT_TRUE(recorded_refusal("recorded:" + file + ":left").contains("it has one hand, without a name"));
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    EXPECT_NE(recorded_refusal("recorded:" + file), "nothing") << "a file that is cut";
}

}  // namespace burin::session
