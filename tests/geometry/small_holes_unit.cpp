// SPDX-License-Identifier: MIT
// Holes of a mesh that are closed without being asked for: a scan's, and not what is open by intent.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "geometry/files/closed_mesh.hpp"
#include "tests/support/run_command.hpp"

namespace burin::geometry {
namespace {

constexpr int kRings = 16, kSegments = 24;

// Writes a ball of 1 m without its first `open` rings of faces; of the next ring one face is missing where `torn`.
void write_ball(const std::string& file, int open, bool torn) {
    std::ofstream out(file);
    for (int i = 0; i <= kRings; ++i)
        for (int j = 0; j < kSegments; ++j) {
            const double a = std::numbers::pi * i / kRings, b = 2.0 * std::numbers::pi * j / kSegments;
            out << "v " << 0.5 * std::sin(a) * std::cos(b) << ' ' << 0.5 * std::sin(a) * std::sin(b) << ' '
                << 0.5 * std::cos(a) << '\n';
        }
    for (int i = open; i < kRings; ++i)
        for (int j = 0; j < kSegments; ++j) {
            if (torn && i == kRings / 2 && j == 3) continue;
            const int next = (j + 1) % kSegments, at = 1 + i * kSegments;
            const int a = at + j, b = at + next, c = at + kSegments + next, d = at + kSegments + j;
            if (i > 0) out << "f " << a << ' ' << d << ' ' << b << '\n';
            if (i + 1 < kRings) out << "f " << b << ' ' << d << ' ' << c << '\n';
        }
}

ClosedMeshOptions options_of(const std::string& file, bool close_small) {
    ClosedMeshOptions options;
    options.file = file;
    options.close_small_holes = close_small;
    return options;
}

}  // namespace

TEST(SmallHoles, OfAScanAreClosedAndToldWhereThatIsAllowed) {
    const Workplace place;
    const std::string file = place / "torn.obj";
    write_ball(file, 0, true);
    const auto refused = load_closed_mesh(options_of(file, false));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("--close-holes"), std::string::npos) << refused.error().line();
    const auto closed = load_closed_mesh(options_of(file, true));
    ASSERT_TRUE(closed) << closed.error().line();
    EXPECT_NE(closed->closed.find("1 hole was closed"), std::string::npos) << closed->closed;
    EXPECT_NE(closed->size.find(closed->closed), std::string::npos) << closed->size;
}

TEST(SmallHoles, ABowlIsRefusedWithTheRemedy) {
    const Workplace place;
    const std::string file = place / "bowl.obj";
    write_ball(file, kRings / 2, false);
    const auto refused = load_closed_mesh(options_of(file, true));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("--close-holes"), std::string::npos) << refused.error().line();
}

TEST(SmallHoles, AClosedMeshHasNothingToTell) {
    const Workplace place;
    const std::string file = place / "ball.obj";
    write_ball(file, 0, false);
    const auto closed = load_closed_mesh(options_of(file, true));
    ASSERT_TRUE(closed) << closed.error().line();
    EXPECT_TRUE(closed->closed.empty());
}

}  // namespace burin::geometry
