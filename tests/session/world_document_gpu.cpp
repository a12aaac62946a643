// SPDX-License-Identifier: MIT
// Worlds as documents: edits of objects are saved, opened without the files that they came from, undone and repeated,
// and come back after a kill.
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

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

const std::string kOff = "OFF\n4 4 0\n0 0 0\n0.1 0 0\n0 0.1 0\n0 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

class DocumentOfAWorld : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
        place.write("t.off", kOff);
        place.write("w.toml",
                    "[[object]]\nname = \"rock\"\nmesh = \"t.off\"\nmesh_units = \"m\"\n[[object]]\nname = \"bird\"\n"
                    "mesh = \"t.off\"\nmesh_units = \"m\"\nposition = [0.2, 0.1, 0.0]\n[[object.path]]\ntime = 0.0\n"
                    "[[object.path]]\ntime = 1.0\nposition = [0.0, 0.05, 0.0]\n[[object.path]]\ntime = 2.0\n");
    }
    std::string command(const std::string& of, const std::string& outputs, const std::string& lines) {
        place.write(outputs + ".txt", "burin-input 1 test\n" + lines);
        return std::string(kBurinCommand) + " " + of + " --offscreen --journal j --outputs " + outputs +
               " --width 320 --height 180 --input " + outputs + ".txt";
    }
    void play(const std::string& of, const std::string& outputs, const std::string& lines) {
        done = place.run(command(of, outputs, lines));
        ASSERT_EQ(done.status, 0) << done.output;
    }
    // The objects of a document, as they are opened.
    std::vector<scene::SceneObject> objects(const std::string& name) {
        Result<document::DocumentReader> reader = document::DocumentReader::open((place / name).string());
        EXPECT_TRUE(reader) << reader.error().line();
        const auto pages = reader->pages_of(scene::kObjectsPart);
        EXPECT_TRUE(pages) << pages.error().line();
        return scene::load_objects(*pages, name)->objects;
    }
    scene::Pages pages(const std::string& name) {
        return *document::DocumentReader::open((place / name).string())->pages_of(scene::kObjectsPart);
    }
    Workplace place;
    Workplace::Outcome done;
};

const std::string kEdits =
    "0.1 command object rock stiffness 500\n0.2 command object rock position 0.1,0.0,0.05\n"
    "0.3 command object bird scale 1.5\n";

}  // namespace

TEST_F(DocumentOfAWorld, IsOpenedWithoutItsFilesAsItWasSaved) {
    play("world w.toml", "a", kEdits + "0.5 command save work.burin\n1 command quit\n");
    EXPECT_TRUE(done.output.contains("saved work.burin")) << done.output;
    fs::remove(place / "t.off");
    fs::remove(place / "w.toml");
    const auto saved = objects("a/work.burin");
    ASSERT_EQ(saved.size(), 2u);
    EXPECT_EQ(saved[0].material.stiffness_N_per_m, 500.0);
    EXPECT_LT(glm::distance(scene::displacement_m(saved[0]), Vec3(0.1, 0.0, 0.05)), 1e-12);
    EXPECT_EQ(saved[1].scale, 1.5);
    EXPECT_TRUE(std::holds_alternative<scene::PathMotion>(saved[1].motion));
    for (const std::string word : {"world", "sculpt"}) {  // whichever word it is opened by
        play(word + " a/work.burin", word, "0.2 command save again.burin\n0.5 command quit\n");
        EXPECT_TRUE(pages("a/work.burin").pages == pages(word + "/again.burin").pages);
    }
    done = place.run(std::string(kBurinCommand) + " info a/work.burin");
    EXPECT_EQ(done.status, 0) << done.output;
    EXPECT_TRUE(done.output.contains("objects: 3 pages")) << done.output;
    EXPECT_TRUE(done.output.contains("w.toml")) << done.output;
    done = place.run(std::string(kBurinCommand) + " world check a/work.burin");
    EXPECT_EQ(done.status, 0) << done.output;
    EXPECT_TRUE(done.output.contains("rock")) << done.output;
    done = place.run(std::string(kBurinCommand) + " convert a/work.burin part.stl");
    EXPECT_NE(done.status, 0);
    EXPECT_TRUE(done.output.contains("holds a world and no workpiece")) << done.output;
}

TEST_F(DocumentOfAWorld, IsUpdatedByWhatHasChangedAlone) {
    play("world w.toml", "a",
         "0.1 command save work.burin\n0.2 command object rock opacity 0.5\n0.5 command save work.burin\n1 command "
         "quit\n");
    EXPECT_EQ(objects("a/work.burin")[0].opacity, 0.5);
    EXPECT_EQ(document::DocumentReader::open((place / "a/work.burin").string())->version().saves, 2);
}

TEST_F(DocumentOfAWorld, HasEditsTakenBackAndRepeated) {
    play("world w.toml", "a",
         "0 command save first.burin\n" + kEdits +
             "0.5 command save all.burin\n0.6 command undo\n0.7 command undo\n0.8 command undo\n0.9 command save "
             "undone.burin\n1 command redo\n1.1 command redo\n1.2 command redo\n1.3 command save redone.burin\n2 "
             "command quit\n");
    EXPECT_TRUE(pages("a/first.burin").pages == pages("a/undone.burin").pages);
    EXPECT_TRUE(pages("a/all.burin").pages == pages("a/redone.burin").pages);
    EXPECT_FALSE(pages("a/all.burin").pages == pages("a/first.burin").pages);
    done = place.run(command("world w.toml", "b", "0.1 command undo\n0.5 command quit\n"));
    EXPECT_TRUE(done.output.contains("there is nothing to take back")) << done.output;
}

// Killed once its journal has the last of the edits, and not after some time: when that is, the disk decides.
TEST_F(DocumentOfAWorld, ComesBackAfterAKillWithWhatWasNotSaved) {
    const std::string burin =
        command("world w.toml", "a", "0 command save work.burin\n" + kEdits + "600 command quit\n") + " --record r.txt";
    const pid_t session = fork();
    if (session == 0) {
        const bool is_there = chdir((place / "").c_str()) == 0 && std::freopen("said.txt", "w", stderr) != nullptr;
        if (is_there) execlp("sh", "sh", "-c", ("exec " + burin).c_str(), static_cast<char*>(nullptr));
        _exit(127);
    }
    fs::create_directory(place / "seen");
    const auto has_edits = [&] {
        std::error_code failed;
        for (fs::directory_iterator at(place / "j", failed), end; !failed && at != end; at.increment(failed)) {
            const std::string name = at->path().filename().string();
            const std::string seen = name.ends_with("-wal") ? "seen/work.burin-wal" : "seen/work.burin";
            if (name.ends_with(".burin") || name.ends_with("-wal"))
                fs::copy_file(at->path(), place / seen, fs::copy_options::overwrite_existing, failed);
        }
        const auto opened = open_document((place / "seen/work.burin").string());
        return opened && opened->world && opened->world->objects.at(1).scale == 1.5;
    };
    pollfd ends{static_cast<int>(syscall(SYS_pidfd_open, session, 0)), POLLIN, 0};
    ASSERT_GE(ends.fd, 0);
    constexpr int kLooksAgain_ms = 50;
    while (!has_edits()) ASSERT_EQ(poll(&ends, 1, kLooksAgain_ms), 0) << "it ended: " << place.read("said.txt");
    close(ends.fd);
    kill(session, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(session, &status, 0), session);
    EXPECT_EQ(objects("a/work.burin")[1].scale, 1.0);
    play("world a/work.burin", "b", "0.2 command save found.burin\n0.5 command quit\n");
    EXPECT_TRUE(done.output.contains("what was not saved has come back")) << done.output;
    EXPECT_EQ(objects("b/found.burin")[0].material.stiffness_N_per_m, 500.0);
    EXPECT_EQ(objects("b/found.burin")[1].scale, 1.5);
}

TEST_F(DocumentOfAWorld, BesideAWorkpieceHoldsBothAndOpensBothByEitherWord) {
    play("world w.toml --workpiece ball:0.05 --resolution 48", "a",
         "0.1 command object rock scale 2\n0.5 command save work.burin\n1 command quit\n");
    EXPECT_EQ(objects("a/work.burin")[0].scale, 2.0);
    const auto solid = [&](const std::string& name) {
        return document::DocumentReader::open((place / name).string())->pages_of("tri-dexel solid")->pages;
    };
    for (const std::string word : {"world", "sculpt"}) {
        play(word + " a/work.burin", word, "0.2 command save again.burin\n0.5 command quit\n");
        EXPECT_TRUE(pages("a/work.burin").pages == pages(word + "/again.burin").pages);
        EXPECT_TRUE(solid("a/work.burin") == solid(word + "/again.burin"));
    }
    done = place.run(command("sculpt a/work.burin --world w.toml", "c", "0.2 command quit\n"));
    EXPECT_NE(done.status, 0);
    EXPECT_TRUE(done.output.contains("brings its own world; leave the other out")) << done.output;
}

TEST_F(DocumentOfAWorld, HoldsWhatWasThereWhenItWasAskedForWhateverFollowsInTheSameFrame) {
    play("world w.toml", "a",
         "0.1 command object rock scale 2\n0.3 command save two.burin\n0.3 command object rock scale 3\n0.3 command "
         "save "
         "three.burin\n1 command quit\n");
    EXPECT_EQ(objects("a/two.burin")[0].scale, 2.0);
    EXPECT_EQ(objects("a/three.burin")[0].scale, 3.0);
}

TEST_F(DocumentOfAWorld, OfWhichAnObjectIsDamagedOpensTheOthersAndIsNotSavedOver) {
    play("world w.toml", "a", "0.1 command save work.burin\n1 command quit\n");
    {
        auto database = record::Database::open(place / "a/work.burin", record::Database::Use::write);
        ASSERT_TRUE(database);
        ASSERT_TRUE(database->run("UPDATE page SET crc = crc + 1 WHERE kind = 'object' AND number = 1"));
    }
    const std::string damaged = place.read("a/work.burin");
    play("world a/work.burin", "b", "0.1 command save found.burin\n0.5 command quit\n");
    EXPECT_TRUE(done.output.contains("1 object cannot be read")) << done.output;
    EXPECT_EQ(place.read("a/work.burin"), damaged);
    EXPECT_EQ(objects("b/found.burin")[1].name, "bird");
    done = place.run(command("world a/work.burin", "c", "0.1 command object lost-1 felt on\n0.5 command quit\n"));
    EXPECT_TRUE(done.output.contains("has no triangles that could be felt")) << done.output;
}

}  // namespace burin::session
