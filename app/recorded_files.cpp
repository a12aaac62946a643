// SPDX-License-Identifier: MIT
#include "app/recorded_files.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "app/recorded_device.hpp"
#include "base/json.hpp"
#include "session/record/session_log.hpp"
#include "session/state/session_settings.hpp"

namespace burin::app {
namespace {

constexpr std::size_t kMostHeadBytes = 1 << 16;  // of a text log's first line

// Collects names of files; words such as "mesh:FILE" and "simulated-wand:FILE" name one as well.
class NamedFiles {
public:
    void add(std::string name) {
        for (const std::string_view kind : {"mesh:", "simulated-wand:"})
            if (name.starts_with(kind)) name.erase(0, kind.size());
        if (!name.empty()) names_.push_back(std::move(name));
    }
    void add_settings(const std::string& line) {
        for (const char* option : {"--world", "--workpiece", "--tool", "--wall", "--device"})
            if (auto name = session::option_on(line, option)) add(std::move(*name));
    }
    // Of settings in JSON, and of their parts.
    void add_json(const Json& json) {
        add_keys(json);
        if (json.is_object())
            for (const Json& part : json) add_keys(part);
    }
    [[nodiscard]] std::vector<std::string> take() { return std::move(names_); }

private:
    void add_keys(const Json& json) {
        if (!json.is_object()) return;
        for (const char* key : {"source", "shape", "stroke", "world", "device"})
            if (json.contains(key) && json[key].is_string()) add(json[key].get<std::string>());
    }
    std::vector<std::string> names_;
};

std::vector<std::string> named_by_session_file(const std::string& path) {
    NamedFiles files;
    for (const char* beside : {"-wal", "-shm", "-journal"}) files.add(path + beside);
    const Result<record::RecordReader> reader = record::RecordReader::open(path);
    if (!reader) return files.take();
    for (const char* fact : {"world", "workpiece", "stroke", "device"}) files.add(fact_of(*reader, fact));
    files.add_settings(live_settings_of(*reader));
    files.add_json(Json::parse(fact_of(*reader, "settings"), nullptr, false));
    return files.take();
}

std::vector<std::string> named_by_text_log(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string head(kMostHeadBytes, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    head.resize(std::min(head.size(), head.find('\n')));
    NamedFiles files;
    const std::size_t settings = head.find("burin sculpt");
    if (head.starts_with("burin-input ") && settings != std::string::npos) files.add_settings(head.substr(settings));
    return files.take();
}

}  // namespace

std::vector<std::string> files_named_by(const std::string& recording) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(recording, ignored)) return {};
    return session::is_database(recording) ? named_by_session_file(recording) : named_by_text_log(recording);
}

}  // namespace burin::app
