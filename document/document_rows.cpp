// SPDX-License-Identifier: MIT
#include "document/document_rows.hpp"

#include <initializer_list>
#include <set>

#include "record/compressed.hpp"

namespace burin::document {
namespace {

using record::Database, record::Statement;

Result<void> put_commands(Database& database, const std::vector<std::string>& commands) {
    if (const auto gone = database.run("DELETE FROM command"); !gone) return gone;
    Result<Statement> put = database.prepare("INSERT INTO command(text) VALUES(?)");
    if (!put) return std::unexpected(put.error());
    for (const std::string& text : commands) {
        put->bind(1, std::string_view(text));
        if (const auto done = put->run(); !done) return done;
    }
    return {};
}

Result<void> put_part(Database& database, std::int64_t number, const scene::Pages& part, Saved& saved) {
    Result<Statement> row = database.prepare("INSERT OR REPLACE INTO part VALUES(?, ?)");
    if (!row) return std::unexpected(row.error());
    row->bind(1, number);
    row->bind(2, std::string_view(part.part));
    if (const auto done = row->run(); !done) return done;
    for (const auto& [name, bytes] : part.pages)
        if (const auto done = put_page(database, Table::page, number, name, bytes, saved); !done) return done;
    return {};
}

Result<void> run_with(Database& database, const char* text, std::initializer_list<std::int64_t> numbers) {
    Result<Statement> run = database.prepare(text);
    if (!run) return std::unexpected(run.error());
    int at = 0;
    for (const std::int64_t number : numbers) run->bind(++at, number);
    return run->run();
}

// Says which steps there are, of which save: a program that knows nothing of them saves without, and they are void.
Result<void> put_history(Database& database, std::int64_t part, const scene::Steps& steps, const Saved& saved) {
    return run_with(database, "INSERT OR REPLACE INTO history VALUES(?, ?, ?, ?, ?, ?)",
                    {part, saved.version.saves, steps.first, steps.done, steps.last,
                     std::int64_t{crc_of(part, saved.version.saves, steps)}});
}

Result<void> put_steps(Database& database, std::int64_t part, const scene::Steps& steps, Saved& saved) {
    if (const auto gone = run_with(database, "DELETE FROM step WHERE part = ? AND (number < ? OR number > ?)",
                                   {part, steps.first, steps.last});
        !gone)
        return gone;
    std::set<std::int64_t> renewed;
    for (const auto& [name, bytes] : steps.pages) renewed.insert(name.number);
    for (const std::int64_t number : renewed)
        if (const auto gone = run_with(database, "DELETE FROM step WHERE part = ? AND number = ?", {part, number});
            !gone)
            return gone;
    for (const auto& [name, bytes] : steps.pages) {
        if (name.number < steps.first || name.number > steps.last) continue;
        if (const auto done = put_page(database, Table::step, part, name, bytes, saved); !done) return done;
    }
    return put_history(database, part, steps, saved);
}

Result<void> drop_steps(Database& database, std::int64_t part) {
    if (const auto gone = run_with(database, "DELETE FROM step WHERE part = ?", {part}); !gone) return gone;
    return run_with(database, "DELETE FROM history WHERE part = ?", {part});
}

const char* name_of(Table table) { return table == Table::page ? "page" : table == Table::change ? "change" : "step"; }

}  // namespace

Result<void> put_fact(Database& database, const std::string& key, const std::string& value) {
    Result<Statement> fact = database.prepare("INSERT OR REPLACE INTO meta VALUES(?, ?)");
    if (!fact) return std::unexpected(fact.error());
    fact->bind(1, std::string_view(key));
    fact->bind(2, std::string_view(value));
    return fact->run();
}

Result<void> put_page(Database& database, Table table, std::int64_t part, const scene::PageName& name,
                      const std::vector<std::byte>& bytes, Saved& saved) {
    Result<Statement> put = database.prepare("INSERT INTO " + std::string(name_of(table)) +
                                             " VALUES(?1, ?2, ?3, ?4, ?5, ?6) ON CONFLICT(part, kind, number) DO "
                                             "UPDATE SET bytes = ?4, crc = ?5, data = ?6");
    if (!put) return std::unexpected(put.error());
    const Result<std::vector<std::byte>> data = record::compressed(bytes);
    if (!data) return std::unexpected(data.error());
    put->bind(1, part);
    put->bind(2, std::string_view(name.kind));
    put->bind(3, name.number);
    put->bind(4, static_cast<std::int64_t>(bytes.size()));
    put->bind(5, std::int64_t{crc_of(part, name, bytes.size(), *data)});
    put->bind(6, std::span<const std::byte>(*data));
    ++saved.pages;
    saved.page_bytes += data->size();
    return put->run();
}

Result<void> put_content(Database& database, const Content& content, Saved& saved) {
    for (const auto& [key, value] : content.facts)
        if (const auto done = put_fact(database, key, value); !done) return done;
    if (const auto done = put_commands(database, content.commands); !done) return done;
    if (const auto made = database.run(history_tables()); !made) return made;
    for (std::size_t part = 0; part < content.parts.size(); ++part) {
        const auto number = static_cast<std::int64_t>(part);
        const scene::Pages& pages = content.parts[part];
        if (const auto done = put_part(database, number, pages, saved); !done) return done;
        const auto kept = pages.steps ? put_steps(database, number, *pages.steps, saved) : drop_steps(database, number);
        if (!kept) return kept;
    }
    return {};
}

}  // namespace burin::document
