// SPDX-License-Identifier: MIT
// The subcommands of burin that are one function each, with their options; one source each. (bench_command.hpp,
// profile.hpp, wall_commands.hpp and world_command.hpp have those of several parts.) One thread. Every Error names a
// file or an option and the remedy; main prints it in one line.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "activities/grasp/grasp_options.hpp"
#include "app/cli/command_line.hpp"
#include "base/error.hpp"
#include "base/length_unit.hpp"
#include "base/space.hpp"
#include "compute/rays/set_algebra.hpp"
#include "document/document_file.hpp"
#include "session/state/session_options.hpp"

namespace burin::app {

// burin sculpt: a workpiece, a tool and a stroke in; a carved mesh, pictures and a report out. Writes nothing before
// all input has been read and all output places have been checked.
[[nodiscard]] Result<void> sculpt(const session::SculptOptions& options);
// Whether --record is of a stroke that a simulated hand feels, which sculpt() records, and not of a live session.
[[nodiscard]] bool records_a_felt_stroke(const session::SculptOptions& options);

// burin convert IN OUT: any mesh format in, STL, PLY or OBJ out; prints the mesh's size and health. A document likewise
// (document_command.hpp). Of a session file:
// burin convert FILE.session [OUT] --to csv|npy|hdf5|mat|bids|log (session_command.hpp).
struct ConvertOptions {
    std::string in, out;
    std::optional<LengthUnit> units;         // of IN; none: as the file states, else guessed (mesh_unit.hpp)
    std::optional<LengthUnit> export_units;  // of OUT; none: those of IN
    bool close_holes = false;
    std::optional<double> weld_m;                // corners at open edges that are joined; none: with close_holes alone
    std::optional<double> simplify_m;            // bound on the surface's motion; none: all triangles
    bool center = false;                         // as a place of 0,0,0
    std::optional<Vec3> place_m;                 // where the middle of the mesh's box goes; none: it stays
    std::optional<double> scale;                 // none: 1
    std::string to;                              // format of a session file's table; empty: IN is a mesh
    std::string columns, part, trials;           // of that table
    std::string subject = "01", task = "touch";  // labels of a BIDS data set

    [[nodiscard]] bool is_of_session() const { return !to.empty(); }
    [[nodiscard]] bool is_of_document() const { return document::is_document_name(in); }
    [[nodiscard]] bool is_misused() const { return out.empty() && to.empty(); }
};
[[nodiscard]] Result<void> convert(const ConvertOptions& options);

// burin combine A B: makes two closed meshes into one, as solids on a lattice that holds both. Writes nothing before
// all input has been read and the result is known not to be empty.
struct CombineOptions {
    std::string a, b;                        // STL, OBJ, PLY, OFF
    std::optional<LengthUnit> units;         // of both files; none: as each states, else guessed (mesh_unit.hpp)
    std::optional<LengthUnit> export_units;  // none: those of A
    compute::Combination operation = compute::Combination::unite;
    int resolution = 256;  // cells along the longest side of both together
    bool close_holes = false;
    std::optional<double> weld_m;      // none: by the files' numbers (sculpt/workpiece.hpp)
    std::vector<std::string> exports;  // STL, PLY, OBJ
    std::string report;                // a JSON file; empty: none
    unsigned threads = 0;              // 0: one per core
};
[[nodiscard]] Result<void> combine_files(const CombineOptions& options);

// burin film: joins the pictures of a folder, in the order of the numbers in their names, into one that moves.
struct FilmOptions {
    std::string folder, out;
    double pictures_a_second = 10.0;
};
void add_film_options(Command command, FilmOptions& film);
[[nodiscard]] Result<void> film(const FilmOptions& options);

// burin seek: the objects of a world are sought by touch, against the clock (activities/seek/seek.hpp).
struct SeekSession {
    session::SculptOptions session;
    unsigned targets = 0;
    std::uint64_t seed = 1;
    std::string report;  // a JSON file; empty: none
};
void add_seek_options(Command command, SeekSession& seek);
[[nodiscard]] Result<void> seek(const SeekSession& options);

// burin hand: a hand in a glove among rigid things (activities/grasp/grasp.hpp).
struct HandSession {
    session::SculptOptions session;
    std::string grasp;  // a scripted hand that closes so; empty: none
    activities::GraspOptions options;
};
void prepare_hand(HandSession& hand);  // its world, glove and tool, as they are where no option says else
void add_hand_options(Command command, HandSession& hand);
[[nodiscard]] Result<void> hand(const HandSession& options);

// A subcommand of burin bench with options of its own; BenchCommand runs the one that was parsed.
struct BenchSubcommand {
    Command command;
    std::function<Result<void>()> run;
};

// Add a subcommand and its options to burin bench. The command line must outlive what is returned.
[[nodiscard]] BenchSubcommand add_bench_body(Command bench);       // bench/body/body_bench.hpp
[[nodiscard]] BenchSubcommand add_bench_glove(Command bench);      // bench/glove/glove_output.hpp
[[nodiscard]] BenchSubcommand add_bench_frame(Command bench);      // bench/frame/frame.hpp
[[nodiscard]] BenchSubcommand add_bench_haptics(Command bench);    // bench/haptics/haptics.hpp
[[nodiscard]] BenchSubcommand add_bench_document(Command bench);   // bench/document/document_bench.hpp
[[nodiscard]] BenchSubcommand add_bench_record(Command bench);     // bench/recording/recording.hpp
[[nodiscard]] BenchSubcommand add_bench_study(Command bench);      // activities/train/simulated_study.hpp
[[nodiscard]] BenchSubcommand add_bench_stability(Command bench);  // bench/stability/stability.hpp
[[nodiscard]] BenchSubcommand add_bench_workspace(Command bench);  // bench/workspace/workspace.hpp
[[nodiscard]] BenchSubcommand add_bench_world(Command bench);      // bench/world/world_bench.hpp

}  // namespace burin::app
