// SPDX-License-Identifier: MIT
#include "app/cli/recorded_files.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "base/json.hpp"
#include "record/export/table_export.hpp"
#include "record/record_reader.hpp"
#include "session/record/input_files.hpp"
#include "session/record/session_log.hpp"
#include "session/state/session_settings.hpp"

namespace burin::app {
namespace {

constexpr std::size_t kMostHeadBytes = 1 << 16;  // of a text log's first line

// Collects what a recording's options, facts and settings name, each by its word: a world with all that it reads.
class NamedFiles {
public:
    void file(const std::string& path) { files_.file(path); }
    void add(std::string_view word, const std::string& name) {
        if (word == "world") {
            files_.world(name);
        } else if (word == "workpiece" || word == "source") {
            if (!name.starts_with("block:") && !name.starts_with("ball:")) files_.mesh(name);
        } else if (word == "tool" || word == "shape") {
            files_.tool(name);
        } else if (word == "device") {
            files_.device(name);
        } else {
            files_.file(name);
        }
    }
    void add_settings(const std::string& line) {
        for (const std::string word : {"world", "workpiece", "tool", "wall", "device"})
            if (const auto name = session::option_on(line, "--" + word)) add(word, *name);
    }
    // Of settings in JSON, and of their parts.
    void add_json(const Json& json) {
        add_keys(json);
        if (json.is_object())
            for (const Json& part : json) add_keys(part);
    }
    [[nodiscard]] const std::vector<std::string>& list() const { return files_.list(); }

private:
    void add_keys(const Json& json) {
        if (!json.is_object()) return;
        for (const char* key : {"source", "shape", "stroke", "world", "device"})
            if (json.contains(key) && json[key].is_string()) add(key, json[key].get<std::string>());
    }
    session::InputFiles files_;
};

std::vector<std::string> named_by_session_file(const std::string& path) {
    NamedFiles files;
    for (const char* beside : {"-wal", "-shm", "-journal"}) files.file(path + beside);
    const Result<record::RecordReader> reader = record::RecordReader::open(path);
    if (!reader) return files.list();
    for (const char* fact : {"world", "workpiece", "stroke", "device"}) files.add(fact, reader->fact(fact));
    files.add_settings(session::settings_on(reader->fact(record::kLogHeaderFact)));
    files.add_json(Json::parse(reader->fact("settings"), nullptr, false));
    return files.list();
}

// Returns the options of a text log's first line; empty where it is no log.
std::string settings_of_text_log(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string head(kMostHeadBytes, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    head.resize(std::min(head.size(), head.find('\n')));
    return head.starts_with("burin-input ") ? session::settings_on(head) : std::string();
}

std::vector<std::string> named_by_text_log(const std::string& path) {
    NamedFiles files;
    if (const std::string settings = settings_of_text_log(path); !settings.empty()) files.add_settings(settings);
    return files.list();
}

// Returns the options of a recording's first line; empty where it is none.
std::string settings_of(const std::string& recording) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(recording, ignored)) return {};
    if (!session::is_database(recording)) return settings_of_text_log(recording);
    const Result<record::RecordReader> reader = record::RecordReader::open(recording);
    return reader ? session::settings_on(reader->fact(record::kLogHeaderFact)) : std::string();
}

}  // namespace

std::vector<std::string> files_named_by(const std::string& recording) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(recording, ignored)) return {};
    return session::is_database(recording) ? named_by_session_file(recording) : named_by_text_log(recording);
}

std::string repeated_activity(const session::SessionSetup& setup) {
    if (setup.record.input.empty() || !setup.record.path.empty() || session::wants_streams(setup.record)) return {};
    return session::activity_on(settings_of(setup.record.input)).value_or("");
}

void leave_to_recording(session::SessionSetup& options, bool world_given) {
    const session::SessionSetup nothing;
    if (!world_given) options.scene.world.clear();
    if (!options.hands.device_given) options.hands.device = nothing.hands.device;
    options.hands.tool.shape = nothing.hands.tool.shape;
}

}  // namespace burin::app
