// SPDX-License-Identifier: MIT
#include "document/document_rows.hpp"

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
    Result<Statement> put = database.prepare("INSERT INTO " + std::string(table == Table::page ? "page" : "change") +
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
    for (std::size_t part = 0; part < content.parts.size(); ++part)
        if (const auto done = put_part(database, static_cast<std::int64_t>(part), content.parts[part], saved); !done)
            return done;
    return {};
}

}  // namespace burin::document
