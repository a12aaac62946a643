// SPDX-License-Identifier: MIT
// Descriptions of trackers: what they mean, and what is wrong with bad ones.
#include "devices/trackers/tracker_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "devices/emulators/emulated_motion.hpp"

namespace burin::devices {
namespace {

constexpr const char* kGood = R"(name = "Lab"
address = "vrpn:10.0.0.2"
units = "cm"
reported_units = "mm"
axes = ["+x", "+z", "-y"]
prediction_ms = 20

[world_from_tracker]
position = [100, 0, -50]
orientation = [0, 0.70710678118654757, 0, 0.70710678118654757]

[head]
body = "Glasses/3"
position = [0, -7, 9]

[[wand]]
body = "Stick"
position = [0, 0, -12]
prediction_ms = 0
buttons = "Keys/2"
button_order = [1, 0]
stick = "Pad/1"
)";

// Returns the text with one line's beginning replaced.
std::string with(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

std::string wrong(const std::string& text) {
    const auto read = parse_tracker(text, "t.toml");
    return read ? "nothing" : read.error().line();
}

// The samples that a translator makes of reports.
std::vector<TrackerInput> heard(TrackerInbox& inbox) {
    std::vector<TrackerInput> inputs;
    for (TrackerSample& sample : inbox.take()) inputs.push_back(std::move(sample.input));
    return inputs;
}

std::filesystem::path written(const std::string& name, const std::string& text) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / name;
    std::ofstream(path) << text;
    return path;
}

}  // namespace

TEST(TrackerFile, P2SaysWhichBodiesCountAndWhatTheirReportsMean) {
    const auto read = parse_tracker(kGood, "t.toml");
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_EQ(read->address, "vrpn:10.0.0.2");
    const TrackerBodies& bodies = read->bodies;
    EXPECT_EQ(bodies.head, (TrackedSource{"Glasses", 3}));
    EXPECT_EQ(bodies.wands[0], (TrackedSource{"Stick", 0}));
    EXPECT_FALSE(bodies.wands[1]);
    EXPECT_EQ(bodies.head_mount.ahead_ns, 20'000'000);
    EXPECT_EQ(bodies.wand_mounts[0].ahead_ns, 0);

    TrackerInbox inbox;
    TrackerTranslator translator("t", bodies, inbox);
    // The head stands 2 m away (system y), 1.6 m up (system z), turned by a quarter about the system's z.
    const Quat turned = glm::angleAxis(std::asin(1.0), Vec3(0, 0, 1));
    translator.pose("Glasses", 3, {{500.0, 2000.0, 1600.0}, turned}, true, 1);
    translator.button("Keys", 3, true, 2);
    translator.button("Keys", 4, true, 2);  // not in the order: nobody's
    translator.channels("Pad", std::array{0.9, 0.1, -0.2}, 3);
    const auto inputs = heard(inbox);
    ASSERT_EQ(inputs.size(), 3u);
    // In the tracker's frame it is at (0.5, 1.6, -2), turned about +y, which takes the offset (0, -0.07, 0.09) to
    // (0.09, -0.07, 0). The tracker's frame is turned about +y by a quarter as well: (x, y, z) becomes (z, y, -x).
    const auto& head = std::get<HeadInput>(inputs[0]);
    EXPECT_LT(glm::length(head.pose_world.position_m - Vec3(1.0 - 2.0, 1.6 - 0.07, -0.5 - 0.59)), 1e-12);
    EXPECT_LT(glm::length(head.pose_world.orientation * Vec3(0, 0, 1) - Vec3(0, 0, -1)), 1e-12) << "a half turn in all";
    EXPECT_EQ(inputs[1], TrackerInput(WandClick{0, 0, true})) << "the second key is the first button";
    EXPECT_EQ(inputs[2], TrackerInput(WandStick{0, {0.1, -0.2}}));
}

// A left-handed system that agrees with the world in x and y has z away from the viewer, and turns the other way round.
TEST(TrackerFile, P2TakesALeftHandedSystemIntoTheWorld) {
    const auto read = parse_tracker(
        "address = \"vrpn:a\"\nunits = \"m\"\naxes = [\"+x\", \"+y\", \"-z\"]\nhandedness = \"left\"\n[head]\nbody = "
        "\"H\"\n",
        "t.toml");
    ASSERT_TRUE(read) << read.error().line();
    TrackerInbox inbox;
    TrackerTranslator translator("t", read->bodies, inbox);
    const double angle = 0.4;
    translator.pose("H", 0, {{0.1, 1.6, -2.0}, glm::angleAxis(angle, Vec3(0, 1, 0))}, true, 1);
    const auto inputs = heard(inbox);
    ASSERT_EQ(inputs.size(), 1u);
    const Pose& pose = std::get<HeadInput>(inputs[0]).pose_world;
    EXPECT_LT(glm::length(pose.position_m - Vec3(0.1, 1.6, 2.0)), 1e-12);
    // The body's z axis in the system is (sin a, 0, cos a); the mirrored body's -z is that, mirrored.
    EXPECT_LT(glm::length(pose.orientation * Vec3(0, 0, -1) - Vec3(std::sin(angle), 0, -std::cos(angle))), 1e-12);
    EXPECT_LT(glm::length(pose.orientation * Vec3(1, 0, 0) - Vec3(std::cos(angle), 0, std::sin(angle))), 1e-12);
}

// The matrix of an axis list says the same.
TEST(TrackerFile, ReadsARotationAsRows) {
    const auto axes = parse_tracker(kGood, "t.toml");
    const auto rows = parse_tracker(
        with(kGood, "axes = [\"+x\", \"+z\", \"-y\"]", "rotation = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]"), "t.toml");
    ASSERT_TRUE(rows) << rows.error().line();
    EXPECT_EQ(rows->bodies, axes->bodies);
}

TEST(TrackerFile, IsTheSameWhenItIsWrittenAndReadAgain) {
    for (const std::string& text :
         {std::string(kGood), with(with(kGood, "vrpn:10.0.0.2", "udp:5005"), "\"Glasses/3\"", "\"head\""),
          with(with(kGood, "\"-y\"", "\"+y\""), "prediction", "handedness = \"left\"\nprediction")}) {
        const auto read = parse_tracker(
            with(with(with(text, "\"Stick\"", "\"wand\""), "Keys/2", "wand0/2"), "Pad/1", "wand0"), "t.toml");
        ASSERT_TRUE(read) << read.error().line();
        const auto again = parse_tracker(tracker_text(*read), "t.toml");
        ASSERT_TRUE(again) << again.error().line() << tracker_text(*read);
        EXPECT_EQ(again->address, read->address);
        EXPECT_EQ(tracker_text(*again), tracker_text(*read));
        EXPECT_EQ(again->bodies.head, read->bodies.head);
        EXPECT_EQ(again->bodies.frame.is_left_handed, read->bodies.frame.is_left_handed);
        EXPECT_LT(glm::length(again->bodies.wand_mounts[0].body_from_point.position_m -
                              read->bodies.wand_mounts[0].body_from_point.position_m),
                  1e-15);
    }
}

TEST(TrackerFile, NamesFileLineAndRemedyOfWhatIsWrong) {
    struct Wrong {
        const char *what, *by, *where, *said;
    };
    for (const Wrong& w : {
             Wrong{"body = \"Glasses/3\"", "bdoy = \"Glasses/3\"", "t.toml:13", "did you mean body?"},
             {"body = \"Glasses/3\"\n", "", "t.toml", "[head] has no body"},
             {"\"Glasses/3\"", "\"Glasses/x\"", "t.toml:13", "write NAME/NUMBER"},
             {"vrpn:10.0.0.2", "optitrack:1", "t.toml:2", "no tracker that Burin knows"},
             {"vrpn:10.0.0.2", "vrpn:a,head=B", "t.toml:2", "settings after a comma"},
             {"address = \"vrpn:10.0.0.2\"\n", "", "t.toml", "has no address"},
             {"units = \"cm\"\n", "", "t.toml", "has no units"},
             {"units = \"cm\"", "units = \"yd\"", "t.toml:3", "units is yd; write m, mm, cm, in or ft"},
             {"reported_units = \"mm\"", "reported_units = \"m m\"", "t.toml:4", "write m, mm, cm, in or ft"},
             {"\"-y\"", "\"+y\"", "t.toml:5", "axes is a mirror image"},
             {"\"-y\"", "\"-x\"", "t.toml:5", "does not name each of x, y and z once"},
             {"\"-y\"", "\"--y\"", "t.toml:5", "does not name each of x, y and z once"},
             {"axes = [\"+x\", \"+z\", \"-y\"]", "rotation = [[1, 0, 0], [0, 0, 1], [0, -1.1, 0]]", "t.toml:5",
              "is no rotation: its rows are off by 0.21"},
             {"axes = [\"+x\", \"+z\", \"-y\"]", "rotation = [[1, 0, 0], [0, 0, 1], [0, 1, 0]]", "t.toml:5",
              "rotation is a mirror image"},
             {"axes = [\"+x\", \"+z\", \"-y\"]", "rotation = [[1, 0, 0], [0, 0, 1]]", "t.toml:5",
              "not a list of 3 rows"},
             {"axes = [\"+x\", \"+z\", \"-y\"]", "handedness = \"left\"", "t.toml:5", "nothing says how the axes lie"},
             {"prediction_ms = 20", "handedness = \"left\"", "t.toml:5", "into another left-handed one"},
             {"prediction_ms = 20", "handedness = \"both\"", "t.toml:6", "write right or left"},
             {"prediction_ms = 20", "prediction_ms = 200", "t.toml:6", "write milliseconds from 0 to 100"},
             {"prediction_ms = 20", "prediction_ms = -1", "t.toml:6", "write milliseconds from 0 to 100"},
             {"[0, -7, 9]", "[0, -7000, 9]", "t.toml:14", "see that units is right"},
             {"[0, -7, 9]", "[0, 9]", "t.toml:14", "not a list of 3 numbers"},
             {"orientation = [0, 0.7", "orientation = [0, nan, 0, 1] # ", "t.toml:10", "orientation"},
             {"\"Stick\"", "\"Glasses/3\"", "t.toml:17", "is the body of another one too"},
             {"button_order = [1, 0]", "button_order = [1, 1]", "t.toml:21", "at most once"},
             {"button_order = [1, 0]", "button_order = [1, 0.5]", "t.toml:21", "at most once"},
             {"name = \"Lab\"", "name = ", "t.toml:1", "is not TOML"},
         }) {
        const std::string said = wrong(with(kGood, w.what, w.by));
        EXPECT_TRUE(said.contains(w.where)) << w.by << ": " << said;
        EXPECT_TRUE(said.contains(w.said)) << w.by << ": " << said;
    }
    EXPECT_TRUE(wrong("address = \"vrpn:a\"\nunits = \"m\"\n").contains("names neither a head nor a wand"));
    EXPECT_TRUE(
        wrong("address = \"dtrack:5000\"\nunits = \"m\"\n[head]\nbody = \"Glasses\"\n")
            .contains("t.toml:4: body is \"Glasses\", which dtrack has not; write a number behind one of: body"));
    EXPECT_TRUE(wrong("address = \"dtrack:5000\"\nunits = \"m\"\nreported_units = \"m\"\n[head]\nbody = \"body\"\n")
                    .contains("t.toml:3: reported_units is set, but the protocol of dtrack has a unit itself"));
    std::string three = kGood;
    for (const char* name : {"A", "B"}) three += std::string("[[wand]]\nbody = \"") + name + "\"\n";
    EXPECT_TRUE(wrong(three).contains("t.toml:25: is one wand more than 2")) << wrong(three);
}

TEST(TrackerFile, TellsAllProblemsAtOnce) {
    const std::string said = wrong(with(with(kGood, "\"-y\"", "\"+y\""), "\"cm\"", "\"yd\""));
    EXPECT_TRUE(said.starts_with("t.toml: 2 problems:")) << said;
}

TEST(TrackerFile, IsNamedByAWallFileWithAnAddressOfItsOwn) {
    static_cast<void>(written("described.toml", kGood));
    const auto wall =
        written("walled.toml", "name = \"w\"\n[tracker]\nfile = \"described.toml\"\naddress = \"vrpn:b:99\"\n");
    const auto read = tracker_of_wall(wall);
    ASSERT_TRUE(read) << read.error().line();
    ASSERT_TRUE(*read);
    EXPECT_EQ((*read)->address, "vrpn:b:99");
    EXPECT_EQ((*read)->bodies, parse_tracker(kGood, "t.toml")->bodies);
    const auto inside = tracker_of_wall(
        written("walled.toml", "[tracker]\naddress = \"udp:5005\"\nunits = \"m\"\n[tracker.head]\nbody = \"head\"\n"));
    ASSERT_TRUE(inside) << inside.error().line();
    EXPECT_EQ((*inside)->address, "udp:5005");
    EXPECT_FALSE(*tracker_of_wall(written("walled.toml", "name = \"w\"\n")));
    const auto said = [&](const std::string& text) {
        const auto none = tracker_of_wall(written("walled.toml", text));
        return none ? "nothing" : none.error().line();
    };
    EXPECT_TRUE(
        said("[tracker]\nfile = \"described.toml\"\naddress = \"udp:1\"\n").contains("give both the same kind"));
    EXPECT_TRUE(
        said("[tracker]\nfile = \"described.toml\"\nunits = \"m\"\n").contains("walled.toml:3: [tracker] has no key"));
    EXPECT_TRUE(said("[tracker]\nfile = \"none.toml\"\n").contains("none.toml"));
    EXPECT_TRUE(said("[tracker]\nfile = 3\n").contains("walled.toml:2: file is not a text"));
}

TEST(TrackerFile, DescriptionsOfTheProjectAreSound) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("assets/trackers")) {
        if (entry.path().extension() != ".toml") continue;
        const auto read = read_tracker(entry.path());
        EXPECT_TRUE(read) << read.error().line();
        ++count;
    }
    EXPECT_GE(count, 2u);
}

// Poses come 40 ms late, 60 a second, of the emulated viewer, whose closed form says where the head is meanwhile.
TEST(TrackerPrediction, LowersTheErrorOfPosesThatComeLate) {
    constexpr Nanoseconds kLate_ns = 40'000'000, kPeriod_ns = kNanosecondsPerSecond / 60;
    const auto worst = [&](Nanoseconds ahead_ns) {
        TrackerBodies bodies{.head = {{"H", 0}}, .wands = {{{{"W", 0}}, std::nullopt}}};
        bodies.head_mount.ahead_ns = bodies.wand_mounts[0].ahead_ns = ahead_ns;
        TrackerInbox inbox;
        TrackerTranslator translator("t", bodies, inbox);
        std::array<double, 4> most{};  // head: m, rad; wand: m, rad
        for (Nanoseconds t = 0; t < 24 * kNanosecondsPerSecond; t += kPeriod_ns) {
            const EmulatedMotion then = emulated_motion(seconds(t)), now = emulated_motion(seconds(t + kLate_ns));
            translator.pose("H", 0, then.head_world, true, t + kLate_ns);
            translator.pose("W", 0, then.wand_world, true, t + kLate_ns);
            const auto inputs = heard(inbox);
            if (t < kPeriod_ns) continue;  // the first has no velocity
            const auto widen = [&](std::size_t i, const Pose& said, const Pose& is) {
                most[i] = std::max(most[i], glm::length(said.position_m - is.position_m));
                most[i + 1] =
                    std::max(most[i + 1], glm::length(rotation_vector_between(said.orientation, is.orientation)));
            };
            widen(0, std::get<HeadInput>(inputs[0]).pose_world, now.head_world);
            widen(2, std::get<WandInput>(inputs[1]).pose_world, now.wand_world);
        }
        return most;
    };
    const auto late = worst(0), predicted = worst(kLate_ns);
    std::printf(
        "40 ms late: head %.2f mm %.2f mrad, wand %.2f mm %.2f mrad; predicted: head %.2f mm %.2f mrad, "
        "wand %.2f mm %.2f mrad\n",
        1e3 * late[0], 1e3 * late[1], 1e3 * late[2], 1e3 * late[3], 1e3 * predicted[0], 1e3 * predicted[1],
        1e3 * predicted[2], 1e3 * predicted[3]);
    // The head's speed reaches 0.2 * 2 pi / 8 m/s and its acceleration 0.2 (2 pi / 8)^2 + 0.02 (2 pi / 3)^2 m/s2; the
    // bound is a T (T + W) / 2 with the window that two samples span.
    const double T = seconds(kLate_ns), W = seconds(kPeriod_ns), pi = std::acos(-1.0);
    EXPECT_GT(late[0], 0.99 * 0.2 * 2.0 * pi / 8.0 * T);
    EXPECT_LT(predicted[0],
              (0.2 * std::pow(2.0 * pi / 8.0, 2) + 0.02 * std::pow(2.0 * pi / 3.0, 2)) * T * (T + W) / 2.0);
    EXPECT_LT(predicted[1], 0.15 * std::pow(2.0 * pi / 8.0, 2) * T * (T + W) / 2.0);
    EXPECT_LT(predicted[2], 0.15 * std::pow(2.0 * pi / 6.0, 2) * T * (T + W) / 2.0);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(predicted[i], 0.15 * late[i]);
}

// A glitch of the tracker, or one that was lost for long, is not gone on with.
TEST(TrackerPrediction, IsBoundedAndForgetsWhatWasLost) {
    TrackerBodies bodies{.head = {{"H", 0}}};
    bodies.head_mount.ahead_ns = kMostAhead_ns;
    TrackerInbox inbox;
    TrackerTranslator translator("t", bodies, inbox);
    const auto said_at = [&](double x_m, Nanoseconds t, bool is_tracked = true) {
        translator.pose("H", 0, {{x_m, 1.6, 2.0}, Quat{1, 0, 0, 0}}, is_tracked, t);
        return std::get<HeadInput>(heard(inbox).at(0)).pose_world.position_m.x;
    };
    EXPECT_EQ(said_at(0.0, 0), 0.0) << "one sample has no velocity";
    EXPECT_NEAR(said_at(0.01, 10'000'000), 0.01 + 0.1, 1e-12) << "1 m/s, 100 ms ahead";
    EXPECT_NEAR(said_at(2.0, 11'000'000), 2.0 + 0.1 * kMostTracked_m_per_s, 1e-9);
    EXPECT_NEAR(said_at(0.0, 12'000'000, false), 2.0 + 0.1 * kMostTracked_m_per_s, 1e-9) << "lost where it was told";
    EXPECT_EQ(said_at(0.5, 20'000'000), 0.5);
    EXPECT_EQ(said_at(0.6, 500'000'000), 0.6) << "480 ms apart is no velocity";
    EXPECT_EQ(said_at(0.6, 500'000'000), 0.6) << "twice at once neither";
}

// A server that goes on, with its bodies or its buttons, although one body has stopped.
TEST(TrackerTranslator, LosesABodyThatHasStoppedAndSaysSo) {
    TrackerBodies bodies{.head = {{"H", 0}}, .wands = {{{{"W", 1}}, std::nullopt}}};
    TrackerInbox inbox;
    TrackerTranslator translator("vrpn:x", bodies, inbox);
    translator.pose("H", 0, {{0.1, 1.6, 2.0}, Quat{1, 0, 0, 0}}, true, 0);
    translator.pose("W", 1, {}, true, 0);
    EXPECT_FALSE(translator.lose_stopped(TrackerTranslator::kStopped_ns));
    translator.pose("W", 1, {}, true, TrackerTranslator::kStopped_ns);
    EXPECT_EQ(heard(inbox).size(), 3u);
    EXPECT_TRUE(translator.lose_stopped(TrackerTranslator::kStopped_ns + 1));
    EXPECT_FALSE(translator.lose_stopped(TrackerTranslator::kStopped_ns + 2)) << "once";
    const auto inputs = heard(inbox);
    ASSERT_EQ(inputs.size(), 1u);
    EXPECT_FALSE(std::get<HeadInput>(inputs[0]).tracked);
    EXPECT_EQ(std::get<HeadInput>(inputs[0]).pose_world.position_m.x, 0.1);
    const auto said = inbox.take_messages();
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0], "tracker vrpn:x: no new pose of H/0 has come for 1 s: it is lost where it was");
    translator.pose("H", 0, {}, true, 5 * kNanosecondsPerSecond);
    EXPECT_TRUE(std::get<HeadInput>(heard(inbox).at(0)).tracked) << "until it comes again";
}

TEST(TrackerTranslator, TellsOnceOfANamedBodyThatNeverShows) {
    TrackerBodies bodies{.head = {{"Glasses", 0}}, .wands = {{{{"Stick", 1}}, std::nullopt}}};
    bodies.are_named = true;
    TrackerInbox inbox;
    TrackerTranslator translator("vrpn:x", bodies, inbox);
    const auto said_until = [&](Nanoseconds until_ns) {
        for (Nanoseconds t = until_ns - kNanosecondsPerSecond; t <= until_ns; t += 100'000'000)
            for (const char* name : {"Glasses", "Tracker0"}) translator.pose(name, 0, {}, true, t);
        return inbox.take_messages();
    };
    EXPECT_TRUE(said_until(kNanosecondsPerSecond).empty());
    EXPECT_TRUE(said_until(2 * kNanosecondsPerSecond).empty());
    const auto said = said_until(TrackerTranslator::kPatience_ns);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0], "tracker vrpn:x: nothing comes of wand0 = Stick/1; what comes is of Glasses/0, Tracker0/0");
    EXPECT_TRUE(said_until(10 * kNanosecondsPerSecond).empty()) << "once";
}

}  // namespace burin::devices
