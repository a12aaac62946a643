// SPDX-License-Identifier: MIT
// Strokes, edits of objects and moves by hand are undone and repeated in one order: across a save, a kill and an
// opening, as often as these come.
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <functional>

#include "base/text.hpp"
#include "document/document_reader.hpp"
#include "gpu/device.hpp"
#include "record/database.hpp"
#include "scene/saved_objects.hpp"
#include "session/work/opened_work.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

const std::string kPyramid = "OFF\n4 4 0\n0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
constexpr std::size_t kUndo_bytes = std::size_t{64} << 20;

// A session's input, one line after the other.
class Lines {
public:
    void add(const std::string& line, double takes_s = 0.02) {
        text_ += formatted("%.3f %s\n", time_s_, line.c_str());
        time_s_ += takes_s;
    }
    void command(const std::string& words) { add("command " + words, 0.7); }  // longer than a step goes on
    void rest(double takes_s) { time_s_ += takes_s; }
    // From where the mouse is to there, in pixels from where it began.
    void move(double x, double y) {
        constexpr int kLines = 20;
        for (int i = 1; i <= kLines; ++i) {
            const double share = i / double{kLines};
            add(formatted("mouse %.2f %.2f", 320.0 + x_ + (x - x_) * share, 200.0 + y_ + (y - y_) * share));
        }
        x_ = x;
        y_ = y;
    }
    void scroll(int count, int way) {
        for (int i = 0; i < count; ++i) add(formatted("scroll 0 %d", way));
    }
    [[nodiscard]] std::string text() const { return "burin-input 1 test\n" + text_; }

private:
    std::string text_;
    double time_s_ = 0.1, x_ = 0.0, y_ = 0.0;
};

// Into the ball at a place, with the button down.
void stroke(Lines& lines, double x) {
    lines.move(x, 80.0);
    lines.rest(0.3);
    lines.add("button press left", 0.1);
    lines.scroll(60, 1);
    lines.add("button release left", 0.5);
    lines.scroll(60, -1);
    lines.rest(0.7);
}

// The rock is taken hold of and left elsewhere.
void move_by_hand(Lines& lines) {
    lines.move(-105.0, 70.0);
    lines.scroll(70, 1);
    lines.rest(0.5);
    lines.add("button press right", 0.1);
    lines.move(-60.0, 50.0);
    lines.rest(0.1);
    lines.add("button release right", 0.5);
    lines.scroll(70, -1);
    lines.rest(0.7);
}

constexpr std::size_t kSteps = 6;
// Two strokes, three edits and a move by hand, with what `after` adds after each.
void six_steps(Lines& lines, const std::function<void(std::size_t)>& after) {
    lines.command("technique fixed");
    lines.add("mouse 320 200");
    after(0);
    stroke(lines, -133.0);
    after(1);
    lines.command("object rock stiffness 500");
    after(2);
    move_by_hand(lines);
    after(3);
    lines.command("object bird scale 1.5");
    after(4);
    stroke(lines, -137.0);
    after(5);
    lines.command("object rock opacity 0.5");
    after(6);
}

class OneHistory : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
        place.write("t.off", kPyramid);
        place.write("w.toml",
                    "[[object]]\nname = \"rock\"\nmesh = \"t.off\"\nmesh_units = \"m\"\n[[object]]\nname = \"bird\"\n"
                    "mesh = \"t.off\"\nmesh_units = \"m\"\nposition = [0.2, 0.1, 0.0]\n");
    }
    std::string command(const std::string& of, const std::string& outputs, const Lines& lines) {
        place.write(outputs + ".txt", lines.text());
        return std::string(kBurinCommand) + " world " + of + " --tool ball:0.0045 --offscreen --journal j --outputs " +
               outputs + " --width 640 --height 400 --input " + outputs + ".txt";
    }
    std::string begins(const std::string& outputs, const Lines& lines) {
        return command("w.toml --workpiece ball:0.03 --resolution 32", outputs, lines);
    }
    void play(const std::string& session) {
        const Workplace::Outcome done = place.run(session);
        ASSERT_EQ(done.status, 0) << done.output;
    }
    // What a document holds of workpiece and objects.
    std::array<scene::Pages, 2> pages(const std::string& name) {
        auto reader = document::DocumentReader::open((place / name).string());
        EXPECT_TRUE(reader) << reader.error().line();
        return {*reader->pages_of("tri-dexel solid"), *reader->pages_of(scene::kObjectsPart)};
    }
    void expect_as_after(std::size_t steps, const std::string& name) {
        const auto found = pages(name), wanted = pages("a/" + std::to_string(steps) + ".burin");
        EXPECT_TRUE(found[0].pages == wanted[0].pages) << name << ": the workpiece after " << steps << " steps";
        EXPECT_TRUE(found[1].pages == wanted[1].pages) << name << ": the objects after " << steps << " steps";
    }
    // Runs a session until its journal is as it is wanted, and kills it.
    void kill_when(const std::string& session, const std::function<bool(const OpenedWork&)>& is_wanted) {
        fs::remove_all(place / "seen");
        fs::create_directory(place / "seen");
        const pid_t child = fork();
        if (child == 0) {
            const bool is_there = chdir((place / "").c_str()) == 0 && std::freopen("said.txt", "w", stderr) != nullptr;
            if (is_there) execlp("sh", "sh", "-c", ("exec " + session).c_str(), static_cast<char*>(nullptr));
            _exit(127);
        }
        pollfd ends{static_cast<int>(syscall(SYS_pidfd_open, child, 0)), POLLIN, 0};
        ASSERT_GE(ends.fd, 0);
        constexpr int kLooksAgain_ms = 50;
        while (!is_wanted(newest_journal(child)))
            ASSERT_EQ(poll(&ends, 1, kLooksAgain_ms), 0) << "it ended: " << place.read("said.txt");
        close(ends.fd);
        kill(child, SIGKILL);
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
    }
    // A copy of the session's journal, opened; nothing in it where it cannot be yet.
    OpenedWork newest_journal(pid_t session) {
        std::error_code failed;
        const std::string number = std::to_string(session);
        for (fs::directory_iterator at(place / "j", failed), end; !failed && at != end; at.increment(failed)) {
            const std::string name = at->path().filename().string();
            if (!name.contains("-" + number)) continue;
            const std::string seen = name.ends_with("-wal") ? "seen/work.burin-wal" : "seen/work.burin";
            if (name.ends_with(".burin") || name.ends_with("-wal"))
                fs::copy_file(at->path(), place / seen, fs::copy_options::overwrite_existing, failed);
        }
        auto opened = open_document((place / "seen/work.burin").string(), kUndo_bytes);
        return opened && opened->lost.empty() ? std::move(*opened) : OpenedWork{.version = {}};
    }
    Workplace place;
};

bool is_after(const OpenedWork& opened, std::size_t done, std::size_t all) {
    return opened.order.done() == done && opened.order.steps().size() == all;
}

}  // namespace

TEST_F(OneHistory, IsGoneBackAndForwardAcrossASaveAKillAndAnOpening) {
    Lines reference;
    six_steps(reference, [&](std::size_t step) { reference.command("save " + std::to_string(step) + ".burin"); });
    reference.command("quit discard");
    play(begins("a", reference));
    for (std::size_t step = 1; step <= kSteps; ++step) {
        const auto before = pages("a/" + std::to_string(step - 1) + ".burin"),
                   after = pages("a/" + std::to_string(step) + ".burin");
        EXPECT_NE(before[0].pages == after[0].pages, before[1].pages == after[1].pages)
            << "step " << step << " is of one part alone";
    }

    // Saved after the move by hand; what came then is in the journal alone.
    Lines killed;
    six_steps(killed, [&](std::size_t step) {
        if (step == 3) killed.command("save work.burin");
    });
    killed.rest(600.0);
    killed.command("quit");
    kill_when(begins("b", killed), [](const OpenedWork& opened) { return is_after(opened, kSteps, kSteps); });
    expect_as_after(3, "b/work.burin");

    // Takes back three, past an edit and the stroke, and is killed again.
    Lines goes_back;
    for (int i = 0; i < 3; ++i) goes_back.command("undo");
    goes_back.rest(600.0);
    goes_back.command("quit");
    kill_when(command("b/work.burin", "c", goes_back),
              [](const OpenedWork& opened) { return is_after(opened, kSteps - 3, kSteps); });

    Lines walks;
    const auto walk = [&](const std::string& way, std::size_t from, std::size_t to) {
        for (std::size_t step = from; step != to; step += to > from ? 1 : -1) {
            const std::size_t now = to > from ? step + 1 : step - 1;
            walks.command(way);
            walks.command("save " + way + std::to_string(now) + ".burin");
        }
    };
    walk("redo", kSteps - 3, kSteps);
    walk("undo", kSteps, 0);
    walks.command("save all.burin");
    walks.command("quit");
    play(command("b/work.burin", "d", walks));
    for (std::size_t step = 4; step <= kSteps; ++step)
        expect_as_after(step, "d/redo" + std::to_string(step) + ".burin");
    for (std::size_t step = 0; step < kSteps; ++step) expect_as_after(step, "d/undo" + std::to_string(step) + ".burin");

    // What was saved with all of it taken back is repeated in another session.
    Lines repeats;
    for (std::size_t step = 0; step < kSteps; ++step) {
        repeats.command("redo");
        repeats.command("save " + std::to_string(step + 1) + ".burin");
    }
    repeats.command("quit");
    play(command("d/all.burin", "e", repeats));
    for (std::size_t step = 1; step <= kSteps; ++step) expect_as_after(step, "e/" + std::to_string(step) + ".burin");
}

TEST_F(OneHistory, OfADamagedOrderUndoesTheEditsFirstAndSaysSo) {
    Lines lines;
    six_steps(lines, [](std::size_t) {});
    lines.command("save work.burin");
    lines.command("quit");
    play(begins("a", lines));
    const std::string name = (place / "a/work.burin").string();
    const auto whole = open_document(name, kUndo_bytes);
    ASSERT_TRUE(whole) << whole.error().line();
    EXPECT_TRUE(whole->lost.empty()) << whole->lost;
    std::vector<std::uint32_t> parts;
    for (const document::StepName& step : whole->order.steps()) parts.push_back(step.part);
    EXPECT_EQ(parts, (std::vector<std::uint32_t>{0, 1, 1, 1, 0, 1}));
    const auto damage = [&](const std::string& statement) {
        auto database = record::Database::open(name, record::Database::Use::write);
        ASSERT_TRUE(database);
        ASSERT_TRUE(database->run(statement));
    };
    damage("UPDATE step SET crc = crc + 1 WHERE part = -1");
    const auto damaged = open_document(name, kUndo_bytes);
    ASSERT_TRUE(damaged) << damaged.error().line();
    EXPECT_TRUE(damaged->lost.contains("the order of its steps is damaged")) << damaged->lost;
    EXPECT_EQ(damaged->order.done(), kSteps);
    EXPECT_EQ(damaged->order.back()->part, 1u);
    // A document of a program that kept no order and no edits: its strokes alone.
    damage("DELETE FROM history WHERE part <> 0");
    const auto older = open_document(name, kUndo_bytes);
    ASSERT_TRUE(older) << older.error().line();
    EXPECT_TRUE(older->lost.empty()) << older->lost;
    EXPECT_EQ(older->order.done(), 2u);
    EXPECT_EQ(older->edits.undoable(), 0u);
    // The oldest edit that can be read ends the way back.
    damage("INSERT INTO history SELECT 1, saves, first, done, last, 0 FROM history");
    const auto unsound = open_document(name, kUndo_bytes);
    ASSERT_TRUE(unsound) << unsound.error().line();
    EXPECT_TRUE(unsound->lost.contains("the history of its objects is damaged")) << unsound->lost;
    EXPECT_EQ(unsound->edits.undoable(), 0u);
}

}  // namespace burin::session
