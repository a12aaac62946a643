// SPDX-License-Identifier: MIT
// burin bench document: what it costs to keep the work.
//
//   journal   STROKE-1000 at a session's pace, a stroke a second: how long a change of rays is on no disk. What is told
//             and when is the rule of sculpt/carved_part.hpp
//   save      strokes of one sweep each, then one save of what they changed: bytes that changed, bytes written, and how
//             long the scene's thread stands still for it. Neither a frame nor a tick waits
//   open      a document against reading and unpacking its pages alone, in turns, each once with the file forgotten by
//             the system (cold) and once not
//   size      the document against the same work as a binary STL
//
// Times are wall times: other work on the machine shows in them. The folder's disk is what is measured.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"

namespace burin::bench {

struct DocumentTask {
    std::string mesh;              // a closed mesh; empty: STROKE-1000's cube
    std::string folder;            // where documents are written, and removed again
    int journal_resolution = 256;  // cells along the longest side
    int resolution = 512;          // of save, open and size
    unsigned strokes = 100;        // before the save
    unsigned runs = 5;             // of open
    unsigned updates = 1000;       // of the journal, 10 ms apart
};

struct DocumentFigures {
    std::string work;
    int journal_resolution = 0, resolution = 0;

    struct Journal {
        std::uint64_t updates = 0, changes = 0;  // that changed rays; that were told
        std::vector<double> unsafe_ms;           // of each such update: until what it changed was on the disk
        std::vector<double> taken_ms;            // of each change: what the scene's thread took to tell it
    } journal;
    struct Save {
        unsigned strokes = 0;
        std::uint64_t rays_changed = 0;
        std::uint64_t changed_bytes = 0;          // what the rays that each stroke has changed hold, in memory
        std::uint64_t changed_packed_bytes = 0;   // that, compressed
        std::uint64_t pages = 0, page_bytes = 0;  // written, with what rays held before, for undo; compressed
        std::uint64_t written_bytes = 0;          // all that the process wrote meanwhile, SQLite's log included
        double taken_ms = 0.0, written_ms = 0.0;  // the scene's thread; the document's
    } save;
    struct Open {
        std::vector<double> read_ms, open_ms;  // of each run
    } cold, warm;
    struct Size {
        std::uint64_t document_bytes = 0, stl_bytes = 0;
    } size;
};

[[nodiscard]] Result<DocumentFigures> measure_documents(const DocumentTask& task);
[[nodiscard]] std::string document_table(const DocumentFigures& figures);
[[nodiscard]] Json document_json(const DocumentFigures& figures);

}  // namespace burin::bench
