// SPDX-License-Identifier: MIT
// A felt stroke is recorded, looked into, compared and converted, as a user does it; and other programs read the file.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app {
namespace {

const std::string kRecordingBurin = kBurinCommand;
// A press into a block from above, 0.9 s with the rests before and after.
const std::string kRecordedPress = kStrokeHeader +
                                   "0,0.01,0.0135,0.01,0,0,0,1,0\n0.1,0.01,0.011,0.01,0,0,0,1,1\n"
                                   "0.3,0.013,0.011,0.01,0,0,0,1,1\n";
const std::string kRecordingSculpt =
    kRecordingBurin +
    " sculpt --workpiece block:0.02,0.01,0.02 --resolution 48 --tool ball:0.002 --stroke "
    "press.csv --hand simulated --report report.json";

// Returns an example of docs/formats.md in a language: "python" or "r".
std::string documented_snippet(const std::string& language) {
    std::ifstream document("docs/formats.md");
    std::stringstream text;
    text << document.rdbuf();
    const std::string all = text.str(), fence = "```" + language + "\n";
    const std::size_t section = all.find("## Session files");
    const std::size_t begin = all.find(fence, section), end = all.find("```", begin + fence.size());
    if (section == std::string::npos || begin == std::string::npos || end == std::string::npos) return {};
    return all.substr(begin + fence.size(), end - begin - fence.size());
}

}  // namespace

TEST(SessionFile, TheSameStrokeGivesTheSameTicksAndAHarderMaterialOthers) {
    const Workplace at;
    at.write("press.csv", kRecordedPress);
    for (const std::string more : {"--record a.session", "--record b.session", "--record c.session --hardness hard"}) {
        const auto sculpted = at.run(kRecordingSculpt + " " + more);
        ASSERT_EQ(sculpted.status, 0) << sculpted.output;
        EXPECT_NE(sculpted.output.find(".session: 900 ticks recorded"), std::string::npos) << sculpted.output;
    }
    const auto same = at.run(kRecordingBurin + " session compare a.session b.session");
    EXPECT_EQ(same.status, 0);
    EXPECT_EQ(same.output, "900 ticks, 74 columns: equal to the bit\n");
    const auto other = at.run(kRecordingBurin + " session compare a.session c.session");
    EXPECT_EQ(other.status, 1);
    EXPECT_NE(other.output.find("simulated PHANTOM Omni, tick "), std::string::npos) << other.output;
    EXPECT_EQ(at.run(kRecordingBurin + " session compare a.session c.session --columns tick,time_ns").status, 0);
}

TEST(SessionFile, TheReportIsTheSameWithAndWithoutARecording) {
    const Workplace at;
    at.write("press.csv", kRecordedPress);
    ASSERT_EQ(at.run(kRecordingSculpt).status, 0);
    const std::string table = at.read("report-felt.csv");
    ASSERT_EQ(at.run(kRecordingSculpt + " --record a.session").status, 0);
    EXPECT_EQ(at.read("report-felt.csv"), table);
}

TEST(SessionFile, IsSoundAndConvertedToTables) {
    const Workplace at;
    at.write("press.csv", kRecordedPress);
    ASSERT_EQ(at.run(kRecordingSculpt + " --record a.session").status, 0);
    const auto info = at.run(kRecordingBurin + " session info a.session");
    EXPECT_EQ(info.status, 0);
    for (const char* words :
         {"simulated PHANTOM Omni: 900 ticks from tick 1", "commanded_force_device_y_N", "hardness"})
        EXPECT_NE(info.output.find(words), std::string::npos) << words;
    const auto checked = at.run(kRecordingBurin + " session check a.session");
    EXPECT_EQ(checked.status, 0) << checked.output;
    EXPECT_NE(checked.output.find("900 ticks read, 0 blocks damaged, 0 gaps"), std::string::npos) << checked.output;
    const auto table = at.run(kRecordingBurin + " convert a.session - --to csv --columns tick,buttons");
    EXPECT_TRUE(table.output.starts_with("tick,buttons\n1,0\n2,0\n")) << table.output.substr(0, 200);
    EXPECT_EQ(at.run(kRecordingBurin + " convert a.session --to npy").output, "a.npy: 900 ticks, 74 columns\n");
    const auto wrong = at.run(kRecordingBurin + " convert a.session --to csv --columns tock");
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.output.find("did you mean tick"), std::string::npos) << wrong.output;
    EXPECT_EQ(at.run(kRecordingBurin + " convert a.session a.session --to csv").status, 1) << "the recording itself";
    EXPECT_EQ(at.run(kRecordingBurin + " session check a.session").status, 0);
    EXPECT_EQ(at.run(kRecordingBurin + " convert a.session").status, 2);
    const auto again = at.run(kRecordingBurin + " convert a.session --to npy");
    EXPECT_EQ(again.status, 1);
    EXPECT_NE(again.output.find("a.npy: exists, and is not written over"), std::string::npos) << again.output;
}

TEST(SessionFile, IsConvertedToWhatOtherProgramsRead) {
    const Workplace at;
    at.write("press.csv", kRecordedPress);
    ASSERT_EQ(at.run(kRecordingSculpt + " --record a.session").status, 0);
    const std::string convert = kRecordingBurin + " convert a.session";
    EXPECT_EQ(at.run(convert + " --to hdf5").output, "a.h5: 900 ticks, 74 columns\n");
    EXPECT_EQ(at.run(convert + " --to mat --columns tick,time_ns").output, "a.mat: 900 ticks, 2 columns\n");
    EXPECT_EQ(at.run(convert + " out --to bids --subject p7 --task press").output, "out: 900 ticks, 74 columns\n");
    EXPECT_TRUE(std::filesystem::exists(at / "out/sub-p7/motion/sub-p7_task-press_tracksys-hand_motion.tsv"));
    EXPECT_NE(at.run(convert + " - --to log").output.find("# hand simulated PHANTOM Omni: 900 ticks of 74 columns"),
              std::string::npos);
    struct Case {
        std::string arguments, said;
    };
    for (const Case& wrong : std::vector<Case>{{" --to hdf5", "a.h5: exists, and is not written over"},
                                               {" out --to bids", "out: exists, and is not written over"},
                                               {" no/folder --to bids", "no/folder"},
                                               {" - --to mat", "standard output"},
                                               {" b.log --to log --columns tick", "has no columns"},
                                               {" c.h5 --to hdf5 --columns tock", "did you mean tick"},
                                               {" c --to bids --subject p_7", "is no label of BIDS"}}) {
        const auto outcome = at.run(convert + wrong.arguments);
        EXPECT_EQ(outcome.status, 1) << wrong.arguments;
        EXPECT_NE(outcome.output.find(wrong.said), std::string::npos) << outcome.output;
    }
    EXPECT_EQ(at.run(convert + " --to tsv").status, 2);
    EXPECT_EQ(at.files(), 8u)
        << "the stroke, a report with its plots, the recording, three tables: nothing that failed";
}

// Where the disk is full; HDF5 then ended the program by a fault of its own.
TEST(SessionFile, IsNotConvertedWhereTheDiskIsFullAndNothingIsLeft) {
    const Workplace at;
    at.write("press.csv", kRecordedPress);
    ASSERT_EQ(at.run(kRecordingSculpt + " --record a.session").status, 0);
    const std::size_t files = at.files();
    for (const std::string format : {"hdf5", "csv", "npy", "mat"}) {
        const auto outcome =
            at.run("trap '' XFSZ; ulimit -f 60; " + kRecordingBurin + " convert a.session out --to " + format);
        EXPECT_EQ(outcome.status, 1) << format << "\n" << outcome.output;
        EXPECT_TRUE(outcome.output.contains("out")) << outcome.output;
        EXPECT_EQ(at.files(), files) << format;
    }
}

TEST(SessionFile, IsNeverWrittenOverAndRefusedBeforeTheWork) {
    const Workplace at;
    at.write("press.csv", kRecordedPress);
    at.write("a.session", "precious");
    const auto refused = at.run(kRecordingSculpt + " --record a.session");
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.output.find("never overwrites"), std::string::npos) << refused.output;
    EXPECT_EQ(at.read("a.session"), "precious");
    EXPECT_EQ(at.run(kRecordingSculpt + " --record no/folder.session").status, 1);
    EXPECT_EQ(at.run(kRecordingBurin + " session info a.session").status, 1);
    EXPECT_EQ(at.run(kRecordingBurin + " session check press.csv").status, 1);
    EXPECT_EQ(at.files(), 2u);
}

TEST(SessionFile, ThePythonOfTheDocumentationReadsIt) {
    const std::string snippet = documented_snippet("python");
    ASSERT_FALSE(snippet.empty());
    const Workplace at;
    at.write("press.csv", kRecordedPress);
    ASSERT_EQ(at.run(kRecordingSculpt + " --record a.session").status, 0);
    if (at.run("/usr/bin/python3 -c 'import numpy, zstandard'").status != 0)
        GTEST_SKIP() << "python3-numpy and python3-zstandard are not installed";
    ASSERT_EQ(at.run(kRecordingBurin + " convert a.session --to npy").status, 0);
    at.write("read.py", snippet + R"(
a = numpy.load('a.npy')
assert len(a.dtype.names) == len(ticks) and len(a) == 900
for name in a.dtype.names:
    assert a[name].tobytes() == ticks[name].tobytes(), name
print('equal')
)");
    const auto outcome = at.run("/usr/bin/python3 read.py a.session");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(outcome.output.ends_with("equal\n")) << outcome.output;
    if (at.run("/usr/bin/python3 -c 'import matplotlib'").status != 0)
        GTEST_SKIP() << "python3-matplotlib is not installed: the picture was not drawn";
    EXPECT_EQ(at.run("/usr/bin/python3 read.py a.session force.png").status, 0);
    EXPECT_TRUE(at.read("force.png").starts_with("\x89PNG"));
}

// R finds every value of the text, but for the last bit: its own reading of decimal numbers is not always the nearest
// (R_strtod scales by powers of ten in long double). Python's, above, is, and is compared to the bit.
TEST(SessionFile, TheROfTheDocumentationReadsItAndPlots) {
    const std::string snippet = documented_snippet("r");
    ASSERT_FALSE(snippet.empty());
    const Workplace at;
    at.write("press.csv", kRecordedPress);
    ASSERT_EQ(at.run(kRecordingSculpt + " --record a.session").status, 0);
    if (at.run("Rscript -e 'library(RSQLite)' && zstd --version").status != 0)
        GTEST_SKIP() << "r-base-core, r-cran-rsqlite or zstd is not installed";
    ASSERT_EQ(at.run(kRecordingBurin + " convert a.session --to csv").status, 0);
    at.write("plot.R", snippet + R"(
table <- read.csv("a.csv")
stopifnot(nrow(table) == nrow(ticks), identical(names(table), names(ticks)))
for (name in names(table)) {
  a <- as.numeric(table[[name]]); b <- as.numeric(ticks[[name]])
  stopifnot(identical(is.nan(a), is.nan(b)), all(is.nan(a) | abs(a - b) <= 2^-52 * abs(b)))
}
cat("equal\n")
)");
    const auto outcome = at.run("Rscript plot.R a.session force.pdf");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(outcome.output.ends_with("equal\n")) << outcome.output;
    EXPECT_TRUE(at.read("force.pdf").starts_with("%PDF"));
}

}  // namespace burin::app
