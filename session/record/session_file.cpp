// SPDX-License-Identifier: MIT
#include "session/record/session_file.hpp"

#include <filesystem>

#include "record/touched_columns.hpp"

namespace burin::session {

bool is_session_file(const std::string& path) { return std::filesystem::path(path).extension() == ".session"; }

std::vector<record::Word> session_row(const haptics::TickRecord& tick, const record::RowShape& shape) {
    std::vector<record::Word> row = record::row_of(tick, shape);
    record::append_touched(tick, shape, row);
    return row;
}

}  // namespace burin::session
