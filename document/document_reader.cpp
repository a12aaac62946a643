// SPDX-License-Identifier: MIT
#include "document/document_reader.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "base/try.hpp"
#include "record/compressed.hpp"
#include "record/store_reading.hpp"

namespace burin::document {
namespace {

using record::Database, record::Statement;

// SQLite's steps for a statement: the list of kMostPages pages takes some 20 a page.
constexpr std::int64_t kMostSteps = 200'000'000;
// A step's number, up or down: more than anybody makes.
constexpr std::int64_t kFarthestStep = std::int64_t{1} << 40;
constexpr const char* kRemedy = kDocumentKind.words.wrong_file;

}  // namespace

Result<DocumentReader> DocumentReader::open(const std::string& path) {
    BURIN_TRY_DO(record::check_regular(path, "is empty", kRemedy));
    record::take_back_what_was_interrupted(path);
    DocumentReader reader;
    reader.path_ = path;
    BURIN_TRY(opened, Database::open(path, Database::Use::read, {}, kDocumentKind.words));
    reader.database_.emplace(std::move(opened));
    reader.database_->limit_steps(kMostSteps);
    BURIN_TRY_DO(reader.database_->run("PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0"));
    BURIN_TRY_DO(record::check_marks(*reader.database_, path, kDocumentKind));
    for (const auto step : {&DocumentReader::check_tables, &DocumentReader::read_facts, &DocumentReader::read_commands,
                            &DocumentReader::read_parts, &DocumentReader::count_changes})
        BURIN_TRY_DO((reader.*step)());
    return reader;
}

Result<void> DocumentReader::check_tables() {
    return record::check_tables(*database_, path_, {"meta", "part", "page", "command"}, kRemedy);
}

Result<void> DocumentReader::read_facts() {
    BURIN_TRY(facts, record::read_facts(*database_));
    facts_ = std::move(facts);
    return {};
}

Result<void> DocumentReader::read_commands() {
    BURIN_TRY(read, database_->prepare("SELECT text FROM command WHERE length(text) <= 4096 ORDER BY at LIMIT " +
                                       std::to_string(kMostFacts)));
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) commands_.push_back(read.text(0));
    if (!row) return std::unexpected(row.error());
    return {};
}

Result<void> DocumentReader::read_parts() {
    BURIN_TRY(read, database_->prepare("SELECT part, kind FROM part WHERE length(kind) <= 1000 ORDER BY part LIMIT " +
                                       std::to_string(kMostParts)));
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) parts_.push_back({.number = read.integer(0), .kind = read.text(1)});
    if (!row) return std::unexpected(row.error());
    for (PartPlace& part : parts_) {
        BURIN_TRY(sum, database_->prepare("SELECT count(*), sum(bytes), sum(length(data)) FROM page WHERE part = ?"));
        sum.bind(1, part.number);
        // A damaged table has no sums; its pages are looked for one by one.
        if (const Result<bool> found = sum.step(); !found || !*found) continue;
        part.pages = static_cast<std::uint64_t>(sum.integer(0));
        part.bytes = static_cast<std::uint64_t>(sum.integer(1));
        part.data_bytes = static_cast<std::uint64_t>(sum.integer(2));
    }
    return {};
}

std::string DocumentReader::fact(const std::string& key) const {
    const auto at = facts_.find(key);
    return at != facts_.end() ? at->second : std::string();
}

std::int64_t DocumentReader::number(const std::string& key) const {
    const std::string text = fact(key);
    std::int64_t number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

Version DocumentReader::version() const { return {fact(kIdFact), number(kSavesFact)}; }

// Names come from the index of the table, so that a page which SQLite cannot read takes no other along.
Result<scene::Pages> DocumentReader::pages(const PartPlace& part) {
    BURIN_TRY(read,
              database_->prepare(
                  "SELECT kind, number FROM page WHERE part = ? AND length(kind) <= 1000 ORDER BY kind, number LIMIT " +
                  std::to_string(kMostPages)));
    read.bind(1, part.number);
    std::vector<scene::PageName> names;
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) names.push_back({read.text(0), read.integer(1)});
    if (!row) return std::unexpected(row.error());
    scene::Pages pages{.part = part.kind};
    for (scene::PageName& name : names) {
        Result<std::vector<std::byte>> bytes = page("page", part.number, name);
        if (bytes)
            pages.pages.emplace(std::move(name), std::move(*bytes));
        else
            pages.damaged.push_back(std::move(name));
    }
    return pages;
}

Result<std::vector<std::byte>> DocumentReader::page(const char* table, std::int64_t part, const scene::PageName& name) {
    const std::string where = path_ + ": " + table + " " + std::to_string(name.number) + " of " + name.kind;
    Result<Statement> read = database_->prepare("SELECT bytes, crc, data FROM " + std::string(table) +
                                                " WHERE part = ? AND kind = ? AND number = ?");
    if (!read) return std::unexpected(read.error());
    read->bind(1, part);
    read->bind(2, std::string_view(name.kind));
    read->bind(3, name.number);
    BURIN_TRY(row, read->step());
    if (!row) return fail(where, "is not there");
    const std::int64_t bytes = read->integer(0);
    const std::span<const std::byte> data = read->blob(2);
    if (bytes < 0 || static_cast<std::uint64_t>(bytes) > kMostPageBytes)
        return fail(where, "claims " + std::to_string(bytes) + " bytes");
    const auto size = static_cast<std::size_t>(bytes);
    if (std::int64_t{crc_of(part, name, size, data)} != read->integer(1))
        return fail(where, "its check sum is wrong", "the other pages can still be read");
    return record::decompressed(data, size, where, "the other pages can still be read");
}

Result<void> DocumentReader::count_changes() {
    BURIN_TRY(there, database_->has_table("change"));
    if (!there) return {};
    // Counts the changes and does not trust their numbers: a gap is found when they are applied.
    BURIN_TRY(last, database_->integer("SELECT count(DISTINCT number) FROM change"));
    changes_ = last;
    return {};
}

Result<scene::Pages> DocumentReader::change(const PartPlace& part, std::int64_t number) {
    return numbered("change", part, number);
}

Result<std::optional<scene::Steps>> DocumentReader::steps(const PartPlace& part) {
    for (const char* const table : {"history", "step"}) {
        BURIN_TRY(there, database_->has_table(table));
        if (!there) return std::nullopt;
    }
    BURIN_TRY(read, database_->prepare("SELECT saves, first, done, last, crc FROM history WHERE part = ?"));
    read.bind(1, part.number);
    BURIN_TRY(row, read.step());
    if (!row) return std::nullopt;
    scene::Steps steps{.first = read.integer(1), .done = read.integer(2), .last = read.integer(3)};
    const std::int64_t saves = read.integer(0);
    const bool is_sound = std::int64_t{crc_of(part.number, saves, steps)} == read.integer(4) &&
                          steps.first >= -kFarthestStep && steps.first <= steps.done + 1 && steps.done <= steps.last &&
                          steps.last <= kFarthestStep;
    if (!is_sound) return fail(path_ + ": the history of " + part.kind, "is damaged");
    if (saves != number(kSavesFact)) return std::nullopt;
    return steps;
}

Result<scene::Pages> DocumentReader::step(const PartPlace& part, std::int64_t number) {
    Result<scene::Pages> pages = numbered("step", part, number);
    if (pages && pages->pages.empty())
        return fail(path_ + ": step " + std::to_string(number) + " of " + part.kind, "is not there");
    return pages;
}

Result<scene::Pages> DocumentReader::numbered(const char* table, const PartPlace& part, std::int64_t number) {
    BURIN_TRY(read, database_->prepare("SELECT kind FROM " + std::string(table) +
                                       " WHERE part = ? AND number = ? AND length(kind) <= 1000 LIMIT 1000"));
    read.bind(1, part.number);
    read.bind(2, number);
    std::vector<std::string> kinds;
    Result<bool> row = read.step();
    for (; row && *row; row = read.step()) kinds.push_back(read.text(0));
    if (!row) return std::unexpected(row.error());
    scene::Pages pages{.part = part.kind, .whole = false};
    for (std::string& kind : kinds) {
        BURIN_TRY(bytes, page(table, part.number, {kind, number}));
        pages.pages[{std::move(kind), 0}] = std::move(bytes);
    }
    return pages;
}

Result<std::optional<History>> DocumentReader::history() {
    const PartPlace own{.number = kHistoryPart, .kind = kOrderPage};
    BURIN_TRY(there, steps(own));
    if (!there) return std::nullopt;
    BURIN_TRY(pages, step(own, kHistoryStep));
    return history_in(pages);
}

Result<std::optional<History>> DocumentReader::history_after(std::int64_t change) {
    BURIN_TRY(pages, numbered("change", {.number = kHistoryPart, .kind = kOrderPage}, change));
    if (pages.pages.empty()) return std::nullopt;
    return history_in(pages);
}

Result<std::optional<History>> DocumentReader::history_in(const scene::Pages& pages) const {
    const std::vector<std::byte>* const bytes = pages.find({kOrderPage, 0});
    std::optional<History> read = bytes != nullptr ? History::from(*bytes) : std::nullopt;
    if (!read) return fail(path_ + ": the order of its steps", "is damaged");
    return read;
}

Result<scene::Pages> DocumentReader::pages_of(std::string_view kind) {
    const auto at = std::ranges::find(parts_, kind, &PartPlace::kind);
    if (at == parts_.end())
        return fail(path_, "holds no " + std::string(kind), "open it with the program that has saved it");
    return pages(*at);
}

}  // namespace burin::document
