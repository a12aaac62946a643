// SPDX-License-Identifier: MIT
#include "document/document_rows.hpp"

#include <initializer_list>
#include <set>

#include "base/try.hpp"
#include "record/compressed.hpp"

namespace burin::document {
namespace {

using record::Database, record::Statement;

Result<void> put_commands(Database& database, const std::vector<std::string>& commands) {
    BURIN_TRY_DO(database.run("DELETE FROM command"));
    BURIN_TRY(put, database.prepare("INSERT INTO command(text) VALUES(?)"));
    for (const std::string& text : commands) {
        put.bind(1, std::string_view(text));
        BURIN_TRY_DO(put.run());
    }
    return {};
}

Result<void> put_part(Database& database, std::int64_t number, const scene::Pages& part, Saved& saved) {
    BURIN_TRY(row, database.prepare("INSERT OR REPLACE INTO part VALUES(?, ?)"));
    row.bind(1, number);
    row.bind(2, std::string_view(part.part));
    BURIN_TRY_DO(row.run());
    for (const auto& [name, bytes] : part.pages)
        BURIN_TRY_DO(put_page(database, Table::page, number, name, bytes, saved));
    return {};
}

Result<void> run_with(Database& database, const char* text, std::initializer_list<std::int64_t> numbers) {
    BURIN_TRY(run, database.prepare(text));
    int at = 0;
    for (const std::int64_t number : numbers) run.bind(++at, number);
    return run.run();
}

// Says which steps there are, of which save: a program that knows nothing of them saves without, and they are void.
Result<void> put_history(Database& database, std::int64_t part, const scene::Steps& steps, const Saved& saved) {
    return run_with(database, "INSERT OR REPLACE INTO history VALUES(?, ?, ?, ?, ?, ?)",
                    {part, saved.version.saves, steps.first, steps.done, steps.last,
                     std::int64_t{crc_of(part, saved.version.saves, steps)}});
}

Result<void> drop_steps(Database& database, std::int64_t part) {
    BURIN_TRY_DO(run_with(database, "DELETE FROM step WHERE part = ?", {part}));
    return run_with(database, "DELETE FROM history WHERE part = ?", {part});
}

const char* name_of(Table table) { return table == Table::page ? "page" : table == Table::change ? "change" : "step"; }

}  // namespace

Result<void> put_steps(Database& database, std::int64_t part, const scene::Steps& steps, Saved& saved) {
    BURIN_TRY_DO(run_with(database, "DELETE FROM step WHERE part = ? AND (number < ? OR number > ?)",
                          {part, steps.first, steps.last}));
    std::set<std::int64_t> renewed;
    for (const auto& [name, bytes] : steps.pages) renewed.insert(name.number);
    for (const std::int64_t number : renewed)
        BURIN_TRY_DO(run_with(database, "DELETE FROM step WHERE part = ? AND number = ?", {part, number}));
    for (const auto& [name, bytes] : steps.pages) {
        if (name.number < steps.first || name.number > steps.last) continue;
        BURIN_TRY_DO(put_page(database, Table::step, part, name, bytes, saved));
    }
    return put_history(database, part, steps, saved);
}

Result<void> put_fact(Database& database, const std::string& key, const std::string& value) {
    BURIN_TRY(fact, database.prepare("INSERT OR REPLACE INTO meta VALUES(?, ?)"));
    fact.bind(1, std::string_view(key));
    fact.bind(2, std::string_view(value));
    return fact.run();
}

Result<void> put_page(Database& database, Table table, std::int64_t part, const scene::PageName& name,
                      const std::vector<std::byte>& bytes, Saved& saved) {
    BURIN_TRY(put, database.prepare("INSERT INTO " + std::string(name_of(table)) +
                                    " VALUES(?1, ?2, ?3, ?4, ?5, ?6) ON CONFLICT(part, kind, number) DO "
                                    "UPDATE SET bytes = ?4, crc = ?5, data = ?6"));
    BURIN_TRY(data, record::compressed(bytes));
    put.bind(1, part);
    put.bind(2, std::string_view(name.kind));
    put.bind(3, name.number);
    put.bind(4, static_cast<std::int64_t>(bytes.size()));
    put.bind(5, std::int64_t{crc_of(part, name, bytes.size(), data)});
    put.bind(6, std::span<const std::byte>(data));
    ++saved.pages;
    saved.page_bytes += data.size();
    return put.run();
}

Result<void> put_content(Database& database, const Content& content, Saved& saved) {
    for (const auto& [key, value] : content.facts) BURIN_TRY_DO(put_fact(database, key, value));
    BURIN_TRY_DO(put_commands(database, content.commands));
    BURIN_TRY_DO(database.run(history_tables()));
    for (std::size_t part = 0; part < content.parts.size(); ++part) {
        const auto number = static_cast<std::int64_t>(part);
        const scene::Pages& pages = content.parts[part];
        BURIN_TRY_DO(put_part(database, number, pages, saved));
        const auto kept = pages.steps ? put_steps(database, number, *pages.steps, saved) : drop_steps(database, number);
        if (!kept) return kept;
    }
    if (!content.history) return drop_steps(database, kHistoryPart);
    scene::Steps order{.first = kHistoryStep, .done = kHistoryStep, .last = kHistoryStep};
    order.pages[{kOrderPage, kHistoryStep}] = content.history->bytes();
    return put_steps(database, kHistoryPart, order, saved);
}

}  // namespace burin::document
