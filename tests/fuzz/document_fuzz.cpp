// SPDX-License-Identifier: MIT
// libFuzzer body of the reader of documents and of the solid in them. Whatever the bytes: no fault, no hang, no memory
// beyond the bounds (run with -rss_limit_mb); every failure has a place and a remedy. The bytes are taken in four ways:
// as a file; as its log; as pages of a solid, so that what lies behind the check sums is reached too; and as changes of
// a sound document with a journal's changes.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "compute/rays/lattice.hpp"
#include "compute/rays/solid.hpp"
#include "document/document_reader.hpp"
#include "document/journal.hpp"
#include "document/log_check.hpp"
#include "tests/fuzz/changed_file.hpp"
#include "workpiece/saved_changes.hpp"
#include "workpiece/saved_solid.hpp"

namespace {

using namespace burin;
using namespace burin::fuzz;

void check_error(const Error& error) { require(!error.what.empty() && !error.where.empty()); }

// A solid whose pages are whole must say the same when it is saved again.
void load(const scene::Pages& pages) {
    const Result<workpiece::LoadedSolid> loaded = workpiece::load_solid(pages, "fuzz");
    if (!loaded) return check_error(loaded.error());
    if (!loaded->lost.empty()) return;
    scene::Pages again;
    workpiece::save_solid(loaded->solid, workpiece::ChangedPages(loaded->solid.lattice), again);
    for (const auto& [name, bytes] : again.pages)
        if (name.kind != "head") require(pages.find(name) != nullptr && *pages.find(name) == bytes);
}

void read_steps(document::DocumentReader& reader, const document::PartPlace& part, const compute::Solid& solid,
                compute::History& history) {
    const auto steps = reader.steps(part);
    if (!steps) return check_error(steps.error());
    if (!*steps) return;
    history.go_on_after((*steps)->done);
    for (std::int64_t number = (*steps)->done; number >= std::max((*steps)->first, (*steps)->done - 4); --number) {
        const auto pages = reader.step(part, number);
        if (!pages) return check_error(pages.error());
        auto step = workpiece::step_in(solid, *pages, "fuzz");
        if (!step) return check_error(step.error());
        if (!history.put_before(std::move(*step))) return;
    }
}

void read_file(const std::string& path) {
    Result<document::DocumentReader> reader = document::DocumentReader::open(path);
    if (!reader) return check_error(reader.error());
    static_cast<void>(reader->version());
    for (const document::PartPlace& part : reader->parts()) {
        const Result<scene::Pages> pages = reader->pages(part);
        if (!pages) {
            check_error(pages.error());
            continue;
        }
        load(*pages);
        Result<workpiece::LoadedSolid> solid = workpiece::load_solid(*pages, "fuzz");
        compute::History history(std::size_t{1} << 20);
        if (solid) read_steps(*reader, part, solid->solid, history);
        for (std::int64_t number = 1; solid && number <= std::min<std::int64_t>(reader->changes(), 4); ++number) {
            const Result<scene::Pages> change = reader->change(part, number);
            if (!change) {
                check_error(change.error());
                break;
            }
            if (const auto done = workpiece::apply_change(solid->solid, *change, "fuzz", &history); !done)
                check_error(done.error());
        }
    }
}

compute::Solid small_solid() {
    Result<compute::Solid> solid = compute::make_block(Vec3(1.0), compute::kMinResolution, {"stone", {120, 120, 120}});
    require(solid.has_value());
    return std::move(*solid);
}

// A document with the changes of a journal behind it.
std::vector<std::uint8_t> sound_file() {
    const std::string path = own_path(".burin");
    compute::Solid solid = small_solid();
    document::Content content{.facts = {{"unit", "mm"}}, .commands = {"tool ball:0.01"}};
    workpiece::save_solid(solid, workpiece::ChangedPages(solid.lattice), content.parts.emplace_back());
    compute::RayBatch stroke;
    stroke.add(shared::ray_code(1, 2, 2), solid.sets[1].ends(2, 2));
    compute::History history;
    require(history.put_before(std::move(stroke)));
    workpiece::save_steps(history, content.parts[0]);
    Result<document::Journal> journal = document::Journal::begin(path, content);
    require(journal.has_value());
    workpiece::ChangedRays changed(solid.lattice);
    compute::Changes changes;
    changes.record({0, 1, 1}, 0, 1, solid.sets[0].ends(1, 1));
    changed.note(changes);
    document::Change change{.part = 0, .pages = {.whole = false}};
    changed.take(solid, compute::HistoryStep::stroke, change.pages);
    require(journal->add({std::move(change)}).has_value());
    journal->end();
    return take_file(path);
}

void read_changed(const std::uint8_t* data, std::size_t size) {
    static const std::vector<std::uint8_t> sound = sound_file();
    read_file(changed_file(sound, data, size));
}

std::vector<std::byte> bytes_of(const std::uint8_t* data, std::size_t size) {
    const auto* bytes = reinterpret_cast<const std::byte*>(data);
    return {bytes, bytes + size};
}

// The first byte says which page the rest takes the place of, or changes.
void read_pages(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return;
    scene::Pages pages;
    const compute::Solid solid = small_solid();
    workpiece::save_solid(solid, workpiece::ChangedPages(solid.lattice), pages);
    auto at = pages.pages.begin();
    std::advance(at, data[0] % pages.pages.size());
    if (data[0] < 128) {
        at->second = bytes_of(data + 1, size - 1);
    } else {
        for (std::size_t i = 1; i + 3 <= size; i += 3)
            at->second[(data[i] + 256u * data[i + 1]) % at->second.size()] ^= static_cast<std::byte>(data[i + 2]);
    }
    load(pages);
    compute::Solid changed = small_solid();
    scene::Pages change{.part = std::string(workpiece::kSolidPart), .whole = false};
    change.pages[{"head", 0}] = *pages.find({"head", 0});
    change.pages[{"rays", 0}] = bytes_of(data + 1, size - 1);
    if (const auto done = workpiece::apply_change(changed, change, "fuzz"); !done) check_error(done.error());
}

void read_log(const std::uint8_t* data, std::size_t size) {
    static const std::string path = own_path("-log");
    std::ofstream(path + "-wal", std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<long>(size));
    static_cast<void>(document::is_log_damaged(path));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    read_file(file_with(data, size));
    read_pages(data, size);
    read_changed(data, size);
    read_log(data, size);
    return 0;
}
