// SPDX-License-Identifier: MIT
#include "record/chain.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <set>
#include <span>
#include <string_view>

#include "base/sha256.hpp"

namespace burin::record {
namespace {

// What is hashed of a table: rows by their id.
struct Chained {
    const char* table;
    const char* one;  // in messages
    std::int64_t ChainLink::* last;
    const char* columns;  // the first is the id
    int count;            // of columns
};
constexpr std::array<Chained, 5> kChained{{
    {"block", "block", &ChainLink::block, "id, hand, tick0, rows, t0_ns, crc, data", 7},
    {"line", "line", &ChainLink::line, "id, time_ns, text", 3},
    {"event", "event", &ChainLink::event, "id, time_ns, trial, name, value", 5},
    {"trial", "trial", &ChainLink::trial, "id, name, begun_ns", 3},
    {"clock", "time of the clocks", &ChainLink::clock, "id, mono_ns, utc_ns", 3},
}};

// The names of what a recording holds, which its first link covers.
struct Named {
    const char* sql;
    int count;
};
constexpr std::array<Named, 3> kNamed{{
    {"SELECT hand, name FROM hand ORDER BY hand", 2},
    {"SELECT hand, position, name, unit, frame, type FROM column ORDER BY hand, position", 6},
    {"SELECT number, name FROM object WHERE part = '' ORDER BY number", 2},
}};

constexpr std::size_t kMostFaults = 20;
constexpr std::int64_t kMostLinks = 4'000'000;  // a month of a transaction a second

// A value as its type, its length and its bytes.
void write_value(std::string& out, const Statement& row, int column) {
    if (row.is_nothing(column)) {
        out += "n;";
    } else if (row.is_integer(column)) {
        out += "i" + std::to_string(row.integer(column)) + ";";
    } else {
        const std::span<const std::byte> bytes = row.blob(column);
        out += "b" + std::to_string(bytes.size()) + ":";
        out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
}

Result<std::int64_t> write_rows(std::string& out, Statement& rows, int count) {
    std::int64_t written = 0;
    Result<bool> row = rows.step();
    for (; row && *row; row = rows.step(), ++written) {
        for (int c = 0; c < count; ++c) write_value(out, rows, c);
        out += '\n';
    }
    if (!row) return std::unexpected(row.error());
    return written;
}

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

// Rows that a link should cover and that are not there.
struct Missing {
    const char* one = "";
    std::int64_t expected = 0, found = 0;
};

// Writes out what a link covers.
class CoveredRows {
public:
    CoveredRows(Database& database, const ChainLink& before, const ChainLink& link)
        : database_(database), before_(before), link_(link) {}

    Result<std::string> digest() {
        out_ = before_.digest + "\n";
        for (const Chained& table : kChained)
            if (const auto done = write_table(table); !done) return std::unexpected(done.error());
        if (const auto done = write_ends(); !done) return std::unexpected(done.error());
        if (before_.id == 0)
            if (const auto done = write_names(); !done) return std::unexpected(done.error());
        if (const auto done = write_facts(); !done) return std::unexpected(done.error());
        return sha256(out_);
    }
    [[nodiscard]] const std::vector<Missing>& missing() const { return missing_; }

private:
    Result<void> write_table(const Chained& table) {
        const std::int64_t from = before_.*table.last, to = link_.*table.last;
        Result<Statement> rows = database_.prepare("SELECT " + std::string(table.columns) + " FROM " + table.table +
                                                   " WHERE id > ? AND id <= ? ORDER BY id");
        if (!rows) return std::unexpected(rows.error());
        rows->bind(1, from);
        rows->bind(2, to);
        out_ += std::string(table.table) + "\n";
        const Result<std::int64_t> written = write_rows(out_, *rows, table.count);
        if (!written) return std::unexpected(written.error());
        if (*written != to - from) missing_.push_back({table.one, to - from, *written});
        return {};
    }

    Result<void> write_ends() {
        out_ += "ended\n";
        for (const std::string_view id : lines_of(link_.ended)) {
            std::int64_t number = 0;
            std::from_chars(id.data(), id.data() + id.size(), number);
            Result<Statement> row = database_.prepare("SELECT id, ended_ns, state FROM trial WHERE id = ?");
            if (!row) return std::unexpected(row.error());
            row->bind(1, number);
            if (const auto done = write_rows(out_, *row, 3); !done) return std::unexpected(done.error());
        }
        return {};
    }

    Result<void> write_names() {
        for (const Named& named : kNamed) {
            Result<Statement> rows = database_.prepare(named.sql);
            if (!rows) return std::unexpected(rows.error());
            out_ += "names\n";
            if (const auto done = write_rows(out_, *rows, named.count); !done) return std::unexpected(done.error());
        }
        return {};
    }

    Result<void> write_facts() {
        out_ += "facts\n";
        for (const std::string_view key : lines_of(link_.facts)) {
            Result<Statement> row = database_.prepare("SELECT key, value FROM meta WHERE key = ?");
            if (!row) return std::unexpected(row.error());
            row->bind(1, key);
            const Result<std::int64_t> written = write_rows(out_, *row, 2);
            if (!written) return std::unexpected(written.error());
            if (*written != 1) missing_.push_back({"fact", 1, *written});
        }
        return {};
    }

    Database& database_;
    const ChainLink &before_, &link_;
    std::string out_;
    std::vector<Missing> missing_;
};

Result<std::int64_t> last_row(Database& database, const char* table) {
    return database.integer("SELECT coalesce(max(id), 0) FROM " + std::string(table));
}

template <typename Values>
std::string a_line_each(const Values& values) {
    std::string text;
    for (const auto& value : values) {
        if constexpr (requires { std::to_string(value); })
            text += std::to_string(value) + "\n";
        else
            text += value + "\n";
    }
    return text;
}

ChainLink link_in(const Statement& row) {
    return {row.integer(0), row.integer(1), row.integer(2), row.integer(3), row.integer(4),
            row.integer(5), row.text(6),    row.text(7),    row.text(8)};
}

std::string place_of(Database& database, const ChainLink& before, const ChainLink& link) {
    if (before.id == 0) return "at the beginning, where facts, hands, columns and objects are named";
    Result<Statement> row = database.prepare("SELECT min(t0_ns) FROM block WHERE id > ? AND id <= ?");
    if (row) {
        row->bind(1, before.block);
        row->bind(2, link.block);
        const Result<bool> there = row->step();
        if (there && *there && !row->is_nothing(0))
            return "in the second from time_ns " + std::to_string(row->integer(0));
    }
    return "in transaction " + std::to_string(link.id);
}

std::string fault_of(Database& database, const ChainLink& before, const ChainLink& link,
                     const std::vector<Missing>& missing) {
    const std::string place = place_of(database, before, link);
    for (const Missing& rows : missing)
        return place + ": " + std::to_string(rows.found) + " of " + std::to_string(rows.expected) + " " + rows.one +
               (rows.expected == 1 ? " is" : "s are") + " there";
    return place + ": something was changed since it was recorded";
}

// What lies beyond the last link was not written by the recorder.
Result<void> look_beyond(Database& database, const ChainLink& last, ChainExamination& found) {
    for (const Chained& table : kChained) {
        const Result<std::int64_t> row = last_row(database, table.table);
        if (!row) return std::unexpected(row.error());
        if (*row > last.*table.last)
            found.faults.push_back("at the end: a " + std::string(table.one) + " was added since it was recorded");
    }
    const Result<std::int64_t> ended = database.integer("SELECT count(*) FROM meta WHERE key = 'end'");
    if (!ended) return std::unexpected(ended.error());
    if (*ended > 0 && last.facts.find("end\n") == std::string::npos)
        found.faults.push_back("at the end: the last transactions are gone, though the recording says that it ended");
    return {};
}

// Facts that no link covers; those of derived tables are written later (derived.hpp).
Result<void> look_for_facts(Database& database, const std::set<std::string>& covered, ChainExamination& found) {
    Result<Statement> keys = database.prepare("SELECT key FROM meta WHERE key NOT LIKE 'derived %' LIMIT 100000");
    if (!keys) return std::unexpected(keys.error());
    Result<bool> row = keys->step();
    for (; row && *row; row = keys->step())
        if (!covered.contains(keys->text(0)))
            found.faults.push_back("fact '" + keys->text(0).substr(0, 60) + "' was added since it was recorded");
    if (!row) return std::unexpected(row.error());
    return {};
}

Result<bool> has_chain(Database& database) {
    const Result<std::int64_t> count =
        database.integer("SELECT count(*) FROM sqlite_schema WHERE name = 'chain' AND type = 'table' AND rootpage > 0");
    if (!count) return std::unexpected(count.error());
    return *count == 1;
}

}  // namespace

const char* chain_table() {
    return R"(
CREATE TABLE chain(id INTEGER PRIMARY KEY, block INTEGER NOT NULL, line INTEGER NOT NULL, event INTEGER NOT NULL,
    trial INTEGER NOT NULL, clock INTEGER NOT NULL, ended TEXT NOT NULL, facts TEXT NOT NULL, digest TEXT NOT NULL);
)";
}

Result<void> ChainWriter::add(Database& database, const std::vector<std::string>& facts,
                              const std::vector<std::int64_t>& ended_trials) {
    next_ = {};
    next_.id = last_.id + 1;
    next_.ended = a_line_each(ended_trials);
    next_.facts = a_line_each(facts);
    for (const Chained& table : kChained) {
        const Result<std::int64_t> row = last_row(database, table.table);
        if (!row) return std::unexpected(row.error());
        next_.*table.last = *row;
    }
    const Result<std::string> digest = CoveredRows(database, last_, next_).digest();
    if (!digest) return std::unexpected(digest.error());
    next_.digest = *digest;
    Result<Statement> link = database.prepare("INSERT INTO chain VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?)");
    if (!link) return std::unexpected(link.error());
    int at = 0;
    for (const std::int64_t number : {next_.id, next_.block, next_.line, next_.event, next_.trial, next_.clock})
        link->bind(++at, number);
    for (const std::string* text : {&next_.ended, &next_.facts, &next_.digest})
        link->bind(++at, std::string_view(*text));
    return link->run();
}

Result<ChainExamination> examine_chain(Database& database) {
    ChainExamination found;
    const Result<bool> there = has_chain(database);
    if (!there) return std::unexpected(there.error());
    found.is_there = *there;
    if (!*there) return found;
    Result<Statement> links = database.prepare(
        "SELECT id, block, line, event, trial, clock, ended, facts, digest FROM chain ORDER BY id LIMIT " +
        std::to_string(kMostLinks));
    if (!links) return std::unexpected(links.error());
    ChainLink before;
    std::set<std::string> facts;
    Result<bool> row = links->step();
    for (; row && *row && found.faults.size() < kMostFaults; row = links->step()) {
        const ChainLink link = link_in(*links);
        ++found.links;
        if (link.id != before.id + 1)
            found.faults.push_back("before transaction " + std::to_string(link.id) + ": " +
                                   std::to_string(link.id - before.id - 1) + " transactions are gone");
        CoveredRows covered(database, before, link);
        const Result<std::string> digest = covered.digest();
        if (!digest) return std::unexpected(digest.error());
        if (*digest != link.digest && link.id == before.id + 1)
            found.faults.push_back(fault_of(database, before, link, covered.missing()));
        for (const std::string_view key : lines_of(link.facts)) facts.emplace(key);
        before = link;
    }
    if (!row) return std::unexpected(row.error());
    found.last_digest = before.digest;
    if (found.links == 0) found.faults.emplace_back("at the beginning: the chain of digests is empty");
    if (const auto looked = look_beyond(database, before, found); !looked) return std::unexpected(looked.error());
    if (const auto looked = look_for_facts(database, facts, found); !looked) return std::unexpected(looked.error());
    return found;
}

Result<std::string> last_digest(Database& database) {
    const Result<bool> there = has_chain(database);
    if (!there) return std::unexpected(there.error());
    if (!*there) return std::string();
    return database.text("SELECT coalesce((SELECT digest FROM chain ORDER BY id DESC LIMIT 1), '')");
}

}  // namespace burin::record
