// SPDX-License-Identifier: MIT
// What happens in a recorded session beside its ticks: its events, and the state of its activity.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/desk/recorded_session.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {

// What fingers touch, and what an activity writes, is in the file by names, and is compared.
TEST(SessionRecording, KeepsWhatIsTouchedAndWhatAnActivityWritesAsEvents) {
    const std::string script = R"(burin-input 1 test
0.02 mouse 320 180
0.05 scroll 0 9
0.2 button press left
2.0 button release left
4.0 close
)";
    const Workplace place;
    const std::string path = (place / "a.session").string();
    static_cast<void>(record_live(grasp_options(path, std::make_shared<Grasping>()), script));
    auto reader = record::RecordReader::open(path);
    ASSERT_TRUE(reader);
    const auto events = *reader->events();
    ASSERT_GE(events.size(), 2u);
    const auto has = [&](const std::string& name) {
        return std::ranges::any_of(events, [&](const auto& e) { return e.name == name && e.value == "block"; });
    };
    EXPECT_TRUE(has("thumb touches"));
    EXPECT_TRUE(has("thumb leaves"));
    EXPECT_TRUE(has("takes hold"));

    auto log = log_in(path);
    ASSERT_TRUE(log) << log.error().line();
    const Judged is = judged(*log, path, grasp_options("", std::make_shared<Grasping>()));
    ASSERT_TRUE(is.done) << is.done.error().line();
    EXPECT_EQ(is.departed, 0u);
    ASSERT_EQ(is.events.size(), events.size());
    const auto told = [&](const std::vector<EventMark>& others, bool whole = true) {
        const auto compared = compare_events(*reader, others, whole);
        return compared ? std::string("nothing") : compared.error().line();
    };
    EXPECT_EQ(told(is.events), "nothing");
    std::vector<EventMark> others = is.events;
    ++others[1].time_ns;
    EXPECT_TRUE(told(others).contains("event 2 is")) << told(others);
    others = is.events;
    others.back().value = "another";
    EXPECT_TRUE(told(others).contains("another'")) << told(others);
    others = is.events;
    others.pop_back();
    EXPECT_TRUE(told(others).contains("when it is done again")) << told(others);
    EXPECT_EQ(told(others, false), "nothing") << "of a log that was torn off before";

    // An activity that goes another way than it went is told by each frame from there on.
    const auto astray = std::make_shared<Grasping>();
    astray->adds_to_check = 1;
    EXPECT_GT(judged(std::move(*log), path, grasp_options("", astray)).departed, 10u);
}

}  // namespace burin::session
