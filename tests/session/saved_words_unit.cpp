// SPDX-License-Identifier: MIT
// What a document keeps of a session besides the work: each command that sets something of it, saved and opened, of
// workpieces and of worlds; and which commands set nothing of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "compute/engine/chosen_engine.hpp"
#include "compute/engine/engine.hpp"
#include "document/document_store.hpp"
#include "sculpt/carved_workpiece.hpp"
#include "sculpt/load_workpiece.hpp"
#include "sculpt/sculpture.hpp"
#include "session/live/session.hpp"
#include "session/state/command_table.hpp"
#include "session/state/session_commands.hpp"
#include "session/work/saved_world.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::session {
namespace {

// A command that sets something of the work, away from where a session begins; by its name. Some need a workpiece.
struct KeptWord {
    std::string line;
    bool needs_workpiece = false;
};
const std::multimap<std::string, KeptWord> kKept{
    {"tool", {"tool cylinder:0.0031,0.017"}}, {"tool", {"tool ball:0.0043"}},
    {"operation", {"operation fill"}},        {"operation", {"operation smooth"}},
    {"colour", {"colour 0.2,0.4,0.8"}},       {"material", {"material oak"}},
    {"material", {"material soft"}},          {"mirror", {"mirror x", true}},
    {"mirror", {"mirror yz", true}},          {"radius", {"radius 0.0123"}},
    {"hardness", {"hardness 3e6"}},           {"hardness", {"hardness 0"}},
    {"friction", {"friction 0.73"}},          {"friction", {"friction 0"}},
    {"stiffness", {"stiffness 321"}},
};

// Commands that set nothing of the work. They are of the person, the room, the hand, its device, the picture or the
// moment.
const std::set<std::string> kOfTheMoment{
    "velocity-filter", "force-filter", "scale",     "eye-distance", "strength",     "force",       "amplifiers",
    "technique",       "stereo-mode",  "swap-eyes", "edge-comfort", "test-pattern", "object",      "select",
    "mouse",           "hand",         "do",        "show-force",   "calibrate",    "catch-drill", "save",
    "save-as",         "document",     "quit",      "export",       "screenshot"};

// Sessions of a workpiece or of a world, by turns of what is opened.
class KeptWords {
public:
    explicit KeptWords(bool carves) : carves_(carves) {
        place_.write("t.off", "OFF\n4 4 0\n0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
        place_.write("w.toml", "[[object]]\nname = \"rock\"\nmesh = \"t.off\"\nmesh_units = \"m\"\n");
    }
    // Returns the first state of a session of new work.
    SessionState begun(SessionSetup options = {}) {
        if (carves_)
            options.carve.workpiece = {"ball:0.03", 16, false};
        else
            options.scene.world = (place_ / "w.toml").string();
        options.scene.no_workpiece = !carves_;
        return state_of(std::move(options));
    }
    // Saves the work with what the state has of it, and the workpiece's bounds.
    void save(const SessionState& state, const Box& bounds_object = {}) {
        document::Content content{.facts = saved_facts(SessionSetup{}, state, bounds_object),
                                  .commands = saved_commands(state)};
        if (carves_) {
            auto ball = sculpt::load_workpiece({"ball:0.03", 16, false}, pool_);
            ASSERT_TRUE(ball);
            sculpt::Sculpture carving(compute::make_cpu_engine(std::move(ball->solid), pool_), pool_);
            carving.copy(content.parts.emplace_back());
        } else {
            SavedWorld world;
            world.begin(*state.world, {}, false);
            content.parts.push_back(world.all(*state.world, {}));
        }
        const auto saved = document::write_document(document_, content, document::Place::replaced);
        ASSERT_TRUE(saved);
        version_ = saved->version;
    }
    // Saves what the state has into the document that is there already, as each save after the first does.
    void save_again(const SessionState& state) {
        const document::Content changed{.facts = saved_facts(SessionSetup{}, state, {}),
                                        .commands = saved_commands(state)};
        const auto saved = document::update_document(document_, changed, version_);
        ASSERT_TRUE(saved);
        version_ = saved->version;
    }
    // Returns the first state of a session that opens what was saved, as the program does; of what is given besides.
    SessionState opened(SessionSetup options = {}) {
        (carves_ ? options.carve.workpiece.source : options.scene.world) = document_;
        options.scene.no_workpiece = !carves_;
        EXPECT_TRUE(settle_document(options));
        EXPECT_TRUE(take_settings_of_document(options));
        return state_of(std::move(options));
    }
    [[nodiscard]] Result<OpenedWork> read() const { return open_document(document_, 0); }

private:
    SessionState state_of(SessionSetup options) {
        options.carve.make_workpiece = sculpt::make_carved_workpiece;
        options.carve.engine = compute::EngineChoice::cpu;
        SimulatedClock clock;
        testing::internal::CaptureStderr();
        auto made = Session::create(options, clock);
        const std::string said = testing::internal::GetCapturedStderr();
        EXPECT_TRUE(made) << said;
        return made ? (*made)->state() : SessionState{};
    }
    bool carves_;
    WorkerPool pool_{1};
    Workplace place_;
    const std::string document_ = place_ / "work.burin";
    document::Version version_;
};

Result<void> run_line(SessionState& state, const std::string& line) {
    SessionOrders orders;
    const Result<SessionCommand> command = parse_command_line(line);
    return command ? run_command(state, orders, *command) : std::unexpected(command.error());
}

void expect_same_work(const SessionState& is, const SessionState& wanted, const std::string& of) {
    EXPECT_EQ(toolbox::text_of(is.led().tool.shape), toolbox::text_of(wanted.led().tool.shape)) << of;
    EXPECT_EQ(is.led().tool, wanted.led().tool) << of;
    EXPECT_EQ(is.feel, wanted.feel) << of;
    EXPECT_EQ(is.mirror, wanted.mirror) << of;
    EXPECT_EQ(saved_commands(is), saved_commands(wanted)) << of;
}

}  // namespace

TEST(SavedWords, EveryCommandIsKnownToBeOfTheWorkOrOfTheMoment) {
    std::size_t looked_at = 0;
    for (const CommandSpec& command : commands()) {
        const std::string name(command.name);
        const auto word = parse_command({name, {}});
        if (word && std::holds_alternative<RunAction>(*word)) continue;  // a key's, which sets what these set
        ++looked_at;
        EXPECT_NE(kKept.contains(name), kOfTheMoment.contains(name)) << name << " is to be in one of the two lists";
    }
    EXPECT_GE(looked_at, 30u);
}

TEST(SavedWords, EachComesBackWithTheDocumentThatWasSavedWithIt) {
    for (const bool carves : {true, false}) {
        KeptWords work(carves);
        const SessionState begun = work.begun();
        for (const auto& [name, word] : kKept) {
            SessionState state = begun;
            const auto done = run_line(state, word.line);
            if (word.needs_workpiece && !carves) {
                EXPECT_FALSE(done) << word.line;
                continue;
            }
            ASSERT_TRUE(done) << word.line << ": " << done.error().line();
            EXPECT_FALSE(state.led().tool == begun.led().tool && state.feel == begun.feel &&
                         state.mirror == begun.mirror)
                << word.line << " is what a session begins with";
            work.save(state);
            expect_same_work(work.opened(), state, word.line + (carves ? ", of a workpiece" : ", of a world"));
        }
    }
}

TEST(SavedWords, ComeBackAllTogether) {
    for (const bool carves : {true, false}) {
        KeptWords work(carves);
        SessionState state = work.begun();
        for (const char* const line :
             {"tool cylinder:0.0061,0.013", "operation paint", "colour 0.6,0.2,0.4", "material maple", "friction 0.41",
              "stiffness 654", "mirror xz", "radius 0.0071"})
            EXPECT_TRUE(run_line(state, line) || !carves) << line;
        work.save(state);
        expect_same_work(work.opened(), state, carves ? "of a workpiece" : "of a world");
        ASSERT_TRUE(run_line(state, "hardness 7e6"));
        work.save(state);
        expect_same_work(work.opened(), state, "with a hardness");
    }
}

// What no command sets: the unit of its numbers, from where it is seen, and how large it was.
TEST(SavedFacts, ComeBackWithTheDocumentThatWasSavedWithThem) {
    const Box bounds_object{{-0.021, -0.013, -0.017}, {0.019, 0.023, 0.011}};
    for (const bool carves : {true, false}) {
        KeptWords work(carves);
        SessionState state = work.begun();
        const Pose pose = uneven_pose(2);
        state.world_from_object = {pose.position_m, pose.orientation, kUnevenScales[2]};
        for (const LengthUnit unit : {LengthUnit::inch, LengthUnit::cm}) {
            state.export_unit = unit;
            work.save(state, carves ? bounds_object : Box{});
            const SessionState is = work.opened();
            EXPECT_EQ(is.world_from_object, state.world_from_object);
            const auto opened = work.read();
            ASSERT_TRUE(opened) << opened.error().line();
            EXPECT_EQ(opened->lost, "");
            if (!carves) continue;
            EXPECT_EQ(is.export_unit, unit);
            EXPECT_EQ(opened->workpiece->unit, unit);
            EXPECT_EQ(opened->workpiece->bounds_object, bounds_object);
        }
    }
}

// What the command line says counts more than the document.
TEST(SavedWords, GiveWayToWhatIsGivenOnOpening) {
    KeptWords work(true);
    SessionState state = work.begun();
    for (const char* const line :
         {"tool ball:0.0043", "colour 0.2,0.4,0.8", "friction 0.73", "stiffness 321", "mirror y"})
        ASSERT_TRUE(run_line(state, line)) << line;
    for (const char* const hardness : {"material oak", "hardness 3e6"}) {
        ASSERT_TRUE(run_line(state, hardness));
        work.save(state);
        SessionSetup given;
        given.hands.tool.shape = "cylinder:0.002,0.01";
        given.hands.tool.material = "1,2,3";
        given.carve.feel.hardness = "ptfe";
        given.carve.feel.friction = 0.11;
        given.carve.feel.stiffness_N_per_m = 777.0;
        given.carve.mirror.across = {true, false, true};
        const SessionState is = work.opened(given);
        EXPECT_EQ(toolbox::text_of(is.led().tool.shape), "cylinder:0.002,0.01");
        EXPECT_EQ(is.led().tool.colour, (std::array<std::uint8_t, 3>{1, 2, 3}));
        EXPECT_EQ(is.feel, (toolbox::FeelSettings{
                               .preset = toolbox::FeelPreset::ptfe, .stiffness_N_per_m = 777.0, .friction = 0.11}))
            << hardness;
        EXPECT_EQ(is.mirror, given.carve.mirror);
    }
}

// No command sets these, and a document keeps them likewise.
TEST(SavedWords, KeepWhatOfTheFeelOptionsAloneSet) {
    for (const bool carves : {true, false}) {
        KeptWords work(carves);
        SessionSetup uncut, yields, grained;
        uncut.carve.feel.hardness = "inf";
        yields.carve.feel.yield_kPa = 12.5;
        grained.carve.feel.grain_mm = 3.5;
        for (const SessionSetup& given : {uncut, yields, grained, SessionSetup{}}) {
            const SessionState state = work.begun(given);
            work.save(state);
            expect_same_work(work.opened(), state, given.carve.feel.hardness);
        }
        SessionSetup both = yields;
        both.carve.feel.grain_mm = 3.5;
        work.save(work.begun(both));
        SessionSetup given;
        given.carve.feel.hardness = "ptfe";
        given.carve.feel.grain_mm = 2.0;
        EXPECT_EQ(work.opened(given).feel,
                  (toolbox::FeelSettings{.preset = toolbox::FeelPreset::ptfe, .grain_mm = 2.0}))
            << "a material that is given brings its own yield";
    }
}

// A document is saved again and again: what was set and is not any more must not come back from an earlier save.
TEST(SavedWords, AreGoneWithTheNextSaveWhereTheyAreSetNoMore) {
    for (const bool carves : {true, false}) {
        KeptWords work(carves);
        const SessionState plain = work.begun();
        work.save(plain);
        SessionSetup uncut, yields, grained;
        uncut.carve.feel.hardness = "inf";
        yields.carve.feel.yield_kPa = 12.5;
        grained.carve.feel.grain_mm = 3.5;
        std::vector<std::pair<SessionState, std::string>> states{
            {work.begun(uncut), "inf"}, {work.begun(yields), "yield"}, {work.begun(grained), "grain"}};
        for (const char* const line : {"hardness 3e6", "friction 0.73", "stiffness 321", "mirror x", "material oak"})
            if (SessionState state = plain; run_line(state, line)) states.emplace_back(std::move(state), line);
        for (const auto& [state, of] : states) {
            work.save_again(state);
            expect_same_work(work.opened(), state, of);
            work.save_again(plain);
            expect_same_work(work.opened(), plain, "no " + of);
        }
    }
}

}  // namespace burin::session
