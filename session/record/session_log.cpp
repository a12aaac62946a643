// SPDX-License-Identifier: MIT
#include "session/record/session_log.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "record/export/table_export.hpp"
#include "session/record/session_file.hpp"

namespace burin::session {

bool is_database(const std::string& path) {
    constexpr std::string_view kBegins = "SQLite format 3";
    std::array<char, kBegins.size()> begins{};
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return false;  // a pipe would be waited for
    std::ifstream file(path, std::ios::binary);
    file.read(begins.data(), begins.size());
    return file && std::string_view(begins.data(), begins.size()) == kBegins;
}

Result<InputLog> read_session_log(record::RecordReader& reader) {
    const auto& facts = reader.facts();
    const auto header = facts.find(record::kLogHeaderFact);
    if (header == facts.end())
        return fail(reader.path(), "holds no log of a live session",
                    "name one that burin world --record or burin sculpt --record has written without a --stroke");
    std::string text = header->second + "\n";
    const auto read = reader.each_line([&](std::int64_t, const std::string& line) { text.append(line).append("\n"); });
    if (!read) return std::unexpected(read.error());
    Result<InputLog> log = parse_input_log(text, reader.path());
    if (!log) return log;
    if (const auto device = facts.find(kDeviceFact); device != facts.end()) log->device = device->second;
    return log;
}

}  // namespace burin::session
