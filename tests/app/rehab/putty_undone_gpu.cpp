// SPDX-License-Identifier: MIT
// Dents of putty in a session: undone and repeated by commands, saved, opened again, and recorded with all of that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "bodies/soft_dents.hpp"
#include "document/document_reader.hpp"
#include "gpu/device.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

// While a hand is near, a body that counts as at rest settles on, slower than 10 um/s: so far in the second between a
// save and the next dent. A dent is far deeper.
constexpr double kSettles_m = 1e-5;

class PuttyUndone : public testing::Test {
protected:
    void SetUp() override {
        if (!gpu::list_devices()) GTEST_SKIP() << "no Vulkan driver";
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (at / name).string(); }
    // The exercise takes its world from the folder of the repository.
    [[nodiscard]] Workplace::Outcome burin(const std::string& words) const {
        return at.run("cd " + std::string(kSessionsFolder) + "/../.. && " + kBurinCommand + " " + words);
    }
    [[nodiscard]] std::string putty(const std::string& script, const std::string& outputs) const {
        at.write(outputs + ".txt", script);
        return "rehab putty --offscreen --input " + path(outputs + ".txt") + " --outputs " + path(outputs);
    }
    // The body of a document.
    [[nodiscard]] scene::Pages body(const std::string& name) const {
        auto reader = document::DocumentReader::open(path(name));
        EXPECT_TRUE(reader) << reader.error().line();
        auto pages = reader ? reader->pages_of(bodies::kSoftBodyPart) : Result<scene::Pages>(scene::Pages());
        EXPECT_TRUE(pages) << pages.error().line();
        return pages ? std::move(*pages) : scene::Pages();
    }
    // How far the places of two bodies are from each other at most; those of other bodies are very far.
    [[nodiscard]] static double apart_m(const scene::Pages& a, const scene::Pages& b) {
        const auto *of_a = a.find({"shape", 0}), *of_b = b.find({"shape", 0});
        if (of_a == nullptr || of_b == nullptr || of_a->size() != of_b->size()) return HUGE_VAL;
        std::uint32_t corners = 0;
        std::memcpy(&corners, of_a->data(), sizeof corners);
        std::vector<double> at_a(3 * std::size_t{corners}), at_b(at_a.size());
        std::memcpy(at_a.data(), of_a->data() + 8, at_a.size() * sizeof(double));
        std::memcpy(at_b.data(), of_b->data() + 8, at_b.size() * sizeof(double));
        double most_m = 0.0;
        for (std::size_t i = 0; i < at_a.size(); ++i) most_m = std::max(most_m, std::abs(at_a[i] - at_b[i]));
        return most_m;
    }
    // Three kneads, the second of them taken back, repeated and taken back once more before the third.
    [[nodiscard]] std::string kneads() const {
        std::string script = at.read(std::string(kSessionsFolder) + "/rehab-putty.txt");
        const auto before = [&](const char* line, const char* more) { script.insert(script.find(line), more); };
        before("2.850 button press", "2.840 command save none.burin\n");
        before("8.250 button press", "8.000 command save one.burin\n");
        before("13.650 button press",
               "12.800 command save two.burin\n12.900 command undo\n13.100 command save undone.burin\n"
               "13.200 command redo\n13.400 command save redone.burin\n13.450 command undo\n");
        before("19.050 command quit", "18.900 command save three.burin\n");
        return script;
    }
    const Workplace at;
};

}  // namespace

TEST_F(PuttyUndone, GoesOnWithItsDentsFromADocument) {
    const auto done = burin(putty(kneads(), "a"));
    ASSERT_EQ(done.status, 0) << done.output;
    const auto none = body("a/none.burin"), one = body("a/one.burin"), two = body("a/two.burin");
    EXPECT_GT(apart_m(none, one), 100.0 * kSettles_m);
    EXPECT_GT(apart_m(one, two), 10.0 * kSettles_m);
    EXPECT_LT(apart_m(body("a/undone.burin"), one), kSettles_m);
    EXPECT_TRUE(body("a/redone.burin").pages == two.pages);
    EXPECT_FALSE(body("a/three.burin").pages == two.pages);

    const std::string walks =
        "burin-input 1 test\n0.1 command save opened.burin\n0.2 command undo\n0.4 command save first.burin\n"
        "0.5 command undo\n0.7 command save fresh.burin\n0.8 command redo\n0.9 command redo\n1.1 command save "
        "again.burin\n1.2 command quit\n";
    const auto opened = burin(putty(walks, "b") + " --from " + path("a/redone.burin"));
    ASSERT_EQ(opened.status, 0) << opened.output;
    EXPECT_TRUE(body("b/opened.burin").pages == two.pages);
    EXPECT_LT(apart_m(body("b/first.burin"), one), kSettles_m);
    EXPECT_LT(apart_m(body("b/fresh.burin"), none), kSettles_m);
    EXPECT_TRUE(body("b/again.burin").pages == two.pages);

    const auto other = burin(putty(walks, "c") + " --hardness soft --from " + path("a/redone.burin"));
    EXPECT_NE(other.status, 0);
    EXPECT_TRUE(other.output.contains("holds another soft body than this one")) << other.output;
    const auto recorded =
        burin(putty(walks, "d") + " --from " + path("a/redone.burin") + " --record " + path("d.session"));
    EXPECT_NE(recorded.status, 0);
    EXPECT_TRUE(recorded.output.contains("cannot be recorded")) << recorded.output;
}

// What its journal holds while it goes on is what is left of it after kill -9. Nothing is saved before.
TEST_F(PuttyUndone, ComesBackWithItsDentsAfterAKill) {
    const auto whole = burin(putty(kneads(), "a"));
    ASSERT_EQ(whole.status, 0) << whole.output;
    const std::string script = at.read(std::string(kSessionsFolder) + "/rehab-putty.txt");
    const std::string two_kneads = script.substr(0, script.find("13.650 button press"));
    std::filesystem::create_directory(at / "j");
    ASSERT_EQ(at.run("{ (cd " + std::string(kSessionsFolder) + "/../.. && exec " + kBurinCommand + " " +
                     putty(two_kneads + "12.900 command undo\n3000 command quit\n", "k") + " --journal " + path("j") +
                     ") > said.txt 2>&1 & echo $! > pid.txt; }")
                  .status,
              0);
    // Looks at a copy of the journal, which the session has open: one dent is done, and one is taken back.
    const auto is_undone = [&] {
        const auto copied = at.run(
            "mkdir -p seen; rm -f seen/*; cp j/*.burin seen/work.burin; "
            "cp j/*.burin-wal seen/work.burin-wal");
        auto reader = copied.status == 0 ? document::DocumentReader::open(path("seen/work.burin"))
                                         : Result<document::DocumentReader>(std::unexpected(Error()));
        if (!reader || reader->parts().empty()) return false;
        const auto steps = reader->steps(reader->parts().front());
        return steps && *steps && (*steps)->done == 1 && (*steps)->last == 2;
    };
    while (!is_undone()) ASSERT_EQ(at.run("kill -0 $(cat pid.txt)").status, 0) << "it ended: " << at.read("said.txt");
    ASSERT_EQ(at.run("kill -9 $(cat pid.txt)").status, 0);

    const std::string walks =
        "burin-input 1 test\n0.1 command save opened.burin\n0.2 command redo\n0.4 command save second.burin\n"
        "0.5 command undo\n0.7 command undo\n0.9 command save fresh.burin\n1 command quit\n";
    const auto opened = burin(putty(walks, "b") + " --from " + path("seen/work.burin"));
    ASSERT_EQ(opened.status, 0) << opened.output;
    EXPECT_LT(apart_m(body("b/opened.burin"), body("a/one.burin")), kSettles_m);
    EXPECT_LT(apart_m(body("b/second.burin"), body("a/two.burin")), kSettles_m);
    EXPECT_LT(apart_m(body("b/fresh.burin"), body("a/none.burin")), kSettles_m);
}

TEST_F(PuttyUndone, IsDoneAgainToTheBitFromARecording) {
    const auto recorded = burin(putty(kneads(), "a") + " --record " + path("p.session"));
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    const auto replayed = burin("replay " + path("p.session"));
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(replayed.output.contains("equal to the bit")) << replayed.output;
}

}  // namespace burin::app
