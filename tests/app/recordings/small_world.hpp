// SPDX-License-Identifier: MIT
// A small world, a stroke through it, and recordings of them, for tests of the command line.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "record/database.hpp"
#include "tests/support/run_command.hpp"

namespace burin::app::test {

inline bool says_so(const Workplace::Outcome& outcome, const std::string& text) {
    return outcome.output.find(text) != std::string::npos;
}

inline std::string cube_world(const std::string& material, const std::string& path = {}) {
    return "[[object]]\nname = \"floor\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\nmaterial = { " + material +
           " }\n[[object]]\nname = \"lift\"\nmesh = \"cube.off\"\nmesh_units = \"m\"\nposition = [0.03, 0.0, 0.0]\n" +
           path;
}

// A cube of 20 mm whose top is at y = 0, and one beside it that rises and falls.
inline void write_small_world(const Workplace& at) {
    at.write("cube.off",
             "OFF\n8 12 0\n-0.01 -0.02 -0.01\n0.01 -0.02 -0.01\n-0.01 0 -0.01\n0.01 0 -0.01\n-0.01 -0.02 0.01\n"
             "0.01 -0.02 0.01\n-0.01 0 0.01\n0.01 0 0.01\n3 0 2 3\n3 0 3 1\n3 4 5 7\n3 4 7 6\n3 0 1 5\n3 0 5 4\n"
             "3 2 6 7\n3 2 7 3\n3 0 4 6\n3 0 6 2\n3 1 3 7\n3 1 7 5\n");
    at.write("w.toml", cube_world("stiffness = 300, static_friction = 0.3",
                                  "[[object.path]]\ntime = 0\n[[object.path]]\ntime = 0.5\n"
                                  "position = [0.0, 0.003, 0.0]\n[[object.path]]\ntime = 1\n"));
    at.write("s.csv", kStrokeHeader +
                          "0,0,0.012,0,0,0,0,1,0\n0.4,0,0.001,0,0,0,0,1,0\n0.8,0.004,0.001,0.002,0,0,0,1,0\n"
                          "1.0,0.015,0.012,0,0,0,0,1,0\n1.3,0.03,0.003,0,0,0,0,1,0\n1.8,0.03,0.003,0,0,0,0,1,0\n");
}

// Runs the program at this path.
inline Workplace::Outcome record_small_world(const Workplace& at, const std::string& burin,
                                             const std::string& to = "a.session") {
    return at.run(burin + " world w.toml --stroke s.csv --radius 0.003 --record " + to);
}

// A wand with two points, the lower one so far below the middle.
inline void write_small_wand(const Workplace& at, const std::string& below_m = "0.08") {
    at.write("wand.toml", "[[point]]\nname = \"up\"\noffset = [0, 0.07, 0]\n[[point]]\nname = \"low\"\noffset = [0, -" +
                              below_m + ", 0]\n");
}

// Leads that wand's middle and its lower point through the small world.
inline Workplace::Outcome record_with_small_wand(const Workplace& at, const std::string& burin) {
    return at.run(burin +
                  " world w.toml --stroke s.csv --device simulated-wand:wand.toml --radius 0.003 --points centre,low "
                  "--record a.session");
}

// Runs statements on a session file, as anybody's SQLite can.
inline void change(const Workplace& at, const std::string& file, const std::string& sql) {
    auto database = record::Database::open(at / file, record::Database::Use::write);
    ASSERT_TRUE(database);
    const auto done = database->run(sql);
    ASSERT_TRUE(done) << done.error().line();
    ASSERT_TRUE(database->close());
}

inline std::string copied(const Workplace& at, const std::string& file) {
    std::filesystem::copy_file(at / "a.session", at / file);
    return file;
}

}  // namespace burin::app::test
