// SPDX-License-Identifier: MIT
// Rows of a document's tables, as documents and journals write them. Within a transaction of the caller's. One thread.
#pragma once

#include <string>
#include <vector>

#include "document/document_file.hpp"
#include "document/document_store.hpp"

namespace burin::document {

enum class Table : std::uint8_t { page, change, step };

// Puts facts, commands, pages and steps of histories in the place of those that are there; what the content does not
// name stays, but for the history of a part that has none. saved.version: the one that this is.
[[nodiscard]] Result<void> put_content(record::Database& database, const Content& content, Saved& saved);
// Compresses and puts one page, or one page of a change or of a step.
[[nodiscard]] Result<void> put_page(record::Database& database, Table table, std::int64_t part,
                                    const scene::PageName& name, const std::vector<std::byte>& bytes, Saved& saved);
// Puts the steps that are new in the place of those that are there, and says which there are. saved.version: of which
// save.
[[nodiscard]] Result<void> put_steps(record::Database& database, std::int64_t part, const scene::Steps& steps,
                                     Saved& saved);
[[nodiscard]] Result<void> put_fact(record::Database& database, const std::string& key, const std::string& value);

}  // namespace burin::document
