// SPDX-License-Identifier: MIT
// Places of output files are checked before the first long step, not after it.
#include "app/output_files.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/run_command.hpp"

namespace burin::app {

TEST(OutputFiles, AreRefusedBeforeAnythingIsWrittenWhereTheyCannotBe) {
    const Workplace place;
    const std::string missing = (place / "no/such/folder").string();
    const std::array good{(place / "a.stl").string(), (place / "b.ply").string()};
    const std::string report = (place / "report.json").string();
    EXPECT_TRUE(check_outputs(good, report));
    EXPECT_TRUE(check_outputs({}, ""));
    const auto refused = [&](std::span<const std::string> exports, const std::string& report_at) {
        const auto checked = check_outputs(exports, report_at);
        return checked ? "" : checked.error().line();
    };
    EXPECT_NE(refused(good, missing + "/report.json").find(missing), std::string::npos);
    EXPECT_NE(refused(good, place / ".").find("is a folder"), std::string::npos);
    EXPECT_NE(refused(std::array{good[0], missing + "/c.ply"}, report).find(missing), std::string::npos);
    EXPECT_NE(refused(std::array{good[0], (place / "c.off").string()}, report).find("c.off"), std::string::npos);
    EXPECT_EQ(place.files(), 0u);
}

}  // namespace burin::app
