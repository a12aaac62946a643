// SPDX-License-Identifier: MIT
// Reads a document, whatever is in it. The file is never changed.
//
// Bad input: not SQLite, another program's, a newer version, truncated or damaged, tables that are views, huge claims:
// an Error, with the remedy. A page is checked when it is read; one that cannot be read is named among the damaged
// ones, and the others are there. A statement that takes too long is interrupted.
// Memory: the pages of the part that is read. Threads: one at a time.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "document/document_file.hpp"
#include "document/document_store.hpp"
#include "record/database.hpp"

namespace burin::document {

struct PartPlace {
    std::int64_t number = 0;
    std::string kind;
    std::uint64_t pages = 0, bytes = 0, data_bytes = 0;  // bytes: of the pages; data_bytes: as they lie in the file
};

class DocumentReader {
public:
    [[nodiscard]] static Result<DocumentReader> open(const std::string& path);

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const std::map<std::string, std::string>& facts() const { return facts_; }
    // Returns the fact's value; empty where there is none.
    [[nodiscard]] std::string fact(const std::string& key) const;
    // Returns the fact's value as a number; 0 where there is none.
    [[nodiscard]] std::int64_t number(const std::string& key) const;
    [[nodiscard]] const std::vector<std::string>& commands() const { return commands_; }
    [[nodiscard]] const std::vector<PartPlace>& parts() const { return parts_; }
    [[nodiscard]] Version version() const;
    // Reads, checks and unpacks the pages of a part.
    [[nodiscard]] Result<scene::Pages> pages(const PartPlace& part);
    // Returns how many changes of the work follow its pages (document/journal.hpp), and the pages of one, each numbered
    // 0; number counts from 1. Fails where a page of it is damaged.
    [[nodiscard]] std::int64_t changes() const { return changes_; }
    [[nodiscard]] Result<scene::Pages> change(const PartPlace& part, std::int64_t number);
    // Returns which steps back and forward a part's pages have, without their pages; nothing where there are none, or
    // where a program that knows nothing of them has saved since. Fails where that is damaged.
    [[nodiscard]] Result<std::optional<scene::Steps>> steps(const PartPlace& part);
    // Returns the pages of a step, each numbered 0. Fails where one of them is damaged, or there is none.
    [[nodiscard]] Result<scene::Pages> step(const PartPlace& part, std::int64_t number);
    // Returns the order of all parts' steps as the pages are, or as it was after a change; nothing where none is there,
    // as in older documents, or where it is not of this save. Fails where it is damaged.
    [[nodiscard]] Result<std::optional<History>> history();
    [[nodiscard]] Result<std::optional<History>> history_after(std::int64_t change);
    // Reads those of the first part of a kind.
    [[nodiscard]] Result<scene::Pages> pages_of(std::string_view kind);

private:
    [[nodiscard]] Result<void> check_tables();
    [[nodiscard]] Result<void> read_facts();
    [[nodiscard]] Result<void> read_commands();
    [[nodiscard]] Result<void> read_parts();
    [[nodiscard]] Result<void> count_changes();
    [[nodiscard]] Result<std::optional<History>> history_in(const scene::Pages& pages) const;
    [[nodiscard]] Result<scene::Pages> numbered(const char* table, const PartPlace& part, std::int64_t number);
    [[nodiscard]] Result<std::vector<std::byte>> page(const char* table, std::int64_t part,
                                                      const scene::PageName& name);

    std::string path_;
    std::optional<record::Database> database_;
    std::map<std::string, std::string> facts_;
    std::vector<std::string> commands_;
    std::vector<PartPlace> parts_;
    std::int64_t changes_ = 0;
};

}  // namespace burin::document
